"""A hearing: each vote is paid once and kept in the judge's own words, and the judge is told nothing but film and criteria."""

import json

import pytest

from judge_stands import chat, pictures_of, said
from worldwright.judge import hearing, judging_prompt, scored_report
from worldwright.judge.ballot import TieError
from worldwright.judge.entrants import Entrant
from worldwright.judge.hearing import Bench
from worldwright.judge.patience import Patience
from worldwright.judge.verdict_record import Protocol, RecordError, Records, outside
from worldwright.model.errors import NotFoundError


@pytest.fixture
def bench(stand_in):
    protocol = Protocol(
        judge="openai_compatible",
        model="eye-1",
        address=stand_in.address,
        form="frames",
        frames=3,
        words_sha256="0" * 64,
    )
    patience = Patience(tries=3, sleep=lambda _: None)
    return Bench(protocol, judging_prompt.WORDS, stand_in.address, votes=3, silent_s=5.0, patience=patience)


@pytest.fixture
def records(tmp_path, bench):
    made = Records.at(tmp_path / "judged", "x")
    made.begin(bench.protocol, bench.words)
    return made


def heard(records, scenario, path, bench, run=None):
    return hearing.hear(records, {scenario.id: scenario}, {scenario.id: Entrant(path, run)}, bench)


def test_votes_are_kept_in_the_judges_words_and_never_paid_again(stand_in, records, scenario, film, bench):
    stand_in.replies = [(200, chat(text), {}) for text in (said(), said("Standard_2"), said("Standard_2"))]
    found = heard(records, scenario, film(), bench)
    assert (found.asked, found.decided, found.undecided) == (3, 1, {})
    record = records.read("039")
    assert record.decided().fields == {"Objects": True, "Event": True, "Standard_1": True, "Standard_2": False}
    assert [vote.model for vote in record.votes] == ["eye-1-2026"] * 3 and record.votes[0].tokens_in == 900
    assert heard(records, scenario, film(), bench).asked == 0 and len(stand_in.asked) == 3
    for kind in ("questions", "exhibits"):
        assert list((records.folder / kind).iterdir())
    assert len(records.pieces(record)) == 3
    assert records.find(record.model_copy(update={"exhibit": ("0.jpg",), "votes": ()})) == record, (
        "whatever the decoder gives"
    )


def test_the_judge_is_told_nothing_of_how_the_film_came_about(stand_in, records, scenario, film, bench, tmp_path):
    run = tmp_path / "films" / "run-of-the-builder"
    (run / "accepted").mkdir(parents=True)
    (run / "plan.md").write_text("the builder says: it bounces 0.7 m high")
    scenario = scenario.model_copy(update={"id": "scenario-of-the-marble"})
    stand_in.replies = [(200, chat(said()), {})]
    heard(records, scenario, film("secret-camera"), bench, run)
    for path, body, headers in stand_in.asked:
        sent = path + json.dumps(body) + json.dumps(headers)
        for word in (
            scenario.id,
            "run-of-the-builder",
            "secret-camera",
            "builder says",
            "Interaction Dynamics",
            str(tmp_path),
        ):
            assert word not in sent
        assert len(pictures_of(body)) == 3
    assert records.read(scenario.id).run == str(run)


def test_a_film_that_the_judge_declines_is_left_undecided_and_the_next_is_judged(
    stand_in, records, scenario, film, bench
):
    refusal = {"choices": [{"message": {"content": None, "refusal": "no"}, "finish_reason": "stop"}]}
    stand_in.replies = [(200, refusal, {}), (200, chat(said()), {})]
    other = scenario.model_copy(update={"id": "040"})
    films = {"039": Entrant(film()), "040": Entrant(film("040"))}
    found = hearing.hear(records, {"039": scenario, "040": other}, films, bench)
    assert found.decided == 1 and found.ended is None and "declined" in found.undecided["039"]
    own = scored_report.of(records)
    assert own.tally is None and "0 of 3 votes" in own.undecided["039"], "no row while a film is undecided"
    assert "withheld" in scored_report.markdown(scored_report.Report(own=(own,)))
    stand_in.replies = [(200, chat(said()), {})]
    assert hearing.hear(records, {"039": scenario, "040": other}, films, bench).asked == 3, "only what was missing"


def test_a_film_that_was_entered_and_never_heard_withholds_the_row(stand_in, records, scenario, film, bench, tmp_path):
    stand_in.replies = [(200, chat(said()), {})]
    heard(records, scenario, film(), bench)
    assert scored_report.of(records).undecided == {}
    records.enter(tmp_path, [scenario.id, "001"])
    assert scored_report.of(records).undecided == {"001": "it was entered and never heard"}


def test_a_judge_that_cannot_be_asked_ends_the_hearing_and_nothing_is_lost(stand_in, records, scenario, film, bench):
    stand_in.replies = [(200, chat(said()), {}), (401, {"error": {"message": "expired"}}, {})]
    other = scenario.model_copy(update={"id": "040"})
    films = {"039": Entrant(film()), "040": Entrant(film("040"))}
    found = hearing.hear(records, {"039": scenario, "040": other}, films, bench)
    assert found.ended is not None and found.ended.code == "unauthorised" and len(records.read("039").votes) == 1
    own = scored_report.of(records, everything=False)
    assert set(own.undecided) == {"039", "040"}, "a film that was not reached is not one that does not exist"


def test_garbage_is_asked_again_and_counted(stand_in, records, scenario, film, bench):
    stand_in.replies = [(200, chat("I think yes"), {}), (503, b"", {"Retry-After": "0"}), (200, chat(said()), {})]
    heard(records, scenario, film(), bench)
    assert records.read("039").votes[0].tries == 3


def test_another_film_of_a_scenario_is_judged_anew_and_the_old_votes_are_kept_aside(
    stand_in, records, scenario, film, bench
):
    stand_in.replies = [(200, chat(said()), {})]
    heard(records, scenario, film(), bench)
    assert heard(records, scenario, film(frames=20), bench).asked == 3
    assert len(list((records.folder / "earlier").iterdir())) == 1


def test_who_goes_back_to_earlier_criteria_pays_nothing_again(stand_in, records, scenario, film, bench):
    stand_in.replies = [(200, chat(said()), {})]
    other = scenario.model_copy(update={"criteria": scenario.criteria.model_copy(update={"event": "it flies"})})
    paid = [heard(records, one, film(), bench).asked for one in (scenario, other, scenario, other)]
    assert paid == [3, 3, 0, 0] and len(records.read("039").votes) == 3


def test_two_hearings_at_once_are_refused_before_anything_is_paid(stand_in, records, scenario, film, bench):
    with records.held(), pytest.raises(RecordError, match="under way"):
        heard(Records(records.folder), scenario, film(), bench)
    assert stand_in.asked == []
    stand_in.replies = [(200, chat(said()), {})]
    assert heard(records, scenario, film(), bench).asked == 3


def test_a_broken_film_is_recorded_and_the_others_are_judged(stand_in, records, scenario, film, bench):
    broken, other = film("broken"), scenario.model_copy(update={"id": "040"})
    broken.write_bytes(b"no film")
    stand_in.replies = [(200, chat(said()), {})]
    films = {"039": Entrant(broken), "040": Entrant(film("040"))}
    assert hearing.size(films, bench)[1] > 0
    found = hearing.hear(records, {"039": scenario, "040": other}, films, bench)
    assert (found.asked, found.decided, found.ended) == (3, 1, None) and "no film" in found.undecided["039"]
    assert "no film" in scored_report.of(records).undecided["039"]


def test_three_films_in_a_row_that_fail_alike_end_the_hearing(stand_in, records, scenario, film, bench):
    stand_in.replies = [(200, b"<html>", {})]
    scenarios = {f"00{n}": scenario.model_copy(update={"id": f"00{n}"}) for n in range(1, 6)}
    found = hearing.hear(records, scenarios, {id: Entrant(film()) for id in scenarios}, bench)
    assert found.ended is not None and found.ended.code == "garbage" and len(stand_in.asked) == 3 * 3


def test_a_film_that_was_decided_before_says_nothing_of_the_judge(stand_in, records, scenario, film, bench):
    scenarios = {f"00{n}": scenario.model_copy(update={"id": f"00{n}"}) for n in range(1, 6)}
    films = {id: Entrant(film()) for id in scenarios}
    stand_in.replies = [(200, chat(said()), {})]
    assert hearing.hear(records, scenarios, {"003": films["003"]}, bench).decided == 1
    stand_in.asked.clear()
    stand_in.replies = [(200, b"<html>", {})]
    found = hearing.hear(records, scenarios, films, bench)
    assert found.ended is not None and len(stand_in.asked) == 3 * 3, "001, 002 and 004 failed alike in a row"


def test_films_that_failed_are_asked_about_last_and_do_not_keep_the_others_from_being_heard(
    stand_in, records, scenario, film, bench
):
    scenarios = {f"00{n}": scenario.model_copy(update={"id": f"00{n}"}) for n in range(1, 6)}
    films = {id: Entrant(film()) for id in scenarios}
    stand_in.replies = [(200, b"<html>", {})]
    assert hearing.hear(records, scenarios, films, bench).ended is not None
    stand_in.replies = [*[(200, chat(said()), {})] * 6, (200, b"<html>", {})]
    found = hearing.hear(records, scenarios, films, bench)
    assert found.decided == 2 and records.read("004").votes and records.read("005").votes
    assert list(found.undecided) == ["001", "002", "003"]


def test_a_decided_film_between_those_that_fail_ends_their_row(stand_in, records, scenario, film, bench):
    scenarios = {f"00{n}": scenario.model_copy(update={"id": f"00{n}"}) for n in range(1, 6)}
    films = {id: Entrant(film()) for id in ("002", "003", "001", "004", "005")}
    good, bad = (200, chat(said()), {}), (200, b"<html>", {})
    stand_in.replies = [*[bad] * 6, *[good] * 3, *[bad] * 3, good]
    found = hearing.hear(records, scenarios, films, bench)
    assert found.ended is None and found.decided == 2 and list(found.undecided) == ["002", "003", "004"]


def test_what_was_recorded_cannot_be_changed_unseen(stand_in, records, scenario, film, bench):
    stand_in.replies = [(200, chat(said("Event")), {})]
    heard(records, scenario, film(), bench)
    path = records.folder / "verdicts/039.json"
    good = path.read_text()
    for before, after in (('\\"Event\\": \\"No\\"', '\\"Event\\": \\"Yes\\"'), ("it falls", "it flies"), ("{", "")):
        path.write_text(good.replace(before, after, 1))
        with pytest.raises(RecordError):
            records.read("039")
    path.write_text(good)
    next((records.folder / "exhibits").iterdir()).write_bytes(b"another picture")
    with pytest.raises(RecordError, match="what is shown"):
        records.pieces(records.read("039"))


def test_verdicts_lie_where_no_builder_reads(tmp_path, bench):
    for name in ("plan.md", "AGENTS.md", "campaign.json"):
        inside = tmp_path / name.partition(".")[0]
        inside.mkdir()
        (inside / name).write_text("")
        with pytest.raises(RecordError, match=name) as raised:
            outside(inside / "deep" / "er")
        assert "--out" in raised.value.next_move
    assert outside(tmp_path / "judged") == tmp_path / "judged"


def test_another_protocol_is_another_folder(records, bench):
    records.begin(bench.protocol, bench.words)
    with pytest.raises(RecordError, match="another protocol"):
        records.begin(bench.protocol.model_copy(update={"frames": 8}), bench.words)


@pytest.mark.parametrize("votes", [0, 2, 4])
def test_an_even_number_of_votes_is_refused(votes):
    with pytest.raises(TieError) as raised:
        hearing.odd(votes)
    assert raised.value.code == "tie" and hearing.odd(3) == 3


def test_a_film_without_criteria_is_named_before_anything_is_paid(stand_in, records, scenario, film, bench):
    with pytest.raises(NotFoundError, match="041"):
        hearing.hear(records, {"039": scenario}, {"039": Entrant(film()), "041": Entrant(film("041"))}, bench)
    assert stand_in.asked == []
