"""One `/generate`, scripted end to end against the real servers: every step by the role it belongs to, through the guard.

A lint failure and its repair, a review that refuses once, a targeted patch, acceptance, and the stamp verifies.
"""

import json
import shutil
from pathlib import Path

import pytest

from worldwright import expose
from worldwright.contract import guard, harnesses
from worldwright.contract.roles import BY_AGENT, MAIN_TOOLS
from worldwright.model.errors import GateError

NAMES = harnesses.find("claude_code").TOOLS


class Harness:
    """What a coding harness does for its agents: files through the guard, tools by their names."""

    def __init__(self, project: Path) -> None:
        self.project, self.used = project, []

    def write(self, agent: str, path: str, text: str) -> None:
        guard.judge({"tool_name": "Write", "tool_input": {"file_path": path}, "agent_type": agent}, self.project, NAMES)
        target = self.project / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, encoding="utf-8")

    def call(self, agent: str, tool: str, **given):
        server, name = tool.split(".")
        guard.judge(
            {"tool_name": f"mcp__{server}__{name}", "tool_input": given, "agent_type": agent}, self.project, NAMES
        )
        assert tool in (BY_AGENT[agent].tools if agent else MAIN_TOOLS)
        self.used.append((agent or "main", tool))
        function = next(f for f in expose.tools(server) if f.__name__ == name)
        return function(**given)

    def run_pass(self, agent: str, run: str, stage: str):
        job = self.call(agent, "stage.start", run=run, stage=stage)
        while job.state in ("queued", "running"):
            job = self.call(agent, "stage.wait", run=run, job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()


def verdict(outcome, objectives, **more):
    from worldwright.model.evidence.verdict import CrossCheck, ObjectiveVerdict, Recognition, Verdict

    return Verdict(
        reviewer="world-review",
        outcome=outcome,
        numeric="the scan is clean and the ball falls",
        visual="a red ball above a floor",
        plan="both objectives are bound to evidence",
        objectives=tuple(
            ObjectiveVerdict(index=i, met=met, evidence=evidence) for i, (met, evidence) in enumerate(objectives)
        ),
        recognised=(
            Recognition(wanted="ball", seen_as="a red ball", same=True),
            Recognition(wanted="event", seen_as="it falls", same=True),
        ),
        cross_checks=(CrossCheck(claim="the ball moves", channel="visual", tested_in="numeric", confirmed=True),),
        **more,
    )


def sight(*more):
    """What is seen of the falling ball, through some cameras more."""
    from worldwright.model.evidence.reports import Sighting, VisualDescription

    return VisualDescription(
        author="world-visual",
        summary="a red ball falls onto a floor",
        cameras={"overview": "a red ball in the air", "side": "the same from the side"}
        | dict.fromkeys(more, "a red ball falls"),
        objects={"ball": "red, in the air"},
        named=(Sighting(seen="a red ball", camera="overview"),),
        event="it falls",
        belief=8,
        betrays=("an empty floor", "a flat sky", "no dust"),
    )


def test_an_accepted_world_is_changed_by_its_plan(accepted, tmp_path, monkeypatch):
    """A higher drop; the old bundle stays until the new one replaces it."""
    monkeypatch.chdir(tmp_path)
    run, plan = "runs/dropped-ball", Path("runs/dropped-ball/plan.md")
    shutil.copytree(accepted, tmp_path / run)
    harness = Harness(tmp_path)
    stamp = harness.project / run / "accepted/stamp.json"
    before, program = stamp.read_bytes(), (harness.project / run / "simulation.py").read_text()
    text = (harness.project / plan).read_text()
    harness.write("world-plan", str(plan), text.replace("bottom: 0.45", "bottom: 0.6"))
    assert harness.call("world-plan", "place.resolve", plan=plan).ok
    assert harness.call("world-plan", "lint.check_plan", plan=plan).ok
    assert harness.call("", "stamp.status", run=run).state != "accepted" and stamp.read_bytes() == before
    harness.call("", "stamp.approve", run=run, by="user")
    drafted = harness.call("world-code", "stage.draft", run=run)
    assert drafted.outcome != "written"  # its author's patch is not thrown away
    patched = program.replace("0.5]", "0.65]") if "0.5]" in program else program.replace("0.5)", "0.65)")
    assert patched != program
    harness.write("world-code", f"{run}/simulation.py", patched)
    assert harness.call("world-code", "lint.check_program", files=[Path(run) / "simulation.py"], plan=plan).ok
    harness.run_pass("world-code", run, "physics")
    for stage in ("stills", "video"):
        harness.run_pass("", run, stage)
    harness.call("world-visual", "stamp.describe", run=run, description=sight())
    harness.call("world-review", "scan.scan", run=run)
    harness.call("world-review", "scan.expect", run=run)
    objectives = [(True, ("expect:falls",)), (True, ("visual:overview",))]
    harness.call("world-review", "stamp.review", run=run, verdict=verdict("pass", objectives))
    while not getattr(harness.call("", "stamp.accept", run=run), "ok", True):
        pass
    assert stamp.read_bytes() != before and harness.call("", "stamp.status", run=run).state == "accepted"


def test_a_world_is_generated_by_its_four_roles(tmp_path, monkeypatch, small_plan):
    monkeypatch.chdir(tmp_path)
    harness = Harness(tmp_path)
    run, plan = "runs/dropped-ball", Path("runs/dropped-ball/plan.md")

    # plan
    harness.write("world-plan", f"{run}/prompt.md", "Drop a ball.\n")
    harness.write("world-plan", f"{run}/plan.md", small_plan)
    assert harness.call("world-plan", "place.resolve", plan=plan).ok
    assert harness.call("world-plan", "lint.check_plan", plan=plan).ok
    assert harness.call("world-plan", "place.check", plan=plan).ok

    # no code before approval
    with pytest.raises(GateError, match="not approved"):
        harness.call("world-code", "stage.draft", run=run)
    harness.call("", "stamp.approve", run=run, by="user")

    # code: a name the simulator does not know, found by lint, looked up, repaired
    assert harness.call("world-code", "stage.draft", run=run).outcome == "written"
    assert (tmp_path / run / "film.py").is_file()  # the first film, filmed below as it was drafted
    drafted = (tmp_path / run / "simulation.py").read_text()
    harness.write(
        "world-code", f"{run}/simulation.py", drafted.replace("def build(", "mujoco.mj_rayTrace\n\n\ndef build(", 1)
    )
    report = harness.call("world-code", "lint.check_program", files=[Path(run) / "simulation.py"], plan=plan)
    assert not report.ok and any(f.code == "WL101" for f in report.findings)
    with pytest.raises(GateError):
        harness.call("world-code", "stage.start", run=run, stage="physics")
    assert not harness.call("world-code", "retrieve.symbol", name="mujoco.mj_rayTrace", run=run).exists
    harness.write("world-code", f"{run}/simulation.py", drafted)
    assert harness.call("world-code", "lint.check_program", files=[Path(run) / "simulation.py"], plan=plan).ok
    harness.run_pass("world-code", run, "physics")

    # look, describe, review: refused once
    for stage in ("stills", "video"):
        harness.run_pass("", run, stage)
    frames = harness.call("world-visual", "stage.frames", run=run)
    assert frames.pictures
    seen = sight("film")
    harness.call("world-visual", "stamp.describe", run=run, description=seen)
    assert harness.call("world-review", "scan.scan", run=run).ok
    assert harness.call("world-review", "scan.expect", run=run).ok
    objectives = [(True, ("expect:falls",)), (False, ("visual:overview",))]
    harness.call(
        "world-review", "stamp.review", run=run,
        verdict=verdict("repair", objectives, repair_target="visual_mismatch", repair="make the ball a deeper red"),
    )  # fmt: skip

    # one targeted patch, and around again
    assert "#b3261e" in drafted
    harness.write("world-code", f"{run}/simulation.py", drafted.replace("#b3261e", "#8c1d18"))
    assert harness.call("world-code", "lint.check_program", files=[Path(run) / "simulation.py"], plan=plan).ok
    harness.run_pass("world-code", run, "physics")
    for stage in ("stills", "video"):
        harness.run_pass("", run, stage)
    harness.call("world-visual", "stamp.describe", run=run, description=seen)
    harness.call("world-review", "scan.scan", run=run)
    harness.call("world-review", "scan.expect", run=run)
    objectives = [(True, ("expect:falls",)), (True, ("visual:overview",))]
    harness.call("world-review", "stamp.review", run=run, verdict=verdict("pass", objectives))

    # accept, and prove it again
    accepted = harness.call("", "stamp.accept", run=run)
    while not getattr(accepted, "ok", True):
        accepted = harness.call("", "stamp.accept", run=run)
    assert (tmp_path / run / "accepted" / "stamp.json").is_file()
    assert harness.call("", "stamp.status", run=run).state == "accepted"
    assert harness.call("", "stamp.verify", run=run).ok

    # every role did its part, and the journal says which
    assert {agent for agent, _ in harness.used} == {"main", *BY_AGENT}
    actions = [json.loads(line)["action"] for line in (tmp_path / run / "journal.jsonl").read_text().splitlines()]
    assert actions.count("review") == 2 and "cite" in actions and actions.count("accept") == 1

    from worldwright.contract.lessons import collect
    from worldwright.model.evidence.run import Run

    told = collect(Run.find(run))
    assert [what for what, _, _ in told] == ["the program did not lint clean", "a review ordered a repair"]
    assert all(owner for _, _, owner in told)
