"""Pictures are carried over to other moments by where every point that is seen stands then."""

from dataclasses import replace

import numpy as np
import pytest

from worldengine.film import carrying
from worldengine.film.carrying import Surfaces
from worldengine.film.renderers.preview.eye import View

WIDTH, HEIGHT = 160, 90
WALL, BALL = 0, 1
RADIUS, AWAY = 0.5, 6.0
TANGENTS = (0.6 * WIDTH / HEIGHT, 0.6)


def turned(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def colours(points: np.ndarray, tone: tuple[float, float, float], wave: float) -> np.ndarray:
    """A pattern that moves with the thing: uint8 (H, W, 3)."""
    stripes = np.sin(wave * points[..., :1]) * np.sin(wave * points[..., 1:2] + 1.0)
    return np.clip(np.array(tone) * (1 + 0.35 * stripes) * 255, 0, 255).astype(np.uint8)


def seen(
    ball: tuple[float, float], spin: float = 0.0, eye: tuple[float, float] = (0.0, 0.0)
) -> tuple[Surfaces, np.ndarray]:
    """A ball in front of a wall at z = -6, seen along -z: what the picture shows, and the picture."""
    view = View(np.array([*eye, 0.0]), np.eye(3), TANGENTS)
    x = ((np.arange(WIDTH) + 0.5) / WIDTH * 2 - 1) * TANGENTS[0]
    y = (1 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 2) * TANGENTS[1]
    ray = np.stack([*np.broadcast_arrays(x[None], y[:, None], -np.ones((1, 1)))], axis=-1)
    middle, turn = np.array([*ball, -3.0]), turned(spin)
    along, square = ray @ (view.eye - middle), (ray**2).sum(axis=-1)
    inside = along**2 - square * (((view.eye - middle) ** 2).sum() - RADIUS**2)
    on_ball = inside > 0
    far = np.where(on_ball, (-along - np.sqrt(np.maximum(inside, 0))) / square, AWAY)
    points = view.eye + ray * far[..., None]
    wall, own = colours(points, (0.3, 0.4, 0.5), 4.0), colours((points - middle) @ turn, (0.6, 0.3, 0.1), 7.0)
    poses = np.zeros((2, 3, 4))
    poses[WALL, :, :3], poses[BALL, :, :3], poses[BALL, :, 3] = np.eye(3), turn * RADIUS, middle
    things = np.where(on_ball, BALL, WALL).astype(np.int32)
    return Surfaces(things, far.astype(np.float32), poses, view), np.where(on_ball[..., None], own, wall)


def apart(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.abs(one.astype(int) - other.astype(int)).max(axis=-1)


@pytest.mark.parametrize("camera", [0.0, 0.25], ids=["still", "moving"])
def test_a_frame_between_two_is_as_if_drawn(camera):
    moments = [seen((0.5 * k, 0.1 * k), 0.3 * k, (camera * k, 0.0)) for k in (-1, 0, 1)]
    (before, first), (now, wanted), (after, last) = moments
    image, missing = carrying.between(now, [(before, first), (after, last)], 0.5)
    off = apart(image, wanted)
    assert missing < 0.01
    assert off.mean() < 1.5 and (off > 16).mean() < 0.02  # outlines, which nothing softens here
    assert apart(first, wanted).mean() > 4 * off.mean(), "the frame before it is no such picture"


def test_what_both_hide_is_told_and_filled_in_from_beside_it():
    (now, wanted), (there, picture) = seen((1.5, 0.0)), seen((0.0, 0.0))
    image, missing = carrying.between(now, [(there, picture), (there, picture)], 0.5)
    hidden = (there.things == BALL).mean()
    assert hidden < missing < 2 * hidden, "the rim of the ball is mixed with what is behind it"
    known = there.things != BALL
    assert (apart(image, wanted)[known & (now.things == WALL)] > 40).mean() < 0.02
    assert not (image == 0).all(axis=-1).any(), "no hole stays"


def test_where_there_is_no_thing_none_is_missed():
    still, _ = seen((0.0, 0.0))
    bare = replace(still, things=np.full_like(still.things, -1), poses=np.zeros((0, 3, 4)))
    assert not carrying.gone(bare, [bare], np.ones(bare.depth.shape, bool))


def test_what_one_picture_hides_comes_from_the_other():
    (now, wanted), (before, first), (after, last) = seen((0.0, 0.0)), seen((-1.2, 0.0)), seen((1.2, 0.0))
    image, missing = carrying.between(now, [(before, first), (after, last)], 0.5)
    assert missing == 0.0
    off = apart(image, wanted)
    for hiding in (before, after):
        assert (off[(hiding.things == BALL) & (now.things == WALL)] > 16).mean() < 0.03


def test_where_nothing_moves_the_pictures_are_blended_as_they_are():
    still, picture = seen((0.0, 0.0))
    brighter = np.clip(picture.astype(int) + 20, 0, 255).astype(np.uint8)
    image, missing = carrying.between(still, [(still, picture), (still, brighter)], 0.25)
    assert missing == 0.0
    assert apart(image, (0.75 * picture + 0.25 * brighter).round().astype(np.uint8)).max() <= 1
    alone, _ = carrying.between(still, [(still, picture)], 0.0)
    assert np.array_equal(alone, picture)


def test_while_a_film_fades_what_only_one_picture_shows_is_as_bright_as_the_rest():
    (now, wanted), (before, first), (after, last) = seen((0.0, 0.0)), seen((-1.2, 0.0)), seen((1.2, 0.0))
    for dark in (0.0, 0.4):
        faded = (dark * first).astype(np.uint8)
        image, _ = carrying.between(now, [(before, faded), (after, last)], 0.5)
        off = apart(image, ((0.5 + 0.5 * dark) * wanted).astype(np.uint8))
        assert off.mean() < 4, dark
        if dark:
            for hiding in (before, after):
                assert off[(hiding.things == BALL) & (now.things == WALL)].mean() < 8


@pytest.mark.parametrize("gone", [0.8, 2.4])
def test_a_camera_that_pans_onto_something_bright_is_no_fade(gone):
    """Along a wall, one end of it dark and the other bright; at the sides each only one picture shows what is seen."""
    moments = []
    for x in (-gone, 0.0, gone):
        surfaces, picture = seen((90.0, 0.0), eye=(x, 0.0))
        across = x + ((np.arange(WIDTH) + 0.5) / WIDTH * 2 - 1) * TANGENTS[0] * AWAY
        picture[:] = np.where(across < 3.0, 40, 220)[None, :, None]
        moments.append((surfaces, picture))
    (before, first), (now, wanted), (after, last) = moments
    assert last.mean() > 1.1 * first.mean()
    image, missing = carrying.between(now, [(before, first), (after, last)], 0.5)
    assert missing == 0.0 and (apart(image, wanted) > 2).mean() < 0.05, "but for the edge between them"


def test_a_place_in_one_picture_is_found_in_the_other_and_back():
    rng = np.random.default_rng(3)
    for _ in range(20):
        one = View(rng.normal(size=3), np.linalg.qr(rng.normal(size=(3, 3)))[0], TANGENTS)
        axes = one.axes @ turned(0.1)
        other = View(one.eye + 0.1 * rng.normal(size=3), axes, (TANGENTS[0] * 1.1, TANGENTS[1] * 1.1))
        there = carrying.pinhole(one, other, np.eye(3), np.zeros(3), WIDTH, HEIGHT)
        back = carrying.pinhole(other, one, np.eye(3), np.zeros(3), WIDTH, HEIGHT)
        pixel, far = np.array([40.0, 30.0, 1.0]), 3.0
        h = there[0] @ pixel + there[1] / far
        again = back[0] @ (h / h[2]) + back[1] / (far * h[2])
        assert np.allclose(again / again[2], pixel, atol=1e-6)
        assert np.isclose(again[2] * h[2], 1.0)


def test_a_thing_that_grows_takes_its_points_with_it():
    now, then = np.zeros((3, 4)), np.zeros((3, 4))
    now[:, :3], then[:, :3], then[:, 3] = 0.5 * np.eye(3), 1.0 * turned(0.5), (1.0, 2.0, 3.0)
    turn, step = carrying.motion(now, then)
    own = np.array([0.2, 0.3, 0.4])
    assert np.allclose(turn @ (now[:, :3] @ own) + step, then[:, :3] @ own + then[:, 3])


def test_how_far_things_stray_does_not_count_the_camera():
    still, _ = seen((0.0, 0.0))
    panned, _ = seen((0.0, 0.0), eye=(0.5, 0.0))
    moved, _ = seen((0.3, 0.0))
    assert carrying.strayed(still, panned) == 0.0
    assert carrying.strayed(still, moved) == pytest.approx(0.3 / 3.0 * HEIGHT / 2 / 0.6, rel=1e-6)
