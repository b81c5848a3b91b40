"""Jobs are the run's own: what is reached by a link belongs to somebody else, and tells nothing of this run."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.run import Run
from worldwright.stage import tools as stage
from worldwright.stage.job import Job
from worldwright.stamp import failures

Copy = Callable[[Path], Path]


def test_a_folder_of_jobs_behind_a_link_is_refused(reviewed: Path, copy: Copy, tmp_path: Path) -> None:
    run = Run(copy(reviewed))
    known = Job.all(run)
    assert known
    run.jobs.rename(tmp_path / "of-another-run")
    run.jobs.symlink_to(tmp_path / "of-another-run")
    for call in (lambda: Job.all(run), lambda: stage.status(str(run.folder)), lambda: stage.start(str(run.folder))):
        with pytest.raises(GateError, match="jobs/ is a link"):
            call()
    state = known[0].spec.key.key
    (tmp_path / "of-another-run" / known[0].folder.name / "state.json").write_text(
        f'{{"stage": "physics", "key": "{state}", "state": "failed", "message": "planted"}}'
    )
    assert failures.newest_failure(run.jobs, "physics", state) == ""


def test_one_job_behind_a_link_is_none_of_the_run(reviewed: Path, copy: Copy, tmp_path: Path) -> None:
    run = Run(copy(reviewed))
    first, *others = Job.all(run)
    first.folder.rename(tmp_path / "planted")
    first.folder.symlink_to(tmp_path / "planted")
    assert [job.folder for job in Job.all(run)] == [job.folder for job in others]
