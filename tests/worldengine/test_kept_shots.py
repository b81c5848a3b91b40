"""A changed shot costs its own frames alone, counted, and the film is bit for bit the one that is drawn whole."""

import hashlib
import json
from argparse import Namespace
from types import SimpleNamespace

import av
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, motion_facts, passes
from worldengine.film.encode import Video, packets, part
from worldkit import portable
from worldkit.filming import Film, Recorded, planned, still

SIZE, FPS = (96, 54), 24


class Studio:
    """A recorded ball, and films of two shots of it."""

    def __init__(self, folder):
        self.folder = folder
        spec = empty()
        floor(spec)
        ball(spec, "ball", (0, 0, 0.6), rgba=(0.8, 0.1, 0.1, 1))
        spec.worldbody.add_camera(name="side", pos=(0, -3, 0.5), xyaxes=(1, 0, 0, 0, 0, 1))
        self.recording = record(spec, folder / "trajectory", 800)
        portable.write(spec, folder / "world.mjz")
        facts = {"fps": FPS, "size": list(SIZE), "movers": ["ball"]}
        motion_facts.write(self.recording, folder / "motion.npz", facts)

    def film(self, name, *earlier, first=(1, -2, 0.5), speed=1.0, words="it lies", mood="noon", second=None, mist=0.1):
        """Draw a film; how many frames were drawn, those of its shots, and the file."""
        with np.load(self.folder / "motion.npz") as arrays:
            told = Film(Recorded(dict(arrays)))
        told.mood(mood)
        told.shot(still(first, "ball"), until=0.4, speed=speed)
        told.puffs("mist", lambda t: (0 * t[:, None, None] + np.ones((1, 3)), 0.1 + 0 * t[:, None], _later(t, mist)))
        told.caption(words, seconds=0.2)
        told.shot(second or still((-1, -2, 0.5), "ball"), start=0.4, until=0.7)
        out = self.folder / name
        (out / "told").mkdir(parents=True)
        lay_film(out / "told", told)
        film = described.read(out / "told", self.recording)
        given = SimpleNamespace(world=self.folder / "world.mjz", size=SIZE, fps=FPS)
        options = Namespace(film=out / "told", out=out, reuse=[self.folder / one for one in earlier])
        plain = portable.read(given.world)
        summary = passes.directed(plain, self.recording, film, given, options, lambda done: None)
        files = {"film.mp4": hashlib.sha256((out / "film.mp4").read_bytes()).hexdigest()}
        (out / "result.json").write_text(json.dumps({"ok": True, "summary": summary, "files": files}))
        assert {path.name for path in out.iterdir()} == {"told", "film.mp4", "result.json"}
        return summary["drawn"], [shot["frames"] for shot in film.shots], (out / "film.mp4").read_bytes()


def _later(times, opacity):
    return np.where(times > 0.45, opacity, 0.1)[:, None]


@pytest.fixture(scope="module")
def studio(tmp_path_factory):
    made = Studio(tmp_path_factory.mktemp("studio"))
    made.drawn, made.shots, _ = made.film("before")
    return made


@pytest.mark.gl
def test_a_changed_shot_costs_its_own_frames_and_the_rest_is_taken_as_it_is(studio):
    assert studio.drawn == sum(studio.shots) and len(studio.shots) == 2
    drawn, shots, reused = studio.film("reused", "before", first=(1, -2, 0.8))
    assert drawn == shots[0] == studio.shots[0]
    drawn, shots, whole = studio.film("whole", first=(1, -2, 0.8))
    assert drawn == sum(shots) and reused == whole
    drawn, _, again = studio.film("again", "reused", "before")
    assert drawn == 0, "one shot stands in each"
    assert again == (studio.folder / "before/film.mp4").read_bytes()


@pytest.mark.gl
def test_a_shot_that_only_moves_to_another_place_in_the_film_is_not_drawn_again(studio):
    drawn, shots, _ = studio.film("longer", "before", speed=0.5)
    assert shots[0] > studio.shots[0] and drawn == shots[0]


@pytest.mark.gl
@pytest.mark.parametrize(
    ("change", "costs"),
    [
        ({"words": "there it lies"}, 1),
        ({"mood": "overcast"}, None),
        ({"second": planned("side")}, 1),
        ({"mist": 0.3}, 1),
    ],
    ids=["words", "light", "camera of the plan", "puffs"],
)
def test_what_is_said_of_one_shot_costs_that_one_and_what_is_said_of_the_film_all(studio, change, costs):
    drawn, shots, _ = studio.film(f"changed-{next(iter(change))}", "before", **change)
    assert drawn == (sum(shots) if costs is None else shots[costs])


@pytest.mark.gl
def test_nothing_is_taken_from_a_film_that_is_not_what_its_pass_wrote(studio):
    studio.film("spoilt")
    film = studio.folder / "spoilt/film.mp4"
    film.write_bytes(film.read_bytes()[:-1] + b"\0")
    drawn, shots, _ = studio.film("after", "spoilt", first=(1, -2, 0.9))
    assert drawn == sum(shots)


def test_a_part_is_taken_only_from_cut_to_cut_and_of_its_own_size(tmp_path):
    noise = np.random.default_rng(0).integers(0, 255, (48, 64, 3)).astype(np.uint8)

    def write(name, *parts):
        with Video(tmp_path / name, 64, 48, FPS) as video:
            for one in parts:
                if isinstance(one, list):
                    video.take(one)
                else:
                    for number in range(10):
                        video.add(np.roll(noise, number + one, axis=1))
                    video.cut()
        with av.open(str(tmp_path / name)) as film:
            return [frame.to_ndarray(format="rgb24") for frame in film.decode(video=0)]

    write("one", 3, 7, 5)
    one = packets(tmp_path / "one", (64, 48), FPS)
    middle = part(one, 10, 10)
    assert middle and len(middle) == 10
    assert len(write("two", middle, 5)) == 20 and len(write("three", 7, 5)) == 20
    assert (tmp_path / "two").read_bytes() == (tmp_path / "three").read_bytes()
    assert part(one, 11, 9) is None
    assert part(one, 25, 10) is None
    assert packets(tmp_path / "one", (64, 50), FPS) == packets(tmp_path / "one", (64, 48), 25) == []
    (tmp_path / "junk").write_bytes(b"no film" * 100)
    for name in ("junk", "gone"):
        with pytest.raises(OSError, match=name):
            packets(tmp_path / name, (64, 48), FPS)


@pytest.mark.parametrize("lengths", [(2, 10), (10, 2, 10), (1, 10), (1, 1, 2, 5), (4, 2, 4), (3, 1, 4)])
def test_shots_of_one_and_two_frames_stand_where_they_belong(tmp_path, lengths):
    levels = iter(range(20, 240, 10))
    shown = [[next(levels) for _ in range(count)] for count in lengths]
    with Video(tmp_path / "film", 64, 48, FPS) as video:
        for shot in shown:
            for level in shot:
                video.add(np.full((48, 64, 3), level, np.uint8))
            video.cut()
    with av.open(str(tmp_path / "film")) as film:
        frames = [(frame.time, frame.to_ndarray(format="rgb24").mean()) for frame in film.decode(video=0)]
    assert [time for time, _ in frames] == pytest.approx([k / FPS for k in range(sum(lengths))], abs=1e-3)
    assert [mean for _, mean in frames] == pytest.approx([level for shot in shown for level in shot], abs=3)


@pytest.mark.gl
def test_an_earlier_film_that_is_gone_or_no_film_costs_all_frames(studio):
    for name, spoil in (("gone", None), ("junk", b"junk")):
        studio.film(name)
        folder = studio.folder / name
        (folder / "film.mp4").unlink()
        if spoil is not None:
            (folder / "film.mp4").write_bytes(spoil)
            told = json.loads((folder / "result.json").read_text())
            told["files"]["film.mp4"] = hashlib.sha256(spoil).hexdigest()
            (folder / "result.json").write_text(json.dumps(told))
        drawn, shots, _ = studio.film(f"after-{name}", name, first=(1, -2, 0.9))
        assert drawn == sum(shots)
