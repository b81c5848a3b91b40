"""An entry that raises is named by a finding, and the others still run: on every shelf, and for a plug-in."""

import textwrap
from importlib.metadata import EntryPoint
from pathlib import Path

import numpy as np
import pytest

from worldwright import shelf as shelves
from worldwright.lint import engine as lint
from worldwright.lint import source
from worldwright.model.recording.trajectory import Trajectory
from worldwright.place import engine as place
from worldwright.place.vocabulary import PREDICATES
from worldwright.scan.anomalies import engine as scan
from worldwright.scan.objectives.claims import EXPECTATIONS
from worldwright.scan.objectives.expecting import measure

OURS = "import mujoco\nfrom worldkit import program\nspec = mujoco.MjSpec()\nspec.add_body()\n"
"""A program with a defect that one rule tells: `MjSpec` has no `add_body`."""


def breaks(*_: object, **__: object) -> None:
    raise ZeroDivisionError("on purpose")


@pytest.fixture
def plug_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """Install a module as a third party's entry of a shelf, and have the shelf read anew."""

    def install(shelf: shelves.Shelf, name: str, text: str) -> None:
        (tmp_path / f"{name}.py").write_text(textwrap.dedent(text), encoding="utf-8")
        monkeypatch.syspath_prepend(str(tmp_path))
        point = EntryPoint(name, name, shelf.package)
        monkeypatch.setattr(shelves, "entry_points", lambda group: [point] if group == shelf.package else [])
        monkeypatch.setattr(shelf, "unusable", {})
        whole = shelves.Shelf(shelf.package, shelf.protocol).entries
        monkeypatch.setitem(shelf.__dict__, "entries", whole)

    return install


def falling() -> Trajectory:
    t = np.arange(0, 1, 0.01)
    pos = np.zeros((len(t), 1, 3))
    pos[:, 0, 2] = 10 - 4.905 * t**2
    vel = np.zeros_like(pos)
    vel[:, 0, 2] = -9.81 * t
    return Trajectory.from_arrays(t, ("ball",), pos, linvel=vel)


def test_a_lint_rule_that_raises_is_a_finding_as_grave_as_what_it_looks_for(plug_in, monkeypatch):
    plug_in(
        lint.PROGRAM_RULES,
        "their_rule",
        '''
        """Theirs."""
        from worldwright.lint.harm import Argued
        CODE, SEVERITY, SCOPE = "WL900", "error", "any"
        GOOD = BAD = ()
        EVIDENCE = Argued("none")
        def check(program):
            yield from [1 / 0]
        ''',
    )
    lint.program_rules.cache_clear()
    monkeypatch.setattr(lint, "program_rules", lambda: tuple(lint.PROGRAM_RULES.values()))
    found = lint.check_source(source.parse(OURS))
    (told,) = [f for f in found if f.code == "WL900"]
    assert told.severity == "error"
    assert "their_rule (WL900) itself failed (ZeroDivisionError" in told.message
    assert any(f.code.startswith("WL1") for f in found), "the other rules were not asked"


def test_an_anomaly_check_that_raises_is_a_finding_and_no_clean_motion(plug_in):
    plug_in(
        scan.CHECKS,
        "their_check",
        '''
        """Theirs."""
        CODE, NEEDS, GOOD, BAD = "WS900", (), (), ()
        def check(trajectory, context):
            raise ZeroDivisionError("on purpose")
        ''',
    )
    report = scan.scan(falling())
    assert {run.code: run.status for run in report.checks}["WS900"] == "skipped"
    assert any(a.code == "WS900" and "their_check (WS900) itself failed" in a.message for a in report.anomalies)
    assert len(report.checks) == len(scan.CHECKS) > 40


def test_an_expectation_that_raises_proves_nothing(plug_in):
    plug_in(
        EXPECTATIONS,
        "their_claim",
        '''
        """Theirs."""
        from pydantic import BaseModel
        class Given(BaseModel):
            body: str
        CODE, GOOD, BAD = "WE900", (), ()
        def measure(trajectory, given):
            raise ZeroDivisionError("on purpose")
        ''',
    )
    told = measure(falling(), "their_claim", {"body": "ball"})
    assert (told.status, "their_claim (WE900) itself failed" in told.message) == ("unknown", True)
    assert measure(falling(), "falls", {"body": "ball", "min_m": 1.0}).status == "holds"


@pytest.mark.parametrize("verb", ["pins", "resolve", "holds"])
def test_a_predicate_that_raises_fails_its_own_row_only(small_plan: str, verb: str, monkeypatch):
    from worldwright.model.plan.plan_text import parse_plan

    plan = parse_plan(small_plan).plan
    rows = plan.topology.scene_predicates
    code = rows[0].predicate
    whole = place.resolve(plan)
    assert not whole.scene.findings
    monkeypatch.setattr(PREDICATES[code].module, verb, breaks)
    spoiled = place.resolve(plan)
    told = [f for f in spoiled.scene.findings if "itself failed (ZeroDivisionError: on purpose)" in f.message]
    assert told
    assert {code in f.message for f in told} == {True}
