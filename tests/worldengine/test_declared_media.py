"""An author's law beside the engine: its forces are inputs, its points a medium that is recorded, driven again and drawn."""

import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pytest

from hung_springs import ROW, STEPS, Springs, motor, run, world
from worldengine.inputs import declared_media as media_of
from worldengine.inputs.declared_media import Media, Medium
from worldengine.inputs.ports import Ports
from worldengine.recording import law_channels, stored
from worldengine.recording.lain import between
from worldengine.recording.replay import Replay
from worldkit import program
from worldkit.errors import ProgramError, RecordingError


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> stored.Recording:
    return run(tmp_path_factory.mktemp("media") / "out")


def test_its_forces_stand_in_the_ledger_and_move_the_body(recorded: stored.Recording) -> None:
    ledger = recorded.interventions
    assert set(ledger.kind) == {"force"} and set(ledger.target) == {"weight"}
    assert len(ledger) >= STEPS - 1
    fallen = 0.7 - recorded.pos[-1, 0, 2]
    assert 0 < fallen < 0.5 * 9.81 * recorded.time[-1] ** 2, "it falls more slowly than without a spring"


def test_momentum_goes_from_points_to_bodies_and_none_is_lost(recorded: stored.Recording) -> None:
    sums, ledger, step = recorded.balances, recorded.interventions, recorded.time_step
    weight = np.array([0, 0, -9.81]) * sums.mass[:, None] * sums.step[:, None] * step
    given = np.array([ledger.value[ledger.time < n * step - 1e-9][:, :3].sum(axis=0) * step for n in sums.step])
    assert sums.momentum - sums.momentum[0] + given + sums.held == pytest.approx(weight, abs=1e-12)
    assert abs(sums.held[-1, 2]) > 0.01
    work = np.array([ledger.work_j[ledger.time < n * step - 1e-9].sum() for n in sums.step])
    assert sums.energy + work == pytest.approx(np.full(len(sums), sums.energy[0]), rel=2e-3)


def test_points_are_recorded_a_hundred_times_a_second_and_drawn_in_between(recorded: stored.Recording) -> None:
    assert list(recorded.balances.step) == list(range(0, STEPS + 1, 10))
    place = recorded.media.place.reshape(16, 3, 3)
    assert place.dtype == np.float32 and place[0, :, 2] == pytest.approx([1.0, 0.9, 0.8])
    shown = Replay(world().compile(), recorded)
    assert shown.show(25).flexvert_xpos == pytest.approx((place[2] + place[3]) / 2, abs=1e-6)
    assert shown.show(STEPS).flexvert_xpos == pytest.approx(place[-1])
    assert between(np.array([0.0]), place[:1].__getitem__, 3.0) == pytest.approx(place[0])


def test_geoms_of_a_body_can_show_it(tmp_path: Path) -> None:
    spec = world()
    drops = spec.worldbody.add_body(name="drops")
    for _ in range(3):
        drops.add_geom(size=(0.02, 0, 0), contype=0, conaffinity=0)
    law = Springs()
    law.shown_by = "drops"
    recording = run(tmp_path / "out", law, spec, (Medium("springs", ("weight",), "drops", world=True),))
    data = Replay(spec.compile(), recording).show(0)
    assert data.geom_xpos[-3:, 2] == pytest.approx([1.0, 0.9, 0.8])


def test_a_replay_needs_no_law_and_gives_the_same_bits(tmp_path: Path, recorded: stored.Recording) -> None:
    again = run(tmp_path / "out", drive=recorded)
    assert again.sha256 == recorded.sha256
    assert stored.inputs_digest(again.folder) == stored.inputs_digest(recorded.folder)
    assert (again.media.place == recorded.media.place).all()
    asked = run(tmp_path / "asked")
    assert stored.inputs_digest(asked.folder) == stored.inputs_digest(recorded.folder), "the law asked again"
    softer = Springs()
    softer.stiffness = 199.0
    other = run(tmp_path / "softer", softer)
    assert stored.inputs_digest(other.folder) != stored.inputs_digest(recorded.folder)


def rewrite(folder: Path, name: str, **changes) -> None:
    """A table with some columns' numbers written otherwise."""
    path = folder / f"{name}.arrows"
    table = pa.ipc.open_stream(path.read_bytes()).read_all()
    for column, change in changes.items():
        at = table.schema.get_field_index(column)
        values = table.column(column).combine_chunks()
        flat = np.array(values.values if pa.types.is_fixed_size_list(values.type) else values)
        flat = pa.array(change(flat))
        size = getattr(values.type, "list_size", 0)
        made = pa.FixedSizeListArray.from_arrays(flat, type=values.type) if size else flat
        table = table.set_column(at, table.schema.field(at), made)
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table)


def _at(row: int, value: float):
    def change(numbers: np.ndarray) -> np.ndarray:
        numbers[row] = value
        return numbers

    return change


@pytest.mark.parametrize(
    ("name", "changes", "says"),
    [
        ("media", {"step": _at(4, 11)}, "row 4 .* nothing is due"),
        ("media", {"medium": _at(2, 1)}, "another medium"),
        ("media", {"point": _at(7, 0)}, "another point"),
        ("media", {"place": _at(5, np.nan)}, "it lies nowhere"),
        ("media", {"colour": _at(5, 1 << 24)}, "its colour is none"),
        ("balances", {"energy": _at(3, np.inf)}, "row 3 .* not finite"),
    ],
)
def test_a_forged_medium_is_refused(tmp_path: Path, recorded: stored.Recording, name: str, changes, says: str) -> None:
    for path in recorded.folder.iterdir():
        (tmp_path / path.name).write_bytes(path.read_bytes())
    rewrite(tmp_path, name, **changes)
    with pytest.raises(RecordingError, match=says):
        run(tmp_path / "out", drive=stored.Replayable(tmp_path))


def test_a_medium_that_is_taken_away_is_missed(tmp_path: Path, recorded: stored.Recording) -> None:
    for name in ("inputs", "balances"):
        (tmp_path / f"{name}.arrows").write_bytes((recorded.folder / f"{name}.arrows").read_bytes())
    with pytest.raises(RecordingError, match=r"media.arrows has 0 rows, and 16 steps"):
        run(tmp_path / "out", drive=stored.Replayable(tmp_path))


def test_sums_of_an_earlier_version_are_refused(tmp_path: Path, recorded: stored.Recording) -> None:
    for name in ("inputs", "edits", "media"):
        (tmp_path / f"{name}.arrows").write_bytes((recorded.folder / f"{name}.arrows").read_bytes())
    table = pa.ipc.open_stream((recorded.folder / "balances.arrows").read_bytes()).read_all().drop_columns(["weight"])
    with pa.OSFile(str(tmp_path / "balances.arrows"), "wb") as sink, pa.ipc.new_stream(sink, table.schema) as writer:
        writer.write_table(table)
    with pytest.raises(RecordingError, match="no column weight, which an earlier version"):
        stored.inputs_digest(tmp_path)


class Meddling(Springs):
    def step(self, model, data, seconds):
        forces = super().step(model, data, seconds)
        data.xfrc_applied[1, 0] = data.qfrc_applied[0] = data.ctrl[0] = 3.0
        return forces


def test_nothing_but_a_laws_forces_reaches_the_world_and_nobody_else_pushes_its_bodies(tmp_path: Path) -> None:
    def control(model, data):
        data.xfrc_applied[1] = 7.0
        data.qfrc_applied[:] = 7.0

    drive = (("control", frozenset({"pull"})),)
    plain = run(tmp_path / "plain", Springs(), motor(), others=drive, steps=20)
    for name, law, by in (("meddling", Meddling(), None), ("pushed", Springs(), control)):
        other = run(tmp_path / name, law, motor(), others=drive, steps=20, control=by)
        assert other.sha256 == plain.sha256, name


def test_a_law_that_writes_the_model_is_refused_whatever_control_may(tmp_path: Path) -> None:
    class Lightening(Springs):
        def step(self, model, data, seconds):
            model.body_mass[1] *= 0.9
            return super().step(model, data, seconds)

    def control(model, data):
        model.body_mass[1] *= 0.9

    opened = (("parameter", frozenset({"weight.body_mass"})),)
    assert run(tmp_path / "control", others=opened, steps=5, control=control).complete
    for name, others in (("law", opened), ("alone", ())):
        with pytest.raises(ProgramError, match=r"a law writes model.body_mass"):
            run(tmp_path / name, Lightening(), others=others, steps=5)


@pytest.mark.parametrize("name", ["x", "cart/x", "cart"])
def test_a_joint_of_a_laws_body_is_no_way_to_push_it(name: str) -> None:
    model, row = motor().compile(), Medium("springs", ("cart",), "net")
    assert "qfrc_applied" not in Ports(model, (), Media(model, [row], 0.001)).entries
    with pytest.raises(ProgramError, match="pushed by the law springs and by another input"):
        Ports(model, (("force", frozenset({name})),), Media(model, [row], 0.001))


class Raising(Springs):
    def step(self, model, data, seconds):
        if data.time > 0.0215:
            raise ZeroDivisionError("a spring without length")
        return super().step(model, data, seconds)


class Exploding(Springs):
    stiffness = 1e9


class Misshapen(Springs):
    def step(self, model, data, seconds):
        return super().step(model, data, seconds)[0]


class TooFew(Springs):
    def start(self, model, data):
        super().start(model, data)
        self.points = self.points[:2]


class Greedy(Springs):
    bodies = ("weight", "net", "world")


@pytest.mark.parametrize(
    ("law", "says"),
    [
        (Raising, r"step of the law springs failed at t = 0.0220 s: ZeroDivisionError: a spring without length"),
        (Exploding, r"law springs (blew up|pushes with what is no number)"),
        (Misshapen, r"returned forces of the shape \(3,\)"),
        (TooFew, r"points of the shape \(2, 3\), and net shows 3 points"),
        (Greedy, r"acts on weight, net, world.*the plan declares weight"),
    ],
)
def test_a_law_that_fails_says_where_and_leaves_what_was_recorded(tmp_path: Path, law, says: str) -> None:
    with pytest.raises(ProgramError, match=says) as caught:
        run(tmp_path / "out", law())
    assert caught.value.next_move
    if law is Raising:
        assert caught.value.place.startswith("test_declared_media.py:")
        kept = stored.open(tmp_path / "out")
        assert not kept.complete and len(kept) == 22
        assert Replay(world().compile(), kept).show(21).flexvert_xpos[0, 2] < 1.0


@pytest.mark.parametrize(
    ("rows", "others", "flex", "says"),
    [
        ((Medium("springs", ("whale",), "net"),), (), {}, "'whale', which is not in the world"),
        ((Medium("springs", ("weight",), "sea"),), (), {}, "'sea', which is no flex and no body"),
        ((Medium("springs", ("weight",), "weight"),), (), {}, "weight, which shows the law springs, collides"),
        ((ROW,), (), {"contype": 1}, "net, which shows the law springs, collides"),
        ((ROW,), (("force", frozenset({"weight"})),), {}, "pushed by the law springs and by another input"),
        ((ROW, Medium("gum", ("weight",), "net")), (), {}, "pushed by the law gum and by the law springs"),
        ((ROW, Medium("springs", (), "net")), (), {}, "two laws are called springs"),
        ((Medium("springs", ("weight", "weight"), "net"),), (), {}, "springs names its body 'weight' twice"),
    ],
)
def test_what_a_law_may_not_be_is_refused_before_the_first_step(tmp_path: Path, rows, others, flex, says: str) -> None:
    with pytest.raises(ProgramError, match=says):
        run(tmp_path / "out", spec=world(**flex), rows=rows, others=others)


def test_too_many_points_are_refused_with_their_number(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(media_of, "MOST_POINTS", 2)
    with pytest.raises(ProgramError, match="move 3 points, more than 2"):
        Media(world().compile(), [ROW], 0.001)


def test_many_points_are_recorded_less_often_down_to_a_rate(monkeypatch: pytest.MonkeyPatch) -> None:
    model = world(points=3000).compile()
    assert Media(model, [ROW], 0.001).every == 20
    assert Media(model, [ROW], 0.04).every == 1
    monkeypatch.setattr(media_of, "POINTS_A_SECOND", 3000)
    assert Media(model, [ROW], 0.001).every == 40, "25 times a second, however many"


def test_a_run_whose_points_no_recording_keeps_is_refused_before_its_first_step() -> None:
    """Before, it was stopped when 2 GiB were full, and told to ask less often, which changes nothing."""
    model = world(points=3000).compile()  # 4.2 MB a second
    assert Media(model, [ROW], 0.001, (), 500_000).end == 500_000
    with pytest.raises(ProgramError, match=r"3000 points .* in 600 s are 2403 MiB, more than 2048") as refused:
        Media(model, [ROW], 0.001, (), 600_000)
    assert "the run be shorter" in refused.value.next_move


def test_a_recording_without_points_tells_of_its_laws_all_the_same(tmp_path: Path) -> None:
    run(tmp_path / "out", steps=7)
    (tmp_path / "out" / "media.arrows").unlink()
    told = law_channels.read(stored.open(tmp_path / "out"))
    assert list(told["law_names"]) == ["springs"] and told["law0_points"].shape == (0, 0, 3)
    assert not len(told["law_grains"]), "what shows it is no crowd of balls"


def test_a_law_is_summed_at_the_end_too_and_asked_often_enough(tmp_path: Path) -> None:
    once = run(tmp_path / "once", steps=7)
    assert list(once.balances.step) == [0, 7], "one question takes the points, and the end"
    assert list(run(tmp_path / "again", drive=once, steps=7).balances.step) == [0, 7]
    model = world().compile()
    with pytest.raises(ProgramError, match=r"asked every 0\.05 s, and its sums are due 25 times"):
        Media(model, [ROW], 0.05)
    with pytest.raises(ProgramError, match="has 150 steps, and the law springs is asked every 20"):
        Media(model, [ROW], 0.02, (), 150, 20)


def test_a_program_has_its_law_stepped_in_its_own_process(tmp_path: Path) -> None:
    words = ["--pass", "physics", "--out", str(tmp_path)]
    assert program.main(lambda: world(), duration=0.05, laws=[Springs()], argv=words) == 0
    recording = stored.open(tmp_path / "trajectory")
    assert [row["law"]["name"] for row in recording.meta["laws"]] == ["springs"] and len(recording.balances) == 6
    assert json.loads((tmp_path / "program.json").read_text())["laws"][0]["bodies"] == ["weight", "world"]


def test_a_law_pushes_on_the_world_only_where_its_row_says_so(tmp_path: Path) -> None:
    row = Medium.read({"bodies": ["weight"], "law": {"name": "springs", "shown_by": "net"}})
    with pytest.raises(ProgramError, match=r"acts on weight, world.*the plan declares weight, shown by net"):
        run(tmp_path / "silent", rows=(row,), steps=5)
    said = Medium.read({"bodies": ["world", "weight"], "law": {"name": "springs", "shown_by": "net"}})
    told = run(tmp_path / "said", rows=(said,), steps=5)
    assert told.meta["laws"][0]["bodies"] == ["weight", "world"] and set(told.interventions.target) == {"weight"}


class Stiffer(Springs):
    stiffness = 400.0


def test_the_motion_of_another_law_is_not_taken_over(tmp_path: Path) -> None:
    told = []
    for name, law in (("old", Springs()), ("new", Stiffer())):
        words = ["--pass", "physics", "--out", str(tmp_path / name), "--reuse", str(tmp_path / "old")]
        assert program.main(lambda: world(), duration=0.05, laws=[law], argv=words) == 0
        told.append(json.loads((tmp_path / name / "result.json").read_text()))
    assert "reused_from" not in told[1] and told[0]["inputs_sha256"] != told[1]["inputs_sha256"]
    assert not any(said["motion_key"] for said in told)


def test_pictures_of_other_points_are_not_those_of_this_recording(tmp_path: Path) -> None:
    class Aside(Springs):
        def start(self, model, data):
            super().start(model, data)
            self.points = self.points + np.array([0.0, 0.3, 0.0])

        def step(self, model, data, seconds):
            return np.zeros((2, 3))

    class Still(Aside):
        def start(self, model, data):
            Springs.start(self, model, data)

    one, same, other = (run(tmp_path / f"{n}", law, steps=20) for n, law in enumerate((Still(), Still(), Aside())))
    assert one.sha256 == other.sha256  # the body moves alike
    assert one.shown_sha256 == same.shown_sha256 != other.shown_sha256


@pytest.mark.parametrize(
    ("laws", "settings", "says"),
    [
        ([Springs], {}, "is a class"),
        ([object()], {}, "has no name"),
        ([Springs(), Springs()], {}, "two laws are called springs"),
        ([Springs()], {"latency": 1}, "latency is 1"),
    ],
)
def test_laws_that_cannot_be_stepped_are_refused(tmp_path: Path, laws, settings, says: str) -> None:
    words = ["--pass", "build", "--out", str(tmp_path)]
    assert program.main(lambda: world(), duration=0.05, laws=laws, argv=words, **settings) == 1
    assert says in json.loads((tmp_path / "error.json").read_text())["message"]


def test_what_is_a_crowd_of_balls_is_told_to_films() -> None:
    rows = {
        "honey": ["sphere"] * 3,
        "cord": ["mesh"],
        "bead": ["sphere"],
        "mixed": ["sphere", "box"],
        "other": ["sphere"] * 2,
    }
    recording = SimpleNamespace(
        meta={"geoms": [{"body": body, "type": kind} for body, kinds in rows.items() for kind in kinds]}
    )
    assert law_channels._grains(recording, {"honey", "cord", "bead", "mixed", "gone"}) == ["honey"]
