"""The clock: advances the world step by step, lets the program control it, and records every row.

Which derived quantities belong to which state is a matter of where in a step one looks (manual, "Simulation pipeline"):
`mj_step1` computes everything that follows from positions and velocities, then the program may act, then `mj_step2`
computes forces and advances the state, leaving poses, velocities of bodies, contacts and forces those of the state
*before*. So a row is copied in two halves, around the forces: state n with what derives from state n. The engine's
`mj_step` is `mj_step1` followed by `mj_step2`, bit for bit, for every single-step integrator (Euler, implicit,
implicitfast, discrete); recording changes nothing.

RK4 has no such halves (`mj_step2` would silently take an Euler step), and it leaves the last stage's contacts behind.
There the forces of the row are computed at the row's own state, and a whole `mj_step` follows from the same state,
again bit for bit. `control` is asked once a step and held over its stages; a law that must be asked at every stage
belongs into an engine callback.

Sleeping islands: contacts inside an island that sleeps are not computed by the engine, so they are not in the row.
Speculative contacts: the engine's distance is a stand-in that steers its solver; the row holds the true one.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

from .errors import DivergedError
from .interventions import Ledger, installed_callbacks

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .record import Recorder

Control = Callable[["mujoco.MjModel", "mujoco.MjData"], object]
Ticker = Callable[[int], object]
HUGE = 1e10
"""MuJoCo's mjMAXVAL: a coordinate, velocity or acceleration beyond it is a blow-up."""


def prepare(model: "mujoco.MjModel") -> None:
    """Switch on what the recording needs: energy, and no silent reset when the simulation blows up."""
    import mujoco

    model.opt.enableflags |= int(mujoco.mjtEnableBit.mjENBL_ENERGY)
    model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)


def simulate(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    recorder: "Recorder",
    steps: int,
    control: Control | None = None,
    every: int = 1,
    tick: Ticker | None = None,
) -> None:
    """Advance `steps` steps, recording every `every`-th state, and the last.

    Args:
        model: prepared by `prepare`.
        data: at the initial state.
        recorder: of the same data.
        control: called each step with derived quantities up to date; may write controls, forces, anything.
        tick: called after each step with the number of steps done.

    Raises:
        DivergedError: a number stopped being sane; names the body. What was recorded until then is kept.
    """
    import mujoco

    rk4 = model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    velocity_stage = int(mujoco.mjtStage.mjSTAGE_VEL)
    called_back = any(callback is not None for callback in installed_callbacks())
    acts = control is not None or called_back
    ledger = Ledger(model, data, recorder.event, lambda: recorder.recorded) if acts else None
    warned = data.warning.number
    seen = warned.tolist()
    step1, step2, before, after = mujoco.mj_step1, mujoco.mj_step2, recorder.before, recorder.after

    for step in range(steps):
        row = every == 1 or step % every == 0
        watched = called_back
        if ledger is not None and watched:
            ledger.watch()  # a callback acts inside mj_step1
        step1(model, data)
        if ledger is not None:
            ledger.settle()
            if not watched:
                ledger.watch()
            ledger.watch_derived()
            if control is not None:
                control(model, data)
            called_back = ledger.compare()
        if row:
            before()
        if rk4:
            mujoco.mj_forwardSkip(model, data, velocity_stage, 0)
        else:
            step2(model, data)
        if row:
            after()
        if ledger is not None:
            ledger.reacted()
        if rk4:
            mujoco.mj_step(model, data)
        if warned.tolist() != seen:
            seen = _warn(model, data, recorder, seen)
        if tick is not None:
            tick(step + 1)
    mujoco.mj_forward(model, data)
    if ledger is not None:
        ledger.settle()
        ledger.check_bulk()
    before()
    after()
    if warned.tolist() != seen:
        _warn(model, data, recorder, seen)


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
