"""Ropes hold, springs stretch as Hooke says, motors push with what they are told: measured in the engine."""

import mujoco
import numpy as np
import pytest

from worldkit import actuators, bodies, joints, scene, tendons


def world(gravity: float = -9.81) -> mujoco.MjSpec:
    spec = scene.new("t", time_step=0.001, gravity=(0, 0, gravity), setting="studio")
    bodies.sphere(spec, "bob", diameter=0.1, pos=(0, 0, 2.0), mass=2.0)
    return spec


def run(spec: mujoco.MjSpec, seconds: float, control=None) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = spec.compile()
    data = mujoco.MjData(model)
    for _ in range(round(seconds / model.opt.timestep)):
        if control:
            control(data)
        mujoco.mj_step(model, data)
    mujoco.mj_forward(model, data)
    return model, data


def test_a_rope_is_slack_then_holds_at_its_length():
    spec = world()
    tendons.rope(spec, "rope", [("world", (0, 0, 3)), ("bob", (0, 0, 2.05))], slack=0.3)
    _, early = run(spec, 0.2)
    assert early.body("bob").xpos[2] == pytest.approx(2 - 9.81 * 0.2**2 / 2, abs=5e-3)
    model, data = run(spec, 4.0)
    assert model.tendon_range[model.tendon("rope").id, 1] == pytest.approx(0.95 + 0.3)
    assert data.tendon("rope").length[0] == pytest.approx(1.25, rel=2e-3)


def test_a_spring_hangs_by_its_load():
    spec = world()
    tendons.spring(spec, "spring", [("world", (0, 0, 3)), ("bob", (0, 0, 2.05))], stiffness=200.0, damping=20.0)
    _, data = run(spec, 6.0)
    assert data.tendon("spring").length[0] - 0.95 == pytest.approx(2 * 9.81 / 200, rel=1e-3)


def test_a_rope_runs_through_its_guide():
    spec = world()
    bodies.sphere(spec, "weight", diameter=0.1, pos=(1, 0, 2.0), mass=3.0)
    ends = [("bob", (0, 0, 2.05)), ("world", (0, 0, 3)), ("world", (1, 0, 3)), ("weight", (1, 0, 2.05))]
    tendons.rope(spec, "rope", ends)
    _, data = run(spec, 0.5)
    # Atwood's machine: a = g (M - m) / (M + m).
    assert data.body("weight").xpos[2] == pytest.approx(2 - 9.81 / 5 * 0.5**2 / 2, abs=0.01)


@pytest.mark.parametrize("wrong", [[("bob", (0, 0, 2))], [("world", (0, 0, 3)), ("nobody", (0, 0, 2))]])
def test_what_cannot_be_fastened_is_refused(wrong):
    with pytest.raises(ValueError, match="tendon rope"):
        tendons.rope(world(), "rope", wrong)


def test_a_rope_shorter_than_its_way_is_refused():
    with pytest.raises(ValueError, match="at the start"):
        tendons.rope(world(), "rope", [("world", (0, 0, 3)), ("bob", (0, 0, 2))], length=0.5)


def cart() -> mujoco.MjSpec:
    spec = scene.new("t", time_step=0.001, gravity=(0, 0, 0), setting="studio")
    slide = joints.Slide("rail", axis=(1, 0, 0))
    bodies.box(spec, "cart", size=(0.2, 0.2, 0.2), pos=(0, 0, 1), mass=2.0, joint=slide)
    return spec


def test_a_motor_pushes_with_its_control_up_to_its_limit():
    spec = cart()
    actuators.motor(spec, "push", joint="rail", limit=6.0)
    _, data = run(spec, 1.0, lambda d: d.actuator("push").ctrl.__setitem__(0, 4.0))
    assert data.joint("rail").qvel[0] == pytest.approx(2.0, rel=1e-6)
    _, data = run(spec, 1.0, lambda d: d.actuator("push").ctrl.__setitem__(0, 40.0))
    assert data.joint("rail").qvel[0] == pytest.approx(3.0, rel=1e-6)


def test_servos_hold_what_they_are_told():
    spec = cart()
    actuators.position(spec, "place", joint="rail", gain=200.0, damping=40.0)
    _, data = run(spec, 3.0, lambda d: d.actuator("place").ctrl.__setitem__(0, 0.25))
    assert data.joint("rail").qpos[0] == pytest.approx(0.25, abs=1e-4)
    spec = cart()
    actuators.velocity(spec, "speed", joint="rail", gain=50.0)
    _, data = run(spec, 1.0, lambda d: d.actuator("speed").ctrl.__setitem__(0, 0.5))
    assert np.isclose(data.joint("rail").qvel[0], 0.5)
    with pytest.raises(ValueError, match="no joint 'rial'"):
        actuators.motor(cart(), "push", joint="rial")


def test_a_rope_may_begin_taut_although_its_ends_were_rounded():
    spec = world()
    made = tendons.rope(spec, "short", [("world", (0, 0, 2)), ("world", (0, 0, 1))], length=0.9999)
    assert made.range[1] == 1.0
    with pytest.raises(ValueError, match=r"1\.000000 m|1 m apart at the start, 1 mm more than its 0\.999 m"):
        tendons.rope(spec, "shorter", [("world", (0, 0, 2)), ("world", (0, 0, 1))], length=0.999)


def test_a_rope_holds_as_soon_as_it_is_told_and_not_sooner_than_four_steps():
    spec = world()
    ends = [("world", (0, 0, 2)), ("world", (0, 0, 1))]
    assert tendons.rope(spec, "firm", ends, time_constant=0.01).solref_limit[0] == 0.01
    assert tendons.rope(spec, "firmer", ends, time_constant=1e-9).solref_limit[0] == 4 * spec.option.timestep


def thrown_up(line) -> tuple[float, float, float]:
    """A bob below a hook goes up with 4 m/s, a little aside: its least and greatest distance from the hook, and its greatest height, m."""
    spec = world()
    line(spec, "line", [("world", (0, 0, 3)), ("bob", (0, 0, 2.0))])
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[:3] = (0.4, 0, 4.0)
    far, high = [], []
    for _ in range(700):
        mujoco.mj_step(model, data)
        far.append(float(np.linalg.norm(data.body("bob").xpos - (0, 0, 3))))
        high.append(float(data.body("bob").xpos[2]))
    return min(far), max(far), max(high)


def test_a_rod_pushes_where_a_rope_goes_slack():
    least, most, high = thrown_up(tendons.rod)
    assert least == pytest.approx(1.0, abs=0.01) and most == pytest.approx(1.0, abs=0.01), "4 m/s, stopped within 4 ms"
    assert high < 2.1, "its speed along the rod is stopped at once"
    assert thrown_up(tendons.rope)[0] < 0.5 and thrown_up(tendons.rope)[2] > 2.5


def test_a_rod_swings_over_its_top_as_a_pendulum_does():
    """v at the bottom 6.6 m/s: at the top v^2 = v0^2 - 4 g L, where a rope would need g L to stay taut."""
    spec = world()
    tendons.rod(spec, "rod", [("world", (0, 0, 3)), ("bob", (0, 0, 2.0))])
    model = spec.compile()
    data = mujoco.MjData(model)
    data.qvel[0] = 6.6
    while data.body("bob").xpos[2] < 3.999 and data.time < 2:
        mujoco.mj_step(model, data)
    assert float(np.linalg.norm(data.qvel[:3])) == pytest.approx((6.6**2 - 4 * 9.81) ** 0.5, rel=0.03)


@pytest.mark.parametrize(
    "ends", [[("bob", (0, 0, 2)), ("bob", (0, 0, 2))], [("world", (0, 0, 3)), ("world", (0, 1, 3)), ("bob", (0, 0, 2))]]
)
def test_a_rod_has_two_ends_apart(ends):
    with pytest.raises(ValueError, match="rod rod: "):
        tendons.rod(world(), "rod", ends)
