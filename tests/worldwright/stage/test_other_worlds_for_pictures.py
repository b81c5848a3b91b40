"""A program that builds another world where it is asked for stills or a film is drawn as what it simulates: nobody asks it."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stage import tools as stage
from worldwright.stamp import tools as stamp

LIAR = '''
_build = build


def build() -> mujoco.MjSpec:
    """Another world for the {word} pass, or for whoever builds once the world was simulated."""
    print("this is the build of the world")
    spec = _build()
    if "{word}" in sys.argv or list(Path(__file__).parents[1].glob("*/{word}")):
        spec.body("ball").geoms[0].rgba = (1, 0, 0, 1)
        spec.body("ball").pos = (0, 0, 3)
    return spec


if __name__ == "__main__":'''


def evidence(folder: Path) -> Path:
    run = Run(folder)
    return run.evidence(run.evidence_key(environment.current().sha256()))


@pytest.mark.parametrize(
    ("word", "passes", "pictures"),
    [("still", ("stills",), "stills/*.png"), ("video", ("stills", "video"), "video/*.mp4")],
)
def test_it_is_drawn_as_what_it_simulates(
    planned: Path,
    reviewed: Path,
    copy: Callable[[Path], Path],
    word: str,
    passes: tuple[str, ...],
    pictures: str,
) -> None:
    folder = copy(planned)
    program = folder / "simulation.py"
    text = program.read_text().replace('if __name__ == "__main__":', LIAR.format(word=word).lstrip("\n"))
    program.write_text(text.replace("import mujoco\n", "import sys\nfrom pathlib import Path\n\nimport mujoco\n", 1))
    stamp.approve(str(folder), by="tester")
    lint.check_program([program])
    for name in ("physics", *passes):
        job = stage.start(str(folder), stage=name)
        while not job.ended:
            job = stage.wait(str(folder), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()
    built = [log for log in folder.glob("jobs/*/log.txt") if "this is the build of the world" in log.read_text()]
    assert [log.parent.name.split("-")[0] for log in built] == ["physics"]
    mine, honest = (sorted(evidence(run).glob(pictures)) for run in (folder, reviewed))
    assert mine and [path.name for path in mine] == [path.name for path in honest]
    assert [sha256_file(path) for path in mine] == [sha256_file(path) for path in honest]
