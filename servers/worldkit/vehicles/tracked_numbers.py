"""The numbers of a tracked vehicle: road wheels in two rows, those of a side turned by one sprocket and held at one speed by their belt."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from .axles import Axle
from .car_numbers import Car

if TYPE_CHECKING:
    from .axles import Vec3


@dataclass(frozen=True)
class Tracked(Car):
    """A tracked vehicle that is steered by the difference of its belts' speeds, its wheels skidding sideways.

    The belt touches the ground below each road wheel; what holds these at one speed is the belt. `wheelbase_m` is from the first
    to the last road wheel, `track_m` between the middles of the belts. The defaults are a bulldozer's. Source: J. Y. Wong, Theory
    of Ground Vehicles (2008), chapter 6 (skid steering, contact lengths 1.2 to 1.8 times the track); rolling resistance of tracks
    on firm ground 0.05 (ibid., chapter 2).

    Raises ValueError where no such vehicle can stand.
    """

    wheelbase_m: float = 2.4
    track_m: float = 1.9
    mass_kg: float = 12_000.0
    height_of_mass_m: float = 0.95
    front_share: float = 0.5
    wheel_radius_m: float = 0.29
    tyre_width_m: float = 0.5
    wheel_kg: float = 90.0
    hub_kg: float = 60.0
    stiffness_n_m: float = 260_000.0
    damping_n_s_m: float = 16_000.0
    tyre_friction: float = 0.7
    rolling_resistance: float = 0.05
    driven: Literal["front", "rear", "all"] = "all"
    drive_n_m: float = 40_000.0
    brake_n_m: float = 8_000.0
    steering_deg: float = 40.0
    length_m: float = 4.0
    width_m: float = 2.5
    height_m: float = 2.8
    power_w: float = 140_000.0
    road_wheels: int = 5
    """On each side."""

    word = "tracked vehicle"

    def __post_init__(self) -> None:
        if not 2 <= self.road_wheels <= 12:
            raise ValueError(f"a tracked vehicle has 2 to 12 road_wheels on a side, not {self.road_wheels}")
        super().__post_init__()

    @property
    def axles(self) -> tuple[Axle, ...]:
        """Its pairs of road wheels, `1` in front; their loads rise or fall evenly from one to the next."""
        count, half = self.road_wheels, self.wheelbase_m / 2
        places = [half - 2 * half * i / (count - 1) for i in range(count)]
        tilt = self.ahead_m / sum(x * x for x in places)
        return tuple(Axle(str(i + 1), x, 1 / count + tilt * x, driven=True) for i, x in enumerate(places))

    @property
    def drives(self) -> dict[str, tuple[str, ...]]:
        """A motor for each belt."""
        return {"drive_l": self.corners[::2], "drive_r": self.corners[1::2]}

    @property
    def belts(self) -> tuple[tuple[str, ...], ...]:
        """Left and right."""
        return self.corners[::2], self.corners[1::2]

    @property
    def solids(self) -> "tuple[tuple[str, Vec3, Vec3], ...]":
        """The hull between the belts, the deck above them, and the cab."""
        over, top = 2.2 * self.wheel_radius_m, 0.6 * self.height_m
        inner, low = self.track_m - self.tyre_width_m - 0.06, 0.35
        return (
            ("hull", (self.length_m, inner, over - low), (0, 0, (over + low) / 2)),
            ("deck", (0.94 * self.length_m, self.width_m, top - over), (0, 0, (top + over) / 2)),
            ("cab", (0.35 * self.length_m, 0.6 * self.width_m, self.height_m - top), (-0.15 * self.length_m, 0, (self.height_m + top) / 2)),
        )  # fmt: skip
