"""Frames that somebody asked to see are drawn once: the same question of the same recording and film is answered from `out`."""

from types import SimpleNamespace

import pytest

from worldwright.model.picture import Illustrated, Picture
from worldwright.stage import drawn_once
from worldwright.stage.pictures import Shown


@pytest.fixture
def run(tmp_path, monkeypatch):
    film = {"film": "one"}
    monkeypatch.setattr(drawn_once.pictures_of, "identity", lambda run, stage: film["film"])
    (tmp_path / "evidence/k/physics").mkdir(parents=True)
    (tmp_path / "evidence/k/physics/result.json").write_text('{"ok": true}')
    return SimpleNamespace(folder=tmp_path, evidence=lambda key: tmp_path / "evidence" / key.key, film=film)


def test_the_same_question_is_drawn_once_and_any_other_anew(run):
    drawn, key = [], SimpleNamespace(key="k")

    def ask(**asked):
        def draw():
            drawn.append(asked)
            shown = Shown(cameras=("film",), captions=("shot 1",))
            return Illustrated(shown, (Picture(b"jpeg %d" % len(drawn), "shots, sheet 1", "jpeg"),))

        return drawn_once.drawn(run, key, "shots", asked, draw)

    first = ask(width=432)
    assert ask(width=432) == first and len(drawn) == 1
    (written,) = first.folder.glob("*.jpg")
    assert written.read_bytes() == b"jpeg 1" and first.folder.is_relative_to(run.folder / "out")
    assert str(first.folder) in first.data.text() and not list((run.folder / "evidence/k").glob("shots*"))
    assert ask(width=640).pictures != first.pictures and len(drawn) == 2
    run.film["film"] = "another"
    ask(width=432)
    assert len(drawn) == 3, "another film, or renderer"
    (run.folder / "evidence/k/physics/result.json").write_text('{"ok": true, "trajectory": 2}')
    found = ask(width=432)
    assert len(drawn) == 4, "another recording"
    next(found.folder.glob("*.jpg")).write_bytes(b"painted over")
    assert ask(width=432).pictures[0].data == b"jpeg 5", "what is not what was drawn is drawn anew"
    for width in range(drawn_once.MOST_KEPT + 5):
        ask(width=width)
    assert len(list((run.folder / "out/frames").iterdir())) == drawn_once.MOST_KEPT


def test_where_nothing_is_recorded_whoever_draws_says_so(run):
    with pytest.raises(LookupError):
        drawn_once.drawn(run, SimpleNamespace(key="none"), "shots", {}, lambda: (_ for _ in ()).throw(LookupError()))
    assert not (run.folder / "out").exists()
