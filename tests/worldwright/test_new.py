"""`worldwright new`: an entry of every shelf is well-formed, has a code of its own, and fails a case until it is written."""

import importlib.util
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.lint import engine as lint
from worldwright.model.errors import NotFoundError, WorldwrightError
from worldwright.scaffolds import new_entry
from worldwright.scaffolds.kinds import KINDS

NAME = "quite_new_idea"


@pytest.fixture
def root(tmp_path: Path) -> Path:
    """A copy of the folders that are written into."""
    for kind in KINDS.values():
        shutil.copytree(new_entry.HERE / kind.folder, tmp_path / "worldwright" / kind.folder)
    (tmp_path / "worldwright/report/templates").mkdir()
    return tmp_path / "worldwright"


def entry(kind: str, root: Path):
    path = new_entry.scaffold(kind, NAME, "kinematics" if KINDS[kind].families else "", root=root)[0]
    package = ".".join(["worldwright", *path.parent.relative_to(root).parts])
    spec = importlib.util.spec_from_file_location(f"{package}.{NAME}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    (found,) = KINDS[kind].open()._entries(module)
    assert "AUTHOR" in path.read_text(encoding="utf-8")
    return found


@pytest.mark.parametrize("kind", KINDS)
def test_it_is_well_formed_and_its_code_is_free(kind: str, root: Path) -> None:
    found = entry(kind, root)
    assert found.code not in KINDS[kind].open()
    taken = {code[:2] for code in KINDS[kind].open()}
    assert kind in ("predicate", "relation") or found.code[:2] in taken


def fails(kind: str, found) -> bool:
    """Whether the case that must fail until the entry is written does."""
    from worldwright.scan.anomalies.engine import run_check

    if kind.endswith("rule"):
        return bool(found.BAD) and list(found.check(None)) == []
    if kind == "check":
        case = found.BAD[0]()
        return run_check(found, case.trajectory, case.context)[1] == []
    if kind == "expectation":
        make, given = found.GOOD[0]
        return found.measure(make(), found.Given.model_validate(given)).margin < 0
    if kind in ("predicate", "relation"):
        subject, reference, params = found.GOOD[0].boxes()
        return found.resolve("x", subject, reference, params).value != found.GOOD[0].gives["x"]
    return bool(list(found.check(None))) if kind == "gate" else "{{ AUTHOR }}" in new_entry.TEMPLATE.format(name=NAME)


@pytest.mark.parametrize("kind", KINDS)
def test_a_case_of_it_fails_until_it_is_written(kind: str, root: Path) -> None:
    assert fails(kind, entry(kind, root))


def test_names_are_checked_and_nothing_is_overwritten(root: Path) -> None:
    for name in ("Bad", "x", "dead_stop"):
        with pytest.raises(WorldwrightError):
            new_entry.scaffold("check", name, root=root)
    with pytest.raises(NotFoundError, match="no family"):
        new_entry.scaffold("expectation", NAME, "magic", root=root)


def test_the_command_says_what_to_write_and_what_to_run(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    whole = new_entry.scaffold
    monkeypatch.setattr(new_entry, "scaffold", lambda *words: whole(*words, root=root))
    done = CliRunner().invoke(cli.main, ["new", "check", NAME])
    assert done.exit_code == 0, done.output
    assert "python -m worldwright.scan.reference" in done.output
    assert "WHOLE" in done.output
    assert CliRunner().invoke(cli.main, ["new", "check", "x"]).exit_code == 2


def test_every_shelf_of_rules_has_its_kind() -> None:
    assert {kind.shelf.partition(":")[2] for kind in KINDS.values()} >= {
        f"{name.upper()}_RULES" for name in lint.SHELVES
    }
