"""The spoonful: it lies in the bowl of the spoon, clear of the wall and of the rim, and is free from the start."""

import numpy as np

from worldkit.matter import Liquid, Matter, within

RIM = np.array((0.014, 0.0, 0.145))  # m: the middle of the rim of the bowl
HALF, UNDER = (
    np.array((0.0232, 0.0232, 0.0212)),
    0.0005,
)  # m: half axes of the room in it; from the rim down to the honey


def spoonful(points):
    """Whether points lie in the spoonful."""
    return (((points - RIM) / HALF) ** 2).sum(axis=1) <= 1.0


class Honey(Matter):
    """A spoonful of warm honey. It does not stick: on a grid this coarse the rim would hold it back; how soon it runs, the servo says."""

    name, bodies, shown_by = "honey", ("spoon", "jar", "world"), "honey"

    def __init__(self, honey_density, honey_viscosity, spacing=0.0028):
        begins = within(spoonful, RIM - HALF, RIM + HALF * (1, 1, 0) - (0, 0, UNDER))
        super().__init__(
            Liquid(honey_density, honey_viscosity, sound=4.0, sticks=False, threads=True), spacing, begins=[begins]
        )
