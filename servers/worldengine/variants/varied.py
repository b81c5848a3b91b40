"""The same world a little otherwise than measured: friction, masses or the start by a factor, in every part of it.

    friction   of every contact of the engine's: geoms, pairs and flexes, sliding, spinning and rolling; not of what a solver
               beside it computes (`given.solvers`)
    masses     of every body that moves, with its inertia: by the factor, by its inverse, and so on in turn, so that who is
               heavier than whom changes, which a factor common to all would hide
    start      the initial velocities, tree by tree by the factor and by its inverse; and loose bodies that nothing ties stand
               across gravity by as much of their size off, unless that would press them into something (of a flex it is
               not known)

A claim that fails then rests on numbers that nobody knows so exactly.
"""

from typing import TYPE_CHECKING

from worldkit.errors import ProgramError

from . import slippery

if TYPE_CHECKING:
    import mujoco
    import numpy as np

KINDS = ("friction", "masses", "start")
FREE = 0
"""mjJNT_FREE."""
DEEPER_M = 1e-6
"""A shifted body may begin so much deeper in another than it did."""


def vary(model: "mujoco.MjModel", kind: str, factor: float) -> None:
    """Change the compiled model.

    Raises:
        ProgramError: there is no such kind; the known ones are listed.
    """
    if kind == "friction":
        slippery.everywhere(model, factor)
    elif kind == "masses":
        _masses(model, factor)
    elif kind == "start":
        _start(model, factor)
    else:
        raise ProgramError(f"nothing varies by the name of {kind}", "--vary", f"name one of: {', '.join(KINDS)}")


def _in_turn(count: int, factor: float) -> "np.ndarray":
    """(count,) the factor, its inverse, the factor …"""
    import numpy as np

    return np.where(np.arange(count) % 2, 1.0 / factor, factor)


def _masses(model: "mujoco.MjModel", factor: float) -> None:
    import mujoco
    import numpy as np

    moving = np.flatnonzero((model.body_treeid >= 0) & (model.body_mass > 0))
    factors = _in_turn(len(moving), factor)
    model.body_mass[moving] *= factors
    model.body_inertia[moving] *= factors[:, None]
    mujoco.mj_setConst(model, mujoco.MjData(model))


def _start(model: "mujoco.MjModel", factor: float) -> None:
    """Change the keyframe that the world begins with; a world without one begins at rest, and its loose bodies are shifted."""
    import mujoco

    from worldkit.world import START, start

    factors = _in_turn(model.ntree, factor)
    key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, START)
    if key >= 0 and model.nv:
        model.key_qvel[key] *= factors[model.dof_treeid]
    positions = model.key_qpos[key] if key >= 0 else model.qpos0
    tied, data = _tied(model), start(model)
    depths = _depths(model, data, positions)
    for joint in range(model.njnt):
        body = int(model.jnt_bodyid[joint])
        tree = int(model.body_treeid[body])
        if model.jnt_type[joint] == FREE and tree not in tied:
            before = positions.copy()
            first = int(model.jnt_qposadr[joint])
            positions[first : first + 3] += _shift(model, tree, float(factors[tree]) - 1.0)
            now = _depths(model, data, positions)  # the whole world collides once for each loose body
            if now[tree] > depths[tree] + DEEPER_M:
                positions[:] = before
            else:
                depths = now


def _shift(model: "mujoco.MjModel", tree: int, share: float) -> "np.ndarray":
    """(3,) this share of the size of a loose body, across gravity, m."""
    import numpy as np

    geoms = np.flatnonzero(model.body_treeid[model.geom_bodyid] == tree)
    size = float(model.geom_rbound[geoms].max(initial=0.0))
    return np.asarray(share * size * _across(model.opt.gravity))


def _across(gravity: "np.ndarray") -> "np.ndarray":
    """(3,) a direction at a right angle to gravity and along no axis of the world where that can be."""
    import numpy as np

    down = gravity / norm if (norm := float(np.linalg.norm(gravity))) else np.array([0.0, 0.0, -1.0])
    across = np.array([0.8, 0.6, 0.0]) - down * (0.8 * down[0] + 0.6 * down[1])
    return np.asarray(across / max(float(np.linalg.norm(across)), 1e-9))


def _depths(model: "mujoco.MjModel", data: "mujoco.MjData", positions: "np.ndarray") -> "np.ndarray":
    """(ntree,) how deep each tree is in what it touches at these positions, m; 0 where it touches nothing."""
    import mujoco
    import numpy as np

    data.qpos[:] = positions
    mujoco.mj_fwdPosition(model, data)
    found = np.zeros(model.ntree)
    for geoms in data.contact.geom.reshape(-1, 2).T:
        trees = model.body_treeid[model.geom_bodyid[np.maximum(geoms, 0)]]
        mine = (geoms >= 0) & (trees >= 0)  # a contact of a flex has no geom there
        np.maximum.at(found, trees[mine], -data.contact.dist[mine])
    return found


def _tied(model: "mujoco.MjModel") -> set[int]:
    """Trees that an equality or a tendon ties to something: shifted, they would begin by being torn back."""
    from worldkit.naming import names

    from ..recording.describing import pulled_bodies, tied_bodies

    called = names(model, "body", model.nbody)
    found = {name for bodies in pulled_bodies(model)["tendon"] for name in bodies}
    found |= {name for equality in range(model.neq) for name in tied_bodies(model, equality, called)}
    return {int(model.body_treeid[body]) for body, name in enumerate(called) if name in found}
