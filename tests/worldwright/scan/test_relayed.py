"""A cause that only sets another motor off is no proof of what that motor does: told where the plan says so, else untested."""

from pathlib import Path

import mujoco
import pytest
from staged import Audit, World, audit, declare, empty

WAITS = 0.05  # m: the press waits until the cutter has gone so far


def bench() -> mujoco.MjSpec:
    """A cutter that a motor draws along x, and a pad that another motor presses down."""
    spec = empty(gravity=0.0, floor=False)
    for name, axis, y in (("cutter", (1, 0, 0), 0.0), ("pad", (0, 0, -1), 1.0)):
        body = spec.worldbody.add_body(name=name, pos=(0, y, 1))
        body.add_joint(name=f"{name} slide", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis, damping=1.0)
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.05, 0.05), mass=1.0)
        motor = spec.add_actuator(
            name="draw" if name == "cutter" else "press", trntype=mujoco.mjtTrn.mjTRN_JOINT, target=f"{name} slide"
        )
        motor.gainprm[0] = 1.0
    return spec


def presses_in_turn(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """The press waits for the cutter."""
    data.ctrl[:] = 2.0, 3.0 if data.qpos[0] > WAITS else 0.0


def presses_anyway(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """The press does not, and is only helped by it."""
    data.ctrl[:] = 2.0, 1.0 + 3.0 * min(max(data.qpos[0], 0.0), 1.0)


def told(tmp_path: Path, control: object, cause: str = "cutter", **press: str) -> Audit:
    rows = (declare("control", "draw"), declare("control", "press", **press))
    claim = {
        "claim": "the cut lets the pad sink",
        "cause": [cause],
        "expect": [{"moves": {"body": "pad", "min_m": 0.3}}],
    }
    return audit(World(bench, control, 1.0, ("cutter", "pad"), rows, (claim,)), tmp_path)


def test_a_press_that_waits_for_the_cutter_and_does_not_say_so_leaves_the_cut_untested(tmp_path: Path) -> None:
    found = told(tmp_path, presses_in_turn)
    (cause,) = found.causes.causes
    assert cause.outcome == "unclear"
    assert "neither does press, which acts from 0.2" in cause.message
    assert "WS324" in found.codes()


@pytest.mark.parametrize(
    "press", [{"trigger": "speed of cutter > 0.3 m/s"}, {"law": "once cutter is out of the way, 3 N"}]
)
def test_where_the_plan_says_so_it_is_told(tmp_path: Path, press: dict[str, str]) -> None:
    (cause,) = told(tmp_path, presses_in_turn, **press).causes.causes
    assert cause.outcome == "caused"
    assert (
        f"it sets off press (in the plan: {next(iter(press.values()))}), whose work without cutter was not tried"
        in cause.message
    )


@pytest.mark.parametrize(
    ("control", "cause"), [(presses_anyway, "cutter"), (presses_in_turn, "press"), (presses_in_turn, "pad")]
)
def test_a_motor_that_acts_all_the_same_or_is_the_cause_itself_is_no_relay(
    tmp_path: Path, control: object, cause: str
) -> None:
    (result,) = told(tmp_path, control, cause).causes.causes
    assert result.outcome == ("survives" if control is presses_anyway and cause == "cutter" else "caused"), (
        result.message
    )
    assert "not tried" not in result.message


def test_all_that_control_sends_is_no_relay_of_itself(tmp_path: Path) -> None:
    (result,) = told(tmp_path, presses_in_turn, "control").causes.causes
    assert "not tried" not in result.message and "neither does" not in result.message, result.message
