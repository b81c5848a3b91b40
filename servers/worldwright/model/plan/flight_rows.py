"""A drone as a row of a plan: where it flies, and what gusts blow at it."""

from itertools import pairwise

from pydantic import Field, field_validator, model_validator

from worldkit.robots.drones import DRONES

from ..frozen import Frozen

Point = tuple[float, float, float]


class Gusting(Frozen):
    """Wind that changes, the same at every repetition."""

    mean_m_s: Point = (0.0, 0.0, 0.0)
    """The wind that it changes about, towards X, Y and Z."""
    strength_m_s: float = Field(gt=0, le=20)
    """The root of the mean square of each part of what comes and goes."""
    source: str
    """What wind that is."""

    @property
    def law(self) -> str:
        """What acts."""
        return (
            f"a wind of {', '.join(f'{part:g}' for part in self.mean_m_s)} m/s that gusts with {self.strength_m_s:g} m/s pushes it: the drone's "
            "measured drag coefficients times the air's velocity past it"
        )


class Flies(Frozen):
    """Points that a drone flies through, and how long it hovers."""

    drone: str
    """Which drone the model is: cf21b."""
    through: tuple[Point, ...] = Field(min_length=1)
    """Points in the world, m, one after the other; it hovers at the last."""
    speed_m_s: float = Field(0.5, gt=0, le=2)
    """The most on its way."""
    hover_s: float = Field(1.0, ge=0, allow_inf_nan=False)
    """How long it waits at each."""
    gusts: Gusting | None = None

    @field_validator("drone")
    @classmethod
    def _known(cls, drone: str) -> str:
        if drone not in DRONES:
            raise ValueError(f"there is no drone `{drone}`; there are: {', '.join(sorted(DRONES))}")
        return drone

    @model_validator(mode="after")
    def _apart(self) -> "Flies":
        if any(a == b for a, b in pairwise(self.through)):
            raise ValueError("two points of `through` that follow one another are one: `hover_s` lets it wait there")
        return self

    def driven(self, name: str) -> dict[str, str]:
        """The rotors of a drone in the world, each with the joint by which it moves."""
        return {f"{name}_{rotor.name}": name for rotor in DRONES[self.drone].rotors}

    @property
    def law(self) -> str:
        """What acts."""
        drone = DRONES[self.drone]
        return (
            f"thrust of each rotor along its axis, 0 to {drone.most_n:g} N, with {drone.drag_m:g} N·m of torque about it for each N, by position "
            f"and attitude control through {len(self.through)} points at {self.speed_m_s:g} m/s"
        )

    @property
    def source(self) -> str:
        """Where that is from."""
        return "flies.through"
