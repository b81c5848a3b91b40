"""Runs with small real programs, at every level of the sandbox that works here."""

import textwrap
from pathlib import Path

import pytest

from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stage import sandbox
from worldwright.stage.tools import start, wait

LEVELS = [name for name in sandbox.LADDER if not sandbox.unusable(name)]


@pytest.fixture(params=LEVELS)
def level(request, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_SANDBOX", request.param)
    sandbox.level.cache_clear()
    yield request.param
    sandbox.level.cache_clear()


@pytest.fixture
def make(tmp_path):
    """A run whose program is approved and counts as linted."""

    def make(source: str, name: str = "world", plan: str = "a plan") -> Run:
        run = Run(tmp_path / name)
        run.folder.mkdir(exist_ok=True)
        run.plan.write_text(plan)
        run.program.write_text(textwrap.dedent(source))
        run.log("test", "approve", plan_sha256=sha256_file(run.plan))
        run.keep(run.evidence_key(environment.current().sha256()), "lint", LintReport(rules=1))
        return run

    return make


@pytest.fixture
def finish():
    """Start a pass and wait for its end."""

    def finish(run: Run, **options):
        job = start(str(run.folder), **options)
        while not job.ended:  # on a busy machine that takes minutes; one that stands still is ended by the supervisor
            job = wait(str(run.folder), job=job.job, timeout_s=10)
        return job

    return finish


@pytest.fixture
def evidence():
    """The evidence folder of a run as it stands."""

    def evidence(run: Run) -> Path:
        return run.evidence(run.evidence_key(environment.current().sha256()))

    return evidence
