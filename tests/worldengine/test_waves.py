"""The solver `water` in a recorded world: what shows it is recorded and drawn, twice the same, and drops keep its volume."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from hung_springs import world
from worldengine.clock.beside import Beside
from worldengine.clock.simulate import prepare, simulate
from worldengine.recording import describing, stored
from worldengine.recording.record import Recorder
from worldengine.recording.replay import Replay
from worldengine.solvers import Row, water
from worldengine.variants import altered
from worldengine.waves.shown_water import ShownWater
from worldkit import bodies, scene, waters
from worldkit.errors import ProgramError
from worldkit.world import start

STEPS, STEP = 150, 0.004


def tank() -> mujoco.MjSpec:
    spec = scene.new("tank", time_step=STEP)
    bodies.container(spec, "tank", size=(0.5, 0.4, 0.3), wall=0.02, pos=(0, 0, 0.15), fixed=True)
    bodies.sphere(spec, "ball", diameter=0.06, pos=(0.02, 0.01, 0.36), density=700.0)
    waters.fill(spec, "water", container="tank", level=0.2, drops=20)
    return spec


def run(
    folder: Path,
    spec: mujoco.MjSpec | None = None,
    floats: tuple[str, ...] = ("ball",),
    steps: int = STEPS,
    without: tuple[str, ...] = (),
    **constants: float,
) -> tuple[mujoco.MjModel, stored.Recording]:
    model = (spec or tank()).compile()
    prepare(model)
    hold = altered.alter(model, altered.Variant.parse(None, without, ())) if without else None
    data = start(model)
    rows = [Row("water", floats, {"density": 998.0, "level": 0.2, **constants}, "water")]
    beside = Beside(model, data, rows, hold=hold)
    meta = {**describing.describe(model), "solvers": [row.written() for row in rows], "shown": beside.shown}
    with Recorder(model, data, folder, meta, channels=beside.channels) as recorder:
        simulate(model, data, recorder, steps, beside=beside)
    return model, stored.open(folder)


@pytest.fixture(scope="module")
def fallen(tmp_path_factory: pytest.TempPathFactory) -> tuple[mujoco.MjModel, stored.Recording]:
    return run(tmp_path_factory.mktemp("fallen") / "out")


def test_a_ball_splashes_and_the_volume_is_kept(fallen) -> None:
    _, recording = fallen
    told = recording.channels("water")
    assert told["drops"].max() > 5, "drops fly"
    assert told["immersed"].max() > 5e-5
    assert np.abs(told["volume"]).max() < 1e-15 * 0.2
    assert told["level"][-1] > 0.2 + 0.5 * told["immersed"][-1, 0] / (0.46 * 0.36)


def test_a_ball_that_a_trial_of_causes_takes_away_leaves_the_water_still(tmp_path: Path) -> None:
    _, recording = run(tmp_path / "out", without=("ball",))
    told = recording.channels("water")
    assert told["drops"].max() == 0 and told["highest"].max() == pytest.approx(0.2, abs=1e-6)
    assert recording.pos[-1, recording.body("ball"), 2] == pytest.approx(0.36, abs=1e-6)


def test_its_surface_is_drawn_where_it_lay(fallen) -> None:
    model, recording = fallen
    replay = Replay(model, recording)
    flat = np.ptp(replay.show(0).flexvert_xpos[:500, 2])
    rough = np.ptp(replay.show(STEPS - 30).flexvert_xpos[:500, 2])
    assert flat < 1e-5 < 1e-3 < rough


def test_it_comes_out_the_same_twice(fallen, tmp_path: Path) -> None:
    _, again = run(tmp_path / "again")
    _, first = fallen
    assert np.array_equal(again.pos, first.pos)
    assert np.array_equal(np.asarray(again.media.place), np.asarray(first.media.place))


def test_a_wind_ruffles_it_and_its_level_stays() -> None:
    model = tank().compile()
    pool = water.start(
        model, start(model), [model.body("ball").id], {"density": 998.0, "level": 0.2, "wind": 25.0}, "water"
    )
    waves = pool.water.surface()
    assert 2e-4 < waves.std() < 5e-3, "JONSWAP: a quarter of 8 mm, less what is finer than the grid"
    assert abs(float((waves * pool.water.grid.areas).sum())) < 1e-12


@pytest.mark.parametrize(
    ("constants", "shown_by", "says"),
    [
        ({"density": 998.0, "level": 0.21}, "water", "shows it at"),
        ({"density": 0.0, "level": 0.2}, "water", "needs a density"),
        ({"density": 998.0, "level": 0.2}, "ball", "is shown by"),
        ({"density": 998.0, "level": float("nan")}, "water", "constant level of the solver water is nan"),
        ({"density": float("inf"), "level": 0.2}, "water", "density of the solver water is inf"),
    ],
)
def test_what_makes_no_sense_is_refused(constants: dict, shown_by: str, says: str) -> None:
    model = tank().compile()
    with pytest.raises(ProgramError, match=says):
        Beside(model, start(model), [Row("water", ("ball",), constants, shown_by)])


def test_a_line_of_points_is_no_water() -> None:
    with pytest.raises(ProgramError, match="no surface of triangles"):
        ShownWater(world().compile(), 0)


def test_a_pond_for_itself_has_a_wind_and_no_body(tmp_path: Path) -> None:
    _, recording = run(tmp_path / "out", floats=(), steps=40, wind=20.0)
    told = recording.channels("water")
    assert "immersed" not in told and told["energy"][1:] == pytest.approx(np.zeros(40), abs=1e-4)
    place = recording.media.place.reshape(11, -1, 3)[:, :500, 2]
    assert place.std() > 2e-5 and np.abs(place[-1] - place[0]).max() > 2e-5, "waves go on"


def barge(welded: bool) -> mujoco.MjSpec:
    """A box that falls aslant into a tank, with a weight on one corner of its deck that is its own or a body welded to it."""
    spec = scene.new("tank", time_step=STEP)
    bodies.container(spec, "tank", size=(0.6, 0.5, 0.3), wall=0.02, pos=(0, 0, 0.15), fixed=True)
    hull = spec.worldbody.add_body(name="hull", pos=(0, 0, 0.3), quat=(0.98, 0.15, 0.1, 0))
    hull.add_freejoint()
    hull.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.06, 0.03), mass=0.4)
    owner, at = (
        (hull.add_body(name="cargo", pos=(0.04, 0.01, 0.03)), (0, 0, 0.01)) if welded else (hull, (0.04, 0.01, 0.04))
    )
    owner.add_geom(size=(0.015, 0, 0), pos=at, mass=0.35, contype=0, conaffinity=0)
    waters.fill(spec, "water", container="tank", level=0.2, drops=2)
    return spec


def test_what_is_welded_to_a_body_is_carried_as_its_own(tmp_path: Path) -> None:
    one, welded = (run(tmp_path / f"{flag}", barge(flag), ("hull",), 250)[1] for flag in (False, True))
    first, second = (each.body("hull") for each in (one, welded))
    assert welded.pos[:, second] == pytest.approx(one.pos[:, first], abs=1e-5)
    assert np.abs((welded.quat[:, second] * one.quat[:, first]).sum(axis=1)) == pytest.approx(
        np.ones(len(one)), abs=1e-7
    )
    assert one.pos[-1, first, 2] == pytest.approx(0.2, abs=0.04), "and it floats"
