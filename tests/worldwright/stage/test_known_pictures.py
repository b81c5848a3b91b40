"""No picture is drawn twice: what an earlier pass drew of the same things is taken over, counted in drawn frames."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.place.tools import resolve
from worldwright.stage import tools as stage
from worldwright.stamp import tools as stamp

pytestmark = pytest.mark.gl
Copy = Callable[[Path], Path]
FILM = """
from worldkit.filming import follow


def film(film):
    film.shot(follow("ball"), until=0.3)
"""


def made(folder: Path, *passes: str) -> list[dict]:
    """Approve and lint a changed world, and go through its passes to their end; their summaries, with the folder of each."""
    stamp.approve(str(folder), by="tester")
    lint.check_program([folder / "simulation.py"])
    return filmed(folder, *passes)


def filmed(folder: Path, *passes: str) -> list[dict]:
    """The same of a world that is linted already."""
    found = []
    for name in ("physics", *passes):
        job = stage.start(str(folder), stage=name)
        while not job.ended:
            job = stage.wait(str(folder), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()
        run = Run(folder)
        here = run.evidence(run.evidence_key(environment.current().sha256())) / name
        result = json.loads((here / "result.json").read_text())
        assert all(sha256_file(here / file) == sha256 for file, sha256 in result["files"].items())
        found.append({**result["summary"], "folder": here})
    return found[1:]


def simulated(folder: Path) -> int:
    """How many steps the physics pass of a world as it stands has simulated; none where it took a recording over."""
    run = Run(folder)
    physics = run.evidence(run.evidence_key(environment.current().sha256())) / "physics"
    summary = json.loads((physics / "result.json").read_text())["summary"]
    return 0 if "reused_from" in summary else summary["steps"]


def patch(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_a_changed_text_and_threshold_cost_no_step_and_no_frame(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    before = filmed(folder, "stills", "video")
    assert simulated(folder) > 0
    patch(folder / "plan.md", "# A dropped ball", "# A ball, told otherwise")
    patch(folder / "plan.md", "min_m: 0.3", "min_m: 0.29")
    resolve(folder / "plan.md")
    stills, video = made(folder, "stills", "video")
    assert (simulated(folder), stills["drawn"], video["drawn"]) == (0, 0, 0)
    assert stills["taken"].keys() == {f"{name}.png" for name in stills["cameras"]}
    for was, now in zip(before, (stills, video), strict=True):
        assert was["folder"] != now["folder"]
        for name in now["taken"]:
            assert sha256_file(was["folder"] / name) == sha256_file(now["folder"] / name)


def test_a_changed_camera_costs_no_step_and_only_its_own_frames(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    first, _ = filmed(folder, "stills", "video")
    side = 'view="side_minus_y", subjects=("ball",)'
    patch(folder / "simulation.py", side, f"{side}, fovy=25.0")
    stills, video = made(folder, "stills", "video")
    assert simulated(folder) == 0 and stills["drawn"] == 1 and "side.png" not in stills["taken"]
    assert len(stills["taken"]) == len(stills["cameras"]) - 1 > 0
    assert video["drawn"] == video["frames"] and "side.mp4" not in video["taken"]
    assert sha256_file(first["folder"] / "side.png") != sha256_file(stills["folder"] / "side.png")


def test_a_changed_look_is_drawn_anew(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    patch(
        folder / "simulation.py",
        "    return spec",
        '    spec.geom("ball").rgba = (0.0, 0.3, 1.0, 1.0)\n    return spec',
    )
    (stills,) = made(folder, "stills")
    assert stills["drawn"] == len(stills["cameras"]) and "taken" not in stills


def test_a_picture_with_an_edited_byte_is_drawn_anew(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    (before,) = filmed(folder, "stills")
    name = before["cameras"][0]
    picture = before["folder"] / f"{name}.png"
    picture.write_bytes(picture.read_bytes() + b"\0")
    patch(folder / "plan.md", "# A dropped ball", "# A ball again")
    resolve(folder / "plan.md")
    (stills,) = made(folder, "stills")
    assert stills["drawn"] == 1 and f"{name}.png" not in stills.get("taken", {})


def test_a_film_is_drawn_again_only_when_it_says_something_else(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    (folder / "film.py").write_text(FILM)
    (video,) = filmed(folder, "video")
    assert video["drawn"] >= video["film"]["frames"]
    (folder / "film.py").write_text("# A remark.\n" + FILM)
    (again,) = filmed(folder, "video")
    assert again["drawn"] == 0 and again["film"] == video["film"] and "film.mp4" in again["taken"]
    (folder / "film.py").write_text(FILM.replace('"ball"', '"ball", azimuth_deg=40'))
    (other,) = filmed(folder, "video")
    assert other["drawn"] == other["film"]["frames"] and "film.mp4" not in other["taken"]
