"""Words stand where no mover is in their way."""

import numpy as np
import pytest

from worldkit.filming import Film, Recorded, free_edge, planned, still
from worldkit.filming.viewpoints import axes


def placed(eye, places, roll_deg: float = 0.0) -> str:
    """For a camera that looks at the origin from two metres away, so that 1 m reaches up to the edge."""
    frames = len(places)
    eyes = np.tile(np.array(eye), (frames, 1))
    turned = axes(eyes, np.zeros((frames, 3)), np.full(frames, roll_deg))
    return free_edge.chosen(eyes, turned, np.full(frames, 53.13), np.array(places)[:, None], np.array([0.1]), 16 / 9)


def seen(*heights: float) -> str:
    return placed((0.0, -2.0, 0.0), [(0.0, 0.0, height) for height in heights])


@pytest.mark.parametrize(
    ("heights", "place"),
    [((0.0, 0.0), "bottom"), ((-0.9, -0.9), "top"), ((0.9, 0.9), "bottom"), ((-0.9, 0.9), "bottom"),
     ((-0.9, *[0.0] * 19), "bottom"), ((-3.0, -3.0), "bottom")],
)  # fmt: skip
def test_words_go_up_only_where_movers_are_at_the_bottom_more_often(heights, place):
    assert seen(*heights) == place


def test_a_camera_that_looks_straight_down_or_is_rolled_has_a_bottom_too():
    assert (
        placed((0.0, 0.0, 2.0), [(0.0, -0.9, 0.0)]) == "top" and placed((0.0, 0.0, 2.0), [(0.0, 0.9, 0.0)]) == "bottom"
    )
    assert placed((0.0, -2.0, 0.0), [(0.0, 0.0, 0.9)], roll_deg=180.0) == "top"


def told(film: Film) -> list[str]:
    return [one["place"] for one in film.description()[0]["captions"]]


def test_a_caption_without_a_place_finds_its_own_and_one_with_a_place_keeps_it():
    t = np.linspace(0.0, 1.0, 30)[:, None]
    film = Film(Recorded.rehearsal({"ball": np.hstack([0.2 * t, 0 * t, 0.1 + 0 * t])}, duration=2.0, radius=0.1))
    film.caption("Here it goes", seconds=1.0)
    film.caption("Here, too", seconds=1.0, place="bottom")
    film.caption("Later", seconds=1.0, start=1.2)
    film.caption("After the end", seconds=1.0, start=60.0)
    film.shot(still((0, -2, 0.75), (0, 0, 0.75), lens_mm=35), until=1.0)
    film.shot(still((0, -4, 0.1), (0.2, 0, 0.1)), until=2.0)
    assert told(film)[:2] == ["top", "bottom"] and told(film)[3] == "bottom"
    assert told(film)[2] == "bottom", "held in the middle"


@pytest.mark.parametrize(("own", "place"), [(False, "bottom"), (True, "top")])
def test_where_a_camera_of_the_plan_stands_is_not_guessed(own, place):
    """From the origin along +x, where no camera stands, the ball would be at the bottom; a shot of the film's own sees it there."""
    t = np.linspace(0.0, 1.0, 30)[:, None]
    recorded = Recorded.rehearsal({"ball": np.hstack([2 + 0 * t, 0.01 * t, -0.55 + 0 * t])}, duration=2.0, radius=0.05)
    recorded.cameras = ("side",)
    film = Film(recorded)
    film.caption("Here it goes", seconds=2.0)
    film.shot(planned("side"), until=1.0)
    if own:
        film.shot(still((0.0, 0.0, 0.0), (1.0, 0.0, 0.0)), until=2.0)
    assert told(film) == [place]
