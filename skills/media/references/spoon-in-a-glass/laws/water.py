"""The water of the tumbler, which the spoon takes along."""

from worldkit.matter import Stirred, Vessel

INSIDE = [(0, 0.01), (0.035, 0.01), (0.0375, 0.012), (0.041, 0.104)]  # m: of the tumbler's profile


class Water(Stirred):
    """Water at rest, with a little foam, and motes in it."""

    name, bodies, shown_by = "water", ("spoon", "world"), "water"

    def __init__(self, water_density, water_viscosity, water_level):
        super().__init__(Vessel(INSIDE), water_level, water_density, water_viscosity)
