"""The numbers of a car, and what follows from them."""

from dataclasses import dataclass
from math import radians, tan
from typing import TYPE_CHECKING, Literal

from .axles import Axle, OnAxles

if TYPE_CHECKING:
    from .axles import Vec3

CORNERS = ("fl", "fr", "rl", "rr")
"""Front left, front right, rear left, rear right."""
DRIVEN = {"front": CORNERS[:2], "rear": CORNERS[2:], "all": CORNERS}
"""Driven wheels, by the name of the drive."""


@dataclass(frozen=True)
class Car(OnAxles):
    """Its numbers; the defaults are a mid-size saloon's.

    Source of the defaults: R. N. Jazar, Vehicle Dynamics (2008), tables of chapters 2 and 8 (mass, wheelbase, height of the
    centre of mass, suspension rates); Bosch Automotive Handbook, "Motor-vehicle dynamics" (rolling resistance 0.012, tyre on dry
    asphalt 0.9); power and moments of a car of that class.

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
    power_w: float = 90_000.0
    """The most of the engine: above some speed the drive's moment falls."""

    word = "car"

    def __post_init__(self) -> None:
        self.check()
        if not 0.2 <= self.front_share <= 0.8:
            raise ValueError(
                f"a {self.word} of {self.mass_kg} kg with {self.front_share:.0%} on its front axle has no chassis between them"
            )
        if self.steering_deg > 50:
            raise ValueError(f"a {self.word}'s front wheels cannot turn by {self.steering_deg} degrees: 50 at most")
        if self.driven not in DRIVEN:
            raise ValueError(f"a {self.word} is not driven {self.driven!r}: {', '.join(DRIVEN)}")
        if (room := self.wheelbase_m - 2.5 * self.wheel_radius_m) <= 0 or self.track_m <= self.tyre_width_m:
            raise ValueError(
                f"a {self.word}'s chassis has no room between its wheels: {room:.2f} m along (2.5 wheel_radius_m are the wheels') and "
                f"{self.track_m - self.tyre_width_m:.2f} m across; give it a larger wheelbase_m or track_m, or smaller wheels"
            )
        if (radius := self.wheelbase_m / tan(radians(self.steering_deg))) <= self.track_m / 2:
            raise ValueError(
                f"a {self.word} steered by {self.steering_deg} degrees turns about a point {radius:.2f} m beside its middle, "
                f"between its wheels: give it less steering_deg, or a track_m below {2 * radius:.2f}"
            )
        self.check_solids()

    @property
    def axles(self) -> tuple[Axle, ...]:
        """Front and rear."""
        half = self.wheelbase_m / 2
        return (
            Axle("f", half, self.front_share, steered=True, driven=self.driven in ("front", "all")),
            Axle("r", -half, 1 - self.front_share, driven=self.driven in ("rear", "all")),
        )

    @property
    def solids(self) -> "tuple[tuple[str, Vec3, Vec3], ...]":
        """A low box between the axles, one above the wheels as long as the car, and the cabin."""
        length, width, height, radius = self.length_m, self.width_m, self.height_m, self.wheel_radius_m
        over, top = 2.3 * radius, 0.63 * height
        inner = self.wheelbase_m - 2.5 * radius
        return (
            ("floor", (inner, width, top - 0.6 * radius), (0, 0, (top + 0.6 * radius) / 2)),
            ("nose", (length, 0.98 * width, max(top - over, 0.1)), (0, 0, (top + over) / 2)),
            ("cabin", (0.38 * length, 0.78 * width, height - top), (-0.08 * length, 0, (height + top) / 2)),
        )
