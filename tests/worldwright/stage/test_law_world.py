"""A rubber cord by a law of the author's, as the skill writes it: from plan and files to an accepted world that is proved again."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import whole_runs
from worldengine.recording import stored
from worldwright.draft.writing import write_program
from worldwright.model.evidence.run import Run
from worldwright.report.material import gather
from worldwright.report.page import render
from worldwright.scan import tools as scan
from worldwright.stage import for_servers as stage
from worldwright.stamp import tools as stamp

pytestmark = [pytest.mark.gl, pytest.mark.slow]
PLAN = Path(__file__).parents[1] / "world" / "rubber-cord.md"
PAGE = Path(__file__).parents[3] / "skills" / "media" / "references" / "rubber.md"
OPEN = r"    # AUTHOR: the law rubber: add what it moves(.*\n    #)*.*\n"


def written(run: Run) -> None:
    """The program as drafted, with the law of the skill beside it and its surface where the draft leaves it open."""
    law, more = re.findall(
        r"^```python program\n(.*?)^```$", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL
    )
    (run.folder / "laws").mkdir()
    (run.folder / "laws" / "rubber.py").write_text(law, encoding="utf-8")
    assert len(write_program(run, actor="code").open_places) == 1
    imports, cord = more.split("\n\n\n")
    text = run.program.read_text(encoding="utf-8")
    text, count = re.subn(OPEN, "    cord(spec)\n", text)
    assert count == 1
    text = text.replace("import mujoco\n", f"import mujoco\n{imports}\n", 1)
    text = text.replace("def build()", f"{cord}\n\n\ndef build()", 1)
    assert "laws=[RUBBER_LAW]" in text
    run.program.write_text(text, encoding="utf-8")


@pytest.fixture(scope="module")
def filmed(once: Callable[[str, Callable[[Path], object]], Path]) -> Run:
    """The cord, from its plan to its film."""

    def make(folder: Path) -> None:
        run = whole_runs.approved(PLAN, folder)
        written(run)
        whole_runs.filmed(run)

    return Run(once("cord", make))


def test_a_law_of_ones_own_stretches_a_cord(filmed: Run) -> None:
    run = filmed
    recording = whole_runs.recorded(run)
    alone = stage.run_variant(run, "without-control", ("--without", "control"))
    assert alone.state == "succeeded", alone.text()
    without = stored.open(stage.variant_folder(run, "without-control") / "trajectory")
    assert without.sha256 == recording.sha256, "there is no control to take away, and the law stays"
    rings = recording.media.place.reshape(-1, 33, 8, 3).mean(axis=2)
    length = np.linalg.norm(np.diff(rings, axis=1), axis=2).sum(axis=1)
    assert 1.55 < length.max() / length[0] < 1.75, "stretched by more than half"
    assert length[-1] < 0.9 * length.max(), "and sprung back"


def test_such_a_run_is_accepted_and_proved_again(filmed: Run) -> None:
    run = filmed
    scanned = scan.scan(str(run.folder))
    assert scanned.ok, scanned.text()
    assert all("declared: a neo-Hookean cord" in acted for acted in scanned.acting) and len(scanned.acting) == 2
    assert scan.expect(str(run.folder)).ok
    (law,) = gather(run).laws
    assert law.from_nowhere < 1e-9 and law.made_j / law.scale_j < 0.03 and law.volume_change < 0.01
    assert "own laws</h3>" in render(gather(run))
    whole_runs.reviewed(run)
    whole_runs.accepted(run)
    while (proved := stamp.verify(str(run.folder), timeout_s=60, rebuild=True)).state == "running":
        pass
    assert (proved.state, proved.mode) == ("proved", "bitwise"), proved.text()
    assert "medium by the author's law rubber law re-run" in proved.text()
