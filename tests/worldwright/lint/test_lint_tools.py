"""The four tools, as agents, the command line and the run folder see them."""

import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import cli, expose
from worldwright.lint import engine, source, tools
from worldwright.model.errors import NotFoundError

EXAMPLES = Path(__file__).parents[3] / "examples"

FAULTY = """\
import mujoco
from worldkit import program


def build():
    spec = mujoco.MjSpec()
    spec.worldbody.add_body(position=(0, 0, 1))
    return spec


program.main(build, duration=1.0)
"""


def invoke(*arguments):
    return CliRunner().invoke(cli.main, ["lint", *arguments], catch_exceptions=False)


def test_json_has_the_promised_shape_and_exit_code(tmp_path):
    one, two = tmp_path / "a.py", tmp_path / "b.py"
    one.write_text(FAULTY)
    two.write_text("x = 1\n")
    result = invoke("check-program", str(one), str(two), "--format", "json")
    assert result.exit_code == 1
    report = json.loads(result.stdout)
    finding = next(f for f in report["findings"] if f["code"] == "WL102")
    assert finding["severity"] == "error" and finding["line"] == 7 and finding["file"] == str(one)
    assert "position" in finding["message"] and "pos" in finding["fix"]
    assert invoke("check-program", str(two)).exit_code == 0


def test_text_shows_the_line_and_a_caret(tmp_path):
    path = tmp_path / "a.py"
    path.write_text(FAULTY)
    shown = invoke("check-program", str(path)).stdout
    assert ">    7 |     spec.worldbody.add_body(position=(0, 0, 1))" in shown
    excerpt = shown.splitlines()
    line = next(i for i, text in enumerate(excerpt) if text.startswith("  >    7"))
    assert excerpt[line + 1].index("^") == excerpt[line].index("(0, 0, 1)")


def test_a_bare_model_file_is_linted(tmp_path):
    path = tmp_path / "model.xml"
    path.write_text("<mujoco>\n  <worldbody>\n    <composite/>\n  </worldbody>\n</mujoco>\n")
    report = tools.check_program([path])
    assert [(f.code, f.line) for f in report.findings] == [("WL103", 3)]
    assert "4.0.0" in report.findings[0].fix


def test_suppressions_need_a_reason_and_stay_visible(tmp_path):
    path = tmp_path / "a.py"
    path.write_text(FAULTY.replace("(0, 0, 1))", "(0, 0, 1))  # worldwright: ignore[WL102] an older build"))
    report = tools.check_program([path])
    assert report.ok
    assert any(f.code == "WL102" and f.severity == "info" and "an older build" in f.message for f in report.findings)
    path.write_text(FAULTY.replace("(0, 0, 1))", "(0, 0, 1))  # worldwright: ignore[WL102]"))
    assert {f.code for f in tools.check_program([path]).findings if f.severity == "error"} >= {"WL102", "WL199"}


def test_a_comment_on_the_line_above_and_inside_a_long_call_counts():
    above = "import mujoco\n# worldwright: ignore[WL101] planned for 4.1\nmujoco.mj_future\n"
    inside = "import mujoco\nmujoco.mj_step(\n    None,  # worldwright: ignore[WL102] x\n    data=1,\n    foo=2,\n)\n"
    assert [f.severity for f in engine.check_source(source.parse(above))] == ["info"]
    assert all(f.severity == "error" for f in engine.check_source(source.parse(inside)))


def test_many_findings_are_capped_and_errors_stay(tmp_path):
    path = tmp_path / "a.py"
    path.write_text("import mujoco\n" + "".join(f"mujoco.mj_no{i}\n" for i in range(500)))
    report = tools.check_program([path])
    assert len(report.findings) <= 82 and not report.ok
    assert len(expose.to_json(report)) < 20_000
    assert any("more of the same" in f.message for f in report.findings)


def test_explain_knows_codes_and_names_and_suggests():
    assert tools.explain("wl130").name == "faked_motion"
    assert tools.explain("faked_motion").code == "WL130"
    assert tools.explain("unplaced_object").code == "WP109"
    assert tools.explain("WP109").bad
    assert "Why is this bad" in tools.explain("WL101").text()
    with pytest.raises(NotFoundError, match="WL1"):
        tools.explain("WL998")
    assert invoke("explain", "nonsense").exit_code == 2


@pytest.mark.parametrize(
    ("code", "says"),
    [
        ("WP302", "two things penetrate"),
        ("wp206", "disagree on an axis"),
        ("WP003", "a section is missing"),
        ("WS115", "falls out of the world"),
        ("WE114", "supported_by"),
    ],
)
def test_explain_answers_for_findings_of_other_servers_with_their_text(code, says):
    text = tools.explain(code).text()
    assert says in text and "retrieve read skills/" in text


def test_list_rules_names_every_rule_once():
    rules = tools.list_rules().rules
    assert len(rules) == len({rule.code for rule in rules}) == len(engine.all_rules())
    assert "WL101" in tools.list_rules().text()


@pytest.mark.parametrize("plan", sorted(EXAMPLES.glob("*/plan.md")), ids=lambda path: path.parent.name)
def test_the_example_plans_are_clean(plan):
    report = tools.check_plan(plan)
    assert report.findings == ()


@pytest.mark.parametrize("program", sorted(EXAMPLES.glob("*/simulation.py")), ids=lambda path: path.parent.name)
def test_the_example_programs_are_clean(program, tmp_path):
    run = tmp_path / program.parent.name
    run.mkdir()
    for name in ("plan.md", "simulation.py"):
        shutil.copy(program.parent / name, run / name)
    report = tools.check_program([run / "simulation.py"])
    assert report.findings == () and "compiled" in report.worlds[0]


def test_a_broken_plan_is_a_report_not_an_error(tmp_path):
    plan = tmp_path / "plan.md"
    plan.write_text("# A plan\n\n## plan_type\nscene\n\n## objectives\n- claim: x\n")
    report = tools.check_plan(plan)
    assert not report.ok and all(f.message for f in report.findings)


def test_plan_findings_have_lines(tmp_path):
    text = (EXAMPLES / "bouncing-basketball" / "plan.md").read_text()
    plan = tmp_path / "plan.md"
    plan.write_text(text.replace("time_step: 0.001 ", "time_step: 0.05 "))
    found = tools.check_plan(plan).findings
    assert found and found[0].code == "WP102"
    lines = plan.read_text().splitlines()
    assert "time_step: 0.05" in lines[found[0].line - 1]
    assert invoke("check-plan", str(plan)).exit_code == 1


def test_a_runs_program_keeps_its_report_as_evidence(tmp_path):
    from worldwright.model.evidence import environment
    from worldwright.model.evidence.reports import LintReport
    from worldwright.model.evidence.run import Run

    run = Run(tmp_path / "a-run")
    run.folder.mkdir()
    shutil.copy(EXAMPLES / "bouncing-basketball" / "plan.md", run.plan)
    run.program.write_text(FAULTY)
    report = tools.check_program([run.program])
    key = run.evidence_key(environment.current().sha256())
    kept = LintReport.model_validate_json((run.evidence(key) / "lint.json").read_text())
    assert not kept.ok and not report.ok and report.kept
    assert {f.code for f in kept.findings} >= {"WL102", "WL120", "WL121", "WL123", "WL124"} - {"WL120"}
    assert all(not Path(f.file).is_absolute() for f in kept.findings)
    assert [(e["action"], e["ok"], e["key"]) for e in run.entries()] == [("lint", False, key.key)]


def test_a_plan_given_from_elsewhere_is_not_evidence(tmp_path):
    program = tmp_path / "other.py"
    program.write_text(FAULTY)
    report = tools.check_program([program], plan=EXAMPLES / "bouncing-basketball" / "plan.md")
    assert not report.kept and not (tmp_path / "evidence").exists()
    assert {"WL121", "WL123"} <= {f.code for f in report.findings}


def test_a_film_that_nothing_was_recorded_for_is_not_called_clean(small_plan, tmp_path):
    (tmp_path / "plan.md").write_text(small_plan)
    (tmp_path / "simulation.py").write_text("from worldkit import program\n")
    (tmp_path / "film.py").write_text(
        "from worldkit.filming import Film, wide\n\n\ndef film(film: Film) -> None:\n    film.shot(wide(), until=1.0)\n"
    )
    report = tools.check_program([tmp_path / "film.py"])
    assert report.findings == ()
    assert f"worldwright go {tmp_path} --until lint" in report.worlds[0]
    assert report.text().endswith("nothing found by reading; NOT TRIED: film.py")
