"""The numbers of trucks and buses: cars by the same words, with other proportions, and a truck with two axles behind."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from .axles import Axle
from .car_numbers import Car

if TYPE_CHECKING:
    from .axles import Vec3


@dataclass(frozen=True)
class Truck(Car):
    """A rigid truck with one steered axle in front and two driven ones with twin tyres behind; its wheelbase ends between these.

    The defaults are a three-axle tipper's, two thirds laden. Source: T. D. Gillespie, Fundamentals of Vehicle Dynamics (1992),
    chapter 1 and 9 (axle loads, height of the centre of mass, track and roll-over threshold of heavy trucks); Council Directive
    96/53/EC (2.55 m of width, 26 t and 1.3-1.4 m between the axles of a tandem).

    Raises ValueError where no such truck can stand.
    """

    wheelbase_m: float = 4.6
    track_m: float = 1.95
    mass_kg: float = 18_000.0
    height_of_mass_m: float = 1.35
    front_share: float = 0.32
    wheel_radius_m: float = 0.5
    tyre_width_m: float = 0.28
    wheel_kg: float = 95.0
    hub_kg: float = 150.0
    stiffness_n_m: float = 280_000.0
    damping_n_s_m: float = 20_000.0
    tyre_friction: float = 0.7
    rolling_resistance: float = 0.007
    driven: Literal["front", "rear", "all"] = "rear"
    drive_n_m: float = 26_000.0
    brake_n_m: float = 13_000.0
    steering_deg: float = 38.0
    length_m: float = 8.6
    width_m: float = 2.5
    height_m: float = 3.2
    power_w: float = 300_000.0
    tandem_m: float = 1.35
    """Between its two rear axles."""
    front_overhang_m: float = 1.4
    """Of the cab before the front axle."""

    word = "truck"

    @property
    def axles(self) -> tuple[Axle, ...]:
        """The steered one, and two behind that carry alike."""
        half, apart = self.wheelbase_m / 2, self.tandem_m / 2
        share, driven = (1 - self.front_share) / 2, self.driven in ("rear", "all")
        return (
            Axle("f", half, self.front_share, steered=True, driven=self.driven in ("front", "all")),
            Axle("m", apart - half, share, driven=driven, twin=True),
            Axle("r", -apart - half, share, driven=driven, twin=True),
        )

    @property
    def middle_x_m(self) -> float:
        """Of the box around it, before the middle of the wheelbase."""
        return self.wheelbase_m / 2 + self.front_overhang_m - self.length_m / 2

    @property
    def cab_m(self) -> float:
        """Length of the cab, from the front."""
        return 0.27 * self.length_m

    @property
    def solids(self) -> "tuple[tuple[str, Vec3, Vec3], ...]":
        """The frame between the wheels, the cab above the front axle, the bed behind it."""
        front, over = self.middle_x_m + self.length_m / 2, 2.15 * self.wheel_radius_m
        cab, bed, gap = self.cab_m, 0.62 * self.height_m, 0.12
        behind = self.length_m - cab - gap
        return (
            ("frame", (self.length_m - 0.3, 0.36 * self.width_m, 0.4), (self.middle_x_m, 0, over - 0.2)),
            ("cab", (cab, 0.98 * self.width_m, self.height_m - over), (front - cab / 2, 0, (self.height_m + over) / 2)),
            ("bed", (behind, self.width_m, bed - over), (front - cab - gap - behind / 2, 0, (bed + over) / 2)),
        )


@dataclass(frozen=True)
class Bus(Car):
    """A city bus on two axles, its rear tyres twin, its front axle behind the door.

    The defaults are a 12 m low-floor bus's with its seats taken. Source: Council Directive 96/53/EC (12 m, 2.55 m, 18 t on two
    axles); T. D. Gillespie, Fundamentals of Vehicle Dynamics (1992), chapter 9.

    Raises ValueError where no such bus can stand.
    """

    wheelbase_m: float = 5.9
    track_m: float = 2.0
    mass_kg: float = 14_500.0
    height_of_mass_m: float = 1.15
    front_share: float = 0.38
    wheel_radius_m: float = 0.48
    tyre_width_m: float = 0.275
    wheel_kg: float = 85.0
    hub_kg: float = 130.0
    stiffness_n_m: float = 260_000.0
    damping_n_s_m: float = 22_000.0
    tyre_friction: float = 0.7
    rolling_resistance: float = 0.008
    driven: Literal["front", "rear", "all"] = "rear"
    drive_n_m: float = 14_000.0
    brake_n_m: float = 13_000.0
    steering_deg: float = 45.0
    length_m: float = 12.0
    width_m: float = 2.5
    height_m: float = 3.0
    power_w: float = 210_000.0
    front_overhang_m: float = 2.7

    word = "bus"

    @property
    def axles(self) -> tuple[Axle, ...]:
        """Front and rear."""
        front, rear = super().axles
        return front, Axle("r", rear.x_m, rear.share, driven=rear.driven, twin=True)

    @property
    def middle_x_m(self) -> float:
        """Of the box around it, before the middle of the wheelbase."""
        return self.wheelbase_m / 2 + self.front_overhang_m - self.length_m / 2

    @property
    def solids(self) -> "tuple[tuple[str, Vec3, Vec3], ...]":
        """A floor between the axles, what hangs over before and behind, and the body above the wheels."""
        low, over, room = 0.30, 2.15 * self.wheel_radius_m, 1.25 * self.wheel_radius_m
        x, half, width, high = self.middle_x_m, self.wheelbase_m / 2, self.width_m, over - low
        nose, tail = x + self.length_m / 2, x - self.length_m / 2
        parts = [("floor", half - room, room - half), ("nose", nose, half + room), ("tail", -half - room, tail)]
        boxes = [(name, (a - b, width, high), ((a + b) / 2, 0.0, (low + over) / 2)) for name, a, b in parts]
        return (*boxes, ("body", (self.length_m, width, self.height_m - over), (x, 0.0, (self.height_m + over) / 2)))


@dataclass(frozen=True)
class Trailer(Car):
    """A trailer on one axle, drawn by a ball at the end of its drawbar; `front_share` of its weight presses on the ball.

    Its wheelbase is from the ball to the axle. It has brakes, and neither drive nor steering. The defaults are a braked box
    trailer's of 1.2 t. Source: EN 13878 and ISO 1103 (ball coupling); ECE R55 (4 % of the weight and more on the ball).

    Raises ValueError where no such trailer can stand.
    """

    wheelbase_m: float = 3.0
    track_m: float = 1.72
    mass_kg: float = 1_200.0
    height_of_mass_m: float = 0.85
    front_share: float = 0.07
    wheel_radius_m: float = 0.31
    tyre_width_m: float = 0.18
    wheel_kg: float = 16.0
    hub_kg: float = 20.0
    stiffness_n_m: float = 60_000.0
    damping_n_s_m: float = 5_000.0
    length_m: float = 4.7
    width_m: float = 1.9
    height_m: float = 2.0
    ball_m: float = 0.42
    """Height of the ball above the ground."""
    drawbar_m: float = 1.2
    """From the ball to the box."""

    word = "trailer"

    def __post_init__(self) -> None:
        self.check()
        if not 0 < self.front_share <= 0.3:
            raise ValueError(
                f"{self.front_share:.0%} of a trailer's weight on its ball: 4 to 15 % let it follow, 30 % at most"
            )
        if self.drawbar_m >= self.wheelbase_m - self.wheel_radius_m:
            raise ValueError("the box of a trailer begins before its wheels: give it a shorter drawbar_m")
        self.check_solids()

    @property
    def axles(self) -> tuple[Axle, ...]:
        """The one behind."""
        return (Axle("r", -self.wheelbase_m / 2, 1 - self.front_share),)

    @property
    def middle_x_m(self) -> float:
        """Of the box around it, before the middle of the wheelbase."""
        return self.wheelbase_m / 2 - self.length_m / 2

    def joints(self, name: str) -> dict[str, str]:
        """Its joints, each with its kind; the ball at its hitch is the world's."""
        return {joint: kind for joint, kind in super().joints(name).items() if joint != name}

    @property
    def ball(self) -> "Vec3":
        """Of its hitch, in its frame, m."""
        return self.wheelbase_m / 2, 0.0, self.ball_m

    @property
    def solids(self) -> "tuple[tuple[str, Vec3, Vec3], ...]":
        """The drawbar, a floor between the wheels, and the box above them."""
        front, over, bar = self.wheelbase_m / 2, 2.15 * self.wheel_radius_m, self.drawbar_m
        long, low = self.length_m - bar, self.ball_m
        middle = front - bar - long / 2
        inner = self.track_m - self.tyre_width_m - 0.08
        return (
            ("drawbar", (bar, 0.12, 0.1), (front - bar / 2, 0, low)),
            ("floor", (long, inner, over - low), (middle, 0, (over + low) / 2)),
            ("box", (long, self.width_m, self.height_m - over), (middle, 0, (self.height_m + over) / 2)),
        )
