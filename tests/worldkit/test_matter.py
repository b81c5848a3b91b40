"""Material points: momentum kept with bodies, walls that hold, what sand and snow do at rest, sources, and what is refused."""

from collections.abc import Sequence

import mujoco
import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.matter import Liquid, Matter, Sand, Snow, Source, block, column, touched_geoms, within
from worldkit.matter.principal import principal, rebuilt

FLOOR = '<geom type="plane" size="1 1 1"/>'


class Stood(Matter):
    name, bodies, shown_by = "stood", ("world",), "stood"


class Pressed(Matter):
    name, bodies, shown_by = "pressed", ("lid", "world"), "pressed"


def at_rest(world: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{world}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def tub(side: float, height: float, wall: float, floor: bool = True) -> str:
    """A tub of thin boxes, open above; its inside begins at z = 0."""
    half, middle = side / 2, (side + wall) / 2
    boxes = [((half + wall, half + wall, wall / 2), (0, 0, -wall / 2))] * floor
    for x, y in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        size = (wall / 2 if x else half + wall, wall / 2 if y else half + wall, height / 2)
        boxes.append((size, (x * middle, y * middle, height / 2)))
    text = "".join('<geom type="box" size="{} {} {}" pos="{} {} {}"/>'.format(*s, *p) for s, p in boxes)
    return f'<body name="tub">{text}</body>'


def advanced(law: Matter, world: str, seconds: float, each: float = 0.01) -> np.ndarray:
    """(k, 6) N s, what its bodies got in all."""
    model, data = at_rest(world)
    law.start(model, data)
    return np.asarray(sum(law.step(model, data, each) for _ in range(round(seconds / each)))) * each


def test_momentum_is_kept_with_a_lid_and_a_source_and_each_time_the_bits_are_the_same() -> None:
    world = tub(0.08, 0.08, 0.003) + (
        '<body name="lid" pos="0 0 0.075"><freejoint/><geom type="box" size="0.03 0.03 0.01" density="400" euler="10 5 0"/></body>'
    )
    ends = []
    for _ in range(2):
        pour = Source(mass=0.02, at=(0.02, 0.02, 0.15), starts=0.01, ends=0.06, radius=0.015)
        law = Pressed(
            Liquid(1000.0, 0.5, sticks=True),
            0.008,
            begins=[block((-0.038, -0.038, 0.002), (0.038, 0.038, 0.05))],
            poured=[pour],
        )
        model, data = at_rest(world)
        law.start(model, data)
        mass, pushed, weight = law.mass.sum(), np.zeros(6), law.mass.sum() * law._pull
        assert mass == pytest.approx(law.mass[law._when < 0].sum() + 0.02, rel=1e-12), "its exact mass"
        for _ in range(15):
            before = law.mass @ law.velocities
            around = np.cross(law.points, law.mass[:, None] * law.velocities).sum(axis=0)
            wrench = law.step(model, data, 0.004)
            gave = law.mass @ law.velocities - before
            assert gave + 0.004 * wrench[:, :3].sum(axis=0) == pytest.approx(0.004 * weight, abs=1e-12)
            assert np.isfinite(around).all()
            data.xfrc_applied[model.body("lid").id] = wrench[0]
            mujoco.mj_step(model, data, 2)
            pushed += wrench[0]
        assert pushed[2] > 0, "it carries the lid"
        ends.append(law.points.copy())
    assert (ends[0] == ends[1]).all()


def test_angular_momentum_goes_to_the_wall_that_took_it() -> None:
    law = Stood(Sand(friction_angle=30.0), 0.01, begins=[block((0.1, 0, 0.001), (0.14, 0.04, 0.04))])
    model, data = at_rest(FLOOR)
    law.start(model, data)
    law._pull = np.zeros(3)
    law.step(model, data, 1e-4)
    law.velocities[:] = (0.5, 0.2, -1.0)

    def turning() -> np.ndarray:
        spin = law._slope.transpose(0, 2, 1) - law._slope
        own = law.cell**2 / 4 * np.stack([spin[:, 1, 2], spin[:, 2, 0], spin[:, 0, 1]], axis=1)
        return (law.mass[:, None] * (np.cross(law.points, law.velocities) + own)).sum(axis=0)

    before, given = turning(), np.zeros(6)
    for _ in range(10):
        given += 0.002 * law.step(model, data, 0.002)[0]
    assert abs(given[3]) > 1e-3
    assert turning() - before + given[3:] == pytest.approx(np.zeros(3), abs=2e-2 * np.abs(given[3:]).max())


def test_walls_thinner_than_a_cell_hold_water_and_it_keeps_its_level() -> None:
    law = Stood(Liquid(1000.0, 0.001), 0.008, begins=[block((-0.04, -0.04, 0), (0.04, 0.04, 0.056))], container="tub")
    advanced(law, tub(0.08, 0.06, 0.002) + FLOOR.replace("/>", ' pos="0 0 -0.1"/>'), 0.5)
    out = (np.abs(law.points[:, :2]) > 0.0401).any(axis=1) | (law.points[:, 2] < -1e-4)
    assert not out.any()
    assert np.sort(law.points[:, 2])[-40:].mean() == pytest.approx(0.052, abs=0.008)
    assert law.volume() == pytest.approx(law.mass.sum() / 1000.0, rel=0.02)


def test_sand_heaps_up_and_comes_to_rest_and_water_does_not() -> None:
    heights = {}
    for stuff in (Sand(friction_angle=35.0, sound=10.0), Liquid(1600.0, 0.001, sound=10.0)):
        law = Stood(stuff, 0.01, begins=[column((0, 0, 0), 0.06, 0.06)])
        advanced(law, FLOOR, 0.5)
        heights[type(stuff)] = law.points[:, 2].max()
        if isinstance(stuff, Sand):
            assert np.linalg.norm(law.velocities, axis=1).mean() < 0.02
    assert heights[Sand] > 0.04 > 0.025 > heights[Liquid]


def test_snow_that_falls_on_a_board_lies_there_as_high_as_its_mass_says() -> None:
    sky = Source(mass=0.24, at=(0, 0, 0.25), starts=0.0, ends=0.4, sides=(0.2, 0.2), speed=1.0)
    law = Stood(Snow(density=100.0), 0.02, poured=[sky])
    advanced(law, '<geom type="box" size="0.1 0.1 0.02" pos="0 0 -0.02"/>', 0.8)
    lies = (np.abs(law.points[:, :2]) < 0.1).all(axis=1) & (law.points[:, 2] > 0)
    assert lies.mean() > 0.9
    assert 2 * law.points[lies, 2].mean() == pytest.approx(0.24 / 100.0 / 0.04, rel=0.35)
    assert np.linalg.norm(law.velocities, axis=1).mean() < 0.03


def test_what_is_poured_tells_how_much_more_of_it_moves_later() -> None:
    sky = Source(mass=0.24, at=(0, 0, 0.25), starts=0.0, ends=2.0, sides=(0.2, 0.2), speed=1.0)
    law = Stood(Snow(density=100.0), 0.01, poured=[sky])
    assert law.grows(0.2, 3.0) == pytest.approx((2 / 3) / 0.05, rel=0.1)  # all from 2 s on, half on the mean before
    assert Stood(Sand(), 0.01, begins=[block((0, 0, 0.05), (0.1, 0.1, 0.1))]).grows(0.2, 3.0) == pytest.approx(1.0)


def test_a_tensor_is_its_principal_values_and_directions() -> None:
    draw = np.random.default_rng(3).normal(size=(3, 3))
    whole = draw @ draw.T
    a, q, out = whole.copy(), np.empty((3, 3)), np.empty(6)
    principal(a, q)
    assert np.sort(np.diag(a)) == pytest.approx(np.linalg.eigvalsh(whole))
    rebuilt(a[0, 0], a[1, 1], a[2, 2], q, out)
    assert out == pytest.approx(whole[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]])


SHAPES = (
    ('type="sphere" size="0.1"', (0.0, 0.0, 0.13), 0.03),
    ('type="capsule" size="0.1 0.2"', (0.0, 0.0, 0.33), 0.03),
    ('type="cylinder" size="0.1 0.2"', (0.13, 0.0, 0.0), 0.03),
    ('type="box" size="0.1 0.1 0.2" euler="0 0 90"', (0.0, 0.0, 0.18), -0.02),
    ('type="ellipsoid" size="0.1 0.2 0.3"', (0.0, 0.0, 0.3), 0.0),
    ('type="mesh" mesh="tet"', (0.05, 0.05, -0.02), 0.02),
    ('type="hfield" hfield="slope"', (0.0, 0.0, 0.07), 0.02 / np.sqrt(1.01)),
)


@pytest.mark.parametrize(("geom", "point", "far"), SHAPES, ids=[shape[0].split('"')[1] for shape in SHAPES])
def test_how_far_a_wall_is(geom: str, point: Sequence[float], far: float) -> None:
    assets = (
        '<asset><mesh name="tet" vertex="0 0 0  0.2 0 0  0 0.2 0  0 0 0.2"/>'
        '<hfield name="slope" nrow="2" ncol="2" size="0.5 0.5 0.1 0.1"/></asset>'
    )
    model = mujoco.MjModel.from_xml_string(f"<mujoco>{assets}<worldbody><geom {geom}/></worldbody></mujoco>")
    model.hfield_data[:] = (0.0, 1.0, 0.0, 1.0)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geoms = touched_geoms.Geoms(model, ["world"], 0.02)
    geoms.place(data)
    gap, _ = geoms.gaps(np.array([point]))
    assert gap[0] == pytest.approx(far, abs=1e-9)


def test_what_cannot_run_is_refused_with_its_numbers() -> None:
    with pytest.raises(ProgramError, match=r"27000 points, more than 20000") as caught:
        Stood(Liquid(), 0.01, begins=[block((0, 0, 0), (0.3, 0.3, 0.3))])
    assert "0.011" in caught.value.next_move
    with pytest.raises(ProgramError, match="has no points"):
        Stood(Liquid(), 0.01, begins=[within(lambda p: p[:, 0] > 1, (0, 0, 0), (0.1, 0.1, 0.1))])
    one = Source(mass=0.1, at=(0, 0, 0.2), starts=0, ends=1, radius=0.02)
    two = Source(mass=0.1, at=(0.03, 0, 0.2), starts=0.5, ends=1, radius=0.02)
    with pytest.raises(ProgramError, match=r"sources 0 and 1 of stood overlap: their middles are 0.03 m apart"):
        Stood(Liquid(), 0.01, poured=[one, two])
    with pytest.raises(ProgramError, match="too narrow"):
        Stood(Liquid(), 0.03, poured=[one])
    with pytest.raises(ProgramError, match="has no mouth, or two"):
        Source(mass=0.1, at=(0, 0, 0), starts=0, ends=1)


@pytest.mark.parametrize(
    ("stuff", "given"),
    [(Snow, {"falls": 0.0}), (Snow, {"density": -1.0}), (Sand, {"sound": np.nan}), (Liquid, {"density": 0.0})],
)
def test_a_number_that_nothing_can_have_is_refused_by_its_name(stuff: type, given: dict[str, float]) -> None:
    with pytest.raises(ProgramError, match=next(iter(given))) as caught:
        stuff(**given)
    assert "above zero" in caught.value.next_move


@pytest.mark.parametrize(
    ("world", "law", "says"),
    [
        (tub(0.08, 0.06, 0.004, floor=False), {"container": "tub"}, "the container tub is open below"),
        (tub(0.08, 0.03, 0.004), {"container": "tub"}, "the container tub is open below"),
        (tub(0.08, 0.06, 0.004), {"container": "cup"}, "'cup', which is no body"),
        (FLOOR.replace("/>", ' pos="0 0 0.02"/>'), {}, r"64 of 320 points of stood begin in a wall of world"),
        (FLOOR, {"step": 0.01}, r"the step of stood, 0.01 s, is too long for its stiffness"),
        (FLOOR, {"stuff": Liquid(1000.0, 1e5)}, "times the most"),
    ],
)
def test_what_a_world_does_not_hold_is_refused_before_it_runs(world: str, law: dict, says: str) -> None:
    filled = block((-0.04, -0.04, 0), (0.04, 0.04, 0.056))
    model, data = at_rest(world)
    with pytest.raises(ProgramError, match=says) as caught:
        Stood(**{"stuff": Liquid(), "spacing": 0.01, "begins": [filled]} | law).start(model, data)
    assert caught.value.next_move


def test_what_would_stick_in_a_shallow_bowl_unasked_is_refused() -> None:
    def begun(world: str, high: float, **told: bool) -> None:
        law = Stood(
            Liquid(1400.0, 10.0, sound=6.0, **told), 0.008, begins=[block((-0.03, -0.03, 0), (0.03, 0.03, high))]
        )
        law.start(*at_rest(world))

    bowl = tub(0.064, 0.08, 0.004)
    with pytest.raises(ProgramError, match=r"stood lies 2.0 cells deep in a bowl and sticks to it") as caught:
        begun(bowl, 0.032)
    assert "0.004 m" in caught.value.next_move
    begun(bowl, 0.066)  # deep enough
    begun(bowl, 0.032, sticks=True)
    begun(bowl, 0.032, sticks=False)
    begun(FLOOR, 0.032)  # no bowl


def test_a_floor_of_tiles_is_one_wall_and_a_corner_is_two() -> None:
    half, tiles = 0.02, range(-4, 5)
    floor = "".join(
        f'<geom type="box" size="{half} {half} 0.01" pos="{2 * half * i} {2 * half * j} -0.01"/>'
        for i in tiles
        for j in tiles
    )
    places = np.random.default_rng(0).uniform((-0.1, -0.1, 0.001), (0.1, 0.1, 0.02), (50, 3))
    for world, walls in ((floor, 1), (floor + '<geom type="box" size="0.2 0.01 0.2" pos="0 0.11 0.2"/>', 2)):
        law = Stood(Snow(), 0.01, begins=[block((0, 0, 0.01), (0.05, 0.05, 0.05))])
        law.start(*at_rest(world))
        law._geoms.sort(places.min(axis=0), places.max(axis=0), 0.06)
        near = np.zeros(50, np.int64)
        planes, walls_of = np.zeros((50, 6, 4)), np.zeros((50, 6), np.int64)
        law._geoms.near(places, 50, 0.03, planes, walls_of, near, np.full((50, 3), np.inf))
        assert near.max() == walls and near.min() == 1


def test_snow_lies_on_a_board_of_many_boxes_as_on_one() -> None:
    def lies(count: int) -> np.ndarray:
        half = 0.1 / count
        middles = [half * (2 * i + 1) - 0.1 for i in range(count)]
        world = "".join(
            f'<geom type="box" size="{half} {half} 0.01" pos="{x} {y} -0.01"/>' for x in middles for y in middles
        )
        law = Stood(Snow(), 0.01, begins=[block((-0.05, -0.05, 0.002), (0.05, 0.05, 0.042))])
        advanced(law, world, 0.05)
        return law.points

    assert np.abs(lies(12) - lies(1)).max() < 1e-9


def test_a_bowl_of_pieces_that_moves_is_sorted_again_and_one_that_stands_is_not() -> None:
    model, data = at_rest(tub(0.08, 0.08, 0.004).replace('name="tub">', 'name="tub" mocap="true">'))
    geoms = touched_geoms.Geoms(model, ["tub"], 0.02)
    geoms.place(data)
    room = np.array((-0.05, -0.05, 0.0)), np.array((0.05, 0.05, 0.1))
    geoms.sort(*room, 0.03)
    first = geoms._listed
    geoms.sort(room[0] + 0.01, room[1] + 0.01, 0.03)
    assert geoms._listed is first
    data.mocap_pos[0, 0] = 0.03
    mujoco.mj_forward(model, data)
    geoms.place(data)
    geoms.sort(*room, 0.03)
    assert geoms._listed is not first
    gap, _ = geoms.gaps(np.array([(0.06, 0.0, 0.04)]))
    assert gap[0] == pytest.approx(0.01, abs=1e-9)  # m, to the wall at 0.04 + 0.03


def test_points_that_fly_apart_are_a_typed_error() -> None:
    law = Stood(Liquid(), 0.01, begins=[block((0, 0, 0), (0.05, 0.05, 0.05))])
    model, data = at_rest('<body name="far" pos="0 0 -9"><geom size="0.01"/></body>')
    law.start(model, data)
    law.step(model, data, 0.01)
    law.velocities[0] = np.nan
    with pytest.raises(ProgramError, match="fly apart"):
        law.step(model, data, 0.01)


def test_a_liquid_that_draws_threads_resists_being_pulled_apart_and_another_does_not() -> None:
    pulled = []
    for threads in (False, True):
        stuff = Liquid(1400.0, 5.0, threads=threads)
        law, state, tau = np.array(stuff.stiffness(5.0)), stuff.begins(1), np.zeros((1, 6))
        stuff.advance(law, state, np.eye(3)[None] * 10.0, np.array([1400.0]), tau, 1, 1e-3)
        pulled.append((float(tau[0, :3].sum()), float(stuff.stored(law, state)[0])))
    (still, kept), (tension, stored) = pulled
    assert abs(still) < 1e-6 and kept == 0.0
    assert tension == pytest.approx(3 * 1.03 * 1400.0 * 25.0 * 0.03, rel=0.01) and stored > 0.0
