"""What stands before a still camera has smooth outlines, and pays for two frames alone; what moves is drawn as it is."""

import numpy as np
import pytest

from filmed_balls import Made
from worldengine.film.standing_outlines import SAME, StandingOutlines
from worldkit.filming import follow, still

STEPS = 255 // 16


def grey(value: int) -> np.ndarray:
    return np.full((4, 6, 3), value, np.uint8)


def test_a_pixel_that_shows_what_a_plate_shows_is_the_plates_and_any_other_stays() -> None:
    drawn: list[tuple[int, bool]] = []

    def draw(frame: int, fine: bool) -> np.ndarray:
        drawn.append((frame, fine))
        return grey(100 + 40 * frame + 7 * fine)

    outlines = StandingOutlines(draw)
    for _ in range(3):
        outlines.ready((1, 0))
    assert drawn == [(1, False), (1, True), (0, False), (0, True)], "each once"
    picture = grey(100)
    picture[:, 2], picture[:, 3], picture[1, 4] = 140 + SAME, 100 + SAME + 1, (100, 100, 30)
    found = outlines.smoothed(picture)
    wanted = picture.copy()
    wanted[:, [0, 1, 4, 5]], wanted[:, 2], wanted[1, 4] = 107, 147, (100, 100, 30)
    assert np.array_equal(found, wanted) and picture[0, 0, 0] == 100
    outlines.ready((2,))
    assert np.array_equal(outlines.smoothed(picture), picture), "the plates of another shot are forgotten"


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Made:
    return Made(tmp_path_factory.mktemp("standing"))


def post(film, camera, **grade) -> None:
    """A thin post that leans stands beside two balls that fall."""
    film.draw("post", "box", (0.02, 0.02, 2.0), pos=(-0.5, 0.4, 0.6), look="#e8e8e8")
    film.draw("beam", "box", (2.0, 0.02, 0.012), pos=(0, 0.6, 0.9), look="#202020")
    if grade:
        film.grade(**grade)
    film.shot(camera, until=0.4, speed=0.25)


@pytest.mark.gl
def test_a_still_camera_sees_smooth_outlines_of_what_stands_and_what_falls_as_it_is_drawn(made, monkeypatch) -> None:
    camera = still((0.3, -3, 0.62), (0, 0, 0.5))
    with made.screening(lambda film: post(film, camera)) as screening:
        middle, drawn = screening.film.frames // 2, []
        images = screening.frames.image
        monkeypatch.setattr(screening.frames, "image", lambda *args: drawn.append(args) or images(*args))
        smooth = screening.wordless(middle)
        assert len(drawn) == 4 + 1
        again = screening.wordless(middle + 1)
        assert len(drawn) == 4 + 2 and again.shape == smooth.shape
        screening.alone = True
        plain = screening.wordless(middle)
        segmentation = screening.segmentation()
        balls = np.isin(segmentation, [screening.model.geom(name).id for name in ("first", "second")])
    with made.screening(lambda film: post(film, camera, outlines=1)) as screening:
        fine = screening.wordless(middle)
    off = np.abs(smooth.astype(int) - plain).max(axis=2)
    edges = np.abs(fine.astype(int) - plain).max(axis=2) > STEPS
    assert balls.sum() > 20 and edges[~balls].sum() > 20
    assert (np.abs(smooth.astype(int) - fine).max(axis=2)[edges & ~balls] <= STEPS).mean() > 0.8
    assert off[balls].max() <= STEPS


@pytest.mark.gl
@pytest.mark.parametrize("how", ["it goes along", "the light changes", "too short"])
def test_where_there_is_nothing_to_stand_in_every_frame_is_drawn_for_itself(made, monkeypatch, how: str) -> None:
    def tell(film) -> None:
        if how == "the light changes":
            film.light(azimuth_deg=0, elevation_deg=30, at=0.0)
            film.light(azimuth_deg=60, elevation_deg=30, at=0.8)
        if how == "too short":
            film.shot(still((0, -3, 0.6), (0, 0, 0.5)), until=0.4)
            return
        post(film, follow("first") if how == "it goes along" else still((0, -3, 0.6), (0, 0, 0.5)))

    with made.screening(tell) as screening:
        drawn, images = [], screening.frames.image
        monkeypatch.setattr(screening.frames, "image", lambda *args: drawn.append(args) or images(*args))
        screening.wordless(3)
        assert len(drawn) == 1
