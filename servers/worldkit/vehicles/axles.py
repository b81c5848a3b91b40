"""What all vehicles on axles have: where their wheels stand, what these carry, and the names that their parts get in a world.

Frame: on the ground below the middle of the wheelbase, x forward, y to the left, z up.
"""

import itertools
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    Vec3 = tuple[float, float, float]

G = 9.81
THINNEST_M = 1e-3
"""Of a part of a body."""


@dataclass(frozen=True)
class Axle:
    """One axle with a wheel on each side."""

    name: str
    """`f` the first, `r` the last, `m` between: its wheels are `fl` and `fr`, and so on."""
    x_m: float
    """Before the middle of the wheelbase."""
    share: float
    """Of the weight."""
    steered: bool = False
    driven: bool = False
    twin: bool = False
    """Two tyres to a side: they touch the ground as one wheel of twice the width."""

    @property
    def corners(self) -> tuple[str, str]:
        """Names of its left and its right wheel."""
        return f"{self.name}l", f"{self.name}r"


class OnAxles:
    """What follows from the numbers of a vehicle; they are fields of its dataclass, which adds `axles`."""

    word = "vehicle"
    """What its errors call it."""
    wheelbase_m: float
    track_m: float
    mass_kg: float
    height_of_mass_m: float
    front_share: float
    wheel_radius_m: float
    tyre_width_m: float
    wheel_kg: float
    hub_kg: float
    stiffness_n_m: float
    damping_n_s_m: float
    tyre_friction: float
    rolling_resistance: float
    drive_n_m: float
    brake_n_m: float
    steering_deg: float
    power_w: float
    length_m: float
    width_m: float
    height_m: float

    @property
    def axles(self) -> tuple[Axle, ...]:
        """From the front to the back."""
        raise NotImplementedError

    @property
    def middle_x_m(self) -> float:
        """Of the box around it, before the middle of the wheelbase."""
        return 0.0

    @property
    def solids(self) -> "tuple[tuple[str, Vec3, Vec3], ...]":
        """What collides of its body besides wheels: (name, full extents, centre), m, boxes in its frame."""
        raise NotImplementedError

    @property
    def extents(self) -> "Vec3":
        """Full extents of the box around it, m."""
        return self.length_m, self.width_m, self.height_m

    @property
    def corners(self) -> tuple[str, ...]:
        """Names of its wheels, from the front to the back, left before right."""
        return tuple(corner for axle in self.axles for corner in axle.corners)

    @property
    def driven_wheels(self) -> tuple[str, ...]:
        """Of `corners`."""
        return tuple(corner for axle in self.axles if axle.driven for corner in axle.corners)

    @property
    def steered_wheels(self) -> tuple[str, ...]:
        """Of `corners`."""
        return tuple(corner for axle in self.axles if axle.steered for corner in axle.corners)

    @property
    def drives(self) -> dict[str, tuple[str, ...]]:
        """Its motors, each with the wheels that share its moment alike."""
        return {"drive": self.driven_wheels} if self.driven_wheels else {}

    @property
    def belts(self) -> tuple[tuple[str, ...], ...]:
        """Wheels that turn at one speed."""
        return ()

    @property
    def sprung_kg(self) -> float:
        """Of the chassis, on its struts."""
        return self.mass_kg - sum(2 * self.unsprung_kg(axle) for axle in self.axles)

    @property
    def ahead_m(self) -> float:
        """Of the centre of mass before the middle of the wheelbase."""
        return (self.front_share - 0.5) * self.wheelbase_m

    def check_solids(self) -> None:
        """Raises ValueError where a part of the body would be nothing, or less."""
        for part, size, _ in self.solids:
            if min(size) < THINNEST_M:
                told = " x ".join(f"{extent:.3g}" for extent in size)
                raise ValueError(
                    f"a {self.word}'s {part} would measure {told} m: its length_m, width_m, height_m, wheel_radius_m and track_m do not go together"
                )

    def axle(self, corner: str) -> Axle:
        """The axle of a wheel."""
        return next(axle for axle in self.axles if corner in axle.corners)

    def place(self, corner: str) -> tuple[float, float]:
        """(x, y) of a wheel, m."""
        return self.axle(corner).x_m, self.track_m / 2 * (1 if corner[-1] == "l" else -1)

    def wheel_mass(self, axle: Axle) -> float:
        """Of one wheel of an axle, kg; a twin is two."""
        return self.wheel_kg * (2 if axle.twin else 1)

    def wheel_width(self, axle: Axle) -> float:
        """Of what touches the ground on one side of an axle, m."""
        return self.tyre_width_m * (2 if axle.twin else 1)

    def unsprung_kg(self, axle: Axle) -> float:
        """Of the wheel and the hub on one side of an axle."""
        return self.wheel_mass(axle) + self.hub_kg

    def strut_n(self, corner: str) -> float:
        """What a strut carries at rest on level ground, N."""
        axle = self.axle(corner)
        return G * (axle.share * self.mass_kg / 2 - self.unsprung_kg(axle))

    def spin_inertia(self, axle: Axle | None = None) -> float:
        """Of a wheel about its axle, kg·m²: most of it lies in the tyre."""
        return 0.6 * (self.wheel_kg if axle is None else self.wheel_mass(axle)) * self.wheel_radius_m**2

    @property
    def rolling_kg(self) -> float:
        """Its mass for what pushes it along: with what spins in its wheels."""
        return self.mass_kg + sum(2 * self.spin_inertia(axle) for axle in self.axles) / self.wheel_radius_m**2

    def axle_joints(self, name: str) -> dict[str, float]:
        """The joints that its wheels turn about, each with the radius of its wheel, m."""
        return {f"{name}_{corner}_axle": self.wheel_radius_m for corner in self.corners}

    def bodies(self, name: str) -> tuple[str, ...]:
        """The bodies that it is made of, itself first."""
        return (name, *(f"{name}_{corner}_{part}" for corner in self.corners for part in ("hub", "wheel")))

    def joints(self, name: str) -> dict[str, str]:
        """Its joints, each with its kind."""
        found = {name: "free"}
        for corner in self.corners:
            found[f"{name}_{corner}_strut"] = "slide"
            if corner in self.steered_wheels:
                found[f"{name}_{corner}_steer"] = "hinge"
            found[f"{name}_{corner}_axle"] = "hinge"
        return found

    def actuators(self, name: str) -> tuple[str, ...]:
        """What `pedals` controls."""
        return (
            *(f"{name}_steer_{corner}" for corner in self.steered_wheels),
            *(f"{name}_{drive}" for drive in self.drives),
            *(f"{name}_brake_{corner}" for corner in self.corners),
        )

    def check(self) -> None:
        """Refuse numbers with which it cannot stand.

        Raises:
            ValueError: the message says which, and what would.
        """
        said = f"a {self.word}"
        numbers = {name: value for name, value in vars(self).items() if isinstance(value, (int, float))}
        if bad := [name for name, value in numbers.items() if not 0 < value < float("inf")]:
            raise ValueError(f"{said}'s {', '.join(bad)} must be positive, finite numbers")
        if self.sprung_kg <= 0:
            raise ValueError(
                f"{said} of {self.mass_kg} kg with {self.front_share:.0%} on its front axle has no chassis between them"
            )
        reach = [abs(axle.x_m - self.middle_x_m) + self.wheel_radius_m for axle in self.axles]
        if max(reach) > self.length_m / 2 + 1e-9 or self.track_m + self.tyre_width_m > self.width_m + 0.1:
            raise ValueError(f"the wheels stand outside of the {self.word}: give it a larger length_m or width_m")
        places = [axle.x_m for axle in self.axles]
        if close := [a - b for a, b in itertools.pairwise(places) if a - b < 2 * self.wheel_radius_m]:
            raise ValueError(
                f"the wheels of a {self.word} stand inside each other: {min(close):.2f} m between two axles, {2 * self.wheel_radius_m:.2f} m "
                "across; give it smaller wheels, or fewer"
            )
        if hung := [f"{corner} {load:.0f} N" for corner in self.corners if (load := self.strut_n(corner)) <= 0]:
            raise ValueError(
                f"{said}'s struts must be pressed at rest, not pulled: {', '.join(hung)}; put its front_share nearer to 0.5"
            )
