"""A law and water in one world: each is recorded at instants of its own, drawn between them, and the law alone is sent again."""

from pathlib import Path
from types import SimpleNamespace

import mujoco
import numpy as np
import pyarrow as pa
import pytest

from hung_springs import ROW, Springs, world
from worldengine.clock import unmoved
from worldengine.clock.beside import Beside
from worldengine.clock.simulate import prepare, simulate
from worldengine.given import Given
from worldengine.inputs.author_link import Local
from worldengine.inputs.declared_media import Media
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Asked, Replayed
from worldengine.recording import describing, lain, law_channels, point_colours, stored
from worldengine.recording.record import Recorder
from worldengine.recording.replay import Replay
from worldengine.solvers import Row
from worldkit import bodies, portable, waters
from worldkit.errors import RecordingError
from worldkit.filming.laws_shown import Laws
from worldkit.world import start

STEPS = 150


def wet() -> mujoco.MjSpec:
    spec = world()
    bodies.container(spec, "tank", size=(0.3, 0.2, 0.2), wall=0.02, pos=(0.6, 0, 0.1), fixed=True)
    bodies.sphere(spec, "ball", diameter=0.05, pos=(0.62, 0, 0.2), density=700.0)
    waters.fill(spec, "water", container="tank", level=0.12, drops=2)
    return spec


def run(
    folder: Path, law: bool = True, drive: "stored.Recording | stored.Replayable | None" = None
) -> stored.Recording:
    model = wet().compile()
    prepare(model)
    data = start(model)
    rows = [Row("water", ("ball",), {"density": 998.0, "level": 0.12}, "water")]
    meta = {**describing.describe(model), "solvers": [row.written() for row in rows]}
    inputs = None
    if law:
        ports = Ports(model, (), Media(model, (ROW,), model.opt.timestep, (), STEPS))
        answers = Local(model, data, ports, None, [Springs()])
        inputs = Replayed(model, data, ports, drive, STEPS) if drive else Asked(model, data, ports, answers)
        meta |= {"inputs": ports.as_meta(), "laws": [ROW.written()]}
    beside = Beside(model, data, rows, inputs.ports if inputs else None)
    meta["shown"] = beside.shown
    with Recorder(model, data, folder, meta, channels=beside.channels) as recorder:
        simulate(model, data, recorder, STEPS, inputs, beside=beside)
    return stored.open(folder)


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> stored.Recording:
    return run(tmp_path_factory.mktemp("both") / "out")


def test_each_is_drawn_between_its_own_instants(both: stored.Recording) -> None:
    media, model = both.media, wet().compile()
    steps = [np.unique(media.step[media.medium == n]) for n in (0, 1)]
    assert list(steps[0]) == list(range(0, STEPS + 1, 10)) and list(steps[1]) == [*range(0, STEPS, 17), STEPS]
    shown = Replay(model, both).show(STEPS - 4).flexvert_xpos
    for number, rows in ((0, slice(0, 3)), (1, slice(3, None))):
        place = media.place[media.medium == number].reshape(len(steps[number]), -1, 3)
        before = int(np.searchsorted(steps[number], STEPS - 4)) - 1
        early, late = steps[number][before : before + 2]
        share = (STEPS - 4 - early) / (late - early)
        assert shown[rows] == pytest.approx((1 - share) * place[before] + share * place[before + 1], abs=1e-6)


def test_both_are_the_same_when_what_was_sent_is_sent_again(tmp_path: Path, both: stored.Recording) -> None:
    for name, drive in (("whole", both), ("sent", stored.Replayable(both.folder))):
        again = run(tmp_path / name, drive=drive)
        assert again.shown_sha256 == both.shown_sha256
        assert stored.inputs_digest(again.folder) == stored.inputs_digest(both.folder) != ""


def test_a_world_of_water_alone_was_sent_nothing(tmp_path: Path) -> None:
    alone = run(tmp_path / "out", law=False)
    assert len(alone.media) and stored.inputs_digest(alone.folder) == ""


def rewritten(folder: Path, of: stored.Recording, change) -> stored.Replayable:
    """The recording with its table `media` changed."""
    folder.mkdir()
    for path in of.folder.iterdir():
        (folder / path.name).write_bytes(path.read_bytes())
    table = change(pa.ipc.open_stream((of.folder / "media.arrows").read_bytes()).read_all())
    with pa.OSFile(str(folder / "media.arrows"), "wb") as sink, pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table)
    return stored.Replayable(folder)


def test_a_law_from_before_colours_has_its_old_digest_and_drives_its_world(
    tmp_path: Path, both: stored.Recording
) -> None:
    old = rewritten(tmp_path / "old", both, lambda table: table.drop_columns(["colour"]))
    assert (old.media.colour == -1).all() and len(old.media.colour) == len(both.media)
    digests = {stored.inputs_digest(folder) for folder in (both.folder, old.folder)}
    assert len(digests) == 2, "it says nothing of colours, as it did when it was stamped"
    again = run(tmp_path / "again", drive=old)
    assert again.sha256 == both.sha256 and (again.media.place == both.media.place).all()


def test_points_that_are_neither_the_laws_nor_the_waters_are_refused(tmp_path: Path, both: stored.Recording) -> None:
    def moved(table: pa.Table) -> pa.Table:
        numbers = table.column("medium").to_numpy().copy()
        numbers[1] = 1
        return table.set_column(1, table.schema.field(1), pa.array(numbers))

    with pytest.raises(RecordingError, match=r"row 1 .* another medium"):
        run(tmp_path / "again", drive=rewritten(tmp_path / "forged", both, moved))


def test_a_colour_is_not_mixed_with_none() -> None:
    times, numbers = np.array([0.0, 1.0]), np.array([[0xFF0000, 0xFF0000, -1], [0x0000FF, -1, 0x0000FF]])
    halfway = lain.mixed(times, numbers.__getitem__, 0.5)
    assert halfway == pytest.approx(np.array([(0.5, 0, 0.5), (1, 0, 0), (-1, -1, -1)]))
    assert lain.mixed(times, numbers.__getitem__, 1.0) == pytest.approx(point_colours.shares(numbers[1]))


@pytest.mark.parametrize("shown", [[{"bodies": []}], 7, [{"law": "water"}], [None]])
def test_what_is_said_to_be_shown_and_makes_no_sense_is_named(both: stored.Recording, shown) -> None:
    damaged = stored.open(both.folder)
    damaged.meta = {**damaged.meta, "shown": shown}
    with pytest.raises(RecordingError, match=r"`shown` in the recording's meta.json makes no sense"):
        Replay(wet().compile(), damaged)


def test_a_world_that_stands_still_has_the_points_of_its_law_and_of_its_water(tmp_path: Path) -> None:
    portable.write(wet(), tmp_path / "world.mjz")
    rows = (Row("water", ("ball",), {"density": 998.0, "level": 0.12}, "water"),)
    given = Given(tmp_path / "world.mjz", 0.5, 24, (64, 48), (), (), 0, "", 10, 0, (), rows, (ROW,))
    unmoved.run(given, SimpleNamespace(out=tmp_path))
    recording = stored.open(tmp_path)
    laws = Laws(law_channels.read(recording))
    assert laws.names == ("springs", "water")
    assert laws.points("water", 0.3)[:, 2].max() == pytest.approx(0.12, abs=1e-3)
    Replay(given.model(), recording).show(3)
