"""A tiny world that really goes through every gate, made once for all workers and copied for each test that changes it."""

import fcntl
import os
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

os.environ.setdefault("MUJOCO_GL", "egl")

import forked_preroll
from worldwright.place import asking
from worldwright.stage.warm import kept_warm

kept_warm.keep()
forked_preroll.fork()

PLAN = (Path(__file__).parent / "world" / "dropped-ball.md").read_text(encoding="utf-8")
RUN = "dropped-ball"


@pytest.fixture
def started_preroll(monkeypatch: pytest.MonkeyPatch) -> None:
    """Pre-rolls are processes that are started, as everywhere but in tests."""
    monkeypatch.setattr(asking, "subprocess", forked_preroll.STARTED)


@pytest.fixture(scope="session")
def small_plan() -> str:
    """The text of a plan that runs in seconds."""
    return PLAN


def _once(factory: pytest.TempPathFactory, name: str, make: Callable[[Path], object]) -> Path:
    """This worker's copy of the run that the first worker who asked for `name` made for all of them."""
    common = factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        common = common.parent
    kept = common / f"once-{name}"
    with (common / f"once-{name}.lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not kept.exists():
            draft = common / f"once-{name}-draft"
            shutil.rmtree(draft, ignore_errors=True)
            draft.mkdir()
            make(draft / RUN)
            draft.rename(kept)
    return Path(shutil.copytree(kept / RUN, factory.mktemp(name) / RUN))


@pytest.fixture(scope="session")
def once(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, Callable[[Path], object]], Path]:
    """This worker's copy of the run that the first who asks for a name makes for all workers."""
    return lambda name, make: _once(tmp_path_factory, name, make)


@pytest.fixture
def fresh(tmp_path: Path, small_plan: str) -> Path:
    """A run that is a plan and nothing else."""
    (tmp_path / "ball").mkdir()
    (tmp_path / "ball/plan.md").write_text(small_plan, encoding="utf-8")
    return tmp_path / "ball"


@pytest.fixture(scope="session")
def sculpted_plan() -> str:
    """The text of a plan in which a pea falls into what `sculpt/bowl.py` makes."""
    return (Path(__file__).parent / "world" / "sculpted_plan.md").read_text(encoding="utf-8")


@pytest.fixture(scope="session")
def planned(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run with a resolved plan and a drafted program, not yet approved."""
    from worldwright.draft import draft
    from worldwright.model.plan.plan_text import read_plan
    from worldwright.place.tools import resolve

    folder = tmp_path_factory.mktemp("worlds") / RUN
    folder.mkdir()
    (folder / "plan.md").write_text(PLAN, encoding="utf-8")
    (folder / "prompt.md").write_text("Drop a ball.\n", encoding="utf-8")
    scene = resolve(folder / "plan.md")
    assert scene.ok, scene.findings
    drafted = draft(read_plan(folder / "plan.md").plan, resolve(folder / "plan.md", write=False))
    (folder / "simulation.py").write_text(drafted.source, encoding="utf-8")
    return folder


def _stage(folder: Path, *passes: str) -> None:
    """Run passes to their end."""
    from worldwright.stage import tools

    for name in passes:
        job = tools.start(str(folder), stage=name)  # type: ignore[arg-type]
        while not job.ended:
            job = tools.wait(str(folder), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()


@pytest.fixture(scope="session")
def prepare() -> Callable[[Path], None]:
    """Brings a planned run up to its review, measured."""
    return _prepare


def _prepare(folder: Path) -> None:
    """Bring a planned run up to its review, measured."""
    from worldwright.lint import tools as lint
    from worldwright.model.evidence.run import Run
    from worldwright.scan import tools as scan
    from worldwright.stamp import by_measurement
    from worldwright.stamp import tools as stamp

    stamp.approve(str(folder), by="tester")
    report = lint.check_program([folder / "simulation.py"])
    assert not [f for f in report.findings if f.severity == "error"], report.text()
    films = "mode: none" not in (folder / "plan.md").read_text(encoding="utf-8")
    _stage(folder, "physics", "stills", *(["video"] if films else []))
    scan.scan(str(folder))
    scan.expect(str(folder))
    stamp.describe(str(folder), by_measurement.describe(Run(folder)))
    stamp.review(str(folder), by_measurement.review(Run(folder)))


@pytest.fixture(scope="session")
def reviewed(planned: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run that passed its measured review."""

    def make(folder: Path) -> None:
        shutil.copytree(planned, folder)
        _prepare(folder)

    return _once(tmp_path_factory, "reviewed", make)


@pytest.fixture(scope="session")
def accepted(reviewed: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An accepted run."""
    from worldwright.stamp import tools as stamp

    def make(folder: Path) -> None:
        shutil.copytree(reviewed, folder)
        calls = (stamp.accept(str(folder), timeout_s=60) for _ in range(20))  # a busy machine needs more than one
        assert any(answer.ok for answer in calls)

    return _once(tmp_path_factory, "accepted", make)


@pytest.fixture
def copy(tmp_path: Path) -> Iterator[Callable[[Path], Path]]:
    """Make a copy of a run that a test may spoil."""

    def make(folder: Path) -> Path:
        target = tmp_path / folder.name
        shutil.copytree(folder, target)
        return target

    return make
