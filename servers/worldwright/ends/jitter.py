"""Let an episode begin a little otherwise than recorded, by amounts in the plan's units: metres, degrees, metres a second."""

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from ..model.errors import GateError, NotFoundError

if TYPE_CHECKING:
    import mujoco

WORDS = ("position_m", "turn_deg", "speed_m_s", "spin_deg_s")
Jitter = Mapping[str, Mapping[str, float]]
"""By a loose body or a hinge or slide: the most that each may be off, either way, equally likely."""


def shake(model: "mujoco.MjModel", data: "mujoco.MjData", jitter: Jitter, rng: np.random.Generator) -> None:
    """Change qpos and qvel.

    A loose body: `position_m` and `speed_m_s` along world x and y each, `turn_deg` and `spin_deg_s` about the vertical. A slide:
    `position_m`, `speed_m_s`. A hinge: `turn_deg`, `spin_deg_s`. What then overlaps is the caller's business.

    Raises:
        NotFoundError: neither a loose body nor a hinge or slide has this name, or it has no such amount.
        GateError: an amount is no finite number.
    """
    import mujoco

    free, slide, hinge = (int(getattr(mujoco.mjtJoint, f"mjJNT_{kind}")) for kind in ("FREE", "SLIDE", "HINGE"))
    known: dict[str, int] = {}
    for joint in range(model.njnt):
        kind = int(model.jnt_type[joint])
        loose = kind == free
        name = model.body(model.jnt_bodyid[joint]).name if loose else model.joint(joint).name
        if kind in (free, slide, hinge):
            known[name] = joint
    for name, amounts in jitter.items():
        if name not in known:
            cause = f"nothing of this world that can be shaken is called {name!r}"
            raise NotFoundError(cause, next_move=f"name one of: {', '.join(sorted(known))}")
        kind = int(model.jnt_type[known[name]])
        own = WORDS if kind == free else WORDS[::2] if kind == slide else WORDS[1::2]
        if odd := sorted(set(amounts) - set(own)):
            raise NotFoundError(f"{name} has no {', '.join(odd)}", next_move=f"give it some of: {', '.join(own)}")
        if bad := [word for word, amount in amounts.items() if not _finite(amount)]:
            raise GateError(f"{name}: {', '.join(bad)} must be finite", next_move="give metres, degrees, or 0 for none")
        _one(model, data, known[name], amounts, rng)


def _finite(amount: object) -> bool:
    return isinstance(amount, (int, float, np.number)) and bool(np.isfinite(amount))


def _one(
    model: "mujoco.MjModel", data: "mujoco.MjData", joint: int, amounts: Mapping[str, float], rng: np.random.Generator
) -> None:
    import mujoco

    at, dof = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
    # All are drawn, whether asked for or not: a seed means the same for each.
    x, y, turn, vx, vy, spin = (
        rng.uniform(-1, 1, 6)
        * [
            *2 * [amounts.get("position_m", 0.0)],
            np.radians(amounts.get("turn_deg", 0.0)),
            *2 * [amounts.get("speed_m_s", 0.0)],
            np.radians(amounts.get("spin_deg_s", 0.0)),
        ]
    ).tolist()
    if model.jnt_type[joint] != int(mujoco.mjtJoint.mjJNT_FREE):
        data.qpos[at] += x + turn
        data.qvel[dof] += vx + spin
        return
    data.qpos[at : at + 2] += x, y
    data.qvel[dof : dof + 2] += vx, vy
    turned, old = np.zeros(4), data.qpos[at + 3 : at + 7].copy()
    mujoco.mju_mulQuat(turned, np.array([np.cos(turn / 2), 0, 0, np.sin(turn / 2)]), old)
    data.qpos[at + 3 : at + 7] = turned
    up = np.zeros(3)
    mujoco.mju_rotVecQuat(up, np.array([0.0, 0.0, spin]), np.array([turned[0], *-turned[1:]]))
    data.qvel[dof + 3 : dof + 6] += up  # the engine has a loose body's spin in its own frame
