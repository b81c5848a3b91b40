"""The action of an accepted world: its declared controls, each with unit, bounds, and who says so."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..model.errors import GateError, NotFoundError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import mujoco
    import numpy as np

    from ..model.plan.committed import Plan

UNITS = {"motor": ("N·m", "N"), "position": ("rad", "m"), "velocity": ("rad/s", "m/s")}
"""Of a control by its actuator's kind: on a hinge, on a slide."""


@dataclass(frozen=True)
class ControlInput:
    """One entry of the action."""

    name: str
    index: int
    """Into the engine's `ctrl`."""
    unit: str
    low: float
    high: float
    bounded_by: str
    """Who says so: the caller, the model's ctrlrange, the plan's limit, joint or number, the recording, or nobody.

    Where the model clamps nothing, what was recorded beyond such a bound is allowed, too: "the joint's range, and the recording".
    """
    kind: str = "motor"
    """`position` and `velocity` for servos; `motor` for all else."""


def control_inputs(
    model: "mujoco.MjModel",
    plan: "Plan",
    indices: "Sequence[int]",
    recorded: "np.ndarray",
    bounds: "Mapping[str, tuple[float, float]] | None" = None,
) -> tuple[ControlInput, ...]:
    """The controls at these indices of `ctrl`.

    Args:
        model: the world.
        plan: says limits of motors and the numbers that controls are given.
        indices: of `ctrl`.
        recorded: (K, len(indices)) what the controls were in the recording.
        bounds: the caller's own, by name; they are believed first.

    Raises:
        NotFoundError: `bounds` names what is no control of this world; the known ones are listed.
    """
    from worldengine.recording.describing import actuator_columns

    called = actuator_columns(model)[0]
    names = [called[index] for index in indices]
    if unknown := sorted(set(bounds or {}) - set(names)):
        raise NotFoundError(
            f"no control of this world is called {', '.join(unknown)}",
            next_move=f"give bounds to some of: {', '.join(names) or '(it has none)'}",
        )
    found = []
    for column, (index, name) in enumerate(zip(indices, names, strict=True)):
        kind, unit, joint = _drive(model, index)
        said = (bounds or {}).get(name)
        if said is not None:
            low, high, by = float(said[0]), float(said[1]), "the caller"
        else:
            low, high, by = _bounds(model, plan, index, name, kind, joint, recorded[:, column])
            if not model.actuator_ctrllimited[index]:
                low, high, by = _with(recorded[:, column], low, high, by)
        found.append(ControlInput(name, index, unit, low, high, by, kind))
    return tuple(found)


def _with(recorded: "np.ndarray", low: float, high: float, by: str) -> tuple[float, float, str]:
    """Bounds widened to what was recorded: an action that is clipped would not give the recorded motion."""
    least, most = float(recorded.min(initial=low)), float(recorded.max(initial=high))
    return (low, high, by) if (least, most) == (low, high) else (least, most, f"{by}, and the recording")


def _drive(model: "mujoco.MjModel", control: int) -> tuple[str, str, int]:
    """(kind, unit, joint) of what a control drives; the joint is -1 where it is no joint of one axis."""
    import mujoco
    import numpy as np

    actuator = int(np.searchsorted(np.cumsum(model.actuator_ctrlnum), control, side="right"))
    gain, bias = model.actuator_gainprm[actuator], model.actuator_biasprm[actuator]
    affine = model.actuator_biastype[actuator] == int(mujoco.mjtBias.mjBIAS_AFFINE)
    kind = "motor"
    if affine and gain[0] and bias[1] == -gain[0]:
        kind = "position"
    elif affine and gain[0] and bias[2] == -gain[0]:
        kind = "velocity"
    turns = (int(mujoco.mjtTrn.mjTRN_JOINT), int(mujoco.mjtTrn.mjTRN_JOINTINPARENT))
    of_joint = int(model.actuator_trntype[actuator]) in turns
    joint = int(model.actuator_trnid[actuator, 0]) if of_joint else -1
    types = {int(mujoco.mjtJoint.mjJNT_HINGE): 0, int(mujoco.mjtJoint.mjJNT_SLIDE): 1}
    form = types.get(int(model.jnt_type[joint])) if joint >= 0 else None
    if form is None or (kind == "motor" and gain[0] != 1.0):
        return kind, "actuator's", joint if form is not None else -1
    return kind, UNITS[kind][form], joint


def _bounds(
    model: "mujoco.MjModel", plan: "Plan", control: int, name: str, kind: str, joint: int, recorded: "np.ndarray"
) -> tuple[float, float, str]:
    import numpy as np

    if model.actuator_ctrllimited[control]:
        low, high = model.actuator_ctrlrange[control]
        return float(low), float(high), "the model's ctrlrange"
    row: Any = next((row for row in plan.topology.actuators if row.name == name), None)
    if row is not None and row.kind == "motor" and row.limit:
        return -row.limit, row.limit, "the plan's limit"
    if kind == "position" and joint >= 0 and model.jnt_limited[joint]:
        low, high = model.jnt_range[joint]
        return float(low), float(high), "the joint's range"
    value: Any = row.control if row is not None else None
    if isinstance(value, str):
        constant = plan.simulation_parameters.constants.get(value)
        value = constant.value if constant is not None else None
    if isinstance(value, (int, float)) and value:
        return -abs(float(value)), abs(float(value)), "the plan's number, either way"
    largest = float(np.abs(recorded).max(initial=0.0))
    return (-largest, largest, "the recording, either way") if largest else (-np.inf, np.inf, "nobody")


def checked(action: Any, shape: tuple[int, ...]) -> "np.ndarray":
    """An action as an array of this shape; a `GateError` where it is none, or a number of it is not finite."""
    import numpy as np

    try:
        given = np.asarray(action, float)
    except (TypeError, ValueError):
        given = np.full((), np.nan)
    if given.shape != shape or not np.isfinite(given).all():
        numbers = " x ".join(map(str, shape))
        raise GateError(f"{action!r} is no action of {numbers} finite numbers", next_move="see env.unwrapped.inputs")
    return given
