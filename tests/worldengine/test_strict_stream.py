"""A stored input stream is read as strictly as it was written: what nobody can have sent is refused, by file, row and cause."""

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pyarrow as pa
import pytest

from small_worlds import ball, empty, floor, record, replay
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Replayed
from worldengine.inputs.strict_stream import Recorded
from worldengine.recording import stored
from worldengine.recording.columns import TABLES, arrow_schema
from worldkit.errors import RecordingError
from worldkit.world import start

STEPS = 40
ROWS = (("force", frozenset({"ball"})), ("velocity", frozenset({"ball"})), ("parameter", frozenset({"ball.body_mass"})))
Rows = list[tuple[Any, ...]]


def world() -> mujoco.MjModel:
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.3))
    return spec.compile()


def stream(folder: Path, inputs: Rows = (), edits: Rows = ()) -> Path:
    """A folder with the two tables: (step, entry, value), and (step, array, index, value)."""
    folder.mkdir(exist_ok=True)
    columns = {
        "inputs": [list(c) for c in zip(*inputs, strict=True)] or [[], [], []],
        "edits": [[0.0] * len(edits), [0] * len(edits), *([list(c) for c in zip(*edits, strict=True)] or [[]] * 4)],
    }
    for name, values in columns.items():
        schema = arrow_schema(TABLES[name])
        arrays = [pa.array(v, field.type) for v, field in zip(values, schema, strict=True)]
        with pa.OSFile(str(folder / f"{name}.arrows"), "wb") as sink, pa.ipc.new_stream(sink, schema) as writer:
            writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))
    return folder


def recorded(folder: Path, every: int = 1) -> Recorded:
    model = world()
    return Recorded(stored.Replayable(folder), model, Ports(model, ROWS), STEPS, every)


def test_an_honest_stream_is_read_back(tmp_path: Path) -> None:
    found = recorded(
        stream(tmp_path / "s", [(0, 0, 1.5), (39, 2, 2.0), (39, 6, float("nan"))], [(3, "body_mass", 1, 2.0)])
    )
    assert [step for step in range(STEPS) if found.speaks(step) and found.answer(step)] == [0, 3, 39]


@pytest.mark.parametrize(
    ("inputs", "edits", "says"),
    [
        ([(0, -5, 1.0)], [], "row 0: its entry is none of"),
        ([(0, 0, 1.0), (1, 4000, 1.0)], [], "row 1: its entry is none of"),
        ([(-1, 0, 1.0)], [], "row 0: its step is none of the run's 40"),
        ([(0, 0, 1.0), (STEPS, 0, 1.0)], [], "row 1: its step is none of"),
        ([(7, 0, 1.0), (3, 0, 1.0)], [], "row 1: its step is before"),
        ([(7, 1, 1.0), (7, 0, 1.0)], [], "row 1: its entry is not after"),
        ([(7, 1, 1.0), (7, 1, 2.0)], [], "row 1: its entry is not after"),
        ([(0, 0, float("nan"))], [], "row 0: its value is not finite"),
        ([(0, 6, float("inf"))], [], "row 0: its value is not finite"),
        ([], [(0, "opt.gravity", 2, -1.0)], "row 0: it edits what is no declared parameter: opt.gravity"),
        ([], [(0, "body_mass", 1, 2.0), (1, "geom_friction", 0, 0.1)], "row 1: it edits what is no declared"),
        ([], [(0, "jnt_qposadr", 0, 1 << 24)], "row 0: it edits what is no declared"),
        ([], [(0, "body_mass", 0, 2.0)], "row 0: it edits an element of body_mass that is not declared: 0"),
        ([], [(0, "body_mass", -1, 2.0)], "row 0: it edits an element of body_mass"),
        ([], [(0, "body_mass", 99, 2.0)], "row 0: it edits an element of body_mass"),
        ([], [(0, "body_mass", 1, float("nan"))], "row 0: its value is not finite"),
        ([], [(5, "body_mass", 1, 2.0), (4, "body_mass", 1, 3.0)], "row 1: its step is before"),
        ([], [(4, "body_mass", 1, 2.0), (4, "body_mass", 1, 3.0)], "row 1: it edits in one step what was edited"),
        ([], [(1 << 30, "body_mass", 1, 2.0)], "row 0: its step is none of"),
    ],
)  # fmt: skip
def test_what_nobody_can_have_sent_is_refused_by_row_and_cause(
    inputs: Rows, edits: Rows, says: str, tmp_path: Path
) -> None:
    with pytest.raises(RecordingError) as caught:
        recorded(stream(tmp_path / "s", inputs, edits))
    row, cause = says.split(": ", 1)
    name = "inputs.arrows" if inputs else "edits.arrows"
    assert caught.value.cause.startswith(f"{name}, {row} (step ") and cause in caught.value.cause


def test_answers_between_questions_are_refused(tmp_path: Path) -> None:
    folder = stream(tmp_path / "s", [(0, 0, 1.0), (7, 0, 2.0)])
    assert recorded(folder).speaks(0)
    with pytest.raises(
        RecordingError, match=r"row 1 \(step 7\): its step is none at which the author is asked, every 5 steps: 7"
    ):
        recorded(folder, every=5)


def test_a_parameter_takes_only_what_it_can_hold(tmp_path: Path) -> None:
    model = world()
    for value, good in ((0.125, True), (0.1, False), (1e300, False)):  # colours are of single precision
        folder = stream(tmp_path / str(value), [], [(0, "geom_rgba", 4, value)])
        if good:
            Recorded(stored.Replayable(folder), model, Ports(model, None), STEPS)
            continue
        with pytest.raises(RecordingError, match="none that geom_rgba can hold"):
            Recorded(stored.Replayable(folder), model, Ports(model, None), STEPS)


@pytest.mark.parametrize("name", ["inputs", "edits"])
def test_a_torn_or_foreign_file_is_damaged_not_shorter(name: str, tmp_path: Path) -> None:
    folder = stream(tmp_path / "s", [(0, 0, 1.0)], [(0, "body_mass", 1, 2.0)])
    path = folder / f"{name}.arrows"
    whole = path.read_bytes()
    for content in (b"", whole[: len(whole) // 2], whole[:-60], b"\x00" * 64, b"no arrow file at all"):
        path.write_bytes(content)
        with pytest.raises(RecordingError, match=f"{name}.arrows is damaged"):
            recorded(folder)
    other = pa.schema([("step", pa.int64()), ("entry", pa.int32()), ("value", pa.float64())])
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, other):
        pass
    with pytest.raises(RecordingError, match=f"{name}.arrows is no table of {name}"):
        recorded(folder)
    path.unlink()
    recorded(folder)


def test_looks_are_driven_again_and_are_no_intervention(tmp_path: Path) -> None:
    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        model.geom_rgba[1, 0] = 0.25 if data.time > 0.005 else 0.75
        data.xfrc_applied[2, 0] = data.time

    def spec() -> mujoco.MjSpec:
        made = empty()
        ball(made, "still", (0, 0, 0))
        ball(made, "other", (1, 0, 0))
        return made

    first = record(spec(), tmp_path / "a", STEPS, control)
    again = replay(spec(), tmp_path / "b", STEPS, first)
    assert first.sha256 == again.sha256
    assert set(first.interventions.target) == set(again.interventions.target) == {"other"}
    assert stored.inputs_digest(tmp_path / "a") == stored.inputs_digest(tmp_path / "b")


def test_user_data_is_an_input_and_is_driven_again(tmp_path: Path) -> None:
    def spec() -> mujoco.MjSpec:
        made = empty()
        made.nuserdata = 3
        ball(made, "ball", (0, 0, 1))
        return made

    def count(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.userdata[1] += 1.0
        data.xfrc_applied[1, 0] = data.userdata[1]  # its own memory, kept where the world keeps it

    first = record(spec(), tmp_path / "a", STEPS, count)
    table = first.interventions
    assert "userdata[1]" in set(table.target) and set(table.kind) == {"force", "parameter"}
    forces = table.value[table.kind == "force"][:, 0]
    np.testing.assert_array_equal(forces, np.arange(1.0, STEPS + 1))
    model = spec().compile()
    data = start(model)
    ports = Ports(model, None)
    drive = Replayed(model, data, ports, first, STEPS)
    assert drive.ports.entries["userdata"] == [0, 1, 2]
    assert replay(spec(), tmp_path / "b", STEPS, first).sha256 == first.sha256
    assert Ports(model, (("force", frozenset({"ball"})),)).entries.keys() == {"qfrc_applied", "xfrc_applied"}
    assert Ports(model, (("parameter", frozenset({"userdata"})),)).entries == {"userdata": [0, 1, 2]}


@pytest.mark.parametrize("rows", [(("force", frozenset({"ball"})),), None], ids=["force", "everything"])
def test_an_answer_like_the_last_one_is_in_no_row_and_acts_all_the_same(tmp_path: Path, rows: Any) -> None:
    """With all inputs open each answer is written; with one force alone, the same force is not even read again."""

    def steady(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1, 2] = 3.0 if data.time < 0.02 else 5.0

    once = record(world(), tmp_path / "once", 40, steady, rows=rows)
    steps, values = once.inputs["step"].tolist(), once.inputs["value"].tolist()
    assert [(s, v) for s, v in zip(steps, values, strict=True) if v in (3.0, 5.0)] == [(0, 3.0), (20, 5.0)]
    assert once.interventions["kind"].tolist().count("force") == 40  # the ledger has every step
