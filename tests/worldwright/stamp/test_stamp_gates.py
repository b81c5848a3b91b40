"""Gates and tools on a run that really went through its passes."""

import ast
import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.draft.assembly import draft
from worldwright.lint import tools as lint
from worldwright.model.errors import GateError, NotFoundError, PlanError
from worldwright.model.evidence.reports import ExpectReport, VisualDescription
from worldwright.model.evidence.run import Run
from worldwright.model.evidence.verdict import CrossCheck, ObjectiveVerdict, Verdict
from worldwright.model.plan.layout import Scene
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.tools import resolve
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement, gates
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State
from worldwright.stamp.statement import Approval

Copy = Callable[[Path], Path]


def verdict(**changes: object) -> Verdict:
    """A passing verdict on the tiny world."""
    fields: dict = {
        "reviewer": "tester",
        "outcome": "pass",
        "numeric": "falls holds",
        "visual": "a red ball",
        "plan": "both met",
        "objectives": (
            ObjectiveVerdict(index=0, met=True, evidence=("expect:falls", "scan:clean")),
            ObjectiveVerdict(index=1, met=True, evidence=("still:overview", "visual:ball", "physics:rows")),
        ),
    }
    return Verdict(**{**fields, **changes})


def evidence(folder: Path) -> Path:
    return Run(folder).evidence(stamp.status(str(folder)).key)


def named_in_the_code() -> set[str]:
    """The gates that some line of the suite asks, by the name it writes."""
    found = set()
    for path in Path(gates.__file__).parents[2].rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            asks = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
            if asks and node.func.attr in ("pass_through", "refusals") and node.args:
                found.add(getattr(node.args[0], "value", None))
    return found


def test_no_gate_stands_where_nobody_passes() -> None:
    assert {entry.name for entry in gates.shelf().values()} == named_in_the_code() - {None}


SHUT = {
    "approve": "no time_step",
    "auto_approve": "nobody marked",
    "describe": "nothing ran",
    "review": "nothing ran",
    "repair": "the cap",
    "accept": "nothing ran",
    "block": "accepted",
}
"""Why each gate is shut for a run that lacks what it asks for; the runs are made below."""


@pytest.mark.parametrize("gate", SHUT)
def test_a_gate_refuses_one_run_and_opens_for_another(
    gate: str, planned: Path, reviewed: Path, accepted: Path, copy: Copy
) -> None:
    opens = {"approve": planned, "auto_approve": planned, "block": planned, "repair": planned}.get(gate, reviewed)
    folder = copy(accepted if gate == "block" else planned)
    plan = folder / "plan.md"
    if gate == "approve":
        plan.write_text(plan.read_text("utf-8").replace("time_step: 0.002", "time_step: TO_CLARIFY"), "utf-8")
    if gate == "auto_approve":
        plan.write_text(plan.read_text("utf-8").replace(", masses.ball]", "]"), "utf-8")
    if gate == "repair":
        for number in range(12):
            Run(folder).log("tester", "review", key=f"key{number}", outcome="repair")
    shut = gates.refusals(gate, State.find(str(folder)))
    assert shut
    assert all(refusal.cause and refusal.next_move for refusal in shut)
    assert gates.refusals(gate, State.find(str(opens))) == []


def test_every_gate_is_tried_and_says_why() -> None:
    assert set(SHUT) == {entry.name for entry in gates.shelf().values()}
    for entry in gates.shelf().values():
        assert "Why:" in entry.doc, f"{entry.name} does not say why"


def test_a_gate_that_fails_itself_stays_shut(planned: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def breaks(state: State) -> None:
        raise RuntimeError("hinge")

    monkeypatch.setattr(gates.shelf()["WG010"].module, "check", breaks)
    (refusal,) = gates.refusals("approve", State.find(str(planned)))
    assert "approve (WG010) itself failed (RuntimeError: hinge)" in refusal.cause


def test_a_planned_run_is_open_and_names_the_next_command(planned: Path) -> None:
    status = stamp.status(str(planned))
    assert (status.state, status.ok) == ("open", False)
    assert [s.name for s in status.steps if s.status == "holds"] == ["check", "place", "draft"]
    assert status.next_move == f"worldwright stamp approve {planned}"
    assert "✓ check" in status.text()


def test_nothing_can_be_skipped(planned: Path, copy: Copy) -> None:
    folder = copy(planned)
    for call in (
        lambda: stamp.describe(str(folder), VisualDescription(author="me", summary="nothing")),
        lambda: stamp.review(str(folder), verdict()),
        lambda: stamp.accept(str(folder)),
    ):
        with pytest.raises(GateError) as caught:
            call()
        assert caught.value.next_move
    assert not (folder / "accepted").exists()
    assert not (folder / "evidence").exists()


def test_approval_needs_a_finished_plan(planned: Path, copy: Copy) -> None:
    folder = copy(planned)
    plan = folder / "plan.md"
    whole = plan.read_text(encoding="utf-8")
    plan.write_text(whole.replace("time_step: 0.002", "time_step: TO_CLARIFY"), encoding="utf-8")
    with pytest.raises(GateError, match="time_step"):
        stamp.approve(str(folder))
    plan.write_text(whole.replace("## topology", "## topologie"), encoding="utf-8")
    with pytest.raises(GateError, match=r"plan\.md"):
        stamp.approve(str(folder))
    plan.write_text(whole, encoding="utf-8")
    assert stamp.approve(str(folder)).run == folder.name
    assert [e["by"] for e in Run(folder).entries() if e["action"] == "approve"] == ["user"]


@pytest.mark.parametrize("section", ["layout_density", "assets", "plan_type"])
def test_a_question_in_prose_blocks_approval_and_code(section: str, planned: Path, copy: Copy) -> None:
    folder = copy(planned)
    plan = folder / "plan.md"
    whole = plan.read_text(encoding="utf-8")
    head = f"## {section}\n"
    asked = "TO_CLARIFY how many blocks."
    # the sentence under the title stands before the first section
    marked = f"{asked}\n\n{head}" if section == "plan_type" else f"{head}\n{asked}\n"
    plan.write_text(whole.replace(head, marked), encoding="utf-8")
    (found,) = [f for f in lint.check_plan(plan).findings if f.code == "WP101"]
    assert found.severity == "error" and plan.read_text(encoding="utf-8").splitlines()[found.line - 1] == asked
    with pytest.raises(GateError, match="TO_CLARIFY how many"):
        stamp.approve(str(folder))
    document = read_plan(plan)
    with pytest.raises(PlanError, match="TO_CLARIFY how many"):
        draft(document.plan, Scene(objects=resolve(plan, write=False).objects))


def test_auto_approval_needs_every_chosen_value_marked(planned: Path, copy: Copy) -> None:
    folder = copy(planned)
    plan = folder / "plan.md"
    whole = plan.read_text(encoding="utf-8")
    plan.write_text(whole.replace(", masses.ball]", "]"), encoding="utf-8")
    with pytest.raises(GateError, match=r"masses\.ball was chosen"):
        stamp.approve(str(folder), auto=True)
    plan.write_text(whole.replace("masses.ball]", "masses.cube]"), encoding="utf-8")
    with pytest.raises(GateError, match=r"WP124 `masses\.cube` leads to nothing"):
        stamp.approve(str(folder), auto=True)
    (folder / "prompt.md").write_text("Drop a ball of 0.2 kg.", encoding="utf-8")
    plan.write_text(whole.replace(", masses.ball]", "]"), encoding="utf-8")
    assert "approved by nobody: auto mode" in stamp.approve(str(folder), auto=True, by="user").what
    (line,) = [e for e in Run(folder).entries() if e["action"] == "approve"]
    assert (line["actor"], line["by"], line["auto"]) == ("nobody: auto mode", "nobody: auto mode", True)
    assert "by nobody: auto mode (automation), " in stamp.status(str(folder)).text()


def test_an_older_approval_in_auto_mode_is_nobody_s_too(planned: Path, copy: Copy) -> None:
    """Older lines and stamps name a user there, who never read the plan."""
    folder = copy(planned)
    run = Run(folder)
    run.log("user", "approve", by="user", auto=True, repairs=12)
    assert "by nobody: auto mode, " in stamp.status(str(folder)).text()
    assert Approval(by="user", time="then", auto=True).told == "by nobody: auto mode"
    assert Approval(by="user", time="then").told == "in the name of user"


def test_a_reviewed_run_holds_every_step_but_the_last(reviewed: Path) -> None:
    status = stamp.status(str(reviewed))
    assert {s.name: s.status for s in status.steps if not s.holds} == {"accept": "missing"}
    assert status.next_move == f"worldwright stamp accept {reviewed}"


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"objectives": verdict().objectives[:1]}, "objective 1 has no verdict"),
        ({"objectives": (*verdict().objectives, verdict().objectives[0])}, "objective 0 is judged twice"),
        (
            {"objectives": (*verdict().objectives, ObjectiveVerdict(index=7, met=True, evidence=("scan:clean",)))},
            "objective 7 is not in the plan",
        ),
        (
            {"objectives": (verdict().objectives[0], ObjectiveVerdict(index=1, met=True, evidence=("still:moon",)))},
            "'still:moon', which does not exist",
        ),
        (
            {"objectives": (verdict().objectives[0], ObjectiveVerdict(index=1, met=True, evidence=("I saw it",)))},
            "'I saw it', which does not exist",
        ),
        ({"outcome": "repair", "repair_target": "scale", "repair": "halve it"}, "rests on one channel alone"),
        (
            {"objectives": (ObjectiveVerdict(index=0, met=True, evidence=("scan:clean",)), verdict().objectives[1])},
            "scan:clean would be there without it too",
        ),
        (
            {"objectives": (verdict().objectives[0], ObjectiveVerdict(index=1, met=True, evidence=("physics:rows",)))},
            "physics:rows would be there without it too",
        ),
        (
            {"cross_checks": (CrossCheck(claim="it falls", channel="numeric", tested_in="numeric", confirmed=True),)},
            "tests the numeric channel in itself",
        ),
    ],
)
def test_a_verdict_is_bound_to_evidence_that_exists(reviewed: Path, copy: Copy, changes: dict, says: str) -> None:
    folder = copy(reviewed)
    before = (evidence(folder) / "review.json").read_bytes()
    with pytest.raises(GateError, match=says):
        stamp.review(str(folder), verdict(**changes))
    assert (evidence(folder) / "review.json").read_bytes() == before


def test_a_verdict_that_stands_is_kept_and_journaled(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    stamp.review(str(folder), verdict())
    assert json.loads((evidence(folder) / "review.json").read_text())["reviewer"] == "tester"
    repair = verdict(
        outcome="repair",
        repair_target="camera_placement",
        repair="move the side camera back",
        cross_checks=(CrossCheck(claim="cut", channel="visual", tested_in="numeric", confirmed=True),),
    )
    stamp.review(str(folder), repair)
    assert next(s for s in stamp.status(str(folder)).steps if s.name == "review").status == "fails"
    with pytest.raises(GateError, match="camera_placement"):
        stamp.accept(str(folder))
    assert [e["outcome"] for e in Run(folder).entries() if e["action"] == "review"] == ["pass", "pass", "repair"]


def test_a_refuted_objective_cannot_be_passed(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    path = evidence(folder) / "expect.json"
    report = ExpectReport.model_validate_json(path.read_bytes()).model_dump(mode="json")
    report["objectives"][0]["status"] = "refuted"
    path.write_text(json.dumps(report), encoding="utf-8")
    with pytest.raises(GateError, match="objective 0 is called met, but measurement says refuted"):
        stamp.review(str(folder), verdict())
    measured_verdict = by_measurement.review(Run(folder))
    assert (measured_verdict.outcome, measured_verdict.objectives[0].met) == ("repair", False)
    with pytest.raises(GateError, match="expect"):
        stamp.accept(str(folder))


def test_the_measured_review_says_that_nobody_looked(reviewed: Path) -> None:
    described = by_measurement.describe(Run(reviewed))
    assert described.author == "measured"
    assert "Nobody judged" in described.summary
    assert set(described.cameras) == {"overview", "side"}
    assert "%" in described.objects["ball"]
    verdict = by_measurement.review(Run(reviewed))
    assert verdict.outcome == "pass"
    assert "not judged" in verdict.objectives[1].note


def seen(summary: str, **changed: dict[str, str]) -> VisualDescription:
    """A description by somebody who looked."""
    named = {"cameras": {"overview": "a ball above a floor", "side": "the same"}, "objects": {"ball": "red"}}
    return VisualDescription.model_validate({"author": "me", "summary": summary, **named, **changed})


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"cameras": {"overview": "a ball"}}, "nothing is observed of camera `side`"),
        ({"cameras": {"overview": "a ball", "side": "  "}}, "nothing is observed of camera `side`"),
        ({"cameras": {"overview": "a ball", "side": "it", "above": "a ball"}}, "no picture is of a camera `above`"),
        ({"objects": {}}, "no object is described"),
        ({"objects": {"ball": "red", "unicorn": "white"}}, "there is no object `unicorn`"),
        ({"objects": {"ball": ""}}, "nothing is observed of object `ball`"),
    ],
)
def test_a_description_names_what_exists_and_says_something_of_it(
    reviewed: Path, changed: dict[str, dict[str, str]], said: str
) -> None:
    with pytest.raises(GateError) as caught:
        stamp.describe(str(reviewed), seen("a ball", **changed))
    assert said in caught.value.cause
    assert caught.value.next_move


def test_everything_that_a_description_lacks_is_named_at_once(reviewed: Path) -> None:
    with pytest.raises(GateError) as caught:
        stamp.describe(str(reviewed), VisualDescription(author="me", summary="a ball"))
    for part in ("camera `overview`", "camera `side`", "no object is described"):
        assert part in caught.value.cause
    assert "ball" in caught.value.next_move


def test_a_witness_is_told_nothing_of_what_the_numbers_say(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    first = stamp.describe(str(folder), seen("a ball"))
    second = stamp.describe(str(folder), seen("a red ball"))
    assert first.next_move == second.next_move == ""
    assert "in place of an earlier description" in second.what


def test_an_object_in_no_picture_is_a_concern_and_fails_its_objective(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    path = evidence(folder) / "stills" / "visibility.json"
    seen = json.loads(path.read_text())
    for shown in seen.values():
        del shown["ball"]
    path.write_text(json.dumps(seen), encoding="utf-8")
    described = by_measurement.describe(Run(folder))
    assert "ball is in no picture" in described.concerns
    stamp.describe(str(folder), described)
    verdict = by_measurement.review(Run(folder))
    assert (verdict.outcome, verdict.repair_target) == ("repair", "camera_placement")


def test_a_black_still_is_a_concern(reviewed: Path, copy: Copy) -> None:
    import cv2
    import numpy as np

    folder = copy(reviewed)
    cv2.imwrite(str(evidence(folder) / "stills" / "side.png"), np.zeros((96, 160, 3), np.uint8))
    described = by_measurement.describe(Run(folder))
    assert any("side: the picture is black" in concern for concern in described.concerns)
    stamp.describe(str(folder), described)
    assert by_measurement.review(Run(folder)).outcome == "repair"


def test_block_ends_a_run_until_it_changes(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    stamp.block(str(folder), cause="the floor cannot be lava")
    status = stamp.status(str(folder))
    assert (status.state, status.cause) == ("blocked", "the floor cannot be lava")
    with pytest.raises(GateError, match="blocked"):
        stamp.accept(str(folder))
    with (folder / "simulation.py").open("a", encoding="utf-8") as program:
        program.write("# another try\n")
    status = stamp.status(str(folder))
    assert status.state == "open"
    assert any("earlier program" in note for note in status.notes)


def test_evidence_of_an_older_program_does_not_count(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    with (folder / "simulation.py").open("a", encoding="utf-8") as program:
        program.write("# patched\n")
    steps = {s.name: s for s in stamp.status(str(folder)).steps}
    for name in ("lint", "physics", "stills", "video", "scan", "expect", "describe", "review"):
        assert steps[name].status == "missing"
        assert "earlier" in steps[name].detail
    assert steps["approve"].holds


def test_an_unknown_run_lists_the_known_ones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, planned: Path) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copytree(planned, tmp_path / "runs" / "drop")
    with pytest.raises(NotFoundError, match="no run") as caught:
        stamp.status("drip")
    assert "runs/drop" in caught.value.next_move
    assert stamp.status("drop").next_move == "worldwright stamp approve runs/drop"


def test_repairs_are_capped_and_symbols_are_looked_up_first(planned: Path, copy: Copy) -> None:
    from worldwright.lint import tools as lint

    folder = copy(planned)
    program = folder / "simulation.py"
    whole = program.read_text(encoding="utf-8")
    program.write_text(
        whole.replace("    return spec", "    mujoco.mj_flyToTheMoon(spec)\n    return spec"), encoding="utf-8"
    )
    lint.check_program([program])
    run = Run(folder)

    def notes() -> str:
        return " ".join(note for note in stamp.status(str(folder)).notes if note.startswith("repair:"))

    assert "mj_flyToTheMoon" in notes()
    stamp.approve(str(folder), by="tester")
    program.write_text(whole, encoding="utf-8")  # patched from memory
    lint.check_program([program])
    with pytest.raises(GateError, match="nothing was looked up since"):
        stage.start(str(folder))
    program.write_text(
        whole.replace("    return spec", "    mujoco.mj_flyToTheMoon(spec)\n    return spec"), encoding="utf-8"
    )
    run.log("retrieve", "cite", source="APIreference")
    assert notes() == ""
    for i in range(12):
        run.log("tester", "review", key=f"key{i}", outcome="repair")
    assert "12 repairs were ordered already" in notes()
