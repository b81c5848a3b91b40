"""Skins with gas inside: their slopes, what they keep, whom they push, and what is refused."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.matter.membranes import Membrane
from worldkit.skins import Gas, Skin, Wall, ball, closed_shapes, met_geoms, revolved, thin_elements

CAN = [(0, 0), (0.02, 0.0), (0.03, 0.01), (0.03, 0.04), (0.02, 0.05), (0, 0.05)]
RUBBER = Wall(young=9e5, thickness=3e-4, density=950.0, rubber=True, stretched=1.5, damping=0.002, hard=1e6)
SHAPES = (ball(1.0, finer=1), revolved([(0, 0), (0.5, 0), (0.8, 0.3), (0.8, 0.8), (0.5, 1.1), (0, 1.2)], 9))


class Balloon(Skin):
    name, bodies, shown_by = "balloon", ("crate", "world"), "balloon"


def at_rest(world: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{world}</mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


FLOOR = (
    '<worldbody><geom type="plane" size="1 1 1"/><body name="crate" pos="0 0 0.219"><freejoint/>'
    '<geom type="box" size="0.05 0.05 0.02" density="200"/></body></worldbody>'
)


@pytest.mark.parametrize("shape", SHAPES, ids=["ball", "revolved"])
def test_a_shape_is_closed_and_turned_outwards(shape: closed_shapes.Shape) -> None:
    points, triangles = shape
    a, b, c = points[triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    assert np.allclose(normal.sum(axis=0), 0, atol=1e-12)
    middle = points.mean(axis=0)
    assert (((a + b + c) / 3 - middle) * normal).sum(axis=1).min() > 0
    assert len(points) - len(triangles) / 2 == 2, "Euler's of a sphere"


@pytest.mark.parametrize("rubber", [False, True])
@pytest.mark.parametrize("shape", SHAPES, ids=["ball", "revolved"])
def test_forces_are_the_slopes_of_what_is_stored(shape: closed_shapes.Shape, rubber: bool) -> None:
    points = shape[0]
    wall = Wall(young=2.0, thickness=0.1, density=1.0, poisson=0.3, rubber=rubber)
    skin = Skin(shape, wall, Gas())
    random = np.random.default_rng(0)
    x, way, h = points + 0.05 * random.normal(size=points.shape), random.normal(size=points.shape), 1e-6
    assert (skin._walls(x + h * way) - skin._walls(x - h * way)) / (2 * h) == pytest.approx(
        float((skin._pulls(x) * way).sum()), rel=1e-6
    )
    assert (skin._room(x + h * way) - skin._room(x - h * way)) / (2 * h) == pytest.approx(
        float((skin._grows(x) * way).sum()), rel=1e-6
    )
    before, after = (skin.sheet.strain(x + s * h * way) for s in (-1, 1))
    change = (skin.sheet.stress(after) - skin.sheet.stress(before)) / (2 * h)
    strain = skin.sheet.strain(x)
    tangent = (skin.sheet.stiff(strain) @ ((after - before) / (2 * h))[:, :, None])[:, :, 0]
    assert change == pytest.approx(tangent, rel=1e-4, abs=1e-5)


def test_a_crease_beyond_the_yield_strain_stays() -> None:
    points, triangles = ball(1.0, finer=1)
    thickness = np.full(len(triangles), 0.1)
    hinges = thin_elements.Hinges(points, triangles, 1.0, 0.3, thickness, yields=0.01)
    dented = points.copy()
    dented[0] *= 0.7
    hinges.flow(dented)
    left = np.abs(hinges.bent(hinges.angle(dented)))
    assert left == pytest.approx(np.minimum(left, hinges.most)) and left.max() > 0.5 * hinges.most.min()
    assert np.abs(hinges.bent(hinges.angle(points))).max() > hinges.most.max(), "what it was before is bent now"


@pytest.mark.parametrize(
    ("kind", "size", "point", "far", "out"),
    [
        (met_geoms.PLANE, (1, 1, 1), (3, 4, -0.5), -0.5, (0, 0, 1)),
        (met_geoms.SPHERE, (1, 0, 0), (0, 3, 4), 4.0, (0, 0.6, 0.8)),
        (met_geoms.CAPSULE, (1, 2, 0), (0, 3, 6), 4.0, (0, 0.6, 0.8)),
        (met_geoms.CYLINDER, (1, 2, 0), (0, 4, 6), 5.0, (0, 0.6, 0.8)),
        (met_geoms.CYLINDER, (1, 2, 0), (0, 0.5, -1.8), -0.2, (0, 0, -1)),
        (met_geoms.BOX, (1, 2, 3), (0, 5, 7), 5.0, (0, 0.6, 0.8)),
        (met_geoms.BOX, (1, 2, 3), (-0.9, 0, 0), -0.1, (-1, 0, 0)),
    ],
)
def test_how_far_a_geom_is(kind: int, size: tuple, point: tuple, far: float, out: tuple) -> None:
    found, way = met_geoms.distance(kind, np.array(size, float), np.array([point], float))
    assert found[0] == pytest.approx(far) and way[0] == pytest.approx(out, abs=1e-12)


def test_momentum_is_kept_with_a_crate_on_it_and_each_time_the_bits_are_the_same() -> None:
    ends = []
    for _ in range(2):
        model, data = at_rest(FLOOR)
        skin = Balloon(ball(0.1, (0, 0, 0.0995), finer=1), RUBBER, Gas())
        skin.start(model, data)
        pushed = np.zeros(6)
        for _ in range(25):
            before = skin.mass @ skin.velocities
            wrench = skin.step(model, data, 0.004)
            gave = skin.mass @ skin.velocities - before
            assert gave + 0.004 * wrench[:, :3].sum(axis=0) == pytest.approx(
                0.004 * skin.mass.sum() * skin._pull, abs=1e-12
            )
            data.xfrc_applied[1] = wrench[0]
            mujoco.mj_step(model, data, 2)
            pushed += wrench[0]
        assert pushed[2] > 0, "it carries"
        ends.append(skin.points.copy())
    assert (ends[0] == ends[1]).all()


def test_warm_gas_that_cools_draws_a_skin_in_and_no_energy_is_made() -> None:
    model, data = at_rest("<option gravity='0 0 0'/>")
    skin = Skin(revolved(CAN, 10), Wall(2e7, 1e-4, 1350.0, yields=0.02), Gas(warm=360.0, around=290.0, takes=0.05))
    skin.start(model, data)
    room, energies = skin.room, []
    for _ in range(40):
        skin.step(model, data, 0.005)
        energies.append(skin.energy() + 0.5 * float((skin.mass[:, None] * skin.velocities**2).sum()))
    assert skin.room < 0.9 * room
    assert skin.pressure * skin.room == pytest.approx(skin.moles * 8.314462618 * skin.gas.temperature(skin.time))
    assert np.diff(energies).max() < 0.02 * np.ptp(energies)


def test_what_springs_off_the_floor_makes_no_energy() -> None:
    """What it is pressed into the floor by is stored while it is there, and comes back."""
    model, data = at_rest('<worldbody><geom type="plane" size="1 1 1"/></worldbody>')
    skin = Skin(ball(0.1, (0, 0, 0.1), finer=1), replace(RUBBER, hard=2e5), Gas(), longest=0.001)
    skin.bodies = ("world",)
    skin.start(model, data)
    skin.velocities[:, 2] = -1.0
    energies, speeds = [], []
    for _ in range(40):
        skin.step(model, data, 0.002)
        motion = 0.5 * float((skin.mass[:, None] * skin.velocities**2).sum())
        weight = 9.81 * float((skin.mass * skin.points[:, 2]).sum())
        energies.append(skin.energy() + motion + weight)
        speeds.append(float(skin.mass @ skin.velocities[:, 2]))
    assert max(speeds) > 0, "it came back"
    made = (np.array(energies) - np.minimum.accumulate(energies)).max()
    assert made < 0.03 * np.ptp(energies), (made, np.ptp(energies))


@pytest.mark.parametrize(("asked", "longest"), [(0.001, 0.002), (0.004, 0.004), (0.016, 0.004)])
def test_a_crate_that_it_throws_back_gains_no_energy_however_seldom_it_is_asked(asked: float, longest: float) -> None:
    """The crate moves on between two questions, by what it is pushed with: it must not be pushed from where it was."""
    model, data = at_rest('<option timestep="0.0005"/>' + FLOOR.replace('density="200"', 'mass="0.06"'))
    skin = Balloon(ball(0.1, (0, 0, 0.1), finer=1), RUBBER, Gas(), longest=longest)
    skin.start(model, data)
    data.qvel[2] = -1.4
    energies = []
    for _ in range(round(0.096 / asked)):
        mujoco.mj_forward(model, data)
        data.xfrc_applied[1] = skin.step(model, data, asked)[0]
        mujoco.mj_step(model, data, round(asked / 0.0005))
        crate = 0.06 * (0.5 * float(data.qvel[:3] @ data.qvel[:3]) + 9.81 * data.qpos[2])
        motion = 0.5 * float((skin.mass[:, None] * skin.velocities**2).sum())
        energies.append(skin.energy() + motion + crate + 9.81 * float((skin.mass * skin.points[:, 2]).sum()))
    assert 1.0 < data.qvel[2] < 1.2, "it is thrown back as it is by steps of half a millisecond"
    made = (np.array(energies) - np.minimum.accumulate(energies)).max()
    assert made < 0.005 * 0.5 * 0.06 * 1.4**2, made


def test_pinned_points_stay_and_the_world_carries_them() -> None:
    skin = Balloon(ball(0.1, finer=1), RUBBER, Gas(), pinned=[0, 1, 4])
    model, data = at_rest(FLOOR.replace('type="plane"', 'type="plane" pos="0 0 -3"'))
    skin.start(model, data)
    begun, held = skin.points.copy(), np.zeros(3)
    for _ in range(30):
        held = skin.step(model, data, 0.01)[1, :3]
    assert (skin.points[[0, 1, 4]] == begun[[0, 1, 4]]).all()
    assert held == pytest.approx(skin.mass.sum() * skin._pull, rel=0.02, abs=0.02 * 9.81 * skin.mass.sum())


def test_what_is_no_skin_is_refused() -> None:
    points, triangles = ball(0.1, finer=1)
    with pytest.raises(ProgramError, match="not closed"):
        Skin((points, triangles[1:]), RUBBER, Gas())
    with pytest.raises(ProgramError, match="sweeps no closed surface"):
        revolved(CAN[1:], 10)
    Balloon.bodies = ("crate",)
    with pytest.raises(ProgramError, match="world"):
        Balloon((points, triangles), RUBBER, Gas(), pinned=[0])
    Balloon.bodies = ("crate", "world")
    model, data = at_rest('<worldbody><geom name="egg" type="ellipsoid" size="1 1 2"/></worldbody>')
    with pytest.raises(ProgramError, match="egg"):
        Skin((points, triangles), RUBBER, Gas()).start(model, data)


class Leaking(Skin):
    name, bodies, shown_by = "leaking", ("world",), "leaking"


def test_by_a_hole_it_empties_in_the_textbooks_time_and_flies_off() -> None:
    """A wall that hardly gives: the root of the pressure falls evenly, to nothing after 2 V sqrt(p0) / (p_out C A sqrt(2 / rho))."""
    model, data = at_rest('<option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/></worldbody>')
    began, hole = 2000.0, 0.002
    wall = Wall(young=2.5e9, thickness=1e-3, density=1000.0)
    gas = Gas(pressure=101325.0 + began, hole=hole, hole_at=0)
    skin = Leaking(ball(0.05, middle=(0, 0, 1), finer=1), wall, gas)
    out = skin.points[0] - (0, 0, 1)
    skin.start(model, data)
    opened = 0.6 * np.pi / 4 * hole**2
    ends = (
        2
        * skin.room
        * np.sqrt(began)
        / (101325.0 * opened * np.sqrt(2 / (101325.0 * 0.0289647 / (8.314462618 * 293.15))))
    )
    given, step, over = np.zeros(3), ends / 60, []
    for _ in range(45):
        given += step * skin.step(model, data, step)[0, :3]
        over.append(skin.pressure - 101325.0)
    shares = 1 - step * np.arange(1, 46) / ends
    assert np.sqrt(np.array(over) / began) == pytest.approx(shares, abs=0.005)
    momentum = (skin.mass[:, None] * skin.velocities).sum(axis=0)
    assert momentum == pytest.approx(-given, abs=1e-9), "what the jet carries away goes to the world"
    # Of 2 C A p over the time: p falls as the square of what is left of it.
    pushed = 2 * opened * began * ends / 3 * (1 - shares[-1] ** 3)
    assert momentum @ out / np.linalg.norm(out) == pytest.approx(-pushed, rel=0.03)


@pytest.mark.parametrize("hole", [0.002, 0.015, 0.030])
def test_however_wide_a_hole_is_the_gas_leaves_and_its_jet_ends(hole: float) -> None:
    """Before, a wide one let nothing out, and pushed for ever."""
    model, data = at_rest('<option gravity="0 0 0"/><worldbody><geom type="plane" size="1 1 1"/></worldbody>')
    wall = Wall(young=2.5e9, thickness=1e-3, density=1000.0)
    skin = Leaking(ball(0.05, middle=(0, 0, 1), finer=1), wall, Gas(pressure=103325.0, hole=hole))
    skin.start(model, data)
    over = [2000.0]
    for _ in range(10):
        skin.step(model, data, 0.004)
        over.append(skin.pressure - 101325.0)
    # What leaves is of the textbook's size, until there is no more: the root of the pressure falls evenly.
    falls = 0.004 * 101325.0 * 0.6 * np.pi / 4 * hole**2 * np.sqrt(2 / 1.2041) / (2 * skin.room)
    textbook = np.maximum(np.sqrt(2000.0) - falls * np.arange(11), 0) ** 2
    assert np.array(over) == pytest.approx(textbook, abs=0.05 * 2000.0)
    assert min(over) > -1.0, "no vacuum is drawn"


@pytest.mark.parametrize(
    ("gas", "match"),
    [
        (Gas(hole=-0.001), "hole of -0.001 m"),
        (Gas(hole=float("nan")), "hole of nan m"),
        (Gas(hole=0.01, discharge=1.5), "`discharge` of 1.5"),
        (Gas(hole=0.01, hole_at=42), "at the point 42, where no triangle is"),
        (Gas(hole=0.01, hole_at=-1), "at the point -1"),
    ],
)
def test_a_hole_is_held_against_the_skin(gas: Gas, match: str) -> None:
    for law in (Leaking, Membrane):
        with pytest.raises(ProgramError, match=match):
            law(ball(0.1, finer=1), RUBBER, gas)


def test_a_hole_needs_a_world_that_it_blows_at() -> None:
    class Lacking(Skin):
        bodies = ("crate",)

    with pytest.raises(ProgramError, match="blown at"):
        Lacking(ball(1.0, finer=1), RUBBER, Gas(hole=0.01))
