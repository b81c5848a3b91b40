"""A final film stands whole whenever its time ends, becomes better in place, and goes on where it was cut."""

import time

import av
import numpy as np
import pytest

from worldengine.film import refining
from worldengine.film.refining import LEVELS, Refined, encode, refine, rounds

SIZE = (64, 36)


class Drawn:
    """Frames whose brightness is their number; it counts what it is asked for."""

    def __init__(self, count: int) -> None:
        self.count, self.asked = count, []

    def picture(self, number: int, samples: int) -> np.ndarray:
        self.asked.append((number, samples))
        return np.full((SIZE[1], SIZE[0], 3), 10 * number, np.uint8)

    def told(self) -> dict:
        return {}


def shown(path) -> list[float]:
    with av.open(str(path)) as film:
        return [float(frame.to_ndarray(format="rgb24").mean()) / 10 for frame in film.decode(video=0)]


def test_each_round_draws_every_frame_once_the_far_apart_ones_first():
    order = list(rounds(20))
    assert [n for n, s in order if s == LEVELS[0]][:5] == [0, 8, 16, 4, 12]
    for samples in LEVELS:
        assert sorted(n for n, s in order if s == samples) == list(range(20))
    assert [s for _, s in order] == sorted(s for _, s in order)


def test_with_no_time_at_all_there_is_still_a_whole_film(tmp_path):
    film, state = Drawn(12), Refined(tmp_path / "frames", 12, "it")
    refine(film, state, time.perf_counter() - 1.0, lambda: None)
    assert film.asked == [(0, LEVELS[0])]
    encode(state, tmp_path / "final.mp4", SIZE, 24)
    assert len(shown(tmp_path / "final.mp4")) == 12
    assert state.told() == {"samples": {"least": 0, "most": LEVELS[0]}, "drawn": 1, "complete": False}


def test_what_is_missing_is_shown_by_the_frame_before_it(tmp_path):
    film, state = Drawn(12), Refined(tmp_path / "frames", 12, "it")
    for number in (0, 4, 8):
        state.keep(number, film.picture(number, 2), 2)
    encode(state, tmp_path / "final.mp4", SIZE, 24)
    assert np.allclose(shown(tmp_path / "final.mp4"), [0] * 4 + [4] * 4 + [8] * 4, atol=0.3)


def test_it_goes_on_where_it_was_cut_and_ends_when_all_is_drawn(tmp_path):
    first, state = Drawn(10), Refined(tmp_path / "frames", 10, "it")
    for number, samples in list(rounds(10))[:13]:
        state.keep(number, first.picture(number, samples), samples)
    again = Refined(tmp_path / "frames", 10, "it")
    assert again.samples == state.samples
    second = Drawn(10)
    refine(second, again, float("inf"), lambda: None)
    assert first.asked + second.asked == list(rounds(10))
    assert again.told()["complete"] and again.samples == [LEVELS[-1]] * 10


@pytest.mark.parametrize("change", ["about", "count", "damaged"])
def test_frames_of_something_else_are_forgotten(tmp_path, change):
    state = Refined(tmp_path / "frames", 4, "it")
    state.keep(0, Drawn(4).picture(0, 2), 2)
    if change == "damaged":
        (tmp_path / "frames" / refining.STATE).write_text("{")
    other = Refined(tmp_path / "frames", 5 if change == "count" else 4, "that" if change == "about" else "it")
    assert not any(other.samples)


def test_a_lost_frame_is_drawn_again(tmp_path):
    state = Refined(tmp_path / "frames", 3, "it")
    for number in range(3):
        state.keep(number, Drawn(3).picture(number, 2), 2)
    state.path(1).unlink()
    assert Refined(tmp_path / "frames", 3, "it").samples == [2, 0, 2]
