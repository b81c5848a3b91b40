"""What lies beside an accepted folder: another plan, a link in its place, and what the stamp says nothing of."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.evidence.run import Run
from worldwright.stamp import as_stamped, private_copy

Copy = Callable[[Path], Path]


def told(folder: Path) -> tuple[list[str], list[str]]:
    """What is refused, and what is only noted, of a run as it lies there."""
    run = Run(folder)
    with private_copy.of(run) as taken:
        checks = as_stamped.static(taken, taken.stamped, live=run)
    return [c.detail for c in checks if not c.ok], [c.detail for c in checks if c.note]


def behind_a_link(path: Path, content: str) -> None:
    path.unlink()
    (path.parent / "notes").mkdir(exist_ok=True)
    (path.parent / "notes" / path.name).write_text(content, encoding="utf-8")
    path.symlink_to(f"notes/{path.name}")


@pytest.mark.parametrize("name", ["plan.md", "journal.jsonl"])
def test_a_plan_or_a_journal_that_is_a_link_is_refused_whatever_it_leads_to(
    accepted: Path, copy: Copy, name: str
) -> None:
    folder = copy(accepted)
    behind_a_link(folder / name, (folder / name).read_text(encoding="utf-8").replace("tester", "Niels Bohr"))
    refused, _ = told(folder)
    assert len(refused) == 1 and f"{name} of the run is a link" in refused[0]


def test_a_plan_and_a_journal_that_are_missing_are_noted(accepted: Path, copy: Copy) -> None:
    folder = copy(accepted)
    (folder / "plan.md").unlink()
    (folder / "journal.jsonl").unlink()
    refused, noted = told(folder)
    assert not refused and [said for said in noted if "plan.md and journal.jsonl of the run: not there" in said]


def test_a_run_in_a_folder_behind_a_link_is_as_stamped(accepted: Path, copy: Copy, tmp_path: Path) -> None:
    folder = copy(accepted)
    (tmp_path / "runs").symlink_to(folder.parent)
    assert told(tmp_path / "runs" / folder.name) == ([], [])


def test_what_was_changed_or_laid_beside_since_is_noted_and_refutes_nothing(accepted: Path, copy: Copy) -> None:
    """As whoever goes on with a run does, and whoever lays a film there that shows something else."""
    folder = copy(accepted)
    program = folder / "simulation.py"
    program.write_text(program.read_text(encoding="utf-8") + "\n# more\n", encoding="utf-8")
    (folder / "film.py").write_text("def film(film): film.caption('600 m')\n", encoding="utf-8")
    (folder / "report.html").write_text("<h1>600 m</h1>", encoding="utf-8")
    (folder / "film.mp4").write_bytes(b"a film")
    (folder / "laws").mkdir()
    (key,) = (folder / "evidence").iterdir()
    (key / "final").mkdir()
    refused, noted = told(folder)
    assert not refused
    assert [said for said in noted if said.startswith("simulation.py: another than what was accepted")]
    (added,) = (said for said in noted if "beside what was accepted, this stamp says nothing of it" in said)
    assert added.startswith(f"film.mp4, film.py, laws/, evidence/{key.name}/final/: ")
