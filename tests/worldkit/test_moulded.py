"""Soft solids: squeezed as textbooks say, dented for good where they yield, with a skin that rides on what is reckoned."""

import mujoco
import numpy as np
import pytest

from worldkit import sculpt
from worldkit.errors import ProgramError
from worldkit.matter import Liquid, Matter, Moulded, Solid, block, clay, foam
from worldkit.matter.lattices import filled, ridden

SIDE = 0.06


def press(stuff: Solid, cell: float = 0.015, pull: float = 0.0) -> tuple[Moulded, mujoco.MjModel, mujoco.MjData]:
    """A cube between a table and a plate that is led by the hand, both without friction."""

    class Pressed(Moulded):
        name, bodies = "cube", ("table", "plate")

    box = '<geom type="box" size=".1 .1 .01"/>'
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="0 0 {-pull}"/><worldbody><body name="table" pos="0 0 -.01">{box}</body>'
        f'<body name="plate" mocap="true" pos="0 0 {SIDE + 0.01}">{box}</body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    law = Pressed(stuff.but(wall_friction=1e-9), sculpt.box((SIDE, SIDE, SIDE)), (0, 0, SIDE / 2), cell)
    law.start(model, data)
    return law, model, data


def squeezed(
    law: Moulded, model: mujoco.MjModel, data: mujoco.MjData, by: float, seconds: float, moves: float = 0.8
) -> np.ndarray:
    """The forces once the plate has gone down by so much, m, in a share of the time."""
    felt = np.zeros((2, 6))
    for k in range(round(seconds / 0.002)):
        data.mocap_pos[0, 2] = SIDE + 0.01 - by * min(1.0, (k + 1) * 0.002 / (moves * seconds))
        mujoco.mj_forward(model, data)
        felt = law.step(model, data, 0.002)
    return felt


def uniaxial(stuff: Solid, stretch: float) -> float:
    """Nominal stress, Pa, of a compressible neo-Hookean bar with free sides."""
    lam, mu = stuff.lame
    wide = 1.0
    for _ in range(100):
        wide -= (mu * (wide**2 - 1) + lam * np.log(stretch * wide**2)) / (2 * mu * wide + 2 * lam / wide)
    return float((mu * (stretch**2 - 1) + lam * np.log(stretch * wide**2)) / stretch)


@pytest.mark.parametrize(("poisson", "stretch"), [(0.1, 0.5), (0.3, 0.7)])
def test_foam_pushes_back_as_a_neo_hookean_solid_does(poisson: float, stretch: float) -> None:
    stuff = foam().but(poisson=poisson)
    law, model, data = press(stuff)
    felt = squeezed(law, model, data, (1 - stretch) * SIDE, 0.4)
    skin = law.points[: len(law.points) - len(law._x)]
    real = float(np.ptp(skin[:, 2])) / SIDE  # walls yield a little
    assert real == pytest.approx(stretch, abs=0.02)
    assert felt[1, 2] == pytest.approx(-uniaxial(stuff, real) * SIDE**2, rel=0.03)
    assert felt[0, 2] == pytest.approx(-felt[1, 2], rel=0.02)


def test_clay_yields_at_its_stress_and_keeps_its_room() -> None:
    law, model, data = press(clay().but(creeps=0.0))
    room = law.volume()
    felt = squeezed(law, model, data, 0.015, 0.25, moves=1.0)
    skin = law.points[: len(law.points) - len(law._x)]
    area = float(np.ptp(skin[:, 0]) * np.ptp(skin[:, 1]))
    assert felt[1, 2] / area == pytest.approx(law.stuff.yields, rel=0.06)
    assert law.volume() == pytest.approx(room, rel=0.03)
    squeezed(law, model, data, -0.005, 0.02)  # the plate goes up again, and the clay stays low
    assert np.ptp(law.points[:, 2]) < SIDE - 0.012


def test_a_ball_leaves_its_dent_and_nothing_comes_from_nowhere() -> None:
    class Clay(Moulded):
        name, bodies = "clay", ("world", "ball")

    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><geom type="plane" size="1 1 1"/><body name="ball" pos="0 0 .0655"><freejoint/>'
        '<geom type="sphere" size=".02" density="7850"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    data.qvel[2] = -2.0
    mujoco.mj_forward(model, data)
    law = Clay(clay(), sculpt.box((0.09, 0.09, 0.045)), (0, 0, 0.0225), 0.011)
    law.start(model, data)
    before, given = data.qvel[2] * model.body_mass[1], np.zeros(6)
    for _ in range(40):
        felt = law.step(model, data, 0.001)
        given += 0.001 * felt.sum(axis=0)
        data.xfrc_applied[1] = felt[1]
        mujoco.mj_step(model, data)
    # what the bodies got, the clay lost, but for its weight
    going = (law.mass[:, None] * law.velocities).sum(axis=0)
    assert given[:3] + going - [0, 0, 0.04 * law.mass.sum() * -9.81] == pytest.approx(np.zeros(3), abs=1e-9)
    assert data.qvel[2] * model.body_mass[1] > before and data.qvel[2] > -0.2  # it was stopped
    skin = law.points[: len(law.points) - len(law._x)]
    top = skin[np.hypot(skin[:, 0], skin[:, 1]) < 0.006][:, 2].max()
    assert top < 0.045 - 0.004


def test_what_lies_still_is_not_reckoned_and_its_price_says_so_until_a_jaw_creeps_on() -> None:
    stuff = foam().but(damping=5e-4, down_to=0.8)
    law, model, data = press(stuff, pull=9.81)
    for _ in range(400):
        felt = law.step(model, data, 0.002)
    assert law.grows(0.4, 9.0) > 2.0
    assert felt[:, :3].sum(axis=0) == pytest.approx([0, 0, -9.81 * law.mass.sum()])
    for k in range(1500):  # 0.9 mm/s: slower than what wakes it at once
        data.mocap_pos[0, 2] = SIDE + 0.01 - 0.9e-3 * 0.002 * (k + 1)
        mujoco.mj_forward(model, data)
        felt = law.step(model, data, 0.002)
    assert felt[1, 2] == pytest.approx(-uniaxial(stuff, 1 - 0.0027 / SIDE) * SIDE**2, rel=0.12)


def test_what_moves_far_away_wakes_nothing() -> None:
    class Clay(Moulded):
        name, bodies = "clay", ("world", "ball")

    model = mujoco.MjModel.from_xml_string(
        '<mujoco><worldbody><geom type="plane" size="1 1 1"/><body name="ball" pos="0 0 .6"><freejoint/>'
        '<geom type="sphere" size=".02"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    law = Clay(clay(), sculpt.box((0.06, 0.06, 0.06)), (0, 0, 0.03), 0.02)
    law.start(model, data)
    for _ in range(100):
        law.step(model, data, 0.002)
        mujoco.mj_step(model, data)
    assert data.qvel[2] < -1 and law.grows(0.2, 1.0) > 3.0, "it lies still while the ball falls"


def test_what_was_thrown_up_does_not_hang_where_it_turns() -> None:
    law, model, data = press(clay(), pull=9.81)
    data.mocap_pos[0, 2] = 1.0
    mujoco.mj_forward(model, data)
    for _ in range(40):
        law.step(model, data, 0.001)
    rest, speed = law.points[:, 2].mean(), 0.5
    law._v[:, 2] += speed
    law._calm = 0
    for _ in range(80):
        law.step(model, data, 0.001)
    assert law.points[:, 2].mean() - rest == pytest.approx(speed * 0.08 - 9.81 * 0.08**2 / 2, abs=1.5e-3)


def test_a_round_shape_is_filled_to_its_surface() -> None:
    lattice = filled(sculpt.sphere(0.08), 0.01, "ball")
    assert lattice.room.min() > 0
    assert lattice.room.sum() == pytest.approx(np.pi / 6 * 0.08**3, rel=0.03)
    assert lattice.area.sum() == pytest.approx(np.pi * 0.08**2, rel=0.15)


def test_the_skin_rides_on_whatever_turns_and_stretches() -> None:
    shape = sculpt.ellipsoid((0.08, 0.06, 0.05))
    lattice = filled(shape, 0.01, "ball")
    corners = np.random.default_rng(3).normal(size=(50, 3))
    corners *= (0.04, 0.03, 0.025) / np.linalg.norm(corners, axis=1, keepdims=True)
    nodes, share = ridden(lattice, corners)
    turn = np.array([[0.4, -1.1, 0.0], [0.9, 0.3, 0.2], [0.0, 0.1, 1.3]])
    carried = (share[..., None] * (lattice.nodes @ turn.T + (1, 2, 3))[nodes]).sum(axis=1)
    assert carried == pytest.approx(corners @ turn.T + (1, 2, 3), abs=1e-6)


def test_what_cannot_be_is_refused_with_the_number_that_can() -> None:
    with pytest.raises(ProgramError, match="poisson"):
        Solid(poisson=0.49)
    with pytest.raises(ProgramError, match="corners") as refused:
        Moulded(foam(), sculpt.box((0.1, 0.1, 0.1)), (0, 0, 0), 0.02, grain=0.001)
    assert "grain" in refused.value.next_move
    with pytest.raises(ProgramError, match="cell"):
        Moulded(foam(), sculpt.box((0.1, 0.1, 0.1)), (0, 0, 0), -1.0)
    with pytest.raises(ProgramError, match="rubs by -1"):
        foam().but(wall_friction=-1.0)
    for given, says in (({"cell": 1e-4}, "make them"), ({"cell": 0.02, "grain": 1e-5}, "grain")):
        with pytest.raises(ProgramError, match="more than") as refused:
            Moulded(foam(), sculpt.box((0.1, 0.1, 0.1)), (0, 0, 0), **given)
        assert says in refused.value.next_move


def test_a_shape_may_lie_anywhere_in_its_own_frame() -> None:
    law, model, data = press(foam())
    far = type(law)(foam(), sculpt.box((SIDE, SIDE, SIDE)).translate(-1, -1, -1), (1, 1, 1 + SIDE / 2), 0.015)
    far.start(model, data)
    assert np.isfinite(far.step(model, data, 0.002)).all()


def test_a_plate_that_is_led_by_the_hand_pushes_a_liquid() -> None:
    class Oil(Matter):
        name, bodies = "oil", ("world", "plate")

    model = mujoco.MjModel.from_xml_string(
        '<mujoco><option gravity="0 0 0"/><worldbody><body name="plate" mocap="true" pos="-.02 0 .02">'
        '<geom type="box" size=".01 .05 .05"/></body></worldbody></mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    law = Oil(Liquid(900.0, 0.1), 0.01, begins=[block((-0.008, -0.02, 0.0), (0.032, 0.02, 0.04))])
    law.start(model, data)
    felt = 0.0
    for k in range(20):
        data.mocap_pos[0, 0] = -0.02 + 0.3 * 0.002 * (k + 1)
        mujoco.mj_forward(model, data)
        felt += 0.002 * law.step(model, data, 0.002)[1, 0]
    pushed = float((law.mass * law.velocities[:, 0]).sum())
    assert pushed > 0.1 * law.mass.sum() * 0.3 and felt == pytest.approx(-pushed, rel=1e-6)
