"""Closed forms of mechanics, one function each: what a plan predicts and a scan measures by is the same formula.

Units are the SI; a parameter that ends in `_deg` is in degrees. `g` (m/s^2, positive) is the gravity of the world. Numbers
that no world can have (a negative height, no mass) raise a ValueError that says which.
"""

import inspect
import math
from collections.abc import Callable
from typing import Any

GRAVITY = 9.81
"""m/s^2, as plans have it unless they say otherwise."""


def fall_time(height: float, g: float = GRAVITY) -> float:
    """Time to fall from rest, s: sqrt(2 h / g). Source: Galileo."""
    return math.sqrt(2 * _least(height, "height") / _positive(g, "g"))


def fall_speed(height: float, g: float = GRAVITY) -> float:
    """Speed after a fall from rest, or at the foot of any smooth path, m/s: sqrt(2 g h). Source: conservation of energy."""
    return math.sqrt(2 * g * _least(height, "height"))


def flight_time(speed: float, angle_deg: float, height: float = 0.0, g: float = GRAVITY) -> float:
    """Time until a projectile, thrown at an angle above the level, is `height` below its start, s."""
    up = speed * math.sin(math.radians(angle_deg))
    under = up**2 + 2 * _positive(g, "g") * height
    if under < 0:
        raise ValueError(f"it rises {up * up / 2 / g:.4g} m, never to {-height:.4g} m above its start")
    return (up + math.sqrt(under)) / g


def flight_range(speed: float, angle_deg: float, height: float = 0.0, g: float = GRAVITY) -> float:
    """Level distance of a projectile that lands `height` below its start, m: v cos(a) t. Source: the parabola of flight."""
    return speed * math.cos(math.radians(angle_deg)) * flight_time(speed, angle_deg, height, g)


def bounce_height(height: float, restitution: float, times: float = 1.0) -> float:
    """Height after so many bounces, m: h e^(2 n). Source: Newton's law of restitution."""
    return _least(height, "height") * _least(restitution, "restitution") ** (2 * times)


def pendulum_period(length: float, amplitude_deg: float = 0.0, g: float = GRAVITY) -> float:
    """Period of a simple pendulum, s: 2 pi sqrt(l / g) (1 + a^2/16 + 11 a^4/3072). Source: its series for finite amplitudes."""
    return 2 * math.pi * math.sqrt(_positive(length, "length") / _positive(g, "g")) * _widened(amplitude_deg)


def body_pendulum_period(
    inertia: float, mass: float, arm: float, amplitude_deg: float = 0.0, g: float = GRAVITY
) -> float:
    """Period of a body on a pivot, s: 2 pi sqrt(I / m g d), I about the pivot, d from there to the centre of mass."""
    weight = _positive(mass, "mass") * _positive(g, "g") * _positive(arm, "arm")
    return 2 * math.pi * math.sqrt(_positive(inertia, "inertia") / weight) * _widened(amplitude_deg)


def _widened(amplitude_deg: float) -> float:
    a = math.radians(amplitude_deg)
    return 1 + a**2 / 16 + 11 * a**4 / 3072


def spring_period(stiffness: float, mass: float) -> float:
    """Period of a mass on a spring, s: 2 pi sqrt(m / k). Source: the harmonic oscillator."""
    return 2 * math.pi * math.sqrt(_positive(mass, "mass") / _positive(stiffness, "stiffness"))


def spring_energy(stiffness: float, compression: float) -> float:
    """Energy in a spring, J: k x^2 / 2. Source: Hooke's law."""
    return stiffness * compression**2 / 2


def spring_launch_speed(stiffness: float, compression: float, mass: float) -> float:
    """Speed of a body that a pressed spring has let go, m/s: x sqrt(k / m). Source: conservation of energy."""
    return abs(compression) * math.sqrt(_least(stiffness, "stiffness") / _positive(mass, "mass"))


def slope_acceleration(angle_deg: float, friction: float = 0.0, g: float = GRAVITY) -> float:
    """Acceleration of a block sliding down a slope, m/s^2: g (sin a - mu cos a), 0 where it sticks. Source: Coulomb."""
    a = math.radians(angle_deg)
    return max(g * (math.sin(a) - friction * math.cos(a)), 0.0)


def rolling_acceleration(angle_deg: float, share: float = 0.4, g: float = GRAVITY) -> float:
    """Acceleration of a body rolling down a slope, m/s^2: g sin(a) / (1 + I / m r^2); share 2/5 ball, 1/2 cylinder, 1 hoop."""
    return g * math.sin(math.radians(angle_deg)) / (1 + share)


def sliding_distance(speed: float, friction: float, g: float = GRAVITY) -> float:
    """Way until a sliding body stands, m: v^2 / 2 mu g. Source: Coulomb's friction."""
    return speed**2 / (2 * _positive(friction, "friction") * _positive(g, "g"))


def rolling_distance(
    speed: float, rolling_friction: float, radius: float, share: float = 0.4, g: float = GRAVITY
) -> float:
    """Way until a rolling body stands, m: v^2 (1 + share) r / (2 c g), c the plan's `rolling_friction` in metres.

    The torque c N takes c m g v / r of the power, from the energy m (1 + I / m r^2) v^2 / 2.
    """
    arm = _positive(rolling_friction, "rolling_friction") / _positive(radius, "radius")
    return speed**2 * (1 + share) / (2 * arm * _positive(g, "g"))


def tipping_angle(width: float, height: float) -> float:
    """Tilt at which a standing block tips, degrees: atan(w / h), its centre of mass in the middle."""
    return math.degrees(math.atan2(_positive(width, "width"), _positive(height, "height")))


def tipping_force(mass: float, width: float, push_height: float, g: float = GRAVITY) -> float:
    """Level push that tips a standing block, N: m g (w / 2) / h; it slides first if that is above mu m g."""
    return _positive(mass, "mass") * g * width / 2 / _positive(push_height, "push_height")


def collision_speed(mass1: float, speed1: float, mass2: float, speed2: float = 0.0, restitution: float = 1.0) -> float:
    """Speed of the first body after a head-on collision, m/s; exchange the bodies for the second's.

    (m1 v1 + m2 v2 + m2 e (v2 - v1)) / (m1 + m2). Source: conservation of momentum; Newton's law of restitution.
    """
    total = _positive(mass1 + mass2, "mass1 + mass2")
    return (mass1 * speed1 + mass2 * speed2 + mass2 * restitution * (speed2 - speed1)) / total


def precession_rate(mass: float, arm: float, inertia: float, spin: float, g: float = GRAVITY) -> float:
    """Rate at which a fast top goes round, rad/s: m g d / (I w). Source: steady precession of a heavy top, fast spin."""
    return mass * g * arm / (_positive(inertia, "inertia") * _positive(abs(spin), "spin")) * math.copysign(1, spin)


def terminal_speed(mass: float, area: float, drag: float = 1.0, density: float = 1.2, g: float = GRAVITY) -> float:
    """Speed at which drag carries the weight, m/s: sqrt(2 m g / rho C A); C = 1 for a plate of area A across the flow.

    As much wind blowing upwards holds it in the air. Source: the drag equation.
    """
    weight = _positive(mass, "mass") * _positive(g, "g")
    return math.sqrt(weight / wind_force(1.0, _positive(area, "area"), _positive(drag, "drag"), density))


def wind_force(speed: float, area: float, drag: float = 1.0, density: float = 1.2) -> float:
    """Force of a flow on a body at rest, N: rho C A v^2 / 2, A seen along the flow. Source: the drag equation."""
    return _positive(density, "density") * _least(drag, "drag") * _least(area, "area") * speed**2 / 2


def cantilever_stiffness(modulus: float, second_moment: float, length: float) -> float:
    """Force per deflection at the free end of a clamped beam, N/m: 3 E I / L^3; I = pi d^4 / 64 of a round rod, b h^3 / 12.

    Source: Euler and Bernoulli's beam.
    """
    return (
        3 * _positive(modulus, "modulus") * _positive(second_moment, "second_moment") / _positive(length, "length") ** 3
    )


def cantilever_period(modulus: float, second_moment: float, length: float, mass: float) -> float:
    """Slowest period of a clamped uniform beam of that mass, s: 2 pi / 1.8751^2 sqrt(m L^3 / E I).

    Source: Euler and Bernoulli's beam; 1.8751 is the first root of cos x cosh x = -1.
    """
    slope = cantilever_stiffness(modulus, second_moment, length) / 3
    return 2 * math.pi / 1.8751041**2 * math.sqrt(_positive(mass, "mass") / slope)


def inertia_ball(mass: float, radius: float) -> float:
    """The inertia of a solid ball about its centre, kg m^2: 2/5 m r^2."""
    return 0.4 * mass * radius**2


def inertia_cylinder(mass: float, radius: float) -> float:
    """The inertia of a solid cylinder about its axis, kg m^2: m r^2 / 2."""
    return mass * radius**2 / 2


def inertia_rod(mass: float, length: float) -> float:
    """The inertia of a thin rod about its middle, kg m^2: m l^2 / 12."""
    return mass * length**2 / 12


def inertia_box(mass: float, width: float, depth: float) -> float:
    """The inertia of a box about the axis across these two sides, kg m^2: m (w^2 + d^2) / 12."""
    return mass * (width**2 + depth**2) / 12


def _positive(value: float, name: str) -> float:
    if value <= 0:
        raise ValueError(f"{name} must be positive, it is {value:.6g}")
    return value


def _least(value: float, name: str) -> float:
    if value < 0:
        raise ValueError(f"{name} must not be negative, it is {value:.6g}")
    return value


FORMS: dict[str, Callable[..., float]] = {
    name: form
    for name, form in list(globals().items())
    if inspect.isfunction(form) and form.__module__ == __name__ and not name.startswith("_")
}


def signature(name: str) -> str:
    """`fall_time(height, g=9.81)`: how a form is called."""
    return f"{name}({', '.join(_parameter(p) for p in inspect.signature(FORMS[name]).parameters.values())})"


def _parameter(parameter: Any) -> str:
    missing = parameter.default is inspect.Parameter.empty
    return parameter.name if missing else f"{parameter.name}={parameter.default:g}"
