"""Contact properties of a surface, in terms of what one can measure: friction and rebound.

MuJoCo's contact is a spring and a damper per unit mass: while two geoms overlap by `r` and approach at `v`, the
contact strives for the acceleration `-b v - k r`, and it can push but not pull. Without adhesion such a contact
returns the fraction `restitution` of the impact speed, whatever the masses, and that fraction depends on the damping
ratio `b / (2 sqrt(k))` alone (Schwager and Pöschel, "Coefficient of restitution and linear-dashpot model revisited",
Granular Matter 9, 2007, eq. 21). `surface` inverts that relation. The familiar `-ln e / sqrt(pi^2 + ln^2 e)` belongs
to a contact that may pull: it would give 0.56 where 0.5 was asked for.

How two surfaces mix, by MuJoCo's rules for geoms of equal priority (manual, "Contact parameters"):
    friction, torsional, rolling: the larger of the two counts; the contact gets the larger `condim`.
    restitution: the *less* bouncy of the two stated values counts (element-wise minimum of the direct solref, and
        more damping is the smaller number), provided both have the same `time_constant`. A surface that states no
        restitution does not count: the other's value does.

How long a contact lasts and how deep it gets is set by `time_constant` (1 / sqrt(k)): a body arriving at speed `v`
dips in by about `v * time_constant` and leaves after about `3 * time_constant`. The default suits time steps up to
2 ms; `time_constant=2 * TIME_STEP` is the stiffest contact that a time step resolves. Where within a step a body
arrives is chance, and the fewer steps a contact lasts, the more it matters: over all arrivals the rebound was within
0.04 of the stated ratio at eight steps to a time constant, 0.05 at four, 0.11 at two, and within 0.015, 0.03 and 0.07
for restitutions above 0.7. Four is a good choice: `time_constant=4 * TIME_STEP`.

What to know:
    The `discrete` integrator damps the contact spring itself: rebounds come out lower than asked for (measured with a
    time constant of 4 ms, restitution 0.8: 0.68 at 0.5 ms, 0.58 at 1 ms, 0.43 at 2 ms). Use another one for bounces.
    Sticking friction acts through the same damper, so very bouncy surfaces (above about 0.9) grip softly: a slip decays
    at the rate `b = 2 zeta / time_constant` instead of at once. A smaller time constant makes the grip firmer.
"""

from functools import lru_cache
from math import atan, exp, log, pi, sqrt
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco

TIME_CONSTANT_S = 0.004
"""Default of the time constant of a contact that states its restitution."""
REACH_M = 1e-3
"""How far an adhesive surface reaches, m."""
STEP_SHARE = 0.25
"""Time step over time constant at which the restitution comes out without bias."""
IMPEDANCE = 0.99
"""Share of the contact's own acceleration in the realised one; the rest is what the bodies would do unhindered."""
QUIET_ONSET = 0.7
"""Onset with which a box on a slope lay still for restitutions up to 0.7; what it costs is creep: 4 mm/s on 20 degrees at
0.6, a tenth of that with `impratio` 10 (time step 1 ms)."""


def surface(
    *,
    friction: float = 0.5,
    torsional: float = 0.005,
    rolling: float = 0.0001,
    restitution: float | None = None,
    onset: float | None = None,
    time_constant: float | None = None,
    density: float | None = None,
    adhesion: float = 0.0,
) -> dict[str, Any]:
    """Keyword arguments for `add_geom(**surface(...))`.

    Args:
        friction: sliding coefficient, unitless.
        torsional: resistance to spinning about the contact normal, metres (coefficient times contact radius).
        rolling: resistance to rolling, metres. Zero leaves rolling out, which makes piles of boxes cheaper.
        restitution: ratio of rebound to impact speed along the normal, 0 to 1; None is MuJoCo's own, nearly dead
            contact. Zero means the deadest contact the law offers (about 0.04).
        onset: impedance of a contact that states its restitution where the surfaces just meet, 0.1 to 0.99 (`IMPEDANCE`,
            the default; reached 1 mm deep at the latest). At 0.99 a resting body lies less deep than it falls in one
            step and so may hop for ever by some um; `QUIET_ONSET` lets it lie still up to a restitution of 0.7.
        time_constant: 1 / natural frequency of the contact, seconds: longer is softer. Default 0.004 with a stated
            restitution, else MuJoCo's 0.02.
        density: kg/m^3, handed through.
        adhesion: N with which it holds at each contact point (a box's face has four of them, a ball one); it reaches 1 mm.
            What hangs by it alone is not held sideways: measured, a wind moves it as if nothing rubbed.

    Raises:
        ValueError: a number outside its range.
    """
    for name, value in (
        ("friction", friction),
        ("torsional", torsional),
        ("rolling", rolling),
        ("adhesion", adhesion),
    ):
        if not 0 <= value < float("inf"):
            raise ValueError(f"contacts.surface: {name} must be zero or positive and finite, got {value}")
    if restitution is not None and not 0 <= restitution <= 1:
        raise ValueError(f"contacts.surface: restitution must lie between 0 and 1, got {restitution}")
    if onset is not None and not 0.1 <= onset <= IMPEDANCE:
        raise ValueError(f"contacts.surface: onset must lie between 0.1 and {IMPEDANCE}, got {onset}")
    if onset is not None and restitution is None:
        raise ValueError("contacts.surface: onset goes with a stated restitution, and none is stated")
    if time_constant is not None and not 0 < time_constant < float("inf"):
        raise ValueError(f"contacts.surface: time_constant must be a positive number of seconds, got {time_constant}")
    properties: dict[str, Any] = {
        "friction": (friction, torsional, rolling),
        # 6 resists rolling and spinning too, 4 spinning, 3 sliding alone, 1 nothing: the least that says it all.
        "condim": 6 if rolling else 4 if torsional else 3 if friction else 1,
    }
    if adhesion:
        properties |= {"adhesion": adhesion, "gap": REACH_M}
    if density is not None:
        properties["density"] = density
    if restitution is not None:
        # Negative numbers are MuJoCo's direct format. Positive ones would be raised to twice the time step.
        stiffness, damping = spring_and_damper(restitution, TIME_CONSTANT_S if time_constant is None else time_constant)
        properties["solref"] = (-stiffness, -damping)
        properties["solimp"] = (IMPEDANCE if onset is None else onset, IMPEDANCE, 0.001, 0.5, 2.0)
    elif time_constant is not None:
        properties["solref"] = (time_constant, 1.0)
    return properties


def pair(spec: "mujoco.MjSpec", one: str, other: str, **constants: Any) -> "list[mujoco.MjsPair]":
    """What two bodies do to each other, instead of what their surfaces say; `ground` is the world.

    `constants` are those of `surface`. Every geom of the one that collides is paired with every one of the other.

    Raises:
        ValueError: a body that is not there, or that has no named geom that collides.
    """
    properties = surface(**constants)
    properties.pop("density", None)
    slide, spin, roll = properties.pop("friction")
    made = []
    for first in _touchable(spec, one):
        for second in _touchable(spec, other):
            kept = {**properties, "friction": (slide, slide, spin, roll, roll)}
            made.append(spec.add_pair(name=f"{first} on {second}", geomname1=first, geomname2=second, **kept))
    return made


def _touchable(spec: "mujoco.MjSpec", name: str) -> list[str]:
    body = spec.worldbody if name in ("ground", "world") else spec.body(name)
    if body is None:
        raise ValueError(f"contacts.pair: there is no body {name!r}; known: {', '.join(b.name for b in spec.bodies)}")
    found = [geom.name for geom in body.geoms if geom.name and (geom.contype or geom.conaffinity)]
    if not found:
        raise ValueError(f"contacts.pair: {name!r} has no named geom that collides")
    return found


def spring_and_damper(restitution: float, time_constant: float) -> tuple[float, float]:
    """Stiffness (1/s^2) and damping (1/s), per unit mass, of a contact with this restitution and time constant (s).

    Corrected for time stepping: an explicit damper takes `1 - 2 zeta h / tau` per step and so acts as
    `zeta (1 + zeta h / tau)`; the correction assumes four steps to a time constant.
    """
    ratio = damping_ratio(restitution)
    ratio = (sqrt(1 + 4 * STEP_SHARE * ratio) - 1) / (2 * STEP_SHARE)
    damping = 2 * min(ratio, 1.0) / time_constant
    # A damper beyond critical would overshoot within one step of time_constant / 2: soften the spring instead.
    return 1 / (time_constant * max(ratio, 1.0)) ** 2, damping


@lru_cache
def damping_ratio(restitution: float) -> float:
    """The damping ratio of a spring and damper that cannot pull, giving this restitution (0 to 1).

    The inverse of `restitution_of`, by bisection; capped at 3 (restitution 0.03).
    """
    low, high = 0.0, 3.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if restitution_of(middle) > restitution else (low, middle)
    return (low + high) / 2


def restitution_of(ratio: float) -> float:
    """Restitution of a spring and damper of this damping ratio that separates when its force would turn to a pull.

    Source: Schwager and Pöschel 2007, eq. 21, with beta = ratio and omega_0 = 1.
    """
    if ratio < 1:
        omega = sqrt(1 - ratio**2)
        if ratio == sqrt(0.5):
            phase = pi / 2
        else:
            phase = atan(2 * ratio * omega / (2 * ratio**2 - 1))
            phase = phase if phase > 0 else phase + pi
        return exp(-ratio / omega * phase)
    if ratio == 1:
        return exp(-2)
    omega = sqrt(ratio**2 - 1)
    return exp(-ratio / omega * log((ratio + omega) / (ratio - omega)))
