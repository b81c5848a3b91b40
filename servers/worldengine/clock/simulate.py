"""Advance a world step by step, let its inputs act, and record every row.

Where in a step one looks decides which derived quantities belong to which state (manual, "Simulation pipeline"):
`mj_step1` computes everything that follows from positions and velocities, then inputs may act, then `mj_step2`
computes forces and advances the state, leaving poses, velocities of bodies, contacts and forces those of the state
*before*. So a row is copied in two halves, around the forces: state n with what derives from state n. The engine's
`mj_step` is `mj_step1` followed by `mj_step2`, bit for bit, for every single-step integrator (Euler, implicit,
implicitfast, discrete); recording changes nothing.

RK4 has no such halves (`mj_step2` would silently take an Euler step), and it leaves the last stage's contacts behind.
There the forces of the row are computed at the row's own state, and a whole `mj_step` follows from the same state,
again bit for bit. Inputs are asked for once per step and held over its stages.

The engine computes no contacts inside a sleeping island, so the row has none of them. For speculative contacts its
distance is a stand-in that steers the solver; the row holds the true distance.
"""

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from worldkit.errors import DivergedError

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..inputs.replayed_inputs import Drive
    from ..recording.record import Recorder
    from .beside import Beside

Ticker = Callable[[int], object]
HUGE = 1e10
"""MuJoCo's mjMAXVAL: a coordinate, velocity or acceleration beyond it is a blow-up."""


def prepare(model: "mujoco.MjModel") -> None:
    """Switch on what the recording needs: the energy, and no silent reset when the simulation blows up."""
    import mujoco

    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)


def simulate(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    recorder: "Recorder",
    steps: int | Iterable[int],
    inputs: "Drive | None" = None,
    every: int = 1,
    tick: Ticker | None = None,
    beside: "Beside | None" = None,
    leap: "Callable[[], int] | None" = None,
) -> int:
    """Advance `steps` steps, recording every `every`-th state, and the last; returns how many were taken.

    Args:
        model: prepared by `prepare`.
        data: at the initial state.
        recorder: the recorder of the same data.
        steps: how many, or their numbers from 0 on, each when it is due.
        inputs: drives the world each step, with derived quantities up to date.
        tick: called after each step with the number of steps done.
        beside: solvers that step with the engine, after the inputs have acted.
        leap: tells how many steps after the one that was taken no input acts in, no row is of, and nobody else looks at: the engine takes them at once,
            to the same bits.

    Raises:
        DivergedError: a number is no longer finite or sane; it names the body. What was recorded until then is kept.
    """
    import mujoco

    rk4 = model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    velocity_stage = int(mujoco.mjtStage.mjSTAGE_VEL)
    if inputs is not None:
        inputs.record(recorder)
    if beside is not None:
        media = inputs.ports.media if inputs is not None else None
        beside.record(recorder, len(media.rows) if media else 0)
    warned = data.warning.number
    seen = warned.tolist()
    step1, step2, before, after = mujoco.mj_step1, mujoco.mj_step2, recorder.before, recorder.after

    taken = 0
    for step in range(steps) if isinstance(steps, int) else steps:
        row = every == 1 or step % every == 0
        step1(model, data)
        if beside is not None:
            beside.measure()
        if inputs is not None:
            inputs.act(step, before if row else None)
        elif row:
            before()
        if beside is not None:
            beside.act(interfered=inputs is not None)
        if rk4:
            mujoco.mj_forwardSkip(model, data, velocity_stage, 0)
        else:
            step2(model, data)
        if row:
            after()
        if inputs is not None:
            inputs.reacted()
        if beside is not None:
            beside.reacted()
        if rk4:
            mujoco.mj_step(model, data)
        if beside is not None:
            beside.ended()
        taken = step + 1
        if leap is not None and (more := leap()):
            mujoco.mj_step(model, data, more)
            taken += more
        if warned.tolist() != seen:
            seen = _warn(model, data, recorder, seen)
        if tick is not None:
            tick(taken)
    mujoco.mj_forward(model, data)
    if inputs is not None:
        inputs.finish(taken)
    if beside is not None:
        beside.finish()
    before()
    after()
    if warned.tolist() != seen:
        _warn(model, data, recorder, seen)
    return taken


def _warn(model: "mujoco.MjModel", data: "mujoco.MjData", recorder: "Recorder", seen: list[int]) -> list[int]:
    """Record new warnings; a blow-up ends the simulation."""
    import mujoco

    now = data.warning.number.tolist()
    diverged = False
    for kind, (old, new) in enumerate(zip(seen, now, strict=True)):
        if new > old:
            name = mujoco.mjtWarning(kind).name.removeprefix("mjWARN_").lower()
            recorder.event("warnings", data.time, name, new - old)
            diverged |= name in ("badqpos", "badqvel", "badqacc")
    if diverged:
        raise _blow_up(model, data)
    return now


def _blow_up(model: "mujoco.MjModel", data: "mujoco.MjData") -> DivergedError:
    """The error for a simulation that blew up, naming the body where it shows most."""
    import mujoco
    import numpy as np

    def bad(values: "np.ndarray") -> "np.ndarray":
        return ~(np.abs(values) < HUGE)

    sick = bad(data.qacc) | bad(data.qvel)
    for joint in range(model.njnt):
        first, dof = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
        last = model.jnt_qposadr[joint + 1] if joint + 1 < model.njnt else model.nq
        if bad(data.qpos[first:last]).any():
            sick[dof] = True
    severity = np.where(sick, np.nan_to_num(np.abs(data.qacc), nan=np.inf), -1.0)
    dof = int(np.argmax(severity))
    body = (
        mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_BODY, int(model.dof_bodyid[dof]))
        or f"body {model.dof_bodyid[dof]}"
    )
    others = len(set(model.dof_bodyid[sick])) - 1
    also = f" (and {others} more)" if others > 0 else ""
    return DivergedError(
        f"the simulation blew up at t = {data.time:.4f} s: {body}{also} has an acceleration of {data.qacc[dof]:.3g}",
        body,
        "look at the last recorded rows of that body: halve the time step, soften or separate what it touches, or "
        "check the forces and velocities that act on it",
    )
