"""A final film stands whole whenever its time ends, becomes better in place, and goes on where it was cut."""

import itertools
import json
import time
from contextlib import ExitStack
from types import SimpleNamespace

import av
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, kept_frames, motion_facts, refining
from worldengine.film.between import neighbours
from worldengine.film.expected_time import Pace
from worldengine.film.refining import Refined, encode, refine, rounds, traced_levels
from worldkit import materials, portable
from worldkit.filming import Film, Recorded
from worldwright.stage import refined

SIZE = (64, 36)
LEVELS = (0.5, 2, 6)


class Drawn:
    """Frames whose brightness is their number; it counts what it is asked for."""

    def __init__(self, count: int) -> None:
        self.count, self.shots, self.asked = count, [range(count)], []

    def levels(self) -> tuple[float, ...]:
        return LEVELS

    def picture(self, number: int, samples: int) -> np.ndarray:
        self.asked.append((number, samples))
        return np.full((SIZE[1], SIZE[0], 3), 10 * number, np.uint8)

    def stills(self, number: int, samples: int) -> int:
        return 0

    def told(self) -> dict:
        return {}

    lacking = give_way = None

    def reckoned(self, number: int, drawn: list[float], read) -> np.ndarray | None:
        return None

    def lettered(self, number: int, image: np.ndarray) -> np.ndarray:
        return image


class Halfway(Drawn):
    """Frames between two drawn ones, of the same shot, have the mean of their brightness."""

    def __init__(self, shots: list[range]) -> None:
        super().__init__(shots[-1].stop)
        self.shots, self.questions = shots, []

    def lacking(self, frame: int, before: int, after: int) -> bool:
        self.questions.append((frame, before, after))
        return False

    def reckoned(self, number: int, drawn: list[float], read) -> np.ndarray | None:
        sides = neighbours(number, drawn, next(shot for shot in self.shots if number in shot))
        return np.mean([read(side) for side in sides], axis=0).astype(np.uint8) if len(sides) == 2 else None


class Traced(Drawn):
    renderer = "traced"


def shown(path) -> list[float]:
    with av.open(str(path)) as film:
        return [float(frame.to_ndarray(format="rgb24").mean()) / 10 for frame in film.decode(video=0)]


def test_each_round_draws_every_frame_once_the_far_apart_ones_first():
    order = list(rounds([range(12), range(12, 20)], LEVELS))
    assert [n for n, s in order if s == LEVELS[0]][:5] == [0, 8, 16, 4, 12]
    assert [n for n, s in order if s == LEVELS[1]][:4] == [0, 8, 4, 2], "after the draft, shot by shot"
    assert [n for n, s in order if s == LEVELS[1]][12:15] == [12, 16, 14]
    for samples in LEVELS:
        assert sorted(n for n, s in order if s == samples) == list(range(20))
    assert [s for _, s in order] == sorted(s for _, s in order)


def test_what_can_be_reckoned_is_drawn_after_the_first_round_of_the_others():
    shots = [range(12), range(12, 32)]
    asked = []

    def lacking(frame: int, before: int, after: int) -> bool:
        asked.append((frame, before, after))
        return frame in (4, 16, 18, 17)

    order = list(rounds(shots, LEVELS, lacking))
    drafts = [n for n, s in order if s == LEVELS[0]]
    assert drafts == [0, 12, 8, 20, 11, 28, 31, 4, 16, 18, 17]
    first = [n for n, s in order if s == LEVELS[1]]
    assert first == [0, 8, 4, 11, 12, 20, 28, 16, 18, 17, 31], "shot by shot"
    second = [n for n, s in order if s == LEVELS[2]]
    assert second[:11] == first and second[11:14] == [2, 6, 10] and sorted(second) == list(range(32))
    assert all(any(before in shot and after in shot for shot in shots) for _, before, after in asked), (
        "never across a cut"
    )
    assert (10, 8, 11) not in asked and (9, 8, 11) in asked and (22, 20, 24) not in asked
    assert [s for _, s in order] == sorted(s for _, s in order)


def test_what_is_traced_becomes_better_without_end():
    assert list(itertools.islice(traced_levels(), 7)) == [0.5, 2, 6, 18, 54, 162, 486]


def test_a_round_is_begun_only_if_its_dearest_frame_fits(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])

    class Uneven(Drawn):
        """The first frame of each round also draws what stands still, which costs as much as 29 others."""

        def stills(self, number: int, samples: float) -> int:
            return 0 if number else 29

        def picture(self, number: int, samples: float) -> np.ndarray:
            clock[0] += samples * (3.0 if number == 0 else 0.1)
            return super().picture(number, samples)

    film = Uneven(20)
    once = 0.5 * (3.0 + 19 * 0.1)
    assert not refine(film, Refined(tmp_path / "a", 20, "it"), once + 5.9, lambda: None)
    assert len(film.asked) == 20, "the first frame of the next round takes 6 s"
    film, clock[0] = Uneven(20), 0.0
    assert not refine(film, Refined(tmp_path / "b", 20, "it"), once + 6.0 + 7.0, lambda: None)
    assert len(film.asked) == 40, "those after it are believed to be cheaper again"


def test_a_shot_is_begun_only_if_what_stands_still_in_it_fits_too(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])

    class TwoShots(Drawn):
        """Of the second shot two more frames are drawn with the first one of a round, and the others are cheap then."""

        def __init__(self) -> None:
            super().__init__(20)
            self.shots = [range(10), range(10, 20)]
            self.known: set[float] = set()

        def stills(self, number: int, samples: float) -> int:
            return 2 if number >= 10 and samples > 1 else 0

        def picture(self, number: int, samples: float) -> np.ndarray:
            cheap = samples in self.known
            clock[0] += samples * (1.0 if number < 10 or samples < 1 else 0.1 if cheap else 3.0)
            if number >= 10:
                self.known.add(samples)
            return super().picture(number, samples)

    draft, shot = 20 * 0.5, 10 * 2.0
    film = TwoShots()
    assert not refine(film, Refined(tmp_path / "a", 20, "it"), draft + shot + 5.9, lambda: None)
    assert len(film.asked) == 30, "with what stands still the next frame takes 6 s"
    again, now = TwoShots(), clock[0]
    assert not refine(again, Refined(tmp_path / "a", 20, "it"), now + 5.9, lambda: None)
    assert again.asked == [(10, 2)] and clock[0] == now + 6, "one is drawn whatever is expected"
    assert not refine(again, Refined(tmp_path / "a", 20, "it"), now + 8.1, lambda: None)
    assert len(again.asked) == 10 and clock[0] < now + 8, "those after it are believed to be cheaper"


def test_a_draft_goes_on_over_all_shots_after_a_slow_start(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])

    class GetsReady(Drawn):
        def picture(self, number: int, samples: float) -> np.ndarray:
            clock[0] += 0.1 if self.asked else 20.0
            return super().picture(number % 20, samples)

    film = GetsReady(80)
    film.shots = [range(k, k + 4) for k in range(0, 80, 4)]
    assert refine(film, Refined(tmp_path / "a", 80, "it"), 50.0, lambda: None), "no shot and no round begins as slowly"
    assert len(film.asked) == 80 * len(LEVELS)


def test_what_an_earlier_process_found_does_not_stop_a_film_for_good(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])

    class Quick(Drawn):
        def picture(self, number: int, samples: float) -> np.ndarray:
            clock[0] += 0.1
            return super().picture(number, samples)

    slow = Refined(tmp_path / "a", 8, "it")
    slow.pace = Pace(LEVELS[0], 500.0, 500.0)  # beside much else
    slow.keep(0, Drawn(8).picture(0, LEVELS[0]), LEVELS[0])
    film = Quick(8)
    film.shots = [range(4), range(4, 8)]
    assert refine(film, Refined(tmp_path / "a", 8, "it"), 20.0, lambda: None)
    assert len(film.asked) == 8 * len(LEVELS) - 1


def test_after_a_draft_the_rest_is_told_by_what_finer_frames_take(tmp_path):
    state = Refined(tmp_path / "frames", 2, "it")
    state.pace.add(0.5, 1.2, 0)
    state.keep(0, Drawn(2).picture(0, 0.5), 0.5)
    pairs_of_samples = (1 + 3) + 3  # of the drawn frame and of the other, whose first two are not counted
    assert state.told()["rest_s"] == pytest.approx(2.9 * pairs_of_samples, rel=0.02)


@pytest.mark.parametrize("count", [24, 5000])
def test_at_least_half_of_the_minutes_is_for_drawing(count):
    assert refining.drawing_s(60.0, count, (1280, 720)) == max(30.0, 60.0 - 0.22 * count)
    assert refining.drawing_s(60.0, 100, (640, 360)) == 60.0 - 5.5
    for seconds in (1.0, 60.0, 9000.0):
        drawing = refining.drawing_s(seconds, count, (1280, 720))
        assert refining.given_s(drawing, count, (1280, 720)) == pytest.approx(seconds)


def test_where_the_renderer_gives_up_the_plainer_one_has_frames_of_its_own(tmp_path):
    class GivesUp(Drawn):
        renderer = "traced"

        def told(self) -> dict:
            return {"renderer": {"name": self.renderer}}

        def picture(self, number: int, samples: int) -> np.ndarray:
            if len(self.asked) == 3 and self.renderer == "traced":
                self.renderer = "preview"
                raise refining.FellBackError
            return super().picture(number, samples)

    film = GivesUp(4)
    complete, state = refining.refined(film, tmp_path / "film", [SIZE], float("inf"), lambda: None)
    assert complete and state.samples == [LEVELS[-1]] * 4
    assert len(list((tmp_path / "film").glob("*.png"))) == 3, "what was traced stands"
    assert len(list((tmp_path / "film-preview").glob("*.png"))) == 4


def test_a_plainer_renderer_that_draws_from_the_start_leaves_what_was_traced(tmp_path):
    class Preview(Drawn):
        renderer = "preview"

    for film in (Traced(2), Preview(2), Traced(2)):
        _, state = refining.refined(film, tmp_path / "film", [SIZE], float("inf"), lambda: None)
    assert state.taken_over == 2 and film.asked == []
    assert sorted(path.name for path in tmp_path.iterdir()) == ["film", "film-preview"]


def test_frames_that_other_code_drew_are_forgotten(tmp_path, monkeypatch):
    class Preview(Drawn):
        renderer = "preview"

    kept = []
    for code in ("old", "old", "new"):
        monkeypatch.setattr(refining, "identity", lambda name, code=code: SimpleNamespace(sha256=f"{name} {code}"))
        _, state = refining.refined(Preview(2), tmp_path / "film", [SIZE], float("inf"), lambda: None)
        kept.append(state.taken_over)
    assert kept == [0, 2, 0]


def test_frames_of_a_world_that_only_looks_otherwise_are_forgotten(tmp_path, monkeypatch):
    monkeypatch.setattr(refining, "encode", lambda *given: None)
    for name in ("out", "film"):
        (tmp_path / name).mkdir()
    (tmp_path / "film" / "film.json").write_text("{}")
    kept = []
    for number, look in enumerate(("wood_oak", "wood_oak", "steel_dark")):
        world = empty()
        ball(world, "ball", (0, 0, 0.6))
        materials.add(world, look)
        world.geoms[0].material = look
        portable.write(world, tmp_path / "world.mjz")
        recording = record(world, tmp_path / str(number), 8)
        monkeypatch.setattr(described, "read", lambda *given: None)
        monkeypatch.setattr(refining, "OfTheAuthor", lambda *given: Traced(2))
        given = SimpleNamespace(
            world=tmp_path / "world.mjz", fps=24, size=SIZE, model=lambda: portable.read(tmp_path / "world.mjz")
        )
        options = SimpleNamespace(
            recording=tmp_path / str(number), film=tmp_path / "film", out=tmp_path / "out", minutes=5.0
        )
        refining.run(given, options)
        result = json.loads((tmp_path / "out" / "result.json").read_text())
        kept.append((recording.sha256, result["taken_over"]))
    assert len({sha256 for sha256, _ in kept}) == 1, "they move alike"
    assert [taken for _, taken in kept] == [0, 2, 0]
    assert len(list((tmp_path / "out" / refining.FRAMES).iterdir())) == 2


def test_with_no_time_at_all_there_is_still_a_whole_film(tmp_path):
    film, state = Drawn(12), Refined(tmp_path / "frames", 12, "it")
    assert not refine(film, state, time.perf_counter() - 1.0, lambda: None)
    assert film.asked == [(0, LEVELS[0])]
    written = []
    encode(film, state, tmp_path / "final.mp4", SIZE, 24, written.append)
    assert len(shown(tmp_path / "final.mp4")) == 12
    assert written == list(range(1, 13)), "who watches is told that it goes on"
    told = state.told()
    assert told.pop("rest_s") >= 0
    assert told == {"samples": {"least": LEVELS[0], "most": LEVELS[0]}, "drawn": 1, "taken_over": 0, "reckoned": 0}


def test_what_is_missing_is_shown_by_the_nearest_drawn_frame(tmp_path):
    film, state = Drawn(12), Refined(tmp_path / "frames", 12, "it")
    for number in (0, 4, 8):
        state.keep(number, film.picture(number, 2), 2)
    encode(film, state, tmp_path / "final.mp4", SIZE, 24, lambda number: None)
    assert np.allclose(shown(tmp_path / "final.mp4"), [0] * 3 + [4] * 4 + [8] * 5, atol=0.3)


def test_a_held_frame_is_of_its_own_shot_where_that_has_any_and_else_has_the_words_of_what_is_shown(tmp_path):
    lettered = []

    class Titled(Halfway):
        def lettered(self, number: int, image: np.ndarray) -> np.ndarray:
            lettered.append(number)
            return image

    film, state = Titled([range(4), range(4, 8), range(8, 12)]), Refined(tmp_path / "frames", 12, "it")
    for number in (3, 7):
        state.keep(number, film.picture(number, 2), 2)
    encode(film, state, tmp_path / "final.mp4", SIZE, 24, lambda number: None)
    assert np.allclose(shown(tmp_path / "final.mp4"), [3] * 4 + [7] * 8, atol=0.3)
    assert lettered == [*range(8), *[7] * 4]


def test_why_no_frame_is_reckoned_any_more_is_told():
    film = refining.OfTheAuthor.__new__(refining.OfTheAuthor)
    film.shots, film._unreckoned, film._fps, film.renderer = [range(3)], "", 24, "traced"
    frames = SimpleNamespace(told=lambda: {"name": "traced", "version": "1"})
    film._screening = SimpleNamespace(frames=frames)
    film._film = SimpleNamespace(told=lambda fps: {}, shutter=0.0)

    class Broken:
        def __getattr__(self, name: str):
            raise RuntimeError("no context")

    film._geometry = Broken()
    assert "unreckoned" not in film.told()
    assert film.reckoned(1, [2.0, 0.0, 2.0], lambda number: None) is None
    assert film.told()["unreckoned"] == "RuntimeError: no context"
    told = {"frames": 3, "drawn": 2, "reckoned": 0, "samples": {"least": 2, "most": 2}, "taken_over": 0, "rest_s": 1}
    assert "(RuntimeError: no context)" in refined.said(told | film.told())


def test_why_a_plainer_renderer_drew_is_told():
    told = {
        "frames": 3,
        "drawn": 3,
        "reckoned": 0,
        "samples": {"least": 2, "most": 2},
        "taken_over": 0,
        "complete": True,
    }
    stepped_in = {"name": "preview", "instead_of": "traced", "because": "RuntimeError: no memory"}
    assert "`preview`, since `traced` failed (RuntimeError: no memory)" in refined.said(told | {"renderer": stepped_in})
    assert "failed" not in refined.said(told | {"renderer": {"name": "traced"}})


def test_light_that_flashes_between_two_traced_frames_is_not_mixed_from_them(monkeypatch):
    from worldengine.film import between
    from worldengine.film.treatment import Treatments

    film = refining.OfTheAuthor.__new__(refining.OfTheAuthor)
    film.shots, film._fps, film._geometry = [range(9)], 1, object()
    monkeypatch.setattr(between, "reckoned", lambda *given: "mixed")
    for brightest, found in ((1.0, "mixed"), (3.0, None)):
        told = [{"at_s": at, "light_strength": brightest if at == 4.0 else 1.0} for at in (0.0, 3.0, 4.0, 5.0)]
        still = {name: np.zeros(9) for name in ("focus_m", "aperture")}
        film._film = SimpleNamespace(treatments=Treatments(told), arrays=still, shutter=0.0)
        assert film.reckoned(1, [2.0, *[0.0] * 7, 2.0], lambda number: None) == found


def test_what_is_missing_is_reckoned_between_the_drawn_frames_of_its_shot_unless_it_is_late(tmp_path):
    film, state = Halfway([range(6), range(6, 12)]), Refined(tmp_path / "frames", 12, "it")
    for number in (0, 4, 6, 10):
        state.keep(number, film.picture(number, 2), 2)
    encode(film, state, tmp_path / "final.mp4", SIZE, 24, lambda number: None)
    assert state.told()["reckoned"] == 6 and "6 reckoned between them" in state.text()
    means = [0, 2, 2, 2, 4, 4, 6, 8, 8, 8, 10, 10]
    assert np.allclose(shown(tmp_path / "final.mp4"), means, atol=0.3)
    encode(film, state, tmp_path / "late.mp4", SIZE, 24, lambda number: None, until=0.0)
    assert state.told()["reckoned"] == 0
    assert np.allclose(shown(tmp_path / "late.mp4"), [0] * 3 + [4] * 3 + [6] * 3 + [10] * 3, atol=0.3)


def test_the_frames_that_others_are_reckoned_from_become_better_first(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])

    class Slow(Halfway):
        def picture(self, number: int, samples: float) -> np.ndarray:
            clock[0] += samples
            return super().picture(number, samples)

    film, state = Slow([range(17)]), Refined(tmp_path / "frames", 17, "it")
    assert not refine(film, state, 3 * 0.5 + 3 * 2.0 + 2.5, lambda: None)
    assert state.samples == [2 if k in (0, 8, 16) else 0 for k in range(17)]
    assert film.questions == [(4, 0, 8), (12, 8, 16)], "what lies between is not asked again"
    assert state.told()["rest_s"] == pytest.approx(17 * 6.0), "the three come first once more"


def test_it_goes_on_where_it_was_cut_and_ends_when_all_is_drawn(tmp_path):
    first, state = Drawn(10), Refined(tmp_path / "frames", 10, "it")
    for number, samples in list(rounds([range(10)], LEVELS))[:13]:
        state.keep(number, first.picture(number, samples), samples)
    again = Refined(tmp_path / "frames", 10, "it")
    assert again.samples == state.samples and again.told()["taken_over"] == 10
    second = Drawn(10)
    assert refine(second, again, float("inf"), lambda: None)
    assert first.asked + second.asked == list(rounds([range(10)], LEVELS))
    assert again.samples == [LEVELS[-1]] * 10


def test_asking_what_is_lacking_takes_time_of_the_film_and_of_no_frame(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])

    class Asks(Halfway):
        def lacking(self, frame: int, before: int, after: int) -> bool:
            clock[0] += 10.0
            return super().lacking(frame, before, after)

        def picture(self, number: int, samples: float) -> np.ndarray:
            clock[0] += samples
            return super().picture(number % 20, samples)

    film, state = Asks([range(81)]), Refined(tmp_path / "frames", 81, "it")
    assert not refine(film, state, 11 * 0.5 + 35.0, lambda: None)
    assert len(film.questions) == 4, "past the end nothing is asked"
    assert state.pace.dearest == 1.0 and len(film.asked) == 11


def test_a_set_that_is_finished_for_ever_is_begun_anew(tmp_path):
    state = Refined(tmp_path / "frames", 2, "it")
    for number in range(2):
        state.keep(number, Drawn(2).picture(number, 2), 2)
    path = tmp_path / "frames" / kept_frames.STATE
    path.write_text(json.dumps(json.loads(path.read_text()) | {"samples": [float("inf")] * 2}))
    assert Refined(tmp_path / "frames", 2, "it").samples == [0.0, 0.0]


@pytest.mark.parametrize("change", ["about", "count", "damaged"])
def test_frames_of_something_else_are_forgotten(tmp_path, change):
    state = Refined(tmp_path / "frames", 4, "it")
    state.keep(0, Drawn(4).picture(0, 2), 2)
    if change == "damaged":
        (tmp_path / "frames" / kept_frames.STATE).write_text("{")
    other = Refined(tmp_path / "frames", 5 if change == "count" else 4, "that" if change == "about" else "it")
    assert not any(other.samples)


def test_a_lost_frame_is_drawn_again(tmp_path):
    state = Refined(tmp_path / "frames", 3, "it")
    for number in range(3):
        state.keep(number, Drawn(3).picture(number, 2), 2)
    state.path(1).unlink()
    assert Refined(tmp_path / "frames", 3, "it").samples == [2, 0, 2]


@pytest.mark.gl
def test_where_paths_cannot_be_traced_the_two_kinds_of_the_preview_are_all(tmp_path, monkeypatch):
    from worldengine.film.renderers.traced import variant

    def missing() -> str:
        raise variant.MissingRendererError("not here", "mitsuba", "")

    monkeypatch.setattr(variant, "choose", missing)
    world = empty()
    floor(world)
    ball(world, "ball", (0, 0, 0.6))
    portable.write(world, tmp_path / "world.mjz")
    recording = record(world, tmp_path / "trajectory", 40)
    motion_facts.write(recording, tmp_path / "motion.npz", {"fps": 24, "size": list(SIZE), "movers": ["ball"]})
    with np.load(tmp_path / "motion.npz") as arrays:
        film = Film(Recorded(dict(arrays)))
    lay_film(tmp_path, film)
    given = SimpleNamespace(world=tmp_path / "world.mjz", fps=24, size=SIZE)
    told = described.read(tmp_path, recording)
    with ExitStack() as stack:
        shown = refining.OfTheAuthor(given, portable.read(given.world), recording, told, stack)
        assert shown.told()["renderer"]["name"] == "preview"
        shown.count, shown.shots, state = 2, [range(2)], Refined(tmp_path / "frames", 2, "it")
        assert refine(shown, state, float("inf"), lambda: None)
    assert state.samples == [4, 4]


class Slow(Halfway):
    """Frames that take a second each on a clock of their own; some lack what others could give them."""

    def __init__(self, count: int, clock: list[float], every: bool) -> None:
        super().__init__([range(count)])
        self.clock, self.every, self.takes_s, self.give_way = clock, every, [], self._give_way

    def lacking(self, frame: int, before: int, after: int) -> bool:
        return self.every

    def _give_way(self, takes_s: float) -> None:
        self.takes_s.append(takes_s)

    def picture(self, number: int, samples: float) -> np.ndarray:
        self.clock[0] += 1.0 if samples == LEVELS[0] else 3.0
        self.asked.append((number, samples))
        return np.zeros((SIZE[1], SIZE[0], 3), np.uint8)


@pytest.mark.parametrize(
    ("seconds", "every", "drawn"),
    [
        (8, False, 3),  # 11 frames far apart do not fit: after three drafts that is plain
        (8, True, 3),  # and what lies between is told, too
        (30, True, 11),  # they do, and not the 70 between that nothing shows
        (30, False, 0),
        (95, True, 0),
    ],
)
def test_a_film_that_cannot_be_traced_in_its_minutes_gives_way_as_a_whole(tmp_path, monkeypatch, seconds, every, drawn):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])
    film = Slow(81, clock, every)
    state = Refined(tmp_path, 81, "it")
    if not drawn:
        refine(film, state, seconds, lambda: None)
        assert not film.takes_s
        return
    with pytest.raises(refining.FellBackError):
        refine(film, state, seconds, lambda: None)
    assert len(film.asked) == drawn and film.takes_s == [pytest.approx(81 if every else 11, rel=0.05)]


def test_a_film_that_is_mostly_traced_is_not_given_up_for_fewer_minutes(tmp_path, monkeypatch):
    clock = [0.0]
    monkeypatch.setattr(refining.time, "perf_counter", lambda: clock[0])
    film, state = Slow(81, clock, True), Refined(tmp_path, 81, "it")
    for number in [*range(0, 81, 8), *(k for k in range(60) if k % 8)]:
        state.keep(number, film.picture(number, LEVELS[0]), LEVELS[0])
    state = Refined(tmp_path, 81, "it")
    state.pace.add(LEVELS[0], 1.0, 0.0)
    refine(film, state, clock[0] + 3, lambda: None)
    assert not film.takes_s


def test_that_tracing_would_take_longer_is_told():
    summary = {"frames": 9, "drawn": 9, "taken_over": 0, "reckoned": 0, "samples": {"least": 1, "most": 1}, "rest_s": 0,
               "complete": True, "renderer": {"name": "preview"}, "tracing_takes_s": 200.0}  # fmt: skip
    assert "drawn by `preview`, since tracing a whole film takes about 4 minutes" in refined.said(summary)
