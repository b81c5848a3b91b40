"""The film that nobody asked for: a place by the plan's words, the whole event in one shot from the side."""

import runpy

import numpy as np
import pytest

from worldkit.filming import Film, Recorded, Touch, hero, unasked, viewpoints, whereabouts


def told(ways: dict, duration: float = 2.0, radius: float = 0.05, **place) -> Recorded:
    found = Recorded.rehearsal(ways, duration, radius)
    found.setting, found.floor = place.pop("setting", "room"), place.pop("floor", "")
    found.words = tuple(place.pop("words", "").split())
    return found


def rolling(length: float, points: int = 60) -> np.ndarray:
    t = np.linspace(-1.0, 1.0, points)[:, None]
    return np.hstack([length / 2 * t, 0 * t, 0.05 + 0 * t])


@pytest.mark.parametrize(
    ("setting", "words", "length", "expected"),
    [
        ("room", "an egg rolls off a plate in the kitchen", 0.5, "kitchen_counter"),
        ("room", "an egg rolls off a plate in the kitchen", 2.0, "living_room"),
        ("room", "a hammer drives a nail", 1.0, "workshop"),
        ("studio", "a basketball bounces on the court", 2.0, "gym"),
        ("studio", "a ball is let go", 2.0, ""),
        ("studio", "a magnet turns a pendulum", 0.3, "still_life"),
        ("room", "a pendulum swings", 0.3, "still_life"),
        ("room", "something moves", 0.3, "still_life"),
        ("room", "something moves", 2.0, "living_room"),
        ("dark", "a candle in the kitchen beside a bowl of apples", 0.5, ""),
        ("outdoor", "a sledge goes down the snow", 10.0, "snow_field"),
        ("outdoor", "something moves", 10.0, "meadow"),
        ("outdoor", "a car brakes on the road", 20.0, "street"),
        ("outdoor", "a light breeze blows over a leaf and a tree branch", 2.0, "park"),
        ("outdoor", "a twig falls from a tree in the garden", 2.0, "park"),
        ("outdoor", "a log rolls into a tree and leaves it standing", 5.0, "forest"),
        ("room", "a toy car rolls", 9.0, "gym"),
    ],
)
def test_the_place_follows_from_setting_words_and_size(setting, words, length, expected) -> None:
    found = told({"thing": rolling(length)}, setting=setting, words=words)
    assert whereabouts.choose(found) == expected


def test_a_word_that_only_begins_like_one_of_a_place_or_an_hour_names_neither() -> None:
    found = told({"thing": rolling(1.0)}, words="a toy on a nightstand beside a chairman, cloudybay and a shelled nut")
    assert whereabouts.hour(found) == ""
    assert whereabouts.hour(told({"thing": rolling(1.0)}, words="on two cold nights")) == "night"
    assert whereabouts._means("branches", "branch") and whereabouts._means("butterflies", "butterfly")


def test_a_floor_that_the_plan_names_stays_and_is_no_table_top() -> None:
    found = told({"thing": rolling(0.5)}, words="an egg on a plate", floor="tiles_white")
    assert whereabouts.choose(found) != "kitchen_counter"
    film = Film(found)
    runpy.run_path(unasked.__file__)["film"](film)
    assert film.description()[0]["ground"] == "tiles_white"


def test_it_is_a_film_like_any_other_and_ends_when_all_lies_still() -> None:
    way = rolling(0.6, 200)
    way[60:] = way[60]
    found = told({"egg": way}, duration=8.0, words="an egg in the kitchen")
    film = Film(found)
    runpy.run_path(unasked.__file__)["film"](film)
    facts, arrays = film.description()
    assert facts["things"] and facts["ground"]
    first = facts["shots"][0]
    shown = arrays["time"][: first["frames"]]
    assert shown[0] == 0.0 and 8.0 * 60 / 200 < shown[-1] < 5.0
    assert np.allclose(np.diff(shown), 1 / found.fps, rtol=0.05)  # as fast as it was


@pytest.mark.parametrize("turn", [0.0, 40.0, 90.0, 145.0])
def test_it_looks_at_a_motion_from_its_side(turn) -> None:
    a = np.radians(turn)
    way = rolling(2.0) @ np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])
    azimuth, elevation = hero.view(told({"ball": way}))
    assert abs(np.sin(np.radians(azimuth - turn))) > 0.75 and 10 < elevation < 50


def test_it_looks_past_what_stands_in_the_way() -> None:
    free = hero.view(told({"ball": rolling(1.0)}))
    e, a = np.radians(free[1]), np.radians(free[0])
    wall = 0.7 * np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    found = told({"ball": rolling(1.0), "wall": np.tile(wall, (60, 1))})
    found._half = np.array([[0.03] * 3, [0.4, 0.4, 0.6]])
    assert found.movers == ("ball",)
    assert hero.view(found) != free


def test_a_small_thing_on_a_long_way_is_never_a_speck() -> None:
    found = told({"stone": rolling(12.0)}, duration=3.0)
    film = Film(found)
    film.usual()
    _, arrays = film.description()
    away = np.linalg.norm(arrays["eye"] - np.array([found.position("stone", t) for t in arrays["time"]]), axis=1)
    share = found.radius("stone") / (away * np.tan(np.radians(arrays["fovy_deg"]) / 2))
    assert np.median(share) >= hero.LEAST and share.min() > 0.5 * hero.LEAST
    down = np.degrees(
        np.arcsin((arrays["eye"] - arrays["target"])[:, 2] / np.linalg.norm(arrays["eye"] - arrays["target"], axis=1))
    )
    assert np.all(down < arrays["fovy_deg"] / 2), "the horizon is in the picture"


def test_two_that_meet_are_both_in_the_picture_from_the_start_and_large_as_they_meet() -> None:
    t = np.linspace(0, 2, 200)[:, None]
    one = np.hstack([np.minimum(t - 1.05, 0.05 - t + 0.9), 0 * t, 0.05 + 0 * t])
    other = one * [-1, 1, 1]
    plain = told({"one": one, "other": other})
    plain._touches = [Touch(1.0, ("one", "other"), 9.0)]
    assert hero.leads(plain) == ("one", "other")
    film = Film(plain)
    film.usual()
    facts, arrays = film.description()
    assert len(facts["shots"]) == 1 and np.all(np.diff(arrays["time"]) > 0), "one shot, and no moment twice"
    away = np.linalg.norm(arrays["eye"] - arrays["target"], axis=1)
    tangent = np.tan(np.radians(arrays["fovy_deg"]) / 2)
    apart = np.abs(plain.position("one", arrays["time"])[:, 0] - plain.position("other", arrays["time"])[:, 0])
    assert np.all(apart / 2 < away * tangent * 16 / 9)
    assert plain.radius("one") / (away * tangent).min() > 0.7 * hero.LEAST


def test_what_is_over_at_once_is_shown_slower_and_what_lasts_long_faster() -> None:
    for duration, factor in ((0.5, 0.2), (1.0, 0.4), (5.0, 1.0), (56.0, 4.0)):
        _, told_ = hero.shots(told({"ball": rolling(1.0)}, duration=duration))[0]
        assert told_["speed"] == pytest.approx(factor)


def test_a_camera_that_stands_still_has_its_focus_and_all_far_behind_is_soft() -> None:
    film = Film(told({"ball": rolling(0.6)}))
    film.usual()
    _, arrays = film.description()
    assert np.ptp(arrays["eye"], axis=0).max() == 0 == np.ptp(arrays["focus_m"])
    disc_mm = hero.LENS_MM**2 / arrays["aperture"][0] / (1000 * arrays["focus_m"][0])
    assert disc_mm == pytest.approx(hero.SOFT)


def test_a_stand_is_in_the_picture_with_what_hangs_on_it_and_land_is_not() -> None:
    found = told(
        {"bob": rolling(0.3), "stand": np.tile([0.0, 0.1, 0.2], (60, 1)), "table": np.tile([0, 0, -0.5], (60, 1))}
    )
    found._half = np.array([[0.03] * 3, [0.02, 0.02, 0.2], [1.5, 1.0, 0.5]])
    assert hero.beside(found) == ("stand",)
    camera, away = hero.whole(found, 0.0, 0.0)
    course = viewpoints.Course(found, np.zeros(1), np.zeros(1))
    eye, target = camera.eye(course)[0], camera.target(course)[0]
    assert np.allclose(eye - target, (away, 0.0, 0.0))
    tangent = np.tan(np.radians(viewpoints.fovy_deg(hero.LENS_MM)) / 2)
    nearest = (eye[0] - 0.02) * tangent / hero.ROOM  # half the height that is left for it
    assert target[2] + nearest == pytest.approx(0.4, abs=0.01), "the stand's top is as near to the edge as it may be"


def test_a_crowd_is_held_whole() -> None:
    ways = {f"bead{k}": rolling(3.0) + np.array([0, 0.2 * k, 0]) for k in range(12)}
    found = told(ways)
    film = Film(found)
    film.usual()
    _, arrays = film.description()
    assert np.ptp(arrays["target"][:20], axis=0).max() < 1e-6  # nothing is followed
    away = np.linalg.norm(arrays["eye"] - arrays["target"], axis=1) * np.tan(np.radians(arrays["fovy_deg"]) / 2)
    assert found.radius("bead1") / away[0] < hero.LEAST


def test_a_liquid_and_snow_are_one_thing_and_beads_are_beads():
    found = told(
        {"thing": rolling(1.0), "honey": rolling(0.1), "snow": rolling(0.1), "beads": rolling(0.1)}, words="a thing"
    )
    found._laws.grains = ("beads", "honey", "snow")
    found.looks = {"honey": "clear #b86a10 6mm", "snow": "snow", "beads": "plastic_red"}
    film = Film(found)
    unasked.film(film)
    assert [(one["of"], one["look"], one.get("smooth", 1.0)) for one in film._surfaces] == [
        (["honey"], "clear #b86a10 6mm", 1.0),
        (["snow"], "snow", 2.0),
    ]
