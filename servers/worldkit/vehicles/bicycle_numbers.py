"""The numbers of a bicycle with its rider, and of how the rider keeps it upright."""

from dataclasses import dataclass
from math import cos, radians, sin
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .axles import Axle, Vec3

NARROW = 0.05


@dataclass(frozen=True)
class Bicycle:
    """A bicycle and its rider, who sits still and steers into the fall.

    Frame as of other vehicles. The rider is one body with the frame; the fork turns about an axis that leans back and meets the
    ground before the front wheel does, by the trail. Numbers: J. P. Meijaard, J. M. Papadopoulos, A. Ruina and A. L. Schwab,
    Linearized dynamics equations for the balance and steer of a bicycle, Proc. R. Soc. A 463 (2007), table 1 (wheelbase 1.02 m,
    trail 0.08 m, head angle 18 degrees from the vertical, 85 kg of rider and frame, wheels of 0.3 to 0.35 m).

    Raises ValueError where no such bicycle can be ridden.
    """

    wheelbase_m: float = 1.02
    trail_m: float = 0.08
    head_deg: float = 18.0
    """Of the steering axis from the vertical."""
    mass_kg: float = 94.0
    """All of it, the rider included."""
    height_of_mass_m: float = 0.93
    front_share: float = 0.38
    wheel_radius_m: float = 0.34
    tyre_width_m: float = 0.04
    wheel_kg: float = 2.0
    fork_kg: float = 4.0
    tyre_friction: float = 0.9
    rolling_resistance: float = 0.005
    drive_n_m: float = 50.0
    """The most, at the rear wheel."""
    brake_n_m: float = 90.0
    """The most on each wheel."""
    steering_deg: float = 45.0
    power_w: float = 300.0
    quickness_rad_s: float = 3.5
    """Of the rider's balance: how fast a lean that is not wanted is taken back."""
    length_m: float = 1.7
    width_m: float = 0.6
    height_m: float = 1.75

    word = "bicycle"
    corners = ("f", "r")
    """Names of its wheels."""
    steered_wheels = ("f",)
    middle_x_m = 0.0

    def __post_init__(self) -> None:
        numbers = {name: value for name, value in vars(self).items() if isinstance(value, (int, float))}
        if bad := [name for name, value in numbers.items() if not 0 < value < float("inf") and name != "head_deg"]:
            raise ValueError(f"a bicycle's {', '.join(bad)} must be positive, finite numbers")
        if not 0 <= self.head_deg <= 45 or not 0.2 <= self.front_share <= 0.8:
            raise ValueError("a bicycle's head_deg must be 0 to 45, its front_share 0.2 to 0.8")
        if self.frame_kg <= 0:
            raise ValueError(f"a bicycle of {self.mass_kg} kg has no frame besides its wheels and fork")
        if self.wheelbase_m + 2 * self.wheel_radius_m > self.length_m + 1e-9:
            raise ValueError("the wheels stand outside of the bicycle: give it a larger length_m")
        if self.height_m <= self.seat_m:
            raise ValueError(
                f"a bicycle {self.height_m} m high has no rider on its seat at {self.seat_m:.2f} m: give it more height_m"
            )
        if self.steering_deg > 60:
            raise ValueError(f"a bicycle's fork cannot turn by {self.steering_deg} degrees: 60 at most")

    @property
    def seat_m(self) -> float:
        """Height of the seat above the ground."""
        return 2.45 * self.wheel_radius_m

    @property
    def frame_kg(self) -> float:
        """Of frame and rider."""
        return self.mass_kg - 2 * self.wheel_kg - self.fork_kg

    @property
    def ahead_m(self) -> float:
        """Of the centre of mass before the middle of the wheelbase."""
        return (self.front_share - 0.5) * self.wheelbase_m

    @property
    def extents(self) -> "Vec3":
        """Full extents of the box around it, m."""
        return self.length_m, self.width_m, self.height_m

    @property
    def steering_axis(self) -> "Vec3":
        """A unit vector, leaning back."""
        tilt = radians(self.head_deg)
        return -sin(tilt), 0.0, cos(tilt)

    @property
    def axes_ahead_m(self) -> float:
        """How far the front hub lies before the steering axis, along x at the hub's height."""
        tilt = radians(self.head_deg)
        # The axis meets the ground `trail_m` before the contact, and at the hub's height is r tan(tilt) further back.
        return self.wheel_radius_m * sin(tilt) / cos(tilt) - self.trail_m

    def spin_inertia(self, axle: "Axle | None" = None) -> float:  # noqa: ARG002 (as of other vehicles)
        """Of a wheel about its axle, kg·m²: nearly all of it in rim and tyre."""
        return 0.8 * self.wheel_kg * self.wheel_radius_m**2

    @property
    def rolling_kg(self) -> float:
        """Its mass for what pushes it along: with what spins in its wheels."""
        return self.mass_kg + 2 * self.spin_inertia() / self.wheel_radius_m**2

    def axle_joints(self, name: str) -> dict[str, float]:
        """The joints that its wheels turn about, each with the radius of its wheel, m."""
        return {f"{name}_{corner}_axle": self.wheel_radius_m for corner in self.corners}

    def bodies(self, name: str) -> tuple[str, ...]:
        """The bodies that it is made of, itself first."""
        return name, f"{name}_fork", f"{name}_f_wheel", f"{name}_r_wheel"

    def joints(self, name: str) -> dict[str, str]:
        """Its joints, each with its kind."""
        return {name: "free", f"{name}_steer": "hinge", f"{name}_f_axle": "hinge", f"{name}_r_axle": "hinge"}

    def actuators(self, name: str) -> tuple[str, ...]:
        """What `pedals` controls."""
        return f"{name}_steer_f", f"{name}_drive", f"{name}_brake_f", f"{name}_brake_r"
