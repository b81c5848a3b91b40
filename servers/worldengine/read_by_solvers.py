"""What solvers beside the engine read of the shapes of a world, in arrays: for whoever compares two worlds, by the solvers' own code."""

import mujoco
import numpy as np


def told(model: mujoco.MjModel) -> dict[str, np.ndarray]:
    """The arrays by their names."""
    return {
        "body_surface": _surfaces(model),
        "body_bore": _bores(model),
        "flex_water": np.array([_water(model, flex) for flex in range(model.nflex)]).reshape(-1, 5),
    }


def _surfaces(model: mujoco.MjModel) -> np.ndarray:
    """(nbody,) m^2: what each body cools over; 0 without geoms."""
    from worldkit.fields.surface_area import of_body

    found = np.zeros(model.nbody)
    for body in np.unique(model.geom_bodyid):
        found[body] = of_body(model, int(body))
    return found


def _bores(model: mujoco.MjModel) -> np.ndarray:
    """(nbody, 9) m: of each body that is a straight tube its radii, its length, its axis and its middle, in the body's frame; else 0."""
    from worldkit.fields import bores

    found = np.zeros((model.nbody, 9))
    for body in np.unique(model.geom_bodyid):
        if (tube := bores.of_geoms(model, bores.solid(model, int(body)))) is not None:
            found[body] = (tube.inner, tube.outer, tube.length, *tube.turn[:, 2], *tube.middle)
    return found


def _water(model: mujoco.MjModel, flex: int) -> np.ndarray:
    """(5,) m, m^2: level, floor, area and middle of the water that a flex shows, world frame; 0 of a flex that shows none."""
    from worldkit.errors import ProgramError
    from worldkit.polygons import area

    from .waves.shown_water import ShownWater

    first = model.flex_vertadr[flex]
    if model.flex_vertbodyid[first : first + model.flex_vertnum[flex]].any():
        return np.zeros(5)  # it moves by itself
    try:
        drawn = ShownWater(model, flex)
    except ProgramError:
        return np.zeros(5)
    return np.array([drawn.level, drawn.floor, area(drawn.outline), *drawn.outline.mean(axis=0)])
