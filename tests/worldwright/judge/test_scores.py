"""Votes, shares and the published rows: counted as the benchmark counts, and the printed figures come back out of whole numbers."""

import csv
import re
from importlib.resources import files

import pytest

from worldwright.judge import anchor_rows, ballot, eighty, intervals, scored_report, tally
from worldwright.judge.ballot import TieError
from worldwright.judge.staging_audit import Staging
from worldwright.judge.verdict_record import Protocol

FIELDS = ("Objects", "Event", "Standard_1", "Standard_2")


def votes(*rows):
    return [dict(zip(FIELDS, (c == "Y" for c in row), strict=True)) for row in rows]


def decided(*rows):
    return ballot.decide(votes(*rows), FIELDS, "039")


def test_wilson_is_the_textbooks():
    """Newcombe, Stat. Med. 17 (1998), table I, method 3: 81/263, 15/148, 0/20, 1/29."""
    for passed, of, low, high in (
        (81, 263, 0.2553, 0.3662),
        (15, 148, 0.0624, 0.1605),
        (0, 20, 0.0, 0.1611),
        (1, 29, 0.0061, 0.1718),
    ):
        assert intervals.wilson(passed, of) == pytest.approx((low, high), abs=5e-5)
    assert intervals.wilson(29, 29)[1] == 1.0 and intervals.wilson(0, 0) == (0.0, 1.0)
    with pytest.raises(ValueError, match="no share"):
        intervals.wilson(3, 2)


def test_kappa_is_one_when_all_agree_and_zero_by_chance():
    assert intervals.fleiss_kappa([3, 0, 3], 3) == pytest.approx(1)
    assert intervals.fleiss_kappa([2, 1, 1, 0], 2) == pytest.approx(0)
    assert intervals.fleiss_kappa([3, 3], 3) is None and intervals.fleiss_kappa([1], 1) is None
    assert intervals.fleiss_kappa([1, 1], 2) == pytest.approx(-1)


@pytest.mark.parametrize(
    ("rows", "sa", "pc"),
    [(["YYYY"], True, True), (["YNYY"], False, True), (["NYYY"], False, True), (["YYYN"], True, False),
     (["YYYY", "NYYN", "YYYN"], True, False), (["NNNN"], False, False)],
)  # fmt: skip
def test_sa_needs_objects_and_event_and_pc_all_standards_by_the_majority(rows, sa, pc):
    found = decided(*rows)
    assert (found.adheres, found.correct, found.both) == (sa, pc, sa and pc)


@pytest.mark.parametrize("rows", [["YYYY", "YYYN"], []])
def test_a_tie_is_refused_by_its_type_with_the_way_on(rows):
    with pytest.raises(TieError, match="tied") as told:
        decided(*rows)
    assert told.value.code == "tie" and "--votes" in told.value.next_move


def test_a_scenario_without_a_film_stays_in_the_denominator():
    asked = {"1": "a", "2": "a", "3": "b"}
    found = tally.tally(asked, {"1": decided("YYYY"), "3": decided("YYYN")})
    assert [(g.name, g.sa.passed, g.pc.passed, g.both.of) for g in found.groups] == [
        ("a", 1, 1, 2), ("b", 1, 0, 1), ("Overall", 2, 1, 3)]  # fmt: skip
    assert found.without_film == ("2",) and (found.standards.passed, found.standards.of) == (3, 4)


def test_the_agreement_counts_fields_on_which_several_voted():
    found = tally.agreement([decided("YYYY", "YYYN", "YYYY"), decided("YYYY")])
    assert (found.questions, found.unanimous) == (4, 3) and found.kappa is not None
    assert tally.agreement([decided("YYYY")]).text() == "one vote each"


def test_every_published_percent_comes_back_out_of_a_whole_number():
    rows = list(csv.DictReader(files("worldwright.judge").joinpath(anchor_rows.FILE).read_text().splitlines()))
    groups = [*anchor_rows.systems(), *anchor_rows.categories()]
    for row, group in zip(rows, groups, strict=True):
        for name, share in (("sa", group.sa), ("pc", group.pc), ("both", group.both)):
            assert 100 * share.value == pytest.approx(float(row[name]), abs=0.051), row
    with pytest.raises(ValueError, match="no whole number"):
        anchor_rows.count(93.9, 80)


def test_the_anchors_are_the_papers():
    """What its text says beside the tables: 29.0 % mean of the ten, 52.5 % the strongest; categories add up to its overall row."""
    reference, *models = anchor_rows.systems()
    assert len(models) == 10 and max(m.both.value for m in models) == 0.525
    assert 100 * sum(m.both.value for m in models) / 10 == pytest.approx(29.0, abs=0.05)
    for metric in ("sa", "pc", "both"):
        assert sum(getattr(c, metric).passed for c in anchor_rows.categories()) == getattr(reference, metric).passed
    assert [c.name for c in anchor_rows.categories()] == list(dict.fromkeys(p.category for p in eighty.prompts()))


def test_the_table_stands_without_a_row_of_ones_own(tmp_path):
    report = scored_report.Report()
    paths = scored_report.write(report, tmp_path)
    assert [path.name for path in paths] == list(scored_report.NAMES) and report.ok
    markdown, table, page = (path.read_text() for path in paths)
    assert len(re.findall(r"^\| .* \| published \|$", markdown, re.MULTILINE)) == 11
    assert "82.5 % [72.7, 89.3]" in markdown and "Gemini 2.5 Pro" in markdown
    rows = list(csv.DictReader(table.splitlines()))
    assert len(rows) == 3 * 19 and {row["source"] for row in rows} == {"published"}
    assert page.count("<tr>") == 2 + 11 + 8 and "<h1>Scores</h1>" in page


def test_a_name_or_a_refusal_loads_nothing_from_anywhere():
    bad = '![p](http://a.example/p.png) <http://b.example> [l](http://c.example) <img src="http://d.example">'
    protocol = Protocol(judge="gemini", model=bad, address="a", form="frames", frames=3, words_sha256="0" * 64)
    own = scored_report.Own(name=bad, protocol=protocol, undecided={"039": bad}, models=(bad,))
    report = scored_report.Report(own=(own,))
    page, text = scored_report.html(report), scored_report.markdown(report)
    assert "c.example" in page and "<img" not in page and "<a " not in page
    assert "](" not in text and "<http" not in text and "<img" not in text


def test_a_run_whose_audit_failed_is_no_run_that_was_not_accepted():
    protocol = Protocol(judge="gemini", model="m", address="a", form="frames", frames=3, words_sha256="0" * 64)
    own = scored_report.Own(name="mine", protocol=protocol, tally=tally.tally({"1": "a"}, {"1": decided("YYYY")}))
    told = {"1": "expect.json is not the one that was stamped"}
    for one, said in (
        (own, "no film of a run"),
        (own.model_copy(update={"not_audited": told}), "1 runs not audited"),
        (
            own.model_copy(update={"not_audited": told, "staging": Staging(counts={"emerged": 2})}),
            "of 2: 2 emerged; 1 runs not audited",
        ),
    ):
        row = next(x for x in scored_report.markdown(scored_report.Report(own=(one,))).splitlines() if "| mine |" in x)
        assert f"| {said} |" in row
