"""A film is tried before anything is simulated: on the start of the world, for as long as that will last."""

from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import JobError
from worldwright.stage import film_trial

FILM = """\
from worldkit.filming import Film, follow, still


def film(film: Film) -> None:
    film.particles("dust", lambda t: t[:, None, None] * [[[0.1, 0.0, 0.0]]] * {count}, diameter=0.01)
    film.shot({camera}, until=film.recorded.duration)
"""


def told(run: Path, count: str = "1.0", camera: str = 'follow("ball")'):
    (run / "film.py").write_text(FILM.format(count=count, camera=camera), encoding="utf-8")
    return lint.check_program([run / "film.py"])


@pytest.mark.gl
def test_it_is_described_and_drawn(fresh: Path) -> None:
    report = told(fresh)
    assert report.findings == () and "described and drawn" in report.worlds[0], report.text()


def test_what_no_motion_mends_is_told_with_its_line(fresh: Path) -> None:
    (finding,) = told(fresh, count="float('nan')").findings
    assert finding.line == 5 and "'dust'" in finding.message


def test_what_may_be_the_missing_motions_fault_is_told_and_no_finding(fresh: Path) -> None:
    report = told(fresh, camera='still((1, 0, film.recorded.touches("ball")[0].time_s), "ball")')
    assert report.findings == ()
    assert "line 6" in report.worlds[0] and "tried again on the recording" in report.worlds[0], report.text()


def test_a_world_that_is_not_to_be_had_is_no_fault_of_its_film(fresh: Path) -> None:
    program = fresh / "simulation.py"
    for broken in ("import beside\n", "def half(\n", "pass\n"):
        program.write_text(broken, encoding="utf-8")
        (fresh / "beside.py").write_text("raise ValueError('its own')\n", encoding="utf-8")
        report = told(fresh)
        assert report.findings == () and "no world" in report.worlds[0], report.text()


@pytest.mark.parametrize(
    ("place", "code", "films"),
    [
        ("film.py:3", "crashed", True), ("film.py:3", "timed_out", True), ("/a/run/film.py:3", "out_of_memory", True),
        ("helper.py:3", "crashed", True), ("", "crashed", True), ("", "timed_out", False), ("", "out_of_memory", False),
        ("/a/run/simulation.py:3", "crashed", False), ("simulation.py", "crashed", False),
    ],
)  # fmt: skip
def test_limits_and_other_files_are_no_findings_of_a_film(place: str, code: str, films: bool) -> None:
    assert film_trial.is_films(JobError("it failed", code=code, place=place)) is films
