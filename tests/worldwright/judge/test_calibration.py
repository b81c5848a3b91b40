"""Films with a planted fault: what is planted is in them, and a judge that does not see it is named unfit."""

import json
from datetime import UTC, datetime
from hashlib import sha256

import mujoco
import numpy as np
import pytest

from worldwright.judge import calibration, planted
from worldwright.judge.verdict_record import FilmRecord, Vote

smalls = pytest.mark.parametrize("small", planted.SMALL, ids=lambda one: one.name)


def record(id, scenario, says):
    """What a judge that is a function of (id, field) says of one film, three times."""
    text = json.dumps({name: "Yes" if says(id, name) else "No" for name in scenario.criteria.fields})
    vote = Vote(text=text, sha256=sha256(text.encode()).hexdigest(), at=datetime.now(UTC).isoformat())
    return FilmRecord(
        id=id, criteria=scenario.criteria, criteria_sha256=scenario.criteria.sha256, film_sha256="f", exhibit=(),
        question_sha256="q", wanted=3, votes=(vote,) * 3,
    )  # fmt: skip


def judged(says):
    return calibration.calibrated(record(id, one, says) for id, one in planted.scenarios().items())


def knows(id, name):
    return planted.answers(id)[1].get(name, True)


def test_who_sees_every_fault_is_fit():
    found = judged(knows)
    assert found.fit and found.films == 18 and found.matrix.yes_no == found.matrix.no_yes == 0
    assert found.matrix.sensitivity.of == 3 * (4 + 1 + 1) and found.matrix.specificity.of == 3 * (1 + 1 + 2 + 2 + 1)
    assert {share.of for share in found.found.values()} == {3} and set(found.found) == set(planted.FAULTS)


@pytest.mark.parametrize(
    ("says", "why"),
    [
        (lambda id, name: True, "says Yes to all"),
        (lambda id, name: False, "says No to all"),
        (lambda id, name: knows(id, name) or "frozen" in id or "reversed" in id, "overlooks faults"),
        (lambda id, name: knows(id, name) and not ("sound" in id and name == "Event"), ""),
        (lambda id, name: knows(id, name) and name != "Objects", "denies what is so"),
    ],
)
def test_a_judge_that_sees_nothing_is_named(says, why):
    found = judged(says)
    assert (not found.fit) == bool(why) and why in " ".join(found.unfit) and (why in found.text())


def test_a_judge_that_did_not_answer_to_all_films_is_not_fit():
    records = [record(id, one, knows) for id, one in planted.scenarios().items()]
    found = calibration.calibrated([records[0].model_copy(update={"votes": ()}), *records[1:-1]])
    assert not found.fit and len(found.undecided) == 1 and len(found.missing) == 1 and "2 of its 18" in found.unfit[0]


@smalls
def test_what_the_criteria_say_is_so_in_the_sound_world_and_not_without_the_contact(small):
    """The numbers behind the right answers, from the states that the films are drawn of."""
    model = mujoco.MjModel.from_xml_string(small.xml)
    loose = planted.apart(mujoco.MjModel.from_xml_string(small.xml), small)
    sound, through = planted.recorded(model, small), planted.recorded(loose, small)
    assert sound.shape == (planted.FRAMES, model.nq) and np.isfinite(through).all()
    if small.name == "drop":
        assert sound[0, 2] - sound[-1, 2] > 1 and sound[-1, 2] == pytest.approx(0.22, abs=0.02)
        assert np.all(np.diff(sound[:, 2]) < 0.02) and through[-1, 2] < -0.3
    elif small.name == "push":
        hit = np.argmax(sound[:, 7] > 0.26)
        assert 3 < hit < planted.FRAMES - 3 and sound[-1, 7] > 0.45 and np.all(sound[:hit, 7] < 0.26)
        assert np.all(sound[:, 0] < sound[:, 7]) and through[-1, 0] > through[-1, 7] + 0.4
        assert through[-1, 7] == pytest.approx(0.25, abs=0.01)
    else:
        assert sound[-1, 0] > 0.9 and sound[-1, 2] < 0.3 and np.all(np.diff(sound[:14, 2]) <= 1e-3)
        assert through[-1, 0] < 0.5 and through[-1, 2] < 0.3, "it falls through the board"


@pytest.mark.gl
def test_each_fault_is_in_the_pictures(monkeypatch):
    monkeypatch.setattr(planted, "FRAMES", 4)
    drop = planted.SMALL[0]
    films = dict(planted.drawn(drop, 64, 48))
    assert set(films) == set(planted.FAULTS) and {len(film) for film in films.values()} == {4}
    first, last = films["sound"][0].astype(int), films["sound"][-1].astype(int)
    assert abs(first - last).max() > 60
    assert all(np.array_equal(picture, films["frozen"][0]) for picture in films["frozen"])
    assert np.array_equal(films["reversed"][0], films["sound"][-1])

    def red(picture):
        return int(((picture[..., 0] > 110) & (picture[..., 1] < 90) & (picture[..., 2] < 90)).sum())

    assert red(films["sound"][-1]) > 5 and red(films["passing"][-1]) == 0 and red(films["missing"][-1]) == 0
    blue = films["recoloured"][-1].astype(int)
    assert red(films["recoloured"][-1]) == 0 and ((blue[..., 2] > 110) & (blue[..., 0] < 90)).sum() > 5
