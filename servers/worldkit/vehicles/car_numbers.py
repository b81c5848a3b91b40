"""The numbers of a car, and what follows from them."""

from dataclasses import dataclass
from math import radians, tan
from typing import Literal

CORNERS = ("fl", "fr", "rl", "rr")
"""Front left, front right, rear left, rear right."""
DRIVEN = {"front": CORNERS[:2], "rear": CORNERS[2:], "all": CORNERS}
"""Driven wheels, by the name of the drive."""


@dataclass(frozen=True)
class Car:
    """Its numbers; the defaults are a mid-size saloon's.

    Raises ValueError where no such car can stand.
    """

    wheelbase_m: float = 2.65
    track_m: float = 1.52
    """Between the middles of the tyres of an axle."""
    mass_kg: float = 1400.0
    """All of it, wheels and hubs included."""
    height_of_mass_m: float = 0.52
    """Of the centre of mass above the ground, at rest."""
    front_share: float = 0.55
    """Of the weight, on the front axle."""
    wheel_radius_m: float = 0.31
    tyre_width_m: float = 0.20
    wheel_kg: float = 18.0
    hub_kg: float = 12.0
    stiffness_n_m: float = 32_000.0
    """Of each strut."""
    damping_n_s_m: float = 3_000.0
    tyre_friction: float = 0.9
    """Of tyre on road; the larger of it and the ground's counts."""
    rolling_resistance: float = 0.012
    """Force over load; it acts as friction in the axles."""
    driven: Literal["front", "rear", "all"] = "front"
    drive_n_m: float = 1_600.0
    """The most on all driven axles together."""
    brake_n_m: float = 2_000.0
    """The most on each wheel."""
    steering_deg: float = 35.0
    """The most, of the wheel in the middle that both front wheels stand for."""
    length_m: float = 4.35
    width_m: float = 1.78
    height_m: float = 1.45

    def __post_init__(self) -> None:
        numbers = {name: value for name, value in vars(self).items() if isinstance(value, (int, float))}
        if bad := [name for name, value in numbers.items() if not 0 < value < float("inf")]:
            raise ValueError(f"a car's {', '.join(bad)} must be positive, finite numbers")
        if self.sprung_kg <= 0 or not 0.2 <= self.front_share <= 0.8:
            raise ValueError(
                f"a car of {self.mass_kg} kg with {self.front_share:.0%} on its front axle has no chassis between them"
            )
        if (
            self.wheelbase_m + 2 * self.wheel_radius_m > self.length_m
            or self.track_m + self.tyre_width_m > self.width_m + 0.1
        ):
            raise ValueError("the wheels stand outside of the car: give it a larger length_m or width_m")
        if self.steering_deg > 50:
            raise ValueError(f"a car's front wheels cannot turn by {self.steering_deg} degrees: 50 at most")
        if self.driven not in DRIVEN:
            raise ValueError(f"a car is not driven {self.driven!r}: {', '.join(DRIVEN)}")
        if hung := [f"{corner} {load:.0f} N" for corner in CORNERS if (load := self.strut_n(corner)) <= 0]:
            raise ValueError(
                f"a car's struts must be pressed at rest, not pulled: {', '.join(hung)}; put its front_share nearer to 0.5"
            )
        if (room := self.wheelbase_m - 2.5 * self.wheel_radius_m) <= 0 or self.track_m <= self.tyre_width_m:
            raise ValueError(
                f"a car's chassis has no room between its wheels: {room:.2f} m along (2.5 wheel_radius_m are the wheels') and "
                f"{self.track_m - self.tyre_width_m:.2f} m across; give it a larger wheelbase_m or track_m, or smaller wheels"
            )
        if (radius := self.wheelbase_m / tan(radians(self.steering_deg))) <= self.track_m / 2:
            raise ValueError(
                f"a car steered by {self.steering_deg} degrees turns about a point {radius:.2f} m beside its middle, "
                f"between its wheels: give it less steering_deg, or a track_m below {2 * radius:.2f}"
            )

    @property
    def sprung_kg(self) -> float:
        """Of the chassis, on its struts."""
        return self.mass_kg - 4 * (self.wheel_kg + self.hub_kg)

    @property
    def ahead_m(self) -> float:
        """Of the centre of mass before the middle of the wheelbase."""
        return (self.front_share - 0.5) * self.wheelbase_m

    @property
    def driven_wheels(self) -> tuple[str, ...]:
        """Of `CORNERS`."""
        return DRIVEN[self.driven]

    def place(self, corner: str) -> tuple[float, float]:
        """(x, y) of a wheel in the car's frame, m."""
        return self.wheelbase_m / 2 * (1 if corner[0] == "f" else -1), self.track_m / 2 * (
            1 if corner[1] == "l" else -1
        )

    def strut_n(self, corner: str) -> float:
        """What a strut carries at rest on level ground, N."""
        # The chassis alone balances about the axles where hubs and wheels, alike at all corners, have been taken away.
        ahead = self.ahead_m * self.mass_kg / self.sprung_kg
        share = 0.5 + ahead / self.wheelbase_m * (1 if corner[0] == "f" else -1)
        return self.sprung_kg * 9.81 * share / 2
