"""Ropes, springs and rods between points of bodies, described in world coordinates at the initial pose.

A rope is a spatial tendon with an upper limit: slack it does nothing, taut it pulls with whatever force keeps its length.
A spring pulls when it is longer than its rest length and pushes when it is shorter. A rod keeps its length, pulled or pushed.

>>> tendons.rope(spec, "leash", [("world", (0, 0, 2)), ("lamp", (0, 0, 1.2))], slack=0.1)
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .joints import Vec3

if TYPE_CHECKING:
    import mujoco

LIMIT_S = 0.016
"""Time constant of a rope's limit, s. Stiffer, a taut rope rattles: a box of 10 kg towed at 0.2 m/s was pulled by 0 to 250 N
at 2 ms, by 0 to 60 N at 16 ms, on average by its friction either way; a weight of 2 kg that falls 0.3 m into it stretches it
by 13 mm for a moment."""
ROUNDED_M = 2e-4
"""Distance, m, by which the ends of a taut rope may be too far apart: plans round coordinates to a tenth of a millimetre."""
PLAY_M = 1e-5
"""Half the play of a rod, m: the engine wants a range that is not empty."""
End = tuple[str, Vec3]
"""Name of a body, or `world`; and a world-frame point at the initial pose, m."""


def rope(
    spec: "mujoco.MjSpec",
    name: str,
    ends: Sequence[End],
    *,
    length: float | None = None,
    slack: float = 0.0,
    time_constant: float = LIMIT_S,
    diameter: float = 0.01,
    look: str = "#c9b48a",
) -> "mujoco.MjsTendon":
    """A line that cannot be longer than `length` (m); None: the way at the start plus `slack` (m).

    A `length` short by up to `ROUNDED_M` is taken for the way at the start: a rope that begins taut.

    Args:
        spec: the world, with its bodies already there.
        name: of the tendon.
        ends: two points or more; those between are guides that it runs through without friction.
        length: metres.
        slack: metres.
        time_constant: of its limit, s; shorter is firmer, four time steps the least.
        diameter: as drawn, m; it touches nothing.
        look: a name from `worldkit.materials`, or `#rrggbb`.

    Raises:
        ValueError: a body that is not there, fewer than two ends, or a length below the way at the start.

    Source: MuJoCo manual, XML reference, `tendon/spatial` (`range`, `solreflimit`).
    """
    import mujoco

    made, way = _line(spec, name, ends, diameter, look)
    longest = way + slack if length is None else length
    if longest < way - ROUNDED_M:
        raise ValueError(
            f"rope {name}: its ends are {way:.6g} m apart at the start, {1000 * (way - longest):.3g} mm more than its "
            f"{longest:.6g} m"
        )
    made.limited = mujoco.mjtLimited.mjLIMITED_TRUE
    made.range = (0.0, max(longest, way))
    made.solref_limit = (max(4 * spec.option.timestep, time_constant), 1.0)
    return made


def spring(
    spec: "mujoco.MjSpec",
    name: str,
    ends: Sequence[End],
    *,
    stiffness: float,
    length: float | None = None,
    pretension: float = 0.0,
    damping: float = 0.0,
    diameter: float = 0.01,
    look: str = "steel_brushed",
) -> "mujoco.MjsTendon":
    """A linear spring of `stiffness` (N/m) that rests at `length` (m; None: as long as at the start).

    With `pretension` (N), instead of `length`, it pulls with that force at the start. `damping` (N·s/m) acts along its whole length. The other arguments are those of `rope`. Source: MuJoCo manual, `tendon/spatial` (`stiffness`, `springlength`).
    """
    made, way = _line(spec, name, ends, diameter, look)
    if pretension and (length is not None or pretension > stiffness * way):
        said = (
            "give `length` or `pretension`"
            if length is not None
            else f"{stiffness * way:.4g} N is the most it can have"
        )
        raise ValueError(f"spring {name}: a pretension of {pretension:g} N: {said}")
    rest = way - pretension / stiffness if length is None else length
    made.stiffness[0] = stiffness
    made.damping[0] = damping
    made.springlength = (rest, rest)
    return made


def rod(
    spec: "mujoco.MjSpec",
    name: str,
    ends: Sequence[End],
    *,
    time_constant: float | None = None,
    diameter: float = 0.01,
    look: str = "steel_brushed",
) -> "mujoco.MjsTendon":
    """A rigid rod without mass, as long as the way between its two ends at the start; it turns freely at both.

    Its force stands in the recording as a tension, negative while it pushes. A rod whose mass matters is a body with a joint at
    either end.

    Args:
        time_constant: s with which it comes back to its length; None: four time steps, the least. The other arguments are
            those of `rope`.

    Raises:
        ValueError: a body that is not there, ends other than two, or two that lie at one point.

    Source: MuJoCo manual, XML reference, `tendon/spatial` (`range`, `solreflimit`): a limit on either side.
    """
    import mujoco

    if len(ends) != 2:
        raise ValueError(f"rod {name}: it has two ends, got {len(ends)}")
    made, way = _line(spec, name, ends, diameter, look)
    if way < 10 * PLAY_M:
        raise ValueError(f"rod {name}: its ends lie at one point")
    made.limited = mujoco.mjtLimited.mjLIMITED_TRUE
    made.range = (way - PLAY_M, way + PLAY_M)
    least = 4 * spec.option.timestep
    made.solref_limit = (least if time_constant is None else max(least, time_constant), 1.0)
    return made


def _line(
    spec: "mujoco.MjSpec", name: str, ends: Sequence[End], diameter: float, look: str
) -> "tuple[mujoco.MjsTendon, float]":
    """The tendon through its sites, and its length at the initial pose."""
    import itertools

    import numpy as np

    from . import materials
    from .poses import world_pose

    if len(ends) < 2:
        raise ValueError(f"tendon {name}: it needs two ends, got {len(ends)}")
    made = spec.add_tendon(name=name, width=diameter / 2, material=materials.add(spec, look))
    points = [np.asarray(point, dtype=float) for _, point in ends]
    for k, (owner, point) in enumerate(zip((body for body, _ in ends), points, strict=True)):
        body = spec.worldbody if owner == "world" else spec.body(owner)
        if body is None:
            known = ", ".join(b.name for b in spec.bodies)
            raise ValueError(f"tendon {name}: there is no body {owner!r} to fasten it to; known: {known}")
        origin, rotation = world_pose(body)
        site = body.add_site(name=f"{name}_{k}", pos=rotation.T @ (point - origin), size=(diameter / 2,) * 3, group=4)
        made.wrap_site(site.name)
    return made, float(sum(np.sqrt(((b - a) ** 2).sum()) for a, b in itertools.pairwise(points)))
