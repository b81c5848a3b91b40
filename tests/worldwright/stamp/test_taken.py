"""What an acceptance copies is the run's own, and reached by no link."""

from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.run import Run
from worldwright.stamp.taken import plain, take


@pytest.mark.parametrize("name", ["prompt.md", "plan.md", "simulation.py", "film.py"])
@pytest.mark.parametrize("kind", ["symlink_to", "hardlink_to"])
def test_a_file_of_the_host_is_not_taken_for_the_runs(fresh: Path, tmp_path: Path, name: str, kind: str) -> None:
    for own in ("prompt.md", "simulation.py", "film.py"):
        (fresh / own).write_text("# mine\n")
    run = Run(fresh)
    assert take(run).prompt == b"# mine\n"
    secret = tmp_path / "secret.txt"
    secret.write_text("topsecret")
    (fresh / name).unlink()
    getattr(fresh / name, kind)(secret)
    with pytest.raises(GateError, match=f"{name} is no plain file") as refused:
        take(run)
    assert refused.value.place == str(run.folder / name)


def test_nothing_is_read_through_a_linked_folder(fresh: Path, tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "key.json").write_text("{}")
    (fresh / "evidence").symlink_to(tmp_path / "elsewhere")
    run = Run(fresh)
    with pytest.raises(GateError, match=r"evidence/key\.json is no plain file"):
        plain(run, run.folder / "evidence" / "key.json")
