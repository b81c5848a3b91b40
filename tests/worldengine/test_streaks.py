"""One picture smeared along the way of what moves, as a film camera's open shutter would see it."""

import numpy as np
import pytest

from worldengine.film import round_things, screws, streaks
from worldengine.film.carrying import Surfaces
from worldengine.film.renderers.preview.eye import View

FRONT = np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]])  # right is x, up is z, it looks along y
SIZE = (120, 160)
SQUARE = (slice(40, 80), slice(60, 100))
POST = (slice(30, 60), slice(92, 96))
MOVER, WALL, FRONT_POST = 0, 1, 2


def view(x=0.0):
    return View(np.array([x, -2.0, 0.0]), FRONT, (0.8, 0.6))


def at(*places):
    found = np.zeros((len(places), 3, 4))
    found[:, :, :3], found[:, :, 3] = np.eye(3), places
    return found


REST = at((0.0, 0, 0), (0, 2, 0), (0, -1, 0))


def scene(post=False):
    """A red square two metres away before a grey wall; maybe with a post of a metre's distance before it."""
    picture, things, depth = np.full((*SIZE, 3), 90, np.uint8), np.full(SIZE, WALL, np.int32), np.full(SIZE, 4.0)
    picture[SQUARE], things[SQUARE], depth[SQUARE] = (220, 30, 30), MOVER, 2.0
    if post:
        picture[POST], things[POST], depth[POST] = (20, 20, 220), FRONT_POST, 1.0
    return picture, Surfaces(things, depth.astype(np.float32), REST, view())


def gone(metres):
    poses = REST.copy()
    poses[MOVER, 0, 3] += metres
    return poses


def test_what_stands_still_stays_as_it_is():
    picture, shown = scene()
    assert streaks.streaked(picture, shown, REST.copy(), view()) is picture


def test_a_thing_is_smeared_over_its_way_to_both_sides_and_nothing_else_changes():
    picture, shown = scene()
    way_px = 10.0
    moved = gone(way_px / 80 * 0.8 * 2)  # half of the width is 0.8 m at one metre, the square is at two
    smeared = streaks.streaked(picture, shown, moved, view())
    assert np.array_equal(smeared, streaks.streaked(picture, shown, moved, view())), "the same again"
    red = smeared[60, :, 0].astype(float)
    assert (np.diff(red[50:66]) > -1).all() and (np.diff(red[94:110]) < 1).all(), "it comes and goes evenly"
    touched = np.flatnonzero((smeared != picture).any(axis=(0, 2)))
    assert touched.min() == pytest.approx(60 - way_px / 2, abs=1.5) and touched.max() == pytest.approx(
        99 + way_px / 2, abs=1.5
    )
    assert np.array_equal(smeared[:38], picture[:38]) and np.array_equal(smeared[60, 70:90], picture[60, 70:90])
    light = [(image[60].astype(float) / 255) ** 2.2 for image in (picture, smeared)]
    assert light[1].sum() == pytest.approx(light[0].sum(), rel=0.01), "no light is lost"
    half = streaks.streaked(picture, shown, moved, view(), share=0.5)
    assert np.flatnonzero((half != picture).any(axis=(0, 2))).min() == pytest.approx(60 - way_px / 4, abs=1.5)


def test_what_stands_before_it_keeps_its_outline_and_leaves_no_colour_on_it():
    picture, shown = scene(post=True)
    smeared = streaks.streaked(picture, shown, gone(0.2), view())
    assert np.array_equal(smeared[POST], picture[POST])
    beside = smeared[45, [*range(85, 92), *range(96, 105)]].astype(float)
    assert (beside[:, 2] < 120).all(), "no blue on the red nor on the wall"


def test_what_spins_is_smeared_where_it_is_fast():
    picture, shown = scene()
    picture[SQUARE][::4] = (250, 250, 250)
    turned = REST.copy()
    c, s = np.cos(0.3), np.sin(0.3)
    turned[MOVER, :, :3] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    changed = np.abs(streaks.streaked(picture, shown, turned, view()).astype(int) - picture).max(axis=2)
    assert changed[58:62, 78:82].max() < 60 < changed[42:76:2, 62:66].max()


def test_a_camera_that_goes_along_keeps_its_subject_sharp_and_smears_what_is_behind():
    picture, shown = scene()
    picture[:, ::8][shown.things[:, ::8] == WALL] = 220
    smeared = streaks.streaked(picture, shown, gone(0.25), view(0.25))
    assert np.array_equal(smeared[45:75, 66:94], picture[45:75, 66:94])
    behind = smeared[10, 20:140, 0].astype(float)
    assert np.ptp(behind) < 0.5 * np.ptp(picture[10, 20:140, 0].astype(float))


def test_no_streak_is_longer_than_its_share_of_the_picture():
    picture, shown = scene()
    smeared = streaks.streaked(picture, shown, gone(3.0), view())
    touched = np.flatnonzero((smeared != picture).any(axis=(0, 2)))
    assert 60 - touched.min() <= streaks.LONGEST * SIZE[0] / 2 + 2


def test_a_disk_that_spins_by_a_sixth_of_a_turn_keeps_its_outline():
    picture, things, depth = np.full((*SIZE, 3), 90, np.uint8), np.full(SIZE, WALL, np.int32), np.full(SIZE, 4.0)
    row, column = np.indices(SIZE)
    away, turn = np.hypot(row - 59.5, column - 79.5), np.arctan2(row - 59.5, column - 79.5)
    disk = away < 30
    picture[disk], things[disk], depth[disk] = (220, 30, 30), MOVER, 2.0
    picture[disk & (np.sin(4 * turn) > 0)] = (250, 250, 250)
    shown, turned, angle = Surfaces(things, depth.astype(np.float32), REST, view()), REST.copy(), np.radians(1.0)
    turned[MOVER, :, :3] = [[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]]
    smeared = streaks.streaked(picture, shown, turned, view(), share=30.0).astype(int)
    off = np.abs(smeared - picture).max(axis=2)
    assert off[away > 31.5].max() == 0, "nothing is flung out along the tangents"
    assert off[(away > 26) & (away < 28)].mean() > 20, "and its pattern is smeared"


@pytest.mark.parametrize("axis", [(0, 1, 0), (1, 0, 0), (0, 0, -1), (0.6, 0.0, -0.8), (-0.48, 0.6, 0.64)])
@pytest.mark.parametrize("short", [0.0, 1e-12, 1e-9, 1e-4])
def test_half_a_turn_goes_along_its_arc(axis, short):
    """Its skew part is nothing, so the other one has to tell the axis; which way round it goes, nobody can."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])

    def by(angle):
        return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross

    pivot = np.array([0.3, -0.2, 0.5])
    turn = by(np.pi - short)
    half, step = screws.screwed(turn[None], (pivot - turn @ pivot)[None], 0.5)
    ways = [by(sign * (np.pi - short) / 2) for sign in (1, -1)][: 1 if short >= 1e-9 else 2]
    (sure,) = [way for way in ways if np.allclose(half[0], way, atol=1e-6)]
    assert step[0] == pytest.approx(pivot - sure @ pivot, abs=1e-6)


def test_what_turns_half_around_is_smeared():
    picture, shown = scene()
    turned = REST.copy()
    turned[MOVER, :, :3] = np.diag([-1.0, 1.0, -1.0])
    turned[MOVER, :, 3] = (0.4, 0, 0)
    assert (streaks.streaked(picture, shown, turned, view()) != picture).any()
    turned[MOVER, :, 3] = 0.0
    picture[SQUARE][::4] = (250, 250, 250)
    changed = np.abs(streaks.streaked(picture, shown, turned, view()).astype(int) - picture).max(axis=2)
    assert changed[42:76:2, 62:66].max() > 30


def test_a_ball_that_spins_keeps_its_outline_and_one_that_is_no_ball_would_not():
    """Its axis lies across the view, as of one that rolls towards the camera: what is above it would come onto it."""
    picture, things, depth = np.full((*SIZE, 3), 90, np.uint8), np.full(SIZE, WALL, np.int32), np.full(SIZE, 4.0)
    row, column = np.indices(SIZE)
    away = np.hypot(row - 59.5, column - 79.5)
    ball = away < 30
    picture[ball], things[ball] = (220, 30, 30), MOVER
    depth[ball] = 2.0 - 0.6 * np.sqrt(1 - (away[ball] / 30) ** 2)
    picture[ball & (row % 12 < 4)] = (250, 250, 250)
    turned, angle = REST.copy(), 1.2
    turned[MOVER, :, :3] = [[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]]
    shown = Surfaces(things, depth.astype(np.float32), REST, view())
    flung = np.abs(streaks.streaked(picture, shown, turned, view()).astype(int) - picture).max(axis=2)
    assert flung[away > 32].max() > 20, "as a part of a larger thing"
    shown = Surfaces(things, depth.astype(np.float32), REST, view(), rounds=np.array([round_things.ALL_ROUND, 0, 0]))
    smeared = streaks.streaked(picture, shown, turned, view())
    off = np.abs(smeared.astype(int) - picture).max(axis=2)
    assert off[away > 32].max() == 0 and off[away < 20].max() > 20
    assert smeared[(away > 26) & (away < 29), 1].max() < 254 and smeared[away < 29, 0].min() > 180, (
        "nothing shows through it"
    )


@pytest.mark.parametrize("most", [0.0, 0.1, 9.0])
def test_a_rolling_cylinder_swings_but_spins_no_more_than_so_much(most):
    def by(axis, angle):
        x, y, z = axis
        cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
        return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross

    now = at((0, 0, 0), (1, 0, 0), (2, 0, 0))
    now[:, :, :3] *= (0.2, 0.2, 0.5)
    then = now.copy()
    swing, spin = by((1, 0, 0), 0.2), by((0, 0, 1), 0.7)
    then[:, :, :3] = swing @ spin @ now[:, :, :3]
    then[:, :, 3] += 0.3
    found = round_things.spun(
        now, then, np.array([round_things.ABOUT_Z, round_things.ALL_ROUND, round_things.NOT]), most
    )
    assert found[0, :, :3] == pytest.approx(swing @ by((0, 0, 1), min(most, 0.7)) @ now[0, :, :3], abs=1e-9)
    whole = swing @ spin
    angle = np.arccos((np.trace(whole) - 1) / 2)
    left = found[1, :, :3] @ np.linalg.inv(now[1, :, :3])
    assert np.arccos(np.clip((np.trace(left) - 1) / 2, -1, 1)) == pytest.approx(min(most, angle), abs=1e-6)
    assert np.array_equal(found[2], then[2]) and np.array_equal(found[:, :, 3], then[:, :, 3])


def test_a_string_beside_a_disk_that_spins_does_not_go_round_with_it():
    """A yo-yo's string was spread beside it like a fan."""
    picture, shown = scene()
    picture[SQUARE], shown.things[SQUARE], shown.depth[SQUARE] = 90, WALL, 4.0
    y, x = np.mgrid[: SIZE[0], : SIZE[1]]
    disk, string = np.hypot(y - 59.5, x - 79.5) < 24, (np.abs(x - 79.5) < 2) & (y < 37)
    for here, thing, colour in ((disk, MOVER, (220, 30, 30)), (string, FRONT_POST, (20, 20, 220))):
        picture[here], shown.things[here], shown.depth[here] = colour, thing, 2.0
    poses = REST.copy()
    c, s = np.cos(1.5), np.sin(1.5)
    poses[MOVER, :, :3] = [[c, 0, s], [0, 1, 0], [-s, 0, c]]
    poses[FRONT_POST, 2, 3] += 0.02
    smeared = streaks.streaked(picture, shown, poses, view()).astype(int)
    beside = ~disk & ~string & (np.hypot(y - 59.5, x - 79.5) > 27)
    assert np.abs(smeared - picture)[beside & (y < 60)].max() < 12


@pytest.mark.parametrize(("then", "goes"), [((0.1, 0, 0.99), True), ((0, 0, -1), False), ((0, 0, 1.5), False)])
def test_a_piece_of_a_string_is_the_same_at_another_moment_where_it_lies_as_it_lay(then, goes):
    now, other = at((0.0, 0, 0)), at((0.3, 0, 0))
    other[0, :, 2] = then
    found = round_things.spun(now, other, np.array([round_things.OF_A_STRING]))
    assert np.allclose(found[0, :, 3], other[0, :, 3] if goes else now[0, :, 3])
