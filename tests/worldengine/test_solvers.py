"""The seam of solvers beside the engine, and the basin that proves it: stepped, logged, recorded, replayed, drawn."""

import json
import math
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

from small_worlds import INTEGRATORS, ball, empty
from worldengine.clock.beside import Beside
from worldengine.clock.simulate import prepare, simulate
from worldengine.inputs.ports import Ports
from worldengine.recording import describing, stored
from worldengine.recording.record import Recorder
from worldengine.recording.replay import Replay
from worldengine.solvers import SEAM, Row, called, check
from worldengine.variants.altered import Variant, alter
from worldkit import portable
from worldkit.errors import ProgramError
from worldkit.fields import bores
from worldkit.world import start

RADIUS = 0.1
VOLUME = 4 / 3 * math.pi * RADIUS**3
WATER = {"density": 1000.0, "area": 1.0, "floor": 0.0, "volume": 0.5, "inflow": 0.0, "damping": 4.0}


def pond(
    integrator: str = "IMPLICITFAST", z: float = 0.5, mass: float = 500 * VOLUME, step: float = 0.002
) -> mujoco.MjSpec:
    """A ball over, in or on water, and a sheet that shows the water's surface."""
    spec = empty(time_step=step, integrator=integrator)
    ball(spec, "duck", (0, 0, z), radius=RADIUS, mass=mass)
    spec.worldbody.add_geom(
        name="surface", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.5, 0.5, 0.01), pos=(0, 0, 0.1), contype=0, conaffinity=0
    )
    return spec


def run(
    spec: mujoco.MjSpec, folder: Path, steps: int, variant: Variant | None = None, every: int = 1, **changes: float
):
    model = spec.compile()
    hold = alter(model, variant) if variant else None
    rows = [Row("basin", ("duck",), {**WATER, **changes}, "surface")]
    prepare(model)
    data = start(model)
    beside = Beside(model, data, rows, hold=hold)
    meta = {**describing.describe(model), "solvers": [row.written() for row in rows]}
    with Recorder(model, data, folder, meta, channels=beside.channels) as recorder:
        simulate(model, data, recorder, steps, every=every, beside=beside)
    return stored.open(folder)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_what_weighs_half_of_its_water_floats_half_under(tmp_path: Path, integrator: str) -> None:
    recording = run(pond(integrator), tmp_path / "out", 5000)
    water = recording.channels("basin")
    assert set(water) == {"level", "volume", "immersed"}
    assert water["immersed"].shape == (5001, 1)
    assert water["immersed"][-1, 0] == pytest.approx(VOLUME / 2, rel=1e-3)
    assert water["level"][-1] == pytest.approx(0.5 + VOLUME / 2, rel=1e-6), "the water rises by what is under it"
    assert recording.pos[-1, 0, 2] == pytest.approx(water["level"][-1], abs=2e-4), "half under"
    assert abs(recording.linvel[-1, 0, 2]) < 1e-3


@pytest.mark.parametrize("integrator", ["IMPLICITFAST", "RK4"])
def test_its_work_is_in_the_ledger(tmp_path: Path, integrator: str) -> None:
    """What gravity and water did is what the ball has: with no drag, and energy measured by the engine."""
    recording = run(pond(integrator, z=0.8, step=0.0002), tmp_path / "out", 2500, damping=0.0)
    ledger = recording.interventions
    assert set(ledger.kind) == {"force"} and set(ledger.target) == {"duck"}
    assert (ledger.value[:, 2] > 0).all() and not ledger.value[:, [0, 1, 3, 4, 5]].any()
    total = recording.energy.sum(axis=1)
    assert ledger.work_j.sum() == pytest.approx(total[-1] - total[0], rel=2e-3)
    under = recording.channels("basin")["immersed"][:-1, 0]
    assert (under > 0).sum() == len(ledger)
    assert ledger.value[:, 2] == pytest.approx(1000 * 9.81 * under[under > 0])


def test_its_own_state_goes_on_with_the_engine(tmp_path: Path) -> None:
    recording = run(pond(), tmp_path / "out", 500, every=10, inflow=0.2)
    water = recording.channels("basin")
    assert water["volume"] == pytest.approx(0.5 + 0.2 * recording.time)
    assert water["level"] == pytest.approx(water["volume"] + water["immersed"][:, 0])
    assert recording.pos[-1, 0, 2] > recording.pos[0, 0, 2], "the bath lifts the duck"
    finer = run(pond(), tmp_path / "fine", 1000, Variant(time_step_factor=0.5), inflow=0.2)
    assert finer.channels("basin")["volume"][-1] == pytest.approx(water["volume"][-1])


def test_without_its_force_it_does_nothing(tmp_path: Path) -> None:
    recording = run(pond(z=0.5), tmp_path / "out", 300, Variant(without=("force:duck",)))
    fallen = 0.5 * 9.81 * recording.time[-1] ** 2
    assert recording.pos[0, 0, 2] - recording.pos[-1, 0, 2] == pytest.approx(fallen, rel=0.02)
    assert not len(recording.interventions)


def test_a_solver_is_taken_away_by_its_own_name(tmp_path: Path) -> None:
    by_force = run(pond(z=0.5), tmp_path / "force", 100, Variant(without=("force:duck", "torque:duck")))
    by_name = run(pond(z=0.5), tmp_path / "solver", 100, Variant(without=("solver:duck",)))
    weaker = run(pond(z=0.5), tmp_path / "weaker", 100, Variant(weaken=(("solver:duck", 0.5),)))
    assert by_name.sha256 == by_force.sha256 and not len(by_name.interventions)
    assert weaker.pos[-1, 0, 2] > by_name.pos[-1, 0, 2]
    with pytest.raises(ProgramError, match="there is no body goose"):
        run(pond(), tmp_path / "none", 1, Variant(without=("solver:goose",)))


def test_a_box_rights_itself_not_but_is_pushed_at_its_middle(tmp_path: Path) -> None:
    """Two geoms of one body: the one under water turns it."""
    spec = empty(time_step=0.002)
    body = spec.worldbody.add_body(name="duck", pos=(0, 0, 0.5))
    body.add_freejoint()
    for x in (-0.3, 0.3):
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.05, 0.05), pos=(x, 0, 0.0 if x < 0 else 0.3), mass=0.5
        )
    model = spec.compile()
    data = start(model)
    mujoco.mj_forward(model, data)
    running = check(Row("basin", ("duck",), WATER)).start(model, data, [1], WATER)
    wrench = running.look(data)
    level = running.channels[next(c for c in running.channels if c.name == "level")]
    under = 0.01 * (float(level) - 0.45)
    assert float(level) == pytest.approx(0.5 + under)
    assert wrench[0, 2] == pytest.approx(9810 * under)
    assert wrench[0, 4] == pytest.approx(0.3 * 9810 * under), "about +Y: the left end goes up"
    assert np.array_equal(running.look(data), wrench), "looking twice is looking once"


def as_files(folder: Path, rows: list, name: str, **facts: object) -> list[str]:
    (folder / name).mkdir()
    spec = pond(z=0.7)
    spec.add_key(name="start", qpos=spec.compile().qpos0)
    portable.write(spec, folder / "world.mjz")
    given = {
        "duration": 0.6, "fps": 10, "size": [160, 96], "movers": ["duck"], "visual_only": ["surface"], "seed": 0,
        "control": None, "control_every": 1, "latency": 0, **facts,
    }  # fmt: skip
    (folder / "program.json").write_text(json.dumps(given))
    (folder / "inputs.json").write_text(json.dumps(rows))
    words = ["--world", "world.mjz", "--program", "program.json", "--inputs", "inputs.json", "--out", name]
    return [sys.executable, "-m", "worldengine", "physics", *words]


def test_the_same_files_give_the_same_hash_again(tmp_path: Path) -> None:
    """By the engine's own command line, twice, and driven by what is recorded."""
    rows = [Row("basin", ("duck",), {**WATER, "inflow": 0.1}, "surface").written()]
    found = []
    for name, more in (("one", []), ("two", []), ("three", ["--replay", "one/trajectory"])):
        done = subprocess.run([*as_files(tmp_path, rows, name), *more], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr
        found.append(json.loads((tmp_path / name / "result.json").read_text()))
    assert len({row["trajectory_sha256"] for row in found}) == 1
    assert found[0]["interventions"]["force"] > 100
    first, third = (stored.open(tmp_path / name / "trajectory") for name in ("one", "three"))
    assert np.array_equal(first.channels("basin")["level"], third.channels("basin")["level"])
    assert first.meta["motion_key"] == stored.open(tmp_path / "two" / "trajectory").meta["motion_key"]
    rows[0]["solver"]["constants"]["inflow"] = 0.2
    done = subprocess.run(as_files(tmp_path, rows, "four"), cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0
    fourth = stored.open(tmp_path / "four" / "trajectory")
    assert fourth.meta["motion_key"] != first.meta["motion_key"] and fourth.sha256 != first.sha256


def test_what_is_recorded_of_it_is_drawn(tmp_path: Path) -> None:
    recording = run(pond(), tmp_path / "out", 200, inflow=0.5)
    model = pond().compile()
    replay = Replay(model, recording)
    surface = model.geom("surface").id
    for row in (0, 100, 200, 50):
        data = replay.show(row)
        level = recording.channels("basin")["level"][row]
        assert data.geom_xpos[surface, 2] + 0.01 == pytest.approx(level)


def test_pictures_of_another_surface_are_not_those_of_this_recording(tmp_path: Path) -> None:
    """High above the water nothing of it reaches the ball."""
    one, same, other = (run(pond(z=5.0), tmp_path / f"{n}", 20, inflow=v) for n, v in enumerate((0.1, 0.1, 0.2)))
    assert one.sha256 == other.sha256 and one.channels("basin")["level"][-1] != other.channels("basin")["level"][-1]
    assert one.shown_sha256 == same.shown_sha256 != other.shown_sha256


def test_two_of_a_kind_have_channels_of_their_own() -> None:
    rows = [Row("basin", (name,), WATER) for name in ("a", "b")]
    assert called(rows) == ["basin", "basin#2"]


@pytest.mark.parametrize(
    ("row", "said"),
    [
        (Row("tide", ("duck",), WATER), "no solver 'tide'"),
        (Row("basin", ("goose",), WATER), "acts on 'goose'"),
        (Row("basin", ("duck",), {**WATER, "salt": 1.0}), "does not know salt"),
        (Row("basin", ("duck",), {k: v for k, v in WATER.items() if k != "area"}), "lacks area"),
        (Row("basin", ("duck",), {**WATER, "area": 0.0}), "positive density and area"),
        (Row("basin", ("duck",), {**WATER, "area": (1.0,)}), "reads one number as its area"),
        (Row("charges", ("duck",), {"charge": (1e-6, 1e-6)}), "has 1 bodies, and 2 numbers"),
        (Row("charges", ("duck",), {"charge": (math.nan,)}), "the constant charge"),
        (Row("heat", ("duck",), {"warm": -1.0, "around": 290.0, "specific_heat": 400.0}), "below 0 K"),
        (Row("heat", ("duck",), {"warm": 290.0, "around": 290.0, "specific_heat": 0.0}), "no specific heat"),
        (
            Row("magnets", ("duck",), {"remanence": 1.0, "saturation": 2.0}),
            "a magnet, soft iron and a conductor at once",
        ),
        (Row("magnets", ("duck",), {"remanence": 0.0, "conductivity": 5.8e7}), "neither a straight tube"),
    ],
)
def test_a_row_that_makes_no_sense_is_refused_with_what_would(row: Row, said: str) -> None:
    model = pond().compile()
    with pytest.raises(ProgramError, match=said) as refused:
        Beside(model, mujoco.MjData(model), [row])
    assert refused.value.next_move


def test_a_body_has_one_who_pushes_it() -> None:
    model = pond().compile()
    data = mujoco.MjData(model)
    row = Row("basin", ("duck",), WATER)
    with pytest.raises(ProgramError, match="'duck' would be pushed by the solver basin and by another"):
        Beside(model, data, [row], Ports(model, (("force", frozenset({"duck"})),)))
    with pytest.raises(ProgramError, match="'duck' would be pushed"):
        Beside(model, data, [row, row])


def test_what_pushes_nothing_shares_its_bodies() -> None:
    """A magnet may have a temperature, too; and what is read is what was written."""
    warm = Row("heat", ("duck",), {"warm": (350.0,), "around": 290.0, "specific_heat": 400.0, "cooling": 50.0})
    row = Row.read(json.loads(json.dumps(warm.written())))
    assert row == warm
    model = pond().compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    beside = Beside(model, data, [Row("basin", ("duck",), WATER), row])
    assert {column.name for column in beside.channels} > {"basin.level", "heat.temperature"}


def test_what_stands_fast_is_pushed_back(tmp_path: Path) -> None:
    """A magnet over a steel ball that is part of the world: the ledger has both forces, opposite, and the work is the field's."""
    spec = mujoco.MjSpec.from_string(
        '<mujoco><option timestep="0.001" gravity="0 0 0"/><worldbody><body name="post"><geom size="0.01"/></body>'
        '<body name="m" pos="0 0 0.06"><freejoint/><geom type="cylinder" size="0.01 0.01" mass="0.05"/></body></worldbody></mujoco>'
    )
    model = spec.compile()
    prepare(model)
    data = start(model)
    rows = [Row("magnets", ("m", "post"), {"remanence": (1.2, 0.0), "saturation": (0.0, 2.0)})]
    beside = Beside(model, data, rows)
    with Recorder(model, data, tmp_path / "out", describing.describe(model), channels=beside.channels) as recorder:
        simulate(model, data, recorder, 100, beside=beside)
    recording = stored.open(tmp_path / "out")
    ledger = recording.interventions
    push = {name: ledger.value[(ledger.target == name) & (ledger.kind == "force"), :3] for name in ("m", "post")}
    assert push["m"][:, 2].max() < 0 < push["post"][:, 2].min()
    assert push["m"] == pytest.approx(-push["post"])
    gained, lost = recording.energy[-1, 1], np.ptp(recording.channels("magnets")["energy"])
    assert gained == pytest.approx(lost, rel=0.02) and gained == pytest.approx(ledger.work_j.sum(), rel=1e-6)


@pytest.mark.parametrize("name", SEAM.names())
def test_every_solver_says_what_it_reads_and_has_cases(name: str) -> None:
    solver = SEAM.find(name)
    assert solver.CONSTANTS and all(unit and meaning for unit, meaning in solver.CONSTANTS.values())
    assert solver.CASES and all(case.because for case in solver.CASES)


@pytest.mark.parametrize(("integrator", "finer"), [(name, 1) for name in INTEGRATORS] + [("IMPLICITFAST", 2)])
@pytest.mark.parametrize(
    ("name", "number"), [(name, n) for name in SEAM.names() for n, _ in enumerate(SEAM.find(name).CASES)]
)
def test_a_case_comes_out_as_it_is_known_to(
    tmp_path: Path, name: str, number: int, integrator: str, finer: int
) -> None:
    case = SEAM.find(name).CASES[number]
    spec = mujoco.MjSpec.from_string(case.world)
    spec.option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator}")
    spec.option.timestep /= finer
    model = spec.compile()
    prepare(model)
    data = start(model)
    beside = Beside(model, data, [Row(name, case.bodies, case.constants, case.shown_by)])
    with Recorder(model, data, tmp_path / "out", describing.describe(model), channels=beside.channels) as recorder:
        simulate(model, data, recorder, round(case.seconds / model.opt.timestep), every=10 * finer, beside=beside)
    recording = stored.open(tmp_path / "out")
    found = recording.channels(name)[case.channel][-1]
    assert float(np.reshape(found, -1)[0]) == pytest.approx(case.expected, abs=case.tolerance), case.because


def rims(outer, inner, length, sides=24):
    """Corners of a straight tube along z; a solid rod with no inner radius."""
    turn = 2 * np.pi * np.arange(sides) / sides
    return np.array([(r * np.cos(a), r * np.sin(a), z) for r in (outer, inner) if r for z in (-length / 2, length / 2) for a in turn])  # fmt: skip


@pytest.mark.parametrize("length", [0.01, 0.036, 0.04, 0.044, 0.3])
def test_a_tube_is_known_by_its_bore_however_long_it_is(length):
    tube = rims(0.02, 0.018, length)
    assert bores.radii_of(tube) == pytest.approx((0.018, 0.02))
    assert bores.radii_of(tube[:, [1, 2, 0]]) is None and bores.radii_of(tube[:, [2, 0, 1]]) is None, "it lies along z"


@pytest.mark.parametrize(
    "corners",
    [rims(0.02, 0, 0.1), rims(0.02, 0.004, 0.1), np.array(list(np.ndindex(2, 2, 2))) * 0.02 - 0.01, rims(0.02, 0.018, 0.1)[:-24]],
    ids=["a rod", "a bore too narrow", "a block", "a cup"],
)  # fmt: skip
def test_what_is_no_tube_has_no_bore(corners):
    assert bores.radii_of(corners) is None
