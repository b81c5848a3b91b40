"""Wide answers are stored as errors of a forecast: every bit comes back, and what nobody can have written is refused."""

from itertools import pairwise
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pyarrow as pa
import pytest

from small_worlds import ball, empty, record, replay
from worldengine.inputs.ports import Ports
from worldengine.inputs.strict_stream import Recorded
from worldengine.recording import stored
from worldengine.recording.columns import FORETOLD_COLUMNS, TABLES, arrow_schema
from worldengine.recording.foretold import BYTES, FEWEST, WEIGHTS, Forecast, foretold, learn
from worldkit.errors import RecordingError

Rows = tuple[np.ndarray, np.ndarray, np.ndarray]


def rows(numbers: np.ndarray, sent: np.ndarray | None = None, first: int = 0) -> Rows:
    """(step, entry, value) of answers (steps, entries), of those that are sent."""
    step, entry = np.nonzero(np.ones(numbers.shape, bool) if sent is None else sent)
    return (step + first).astype(np.int32), entry.astype(np.int32), numbers[step, entry]


def there_and_back(*blocks: Rows) -> list[tuple[list[float], list[np.ndarray]]]:
    """Weights and bytes of blocks, which come back bit by bit."""
    writer, reader = Forecast(), Forecast()
    found = []
    for step, entry, value in blocks:
        weights, columns = writer.encode(step, entry, value)
        again = reader.decode(step, entry, columns, weights)
        assert again.tobytes() == value.tobytes()
        found.append((weights, columns))
    return found


def size(columns: list[np.ndarray]) -> float:
    return sum(pa.compress(column, codec="zstd").size for column in columns) / len(columns[0])


def swings(steps: int, entries: int) -> np.ndarray:
    """Springs and dampers of one law, each with its own start, with the rounding of an engine's state."""
    random = np.random.default_rng(0)
    home, found = random.uniform(0, 4, entries), np.empty((steps, entries))
    place, speed = home + random.normal(0, 0.1, entries), random.normal(0, 0.4, entries)
    for n in range(steps):
        found[n] = -40.0 * (place - home) - 0.2 * speed
        speed = speed + 0.002 * found[n]
        place = place + 0.002 * speed
    return found


def test_what_follows_a_law_takes_little_room() -> None:
    force = swings(300, 120)
    ((_, first), (weights, second)) = there_and_back(rows(force[:100]), rows(force[100:], first=100))
    assert size(second) < 1.5 and len(weights) > 2
    assert size(first) < 2.0  # its first steps have no past


def test_noise_takes_hardly_more_than_it_is() -> None:
    noise = np.random.default_rng(1).normal(size=(50, 100))
    ((_, columns),) = there_and_back(rows(noise))
    assert size(columns) < 8.0


def test_every_bit_comes_back_whatever_the_numbers_are() -> None:
    random = np.random.default_rng(2)
    odd = swings(90, 100)
    odd[20, 7], odd[21, 7], odd[30:33, 9] = np.inf, -np.inf, np.array([0x7FF8_0000_0000_1234], np.uint64).view(float)
    odd[40], odd[41], odd[50:60], odd[60:70] = 1.7e308, -1.7e308, odd[50:60] * 1e-310, -0.0
    odd[70:] = random.integers(0, 1 << 64, (20, 100), dtype=np.uint64).view(float)
    there_and_back(rows(odd[:35]), rows(odd[35:75], first=35), rows(odd[75:], first=75))


def test_what_is_not_sent_at_every_step_comes_back() -> None:
    random, force = np.random.default_rng(3), swings(120, 150)
    sent = random.random(force.shape) < 0.8
    ((weights, _),) = there_and_back(rows(force, sent))
    assert weights
    blocks = [rows(force[:40], sent[:40]), rows(force[40:43, :100], first=40), rows(force[43:, :3], first=43)]
    found = there_and_back(*blocks, rows(force[43:], first=200))
    assert [bool(weights) for weights, _ in found] == [
        True,
        True,
        False,
        True,
    ]  # three entries are not worth a forecast
    there_and_back(*(rows(force[:0]), rows(force[:1]), rows(force[1:2], first=1)))


def test_a_forecast_is_made_of_single_operations_in_one_order() -> None:
    """By Python's own arithmetic, number by number: no other machine, nor another numpy, may round otherwise."""
    past, numbers, weights = (
        np.zeros((8, 3)),
        np.random.default_rng(4).normal(size=(12, 3)),
        [1.01, 0.9, -0.3, 0.07, 1e-9],
    )
    for now in numbers:
        learn(past, now)
    for entry, told in enumerate(foretold(past, weights).tolist()):
        differences, values = [], numbers[:, entry].tolist()
        for _ in range(8):
            differences.append(values[-1])
            values = [b - a for a, b in pairwise(values)]
        wanted = 0.0
        for weight, difference in zip(weights, differences, strict=False):
            wanted = wanted + difference * weight
        assert told == wanted


def block(
    steps: int = 2, entries: int = FEWEST, first: int = 0, step: int = 0
) -> tuple[np.ndarray, np.ndarray, list[np.ndarray]]:
    step_, entry, value = rows(np.ones((steps, entries)))
    return step_ + step, entry + first, [np.zeros(len(value), np.uint8)] * 8


@pytest.mark.parametrize(
    ("made", "weights"),
    [
        (block(), [1.0] * 9),
        (block(), [float("nan")]),
        (block(), [float("inf")]),
        (block(entries=FEWEST - 1), [1.0]),
        (block(first=-1), [1.0]),
        (block(first=FEWEST * 4), [1.0]),  # most entries are not sent
        (block(entries=FEWEST, first=(1 << 31) - FEWEST - 1), [1.0]),
        (block(steps=0), [1.0]),
    ],
)
def test_a_block_that_nobody_writes_is_refused(made: Any, weights: list[float]) -> None:
    with pytest.raises(ValueError, match="nobody foretells"):
        Forecast().decode(*made, weights)


# -- in a recording ----------------------------------------------------------------------------------------------------

BODIES, STEPS = 30, 40


def crowd() -> mujoco.MjSpec:
    spec = empty(gravity=0.0)
    for n in range(BODIES):
        ball(spec, f"ball_{n}", (n, 0, 0), mass=1.0 + n)
    return spec


def wind(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    data.xfrc_applied[1:, :3] = 1.0 - 0.5 * data.cvel[1:, 3:]


def schema(folder: Path) -> pa.Schema:
    with pa.ipc.open_stream(str(folder / "inputs.arrows")) as reader:
        return reader.schema


def rewritten(
    folder: Path, to: Path, weights: bytes | None = None, form: Any = FORETOLD_COLUMNS, **columns: Any
) -> Path:
    """The stream of a recording in another form, or with something else in it."""
    to.mkdir()
    with pa.ipc.open_stream(str(folder / "inputs.arrows")) as reader:
        batch, about = reader.read_next_batch_with_custom_metadata()
        rest = list(reader)
    assert not rest and about[WEIGHTS]
    arrays = [columns.get(c.name, batch[c.name] if c.name in batch.schema.names else None) for c in form]
    with pa.ipc.new_stream(str(to / "inputs.arrows"), arrow_schema(form)) as writer:
        said = {WEIGHTS: about[WEIGHTS] if weights is None else weights}
        writer.write_batch(pa.RecordBatch.from_arrays([pa.array(a) for a in arrays], schema=arrow_schema(form)), said)
    return to


def recorded(folder: Path) -> Recorded:
    model = crowd().compile()
    return Recorded(stored.Replayable(folder), model, Ports(model, None), STEPS)


def test_a_wide_stream_drives_its_world_again_and_so_does_its_plain_form(tmp_path: Path) -> None:
    first = record(crowd(), tmp_path / "a", STEPS, wind)
    assert schema(tmp_path / "a").names == ["step", "entry", *BYTES]
    assert len(first.inputs) > 3 * BODIES * (STEPS - 1)
    again = replay(crowd(), tmp_path / "b", STEPS, first)
    assert again.sha256 == first.sha256
    assert (tmp_path / "a/inputs.arrows").read_bytes() == (tmp_path / "b/inputs.arrows").read_bytes()
    values = {name: first.inputs[name] for name in ("step", "entry", "value")}
    plain = rewritten(tmp_path / "a", tmp_path / "plain", form=TABLES["inputs"], **values)
    assert stored.inputs_digest(plain) == stored.inputs_digest(tmp_path / "a") != ""
    given: Any = stored.Replayable(plain)
    assert replay(crowd(), tmp_path / "c", STEPS, given).sha256 == first.sha256


def test_a_narrow_stream_is_kept_as_it_always_was(tmp_path: Path) -> None:
    spec = empty()
    ball(spec, "ball", (0, 0, 1))

    def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1, 0] = data.time

    record(spec, tmp_path / "a", 20, push)
    assert schema(tmp_path / "a").equals(arrow_schema(TABLES["inputs"]))


def test_a_forged_wide_stream_is_refused(tmp_path: Path) -> None:
    first = record(crowd(), tmp_path / "a", STEPS, wind)
    recorded(rewritten(tmp_path / "a", tmp_path / "honest"))
    for n, weights in enumerate((b"nan", b"1 1 1 1 1 1 1 1 1", b"one", b"1.0 " * 1000, b"\xff")):
        with pytest.raises(RecordingError, match=r"inputs.arrows is damaged"):
            recorded(rewritten(tmp_path / "a", tmp_path / f"weights_{n}", weights))
    entry, step = first.inputs["entry"].copy(), first.inputs["step"].copy()
    entry[-1], step[-1] = 1 << 30, STEPS
    for name, changed, says in (("entry", entry, "is damaged"), ("step", step, "its step is none of the run's")):
        with pytest.raises(RecordingError, match=says):
            recorded(rewritten(tmp_path / "a", tmp_path / name, **{name: changed}))
    with pytest.raises(RecordingError, match="its value is not finite"):  # by other weights, other numbers
        recorded(rewritten(tmp_path / "a", tmp_path / "other", b"1e300 -1e300 1e308"))
