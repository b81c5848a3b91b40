"""What numba compiles is kept beside the sources, and nothing is left elsewhere; whether it is there is told without numba."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import worldkit
from worldkit import kept_kernels
from worldwright.stage import confined, sandbox

WORLDKIT = Path(worldkit.__file__).parent
USES = "from worldkit.matter.tiny import one; assert one(2) == 3; print(sum(one.stats.cache_hits.values()))"
READ_ONLY = """
import tempfile
real = tempfile.TemporaryFile
def refuses(*words, dir=None, **more):
    if dir is not None and str(dir).endswith("matter/__pycache__"):
        raise PermissionError("read-only")
    return real(*words, dir=dir, **more)
tempfile.TemporaryFile = refuses
"""
"""Root may write everywhere, so what asks whether it may is told that it may not."""


@pytest.fixture
def installed(tmp_path: Path) -> Path:
    """A worldkit with one kernel, of which nothing was compiled."""
    package = tmp_path / "lib" / "worldkit"
    (package / "matter").mkdir(parents=True)
    for name in ("__init__", "errors", "kept_kernels", "lock", "wheels", "matter/kernels"):
        shutil.copy(WORLDKIT / f"{name}.py", package / f"{name}.py")
    (package / "matter" / "__init__.py").touch()
    (package / "matter" / "tiny.py").write_text(
        "from .kernels import kernel\n\n\n@kernel\ndef one(n):\n    return n + 1\n"
    )
    return tmp_path


def hits(installed: Path, code: str) -> tuple[int, list[Path]]:
    """How often what it uses was found compiled, and what the process leaves in the folders of its user."""
    home = installed / "home"
    home.mkdir(exist_ok=True)
    variables = {
        "PYTHONPATH": f"{installed}/lib",
        "TMPDIR": f"{home}",
        "HOME": f"{home}",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    environment = {k: v for k, v in os.environ.items() if not k.startswith(("NUMBA", "XDG", "WORLDKIT"))} | variables
    done = subprocess.run(
        [sys.executable, "-s", "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    return int(done.stdout), [path for path in home.rglob("*") if path.is_file() or path.name.startswith("compiled-")]


MARKED = "from worldkit import kept_kernels as k; k.MARK.write_text(k.state()); print(0)"


def test_what_was_compiled_of_other_sources_is_no_beginning(installed: Path) -> None:
    """numba asks after the function's own file alone."""
    hits(installed, USES)
    hits(installed, MARKED)
    (installed / "lib/worldkit/matter/other.py").write_text("TWO = 2\n")
    assert hits(installed, READ_ONLY + USES)[0] == 0


def test_it_is_kept_beside_and_one_who_may_only_read_begins_from_it_and_leaves_nothing(installed: Path) -> None:
    assert hits(installed, USES) == (0, [])
    assert list((installed / "lib/worldkit/matter/__pycache__").glob("tiny.one-*.nbi"))
    hits(installed, MARKED)
    assert hits(installed, READ_ONLY + USES) == (1, [])


@pytest.mark.skipif(sandbox.level() not in sandbox.CONFINING, reason="no level confines here")
def test_a_confined_process_begins_from_it(installed: Path) -> None:
    """It may not write where it is kept, nor change modes."""
    assert hits(installed, USES) == (0, [])
    hits(installed, MARKED)
    code = f"import sys; sys.path.insert(0, {str(installed / 'lib')!r}); {USES}"
    done = confined.run([sys.executable, "-s", "-c", code], reads=[installed / "lib"])
    assert (done.exit_code, done.log) == (0, "1\n")


def test_one_who_may_only_read_and_finds_nothing_keeps_it_in_the_users_one_place(installed: Path) -> None:
    _, left = hits(installed, READ_ONLY + USES)
    assert not [path for path in left if "compiled-" in str(path)]
    assert hits(installed, READ_ONLY + USES)[0] == 1


def test_what_was_compiled_of_other_sources_or_by_another_numba_counts_as_not_compiled(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    source = tmp_path / "flows.py"
    source.write_text("one")
    monkeypatch.setattr(kept_kernels, "SOURCES", tmp_path)
    monkeypatch.setattr(kept_kernels, "MARK", tmp_path / "mark")
    assert not kept_kernels.compiled()
    kept_kernels.MARK.write_text(kept_kernels.state())
    assert kept_kernels.compiled()
    source.write_text("two")
    assert not kept_kernels.compiled()
    source.write_text("one")
    monkeypatch.setattr(kept_kernels, "version", lambda _: "9.9")
    assert not kept_kernels.compiled()
