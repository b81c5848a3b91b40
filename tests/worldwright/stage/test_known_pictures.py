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
CLOSE = ('if __name__ == "__main__":', '\n_build = build\n\n\ndef build() -> mujoco.MjSpec:\n    """With one more camera."""\n    spec = _build()\n    cameras.add(spec, "close", view="{view}", subjects=("ball",))\n    return spec\n\n\nif __name__ == "__main__":')  # fmt: skip


def made(folder: Path, *passes: str) -> list[dict]:
    """Go through the passes to their end; their summaries, with the folder of each."""
    stamp.approve(str(folder), by="tester")
    lint.check_program([folder / "simulation.py"])
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


def patch(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    assert old in text
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_a_changed_text_or_threshold_costs_no_frame(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    before = made(folder, "stills", "video")
    patch(folder / "plan.md", "# A dropped ball", "# A ball, told otherwise")
    resolve(folder / "plan.md")
    stills, video = made(folder, "stills", "video")
    assert (stills["drawn"], video["drawn"]) == (0, 0)
    assert stills["taken"].keys() == {f"{name}.png" for name in stills["cameras"]}
    for was, now in zip(before, (stills, video), strict=True):
        assert was["folder"] != now["folder"]
        for name in now["taken"]:
            assert sha256_file(was["folder"] / name) == sha256_file(now["folder"] / name)


def test_a_changed_camera_costs_only_its_own_frames(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    patch(folder / "simulation.py", CLOSE[0], CLOSE[1].format(view="top_down"))
    first, _ = made(folder, "stills", "video")
    patch(
        folder / "simulation.py",
        'view="top_down", subjects=("ball",))\n    return',
        'view="close_up", subjects=("ball",))\n    return',
    )
    stills, video = made(folder, "stills", "video")
    assert stills["drawn"] == 1 and "close.png" not in stills["taken"]
    assert len(stills["taken"]) == len(stills["cameras"]) - 1
    assert video["drawn"] == video["frames"] and "close.mp4" not in video["taken"]
    assert sha256_file(first["folder"] / "close.png") != sha256_file(stills["folder"] / "close.png")


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
    (before,) = made(folder, "stills")
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
    (video,) = made(folder, "video")
    assert video["drawn"] >= video["film"]["frames"]
    (folder / "film.py").write_text("# A remark.\n" + FILM)
    (again,) = made(folder, "video")
    assert again["drawn"] == 0 and again["film"] == video["film"] and "film.mp4" in again["taken"]
    (folder / "film.py").write_text(FILM.replace('"ball"', '"ball", azimuth_deg=40'))
    (other,) = made(folder, "video")
    assert other["drawn"] == other["film"]["frames"] and "film.mp4" not in other["taken"]
