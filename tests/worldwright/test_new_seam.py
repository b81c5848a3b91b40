"""`worldwright new` for a seam: one whole file, which the tests of its seam refuse until it is written."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.model.errors import WorldwrightError
from worldwright.scaffolds import new_entry
from worldwright.scaffolds.seam_kinds import SEAMS

ROOT = Path(__file__).parents[2]
NAME = "quite_new"


@pytest.fixture(scope="module")
def house(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A copy of the code and of the seams' tests, with a new entry in every seam."""
    home = tmp_path_factory.mktemp("house")
    for part in ("servers", "tests"):
        shutil.copytree(ROOT / part, home / part, ignore=shutil.ignore_patterns("__pycache__"))
    (home / "catalog").symlink_to(ROOT / "catalog")
    shutil.copy(ROOT / "pyproject.toml", home)
    for kind in SEAMS:
        new_entry.scaffold(kind, f"{NAME}_{kind}", root=home / "servers" / "worldwright")
    return home


def run(house: Path, *words: str) -> subprocess.CompletedProcess[str]:
    variables = {**os.environ, "PYTHONPATH": f"{house / 'servers'}", "MUJOCO_GL": "egl"}
    call = [sys.executable, "-m", *words]
    return subprocess.run(call, cwd=house, env=variables, capture_output=True, text=True, check=False)


@pytest.mark.gl
@pytest.mark.slow
def test_its_seams_tests_fail_for_it_and_for_no_other(house: Path) -> None:
    tests = [test for seam in SEAMS.values() for test in seam.tests.split()]
    done = run(house, "pytest", "-q", "-p", "no:xdist", "-k", NAME, *tests)
    assert done.returncode == 1, done.stdout + done.stderr
    failed = [line for line in done.stdout.splitlines() if line.startswith("FAILED")]
    assert all(NAME in line for line in failed), done.stdout
    assert all(any(f"{NAME}_{kind}" in line for line in failed) for kind in SEAMS), done.stdout
    assert "ERROR" not in done.stdout, "it is whole: it fails by what it does, not by how it is written"


def test_it_is_well_formed(house: Path) -> None:
    paths = [house / "servers" / seam.folder / f"{NAME}_{kind}.py" for kind, seam in SEAMS.items()]
    assert all("AUTHOR" in path.read_text(encoding="utf-8") for path in paths)
    for words in (("ruff", "check"), ("ruff", "format", "--check"), ("mypy",)):
        config = "--config-file" if words[0] == "mypy" else "--config"
        done = run(house, *words, config, "pyproject.toml", *map(str, paths))
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.parametrize("kind", SEAMS)
def test_the_command_says_what_to_define_and_what_to_run(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(new_entry, "scaffold", lambda *words: [Path("somewhere") / f"{NAME}.py"])
    done = CliRunner().invoke(cli.main, ["new", kind, NAME])
    assert done.exit_code == 0, done.output
    assert f"somewhere/{NAME}.py: write what is marked AUTHOR" in done.output
    assert f"python -m pytest -q {SEAMS[kind].tests} -k {NAME}" in done.output
    assert all(page in done.output for page in SEAMS[kind].pages)
    rows = dict(SEAMS[kind].members())
    assert len(rows) > 1 and all(rows.values()), "every member has its meaning"
    assert all(name in done.output and meaning in done.output for name, meaning in rows.items())


@pytest.mark.parametrize("name", ["Bad", "1st", "classic", "preview", "two words"])
def test_names_are_checked_and_nothing_is_overwritten(name: str) -> None:
    with pytest.raises(WorldwrightError):
        new_entry.scaffold("renderer", name)
