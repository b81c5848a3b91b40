"""A process that the suite starts takes its modules from where the suite is, never from the folder that it is started in."""

import re
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldkit import handover
from worldwright.model import work_beside
from worldwright.scan.audits import unasked_audit
from worldwright.stage import launch

SERVERS = Path(launch.__file__).parents[2]
AUTHORS = {
    "cutting.py", "taking_in.py", "authoring.py", "sculpting_step.py", "sheets.py",  # in the sandbox, beside what they are asked of
    "imported.py",  # in the suite's own folder
}  # fmt: skip


@pytest.fixture
def poisoned(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for name in ("worldwright", "worldengine", "worldkit", "json"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").write_text(f"open({str(tmp_path / 'ran')!r}, 'w').close()\n")
    monkeypatch.chdir(tmp_path)
    return tmp_path / "ran"


@pytest.fixture
def called(monkeypatch: pytest.MonkeyPatch) -> list[tuple[list[str], dict[str, str] | None]]:
    """Calls that would have been detached."""
    found: list[tuple[list[str], dict[str, str] | None]] = []
    popen = lambda call, **more: found.append((call, more.get("env")))  # noqa: E731
    monkeypatch.setenv("WORLDWRIGHT_WARM", "0")
    monkeypatch.setattr(launch, "subprocess", SimpleNamespace(Popen=popen, DEVNULL=subprocess.DEVNULL))
    monkeypatch.setattr(work_beside, "subprocess", SimpleNamespace(Popen=popen, DEVNULL=subprocess.DEVNULL))
    return found


def test_modules_in_the_callers_folder_are_not_run(poisoned: Path, called, monkeypatch: pytest.MonkeyPatch) -> None:
    (job := poisoned.parent / "job").mkdir()
    launch._detach(SimpleNamespace(folder=job))
    monkeypatch.setattr(unasked_audit, "_kept", lambda run, key: None)
    monkeypatch.setattr(unasked_audit, "_holds", lambda run, key: True)
    monkeypatch.delenv(work_beside.SWITCH, raising=False)
    unasked_audit.begin(SimpleNamespace(evidence=lambda key: job, folder=poisoned.parent), None)
    called.append((handover._call(["--help"]), handover._environment()))
    assert len(called) == 3
    for call, env in called:
        subprocess.run([*call[:-1], "0"] if call[-1].isdigit() else call, env=env, capture_output=True, check=False)
        assert not poisoned.exists(), call


def test_no_process_but_those_that_run_beside_an_authors_files_looks_into_its_folder() -> None:
    for path in SERVERS.rglob("*.py"):
        for call in re.findall(r"\[sys\.executable,[^\]]*", path.read_text(encoding="utf-8")):
            assert '"-m"' not in call or '"-P"' in call or path.name in AUTHORS, (path, call)
