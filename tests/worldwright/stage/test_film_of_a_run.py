"""film.py decides what film.mp4 shows and nothing else: no physics, no still, no film of the plan's cameras depends on it."""

import json
import uuid
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import JobError
from worldwright.model.evidence import environment, pictures_of
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.report import facts, material
from worldwright.stage import gates, kept_sculpts, one_frame
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]
FILM = """\
from worldkit.filming import Film, follow


def film(film: Film) -> None:
    film.mood("noon")
    film.draw("kerb", "box", (0.4, 0.05, 0.05), pos=(0, 0.6, 0.025), look="granite")
    film.shot(follow("ball"), until=0.3)
    film.shot(follow("ball", azimuth_deg=40), until=0.4, speed=0.5)
"""


def passed(run: Run) -> set[str]:
    key = run.evidence_key(environment.current().sha256())
    return {name for name in ("physics", "stills", "video") if gates.passed(run, key, name)}


def video(run: Run):
    job = stage.start(str(run.folder), stage="video")
    while not job.ended:
        job = stage.wait(str(run.folder), job=job.job, timeout_s=30)
    return job


def result(run: Run) -> dict:
    key = run.evidence_key(environment.current().sha256())
    return json.loads((run.evidence(key) / "video" / "result.json").read_text())


def write(run: Run, text: str) -> None:
    (run.folder / "film.py").write_text(text, encoding="utf-8")


def test_a_film_is_seen_at_moments_and_shot_by_shot_before_its_video(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Run(copy(reviewed))
    key = run.evidence_key(environment.current().sha256())
    write(run, FILM)
    shown = stage.frames(str(run.folder), at=0.35)
    assert "film at" in shown.data.text()
    assert "drawn only: kerb" in shown.data.text()
    assert shown.pictures[0].data.startswith(b"\x89PNG")
    several = stage.frames(str(run.folder), at=[0.35, 0.0])
    assert [picture.caption[:14] for picture in several.pictures] == ["film at 0.33 s", "film at 0.00 s"]
    sheet = stage.frames(str(run.folder), show="shots")
    held = run.evidence_key(environment.current().sha256())
    with monkeypatch.context() as undrawn:
        undrawn.setattr(one_frame, "draw_frame", lambda *_, **__: pytest.fail("what was drawn is drawn again"))
        again = stage.frames(str(run.folder), show="shots")
    assert again == sheet and min(p.name for p in again.folder.iterdir()).startswith("01-shots-sheet-1")
    assert str(again.folder) in again.data.text() and held == key
    assert [line[:6] for line in sheet.data.captions[:3]] == ["shot 1", "shot 2", "all 6 "]
    assert any(line.startswith("judge belief now") for line in sheet.data.captions)
    assert "ball 0, " not in sheet.data.captions[0] and "speed 0.5" in sheet.data.captions[1]
    (page,) = [cv2.imdecode(np.frombuffer(p.data, np.uint8), cv2.IMREAD_COLOR) for p in sheet.pictures]
    assert page.shape[1] > 2 * page.shape[0]  # two rows of three


def test_a_film_costs_no_physics_and_is_stamped(reviewed: Path, copy: Copy) -> None:
    run = Run(copy(reviewed))
    key = run.evidence_key(environment.current().sha256())
    before = result(run)["files"]
    write(run, FILM)
    assert run.evidence_key(environment.current().sha256()) == key
    assert passed(run) == {"physics", "stills"}
    assert lint.check_program([run.folder / "film.py"]).findings == ()

    assert video(run).state == "succeeded"
    assert passed(run) == {"physics", "stills", "video"}
    made = result(run)
    assert "film.mp4" in made["files"]
    assert {name: made["files"][name] for name in before if name.endswith(".mp4")} == {
        name: sha256 for name, sha256 in before.items() if name.endswith(".mp4")
    }
    assert made["summary"]["film"]["drawn_only"] == ["kerb", "sky"]
    assert [shot["speed"] for shot in made["summary"]["film"]["shots"]] == [1.0, 0.5]
    assert made["summary"]["cameras"]

    assert stamp.status(str(run.folder)).next_move  # the pictures are others: they are described anew
    stamp.describe(str(run.folder), by_measurement.describe(run))
    stamp.review(str(run.folder), by_measurement.review(run))
    assert stamp.accept(str(run.folder), timeout_s=60).ok
    stamped = Statement.model_validate_json((run.accepted / "stamp.json").read_bytes())
    assert stamped.predicate.film is not None
    assert stamped.predicate.film.sha256 == pictures_of.author_sha256(run)
    assert stamped.predicate.film.drawn_only == ("kerb", "sky")
    assert stamped.digest_of("film.py") == sha256_file(run.folder / "film.py")
    assert stamped.digest_of("video/film.mp4") == made["files"]["film.mp4"]
    assert "film.py" in stamped.predicate.source.materials
    gathered = material.gather(run)
    assert next(iter(gathered.videos)) == "film"
    assert ("drawn only, not simulated", "kerb, sky") in facts.provenance(gathered)["Film"]

    write(run, FILM.replace("noon", "overcast"))
    assert stamp.status(str(run.folder)).state != "accepted"


def test_a_film_that_fails_says_where(reviewed: Path, copy: Copy) -> None:
    run = Run(copy(reviewed))
    write(run, FILM.replace('follow("ball")', 'follow("bell")'))
    found = lint.check_program([run.folder / "film.py"]).findings
    assert [(f.code, f.line) for f in found] == [("WR101", 7)]
    assert "ball" in found[0].fix
    job = video(run)
    assert (job.state, job.place) == ("failed", "film.py:7")
    assert "bell" in job.message


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("    open('/etc/passwd').read()\n", "Permission|No such file|passwd"),
        ("    import worldengine\n    film._looks['ball'] = 'no such'\n", "no look is called"),
        ("    film._air.append({'at_s': 0.0, 'ball_rgba': [0, 0, 0]})\n", "nothing of the light"),
    ],
)
def test_a_film_gets_no_further_than_its_words(reviewed: Path, copy: Copy, line: str, words: str) -> None:
    run = Run(copy(reviewed))
    write(run, FILM + line)
    with pytest.raises(JobError, match=words):
        stage.frames(str(run.folder), at=0.0)


def test_a_moment_is_shown_through_a_camera_of_the_plan(reviewed: Path) -> None:
    shown = stage.frames(str(reviewed), at=0.2, camera="side")
    assert shown.data.cameras == ("side",)
    assert "0.200 s of the recording" in shown.data.text()


def test_a_film_is_no_companion_of_the_program(reviewed: Path, copy: Copy) -> None:
    run = Run(copy(reviewed))
    key = run.evidence_key(environment.current().sha256())
    write(run, FILM)
    (run.folder / "palette.py").write_text("BLUE = '#0000ff'\n")
    assert pictures_of.author_sha256(run)
    one = pictures_of.author_sha256(run)
    write(run, "import palette\n" + FILM)
    other = pictures_of.author_sha256(run)
    (run.folder / "palette.py").write_text("BLUE = '#0000fe'\n")
    assert len({one, other, pictures_of.author_sha256(run)}) == 3
    assert run.evidence_key(environment.current().sha256()) == key


FORGED = """\
    import worldkit.filming.director as d
    old = d.sampled
    d.sampled = lambda *a: {**old(*a), 'eye': old(*a)['eye'] * float('nan')}
"""
PIXELS = """\
    import numpy as np
    from worldkit.filming import Surface
    film.draw('x', 'box', 1, look=Surface(picture=np.zeros((8, 40000, 3), np.uint8)))
"""
LAMPS = """\
    for number in range(10_000):
        film.lamp(f"lamp {number}", (0, 0, 1))
"""
HOSTILE = {
    "10,000 lights": (LAMPS, "at most 64 lamps", ":7"),
    "NaN cameras": ("    film.shot(still((float('nan'), 0, 1), 'ball'), until=0.2)\n", "shot", ":6"),
    "forged NaN cameras": (FORGED, "eye must be", ""),
    "40,000 pixels": (PIXELS, "4096", ":8"),
    "reads the plan": ("    open(__file__.replace('film.py', 'plan.md')).read()\n", "plan.md", ":6"),
    "raises": ("    raise ValueError('no')\n", "ValueError: no", ":6"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_film_is_refused_with_its_line_and_the_house_makes_one(reviewed: Path, copy: Copy, name: str) -> None:
    line, words, where = HOSTILE[name]
    run = Run(copy(reviewed))
    write(
        run,
        "from worldkit.filming import Film, still\n\n\ndef film(film: Film) -> None:\n    film.mood('noon')\n" + line,
    )
    with pytest.raises(JobError, match=words):
        stage.frames(str(run.folder), at=0.0)
    job = video(run)
    assert job.state == "failed" and words in job.message, job.text()
    assert job.place == f"film.py{where}"
    made = run.jobs / job.job / "out" / "film.mp4"
    assert str(made) in job.message and made.stat().st_size > 3_000


def test_a_run_without_a_film_has_the_houses_own(reviewed: Path) -> None:
    shown = stage.frames(str(reviewed), at=0.1, camera="film")
    assert "film at 0.12 s" in shown.data.text() or "film at 0.08 s" in shown.data.text()
    assert "frames like this one take" in shown.data.text()


def test_what_a_film_sculpts_is_made_once_for_its_frames_and_the_video(reviewed: Path, copy: Copy) -> None:
    run = Run(copy(reviewed))
    ball = f"from worldkit import sculpt\n\nBALL = sculpt.made(sculpt.sphere(0.1), cells=24)  # {uuid.uuid4()}\n"
    write(run, ball + FILM)
    place = kept_sculpts.given(pictures_of.files(run)).own
    assert not place.exists()
    stage.frames(str(run.folder), at=0.1)
    (made,) = place.glob("*.npz")
    before = made.stat().st_mtime_ns
    assert video(run).state == "succeeded"
    assert [path.stat().st_mtime_ns for path in place.glob("*.npz")] == [before]
    made.unlink()
    write(run, ball + FILM.replace("until=0.4", "until=0.35"))
    assert video(run).state == "succeeded"
    assert len(list(kept_sculpts.given(pictures_of.files(run)).own.glob("*.npz"))) == 1
