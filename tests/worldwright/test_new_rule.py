"""A failed iteration becomes the scaffold of a rule: well-formed, silent, and failing its tests until it is written."""

import importlib.util
import json
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import cli, new_rule
from worldwright.lint import engine
from worldwright.model.errors import WorldwrightError
from worldwright.model.evidence.run import Run

PROGRAM = (
    "import mujoco\n\n\ndef build():\n    spec = mujoco.MjSpec()\n    raise ValueError('too stiff')\n    return spec\n"
)


@pytest.fixture
def run(tmp_path):
    run = Run(tmp_path / "a-run")
    run.folder.mkdir()
    run.plan.write_text("# A plan")
    job = run.jobs / "physics-1-0a0b"
    (job / "inputs").mkdir(parents=True)
    (job / "inputs" / "simulation.py").write_text(PROGRAM)
    said = {"ok": False, "code": "crashed", "message": 'ValueError: "too stiff"', "place": "simulation.py:6"}
    (job / "result.json").write_text(json.dumps(said))
    run.log("lint", "lint", key="k", ok=False, findings=1, codes=["WL130"])
    run.log("lint", "lint", key="k", ok=True, findings=0, codes=[])
    run.log("stage", "stage", key="k", stage="physics", ok=False, code="crashed", job="physics-1-0a0b")
    run.log("world-review", "review", key="k", outcome="repair", repair_target="scale")
    return run


@pytest.fixture
def rules(tmp_path):
    folder = tmp_path / "rules"
    for shelf in new_rule.PREFIXES:
        shutil.copytree(new_rule.RULES / shelf, folder / shelf)
    return folder


def test_failures_are_read_from_the_journal(run):
    found = new_rule.failures(run)
    assert [(f.number, f.why) for f in found] == [
        (1, "WL130"),
        (3, 'simulation.py:6: ValueError: "too stiff"'),
        (4, "scale"),
    ]
    assert "raise ValueError('too stiff')" in found[1].excerpt


@pytest.mark.parametrize("shelf", new_rule.PREFIXES)
def test_a_scaffold_is_well_formed_and_finds_nothing(run, rules, shelf):
    path = new_rule.scaffold(run, new_rule.failures(run)[1], "too_stiff_spring", shelf, rules)
    text = path.read_text()
    assert "AUTHOR:" in text and "journal entry 3" in text and "too stiff" in text
    package = f"worldwright.lint.rules.{shelf}"
    spec = importlib.util.spec_from_file_location(f"{package}.too_stiff_spring", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    entry = engine.SHELVES[shelf]._entry(module, module)
    assert entry.code not in {rule.code for rule in engine.all_rules()}
    assert entry.code.startswith(new_rule.PREFIXES[shelf]) and list(entry.check(None)) == []
    assert new_rule.next_code(shelf, rules) > entry.code


def test_names_are_checked_and_never_overwritten(run, rules):
    failure = new_rule.failures(run)[0]
    for name in ("Bad", "x", "stored_view"):
        with pytest.raises(WorldwrightError):
            new_rule.scaffold(run, failure, name, "program", rules)


@pytest.mark.parametrize("why", ['"""', "\\", "'''\n\"\"\" {x} {0}", "ü" * 2000, "\\N{nothing}"])
def test_whatever_a_failure_says_stays_a_quotation(run, rules, why):
    failure = new_rule.Failure(1, "it failed", why, excerpt=why)
    compile(new_rule.scaffold(run, failure, "odd_words", "program", rules).read_text(), "rule", "exec")


def test_the_command_lists_and_writes(run, rules, monkeypatch):
    monkeypatch.setattr(new_rule, "RULES", rules)
    invoke = lambda *words: CliRunner().invoke(cli.main, ["new-rule", str(run.folder), *words])  # noqa: E731
    assert "too stiff" in invoke().stdout
    done = invoke("--name", "too_stiff_spring", "--entry", "3", "--shelf", "model")
    assert done.exit_code == 0, done.output
    assert Path(done.stdout.split(": fill", 1)[0]).is_file()
    assert invoke("--name", "another_one", "--entry", "2").exit_code == 2
    assert invoke("--name", "too_stiff_spring").exit_code == 2
