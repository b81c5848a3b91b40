"""What a film's author says becomes a description of every frame, or is refused with what to do instead."""

import itertools
import json
import runpy

import numpy as np
import pytest

from worldkit import sculpt, turning
from worldkit.errors import ProgramError
from worldkit.filming import (
    MOODS,
    Film,
    Recorded,
    Surface,
    along,
    fluttering,
    follow,
    orbit,
    planned,
    ride,
    still,
    telling,
    wide,
)
from worldkit.filming.viewpoints import between, fovy_deg

T = np.linspace(0.0, 3.0, 301)[:, None]


def rehearsal():
    return Recorded.rehearsal(
        {"ball": np.hstack([T, 0 * T, 0.1 + 0 * T]), "post": np.hstack([2 + 0 * T, 1 + 0 * T, 0 * T])}, duration=3.0
    )


@pytest.fixture
def film():
    return Film(rehearsal())


def described(film):
    facts, arrays = film.description()
    json.dumps(facts)
    return facts, arrays


def test_the_focus_is_a_point_a_distance_or_a_body(film):
    eye = (0.0, -2.0, 0.5)
    for focus in ((0.0, 1.0, 0.5), 1.5, "post", np.array([0.0, 0.0, 0.5])):
        film.shot(still(eye, (0, 0, 0.5), focus=focus), until=film.reached + 0.5)
    at = described(film)[1]["focus_m"].reshape(4, 12)[:, 5]
    assert at == pytest.approx([3.0, 1.5, np.linalg.norm([2.0, 3.0, 0.5]), 2.0])


@pytest.mark.parametrize(
    "lens",
    [
        {"focus": (1.0, 2.0)}, {"focus": ["ball"]}, {"focus": -1.0}, {"focus": float("nan")}, {"aperture": "wide"},
        {"lens_mm": "50"}, {"lens_mm": (24, 35, 50)}, {"shake": (1, 2)}, {"roll_deg": "left"}, {"focus": (1, 2, "z")},
    ],
)  # fmt: skip
def test_a_lens_that_is_none_is_refused_by_its_word(lens):
    with pytest.raises(ProgramError) as refused:
        follow("ball", **lens)
    assert next(iter(lens)) in refused.value.cause and refused.value.next_move


def test_a_name_that_a_set_owns_is_said_to_be_the_sets(film):
    film.set("snow_field")
    with pytest.raises(ProgramError, match="the set 'snow_field' gives") as refused:
        film.tree("spruces", "pine", at=[(9.0, 9.0)])
    assert "'drift 1' to 'drift 14', 'spruces', 'spruces (leaves)', 'hills'" in refused.value.next_move
    other = Film(rehearsal())
    other.draw("spruces", "box", 1.0, pos=(9.0, 9.0, 0.5))
    with pytest.raises(ProgramError, match="'spruces', which the set 'snow_field' gives"):
        other.set("snow_field")


def test_shots_follow_each_other_at_their_speed(film):
    film.shot(follow("ball"), until=1.0)
    film.shot(follow("ball"), until=2.0, speed=0.25)
    assert film.reached == pytest.approx(2.0)
    assert film.now == pytest.approx(1.0 + 4.0)
    facts, arrays = described(film)
    assert [shot["frames"] for shot in facts["shots"]] == [24, 96]
    step = np.diff(arrays["time"])
    assert step[:23] == pytest.approx(1 / 24)
    assert step[24:] == pytest.approx(1 / 96)


def test_a_speed_is_exact_where_a_shot_is_no_whole_number_of_frames(film):
    film.shot(wide(), until=0.61)
    _, arrays = described(film)
    assert np.diff(arrays["time"]) == pytest.approx(1 / 24)


def test_a_ramp_begins_at_one_speed_and_ends_at_the_other(film):
    film.shot(wide(), until=3.0, speed=(1.0, 0.25))
    _, arrays = described(film)
    speed = np.diff(arrays["time"]) * 24
    assert speed[0] == pytest.approx(1.0, abs=0.02)
    assert speed[-1] == pytest.approx(0.25, abs=0.02)
    assert (np.diff(speed) < 1e-9).all()


def test_a_held_moment_stands_still_while_the_camera_moves(film):
    film.hold(orbit("ball", azimuth_deg=(0, 90)), 1.0, at=1.5)
    _, arrays = described(film)
    assert arrays["time"].tolist() == [1.5] * 24
    assert np.linalg.norm(arrays["eye"][-1] - arrays["eye"][0]) > 0.3


def test_a_following_camera_keeps_its_body_in_the_middle_and_its_size(film):
    film.shot(follow("ball", lens_mm=50, fill=0.25), until=3.0)
    _, arrays = described(film)
    ball = film.recorded.position("ball", arrays["time"])
    inner = (arrays["time"] > 0.3) & (arrays["time"] < 2.7)
    assert np.abs(arrays["target"] - ball)[inner].max() < 1e-6
    away = np.linalg.norm(arrays["eye"] - arrays["target"], axis=1)
    seen = film.recorded.radius("ball") / (away * np.tan(np.radians(arrays["fovy_deg"]) / 2))
    assert seen == pytest.approx(0.25)


@pytest.mark.parametrize("lens", [24, (35, 85)])
def test_a_camera_that_follows_two_keeps_both_in_the_picture_as_they_part(lens):
    t = np.linspace(0.0, 4.0, 400)[:, None]
    ways = {"a": np.hstack([t**2, 0 * t, 0 * t + 0.2]), "b": np.hstack([0.2 * t**2, -1.5 * t, 0 * t + 0.2])}
    film = Film(Recorded.rehearsal(ways, duration=4.0, radius=0.2))
    film.shot(follow(["a", "b"], azimuth_deg=(-60, -20), lens_mm=lens), until=4.0)
    _, frames = film.description()
    eye, target = frames["eye"], frames["target"]
    ahead = (target - eye) / np.linalg.norm(target - eye, axis=1, keepdims=True)
    right = np.cross(ahead, (0, 0, 1.0))
    right /= np.linalg.norm(right, axis=1, keepdims=True)
    up = np.cross(right, ahead)
    half = np.tan(np.radians(frames["fovy_deg"]) / 2)
    widest = 0.0
    for name in ways:
        apart = film.recorded.position(name, frames["time"]) - eye
        deep = (apart * ahead).sum(axis=1)
        shares = [
            ((apart * side).sum(axis=1).__abs__() + 0.2) / deep / k for side, k in ((right, half * 16 / 9), (up, half))
        ]
        widest = max(widest, float(np.max(shares)))
    assert 0.6 < widest <= 0.85  # room is a quarter of what they take
    away = np.linalg.norm(eye - target, axis=1)
    assert away[-1] > 2 * away[0] or isinstance(lens, tuple)
    assert np.abs(np.diff(away, 2)).max() < 0.02 * away.max()


def test_a_focused_lens_knows_how_far_its_subject_is(film):
    film.shot(still((0, -2, 0.1), "post", focus="ball", aperture=2.0, lens_mm=200), until=1.0)
    _, arrays = described(film)
    expected = np.linalg.norm(film.recorded.position("ball", arrays["time"]) - arrays["eye"], axis=1)
    assert arrays["focus_m"] == pytest.approx(expected)
    assert set(arrays["aperture"]) == {2.0}


def test_a_still_camera_turns_its_ring_only_where_its_subject_would_blur(film):
    film.shot(still((0, -2, 0.1), "post", focus="ball", aperture=16.0), until=0.3)
    film.shot(follow("ball", focus="post", aperture=16.0), until=0.6)
    _, arrays = described(film)
    away = np.hypot(arrays["time"][:7], 2.0)
    assert np.ptp(arrays["focus_m"][:7]) == 0 and away.min() < arrays["focus_m"][0] < away.max()
    assert np.ptp(arrays["focus_m"][8:]) > 0, "a camera that moves draws all anew anyway"


def test_a_way_passes_through_its_points_with_a_gentle_start_and_end(film):
    points = [(0, -3, 1), (1, -2, 1), (3, -3, 2)]
    film.shot(along(points, "ball"), until=2.0)
    _, arrays = described(film)
    for point in points:
        assert np.linalg.norm(arrays["eye"] - point, axis=1).min() < 0.08
    way = np.linalg.norm(np.diff(arrays["eye"], axis=0), axis=1)
    assert max(way[0], way[-1]) < 0.02 * way.max()


def test_a_rider_looks_where_the_body_goes(film):
    film.shot(ride("ball", seat=(-1, 0, 0.5)), until=2.0)
    _, arrays = described(film)
    assert (arrays["target"] - arrays["eye"]) == pytest.approx(np.tile([1.0, 0, 0], (48, 1)))


def test_a_wide_camera_holds_the_whole_way(film):
    film.shot(wide(), until=3.0)
    _, arrays = described(film)
    for frame in (0, len(arrays["time"]) - 1):
        eye, target = arrays["eye"][frame], arrays["target"][frame]
        forward = (target - eye) / np.linalg.norm(target - eye)
        right = np.cross(forward, [0, 0, 1.0])
        right /= np.linalg.norm(right)
        up = np.cross(right, forward)
        tangent = np.tan(np.radians(arrays["fovy_deg"][frame]) / 2)
        for at in (0.0, 3.0):
            way = film.recorded.position("ball", at) - eye
            assert abs(way @ right) < way @ forward * tangent * 16 / 9
            assert abs(way @ up) < way @ forward * tangent


def test_a_film_without_a_shot_tells_the_event_by_itself(film):
    facts, arrays = described(film)
    assert len(facts["shots"]) == 1, "nothing happens on an even way that is worth seeing twice"
    assert arrays["time"][0] == 0.0
    assert arrays["time"].max() == pytest.approx(3.0, abs=0.09)


def test_a_lens_zooms_gently():
    assert between((24, 48), np.array([0.0, 0.5, 1.0])).tolist() == [24.0, 36.0, 48.0]
    assert fovy_deg(50.0) == pytest.approx(22.9, abs=0.05)


@pytest.mark.parametrize("name", MOODS)
def test_every_mood_can_be_told(film, name):
    film.mood(name)
    facts, _ = described(film)
    assert any("sky_zenith" in told for told in facts["air"])


def test_what_grows_is_one_mesh_that_keeps_clear(film):
    film.grass(area=(-1, -1, 1, 1), height=0.2, count=500, clear_of=[(0, 0, 0.5)])
    facts, arrays = described(film)
    points = arrays[facts["things"][0]["vertices"]].reshape(-1, 5, 3)
    feet = points[:, :2, :2].mean(axis=1)
    assert np.hypot(*feet.T).min() > 0.49
    assert 0.05 < points[..., 2].max() <= 0.2


def test_leaves_rock_as_they_fall_lie_level_at_rest_and_a_moment_looks_the_same_twice() -> None:
    times = np.array([*np.linspace(0, 2, 81), *np.linspace(0.5, 1.0, 21), 1.0, 1.0])
    height = np.maximum(1.0 - times, 0.0)[:, None, None]
    found = fluttering.turns(np.concatenate([0 * height, 0 * height, height], axis=2), times, 0.05)
    assert found.shape == (len(times), 1, 4) and np.allclose(np.linalg.norm(found, axis=2), 1)
    level = turning.matrices(found)[:, 0, 2, 2]
    assert level[:40].min() < 0.8 and np.allclose(level[45:81], 1)
    assert np.allclose(found[81], found[20]) and np.allclose(found[-3:], found[40])


def test_particles_have_a_place_in_every_frame(film):
    film.shot(wide(), until=1.0)
    film.particles("sparks", lambda times: (np.zeros((len(times), 3, 3)), np.full((len(times), 3), 0.01)))
    facts, arrays = described(film)
    assert arrays[facts["things"][0]["ways"]].shape == (24, 3, 3)


def test_touches_are_told_with_their_bodies():
    arrays = {name: value for name, value in vars(rehearsal()).items() if name == "time"}
    assert arrays["time"][-1] == 3.0
    assert rehearsal().touches() == []
    assert rehearsal().event() <= 3.0


REFUSED = {
    "no body is called": lambda f: f.shot(follow("bal"), until=1.0) or f.description(),
    "shows nothing": lambda f: f.shot(wide(), until=1.0, start=2.0),
    "a speed lies between": lambda f: f.shot(wide(), until=1.0, speed=0.0),
    "the plan has no camera": lambda f: f.shot(planned("side"), until=1.0),
    "a shot needs a camera": lambda f: f.shot("side", until=1.0),
    "no mood is called": lambda f: f.mood("sunny"),
    "a colour is written": lambda f: f.light(colour="red"),
    "no look is called 'gould'": lambda f: f.look("ball", "gould"),
    "needs a name of its own": lambda f: [f.draw("a", "box", 1.0), f.draw("a", "box", 1.0)],
    "there is no shape": lambda f: f.draw("a", "cone", 1.0),
    "belongs to no body": lambda f: f.mesh("a", np.eye(4)[:, :3], [[0, 1, 2]], instead=True),
    "a caption has words": lambda f: f.caption(" "),
    "fill lies between 0 and 10, got -1": lambda f: f.light(fill=-1),
    "from -1 s on": lambda f: f.caption("a", start=-1.0),
    "from nan s on": lambda f: f.caption("a", start=NAN),
    "for inf s": lambda f: f.caption("a", seconds=INF),
    "for 0 s": lambda f: f.caption("a", seconds=0.0),
    "fog needs a visibility": lambda f: f.fog(visibility_m=0),
    "lens_mm must lie": lambda f: f.shot(wide(lens_mm=2), until=1.0),
    "stands where it looks": lambda f: f.shot(still((1, 1, 1), (1, 1, 1)), until=1.0) or f.description(),
    "roll_deg is a number or a pair of numbers, not": lambda f: (
        f.shot(wide(roll_deg=np.nan), until=1.0) or f.description()
    ),
    "focus is a body's name or a distance above 0 m or a point": lambda f: (
        f.shot(wide(focus=np.inf), until=1.0) or f.description()
    ),
    "shake is a number, not nan": lambda f: f.shot(wide(shake=np.nan), until=1.0) or f.description(),
    "numbers, none below 0": lambda f: (
        f.particles("p", lambda t: (np.zeros((len(t), 1, 3)), np.full((len(t), 1), np.inf))) or f.description()
    ),
    "must be": lambda f: f.particles("p", lambda times: np.zeros(3)) or f.description(),
    "balls or leaves": lambda f: f.particles("p", lambda times: np.zeros((len(times), 1, 3)), shape="cube"),
    "all of one size": lambda f: (
        f.particles("p", lambda t: (np.zeros((len(t), 1, 3)), np.ones((len(t), 1))), shape="leaf") or f.description()
    ),
    "a picture is uint8": lambda f: Surface(picture=np.zeros((4, 4, 3))),
}


NAN, INF = float("nan"), float("inf")
NO_NUMBERS = [
    ("light", {"softness_deg": NAN}), ("light", {"fill": INF}), ("light", {"elevation_deg": 40, "at": NAN}), ("light", {"strength": -1}),
    ("light", {"elevation_deg": 40, "at": -1.0}), ("sky", {"zenith": "#000000", "horizon": "#000000", "glow": NAN}), ("fog", {"visibility_m": NAN}),
    ("fog", {"visibility_m": 1e-3}), ("grade", {"fade": 2.0}), ("gobo", {"softness_deg": NAN}), ("label", {"text": "a", "pos": (NAN, 0, 0)}),
    ("label", {"text": "a", "pos": (0, 0, 0), "facing_deg": INF}), ("label", {"text": "a", "pos": (0, 0, 0), "height": 1e300}),
    ("label", {"text": "a", "pos": None}), ("draw", {"name": "a", "shape": "box", "size": 1.0, "pos": NAN}),
    ("draw", {"name": "a", "shape": "box", "size": -1.0}), ("draw", {"name": "a", "shape": "box", "size": 1.0, "quat": (0, 0, 0, 0)}),
    ("grass", {"area": (0, 0, 1, 1), "height": NAN}), ("tree", {"name": "a", "at": [(0, 0)], "height": INF}), ("lamp", {"name": "a", "pos": (0, 0, 1e9)}), ("panel", {"name": "a", "pos": (0, 0, 1e9), "size": (1, 1), "towards": (0, 0, 0)}),
    ("breeze", {"speed": 3.0, "towards_deg": NAN}), ("mesh", {"name": "a", "vertices": np.eye(4)[:, :3], "faces": [[0, 1, 2]], "uv": np.full((4, 2), NAN)}),
]  # fmt: skip


@pytest.mark.parametrize(
    ("word", "given"), NO_NUMBERS, ids=lambda one: one if isinstance(one, str) else str(list(one.items())[-1])[:40]
)
def test_a_number_that_nothing_can_have_is_refused_where_it_is_said(film, word, given):
    with pytest.raises(ProgramError) as refused:
        getattr(film, word)(**given)
    assert refused.value.place == "film.py"


@pytest.mark.parametrize("odd", [{"glow": NAN}, {"glow": -1.0}, {"tile_m": 0.0}, {"tile_m": NAN}])
def test_a_surface_glows_and_repeats_with_numbers(odd):
    with pytest.raises(ProgramError, match="a surface glows"):
        Surface(**odd)


@pytest.mark.parametrize("words", REFUSED)
def test_what_cannot_be_shown_is_refused(film, words):
    with pytest.raises(ProgramError, match=words):
        REFUSED[words](film)


MISUSED = [
    ("label", {"text": 3, "pos": (0, 0, 0)}), ("label", {"text": "a", "pos": (0, 0, 0), "height": "x"}),
    ("label", {"text": "a", "pos": (0, 0, 0), "facing_deg": None}), ("label", {"text": "a", "pos": (0, 0, 0), "to": None}),
    ("label", {"text": "a", "pos": (0, 0, 0), "name": 3}), ("draw", {"name": "a", "shape": "box", "size": None}),
    ("draw", {"name": "a", "shape": "box", "size": 1.0, "to": 3}), ("draw", {"name": "a", "shape": "box", "size": 1.0, "look": 3}),
    ("caption", {"text": 3}), ("caption", {"text": "a", "seconds": "x"}), ("shutter", {"share": "x"}), ("light", {"fill": "x"}),
    ("set", {"name": "park", "seed": np.nan}), ("set", {"name": "park", "seed": None}), ("set", {"name": "park", "facing_deg": None}),
    ("grass", {"area": (0, 0, 1, 1), "seed": 1.5}), ("mood", {"name": []}), ("shot", {"camera": wide(), "until": None}),
    ("light", {"hue": 3}), ("light", {"strength": [1.0, 2.0]}), ("sky", {"zenith": "#000000", "horizon": "#000000", "glow": []}),
    ("particles", {"name": "p", "at": 3.0}), ("look", {"name": 3, "look": "gold"}),
]  # fmt: skip


@pytest.mark.parametrize(
    ("word", "given"), MISUSED, ids=lambda one: one if isinstance(one, str) else str(list(one.items())[-1])
)
def test_what_is_given_wrongly_is_refused_where_it_is_said(film, word, given):
    with pytest.raises(ProgramError) as refused:
        getattr(film, word)(**given)
    assert refused.value.place == "film.py"


def test_what_an_author_s_own_function_does_wrong_stays_its_own(tmp_path):
    program = tmp_path / "film.py"
    program.write_text("def height(x, y):\n    raise ValueError('no ground')\n")
    height = runpy.run_path(str(program))["height"]
    with pytest.raises(ValueError, match="no ground"):
        Film(rehearsal()).grass(area=(0, 0, 1, 1), z=height)


def motion_file(tmp_path):
    seen = rehearsal()
    nothing = np.zeros(0)
    np.savez(
        tmp_path / "motion.npz", time=seen.time, pos=seen._pos, quat=seen._quat, middle=seen._middle, half=seen._half,
        bodies=np.array(seen.bodies), cameras=np.array(["side"]), movers=np.array(["ball"]), fps=24, size=[64, 36], floor_z=0.0,
        touch_time=nothing, touch_a=nothing, touch_b=nothing, touch_force=nothing,
    )  # fmt: skip
    return tmp_path / "motion.npz"


def test_a_film_is_described_in_a_process_of_its_own(tmp_path):
    (tmp_path / "film.py").write_text(
        "from worldkit.filming import Film, follow\ndef film(film: Film):\n    film.shot(follow('ball'), until=1.0)\n"
    )
    words = [str(tmp_path / "film.py"), "--motion", str(motion_file(tmp_path)), "--out", str(tmp_path)]
    assert telling.main(words) == 0
    assert json.loads((tmp_path / "film.json").read_text())["shots"][0]["frames"] == 24
    with np.load(tmp_path / "film.npz", allow_pickle=False) as arrays:
        assert arrays["eye"].shape == (24, 3)


def test_a_film_that_fails_names_its_line(tmp_path):
    (tmp_path / "film.py").write_text(
        "from worldkit.filming import Film, follow\n\n\ndef film(film: Film):\n    film.shot(follow('bell'), until=1.0)\n"
    )
    words = [str(tmp_path / "film.py"), "--motion", str(motion_file(tmp_path)), "--out", str(tmp_path)]
    assert telling.main(words) == 1
    error = json.loads((tmp_path / "error.json").read_text())
    assert error["line"] == 5
    assert "ball" in error["next_move"]


HILL = np.array([(-2, -2, 0), (2, -2, 1), (-2, 2, 0), (2, 2, 1)], float), np.array([(0, 1, 2), (1, 3, 2)])


@pytest.fixture
def on_hill():
    ways = {"ball": np.hstack([T, 0 * T, 0.1 + 0 * T]), "hill": np.zeros((301, 3))}
    return Film(Recorded.rehearsal(ways, duration=3.0, ground={"hill": HILL}))


@pytest.mark.parametrize("z", ["hill", lambda x, y: 0.5 + x / 4])
def test_grass_stands_on_a_hill_or_on_a_function(on_hill, z):
    on_hill.grass(area=(-2, -2, 2, 2), count=500, height=0.2, z=z)
    _, arrays = described(on_hill)
    feet = arrays["vertices0"].reshape(-1, 5, 3)[:, :2]
    assert len(feet) == 500
    middle = feet.mean(axis=1)
    assert middle[:, 2] == pytest.approx(0.5 + middle[:, 0] / 4 - 0.002, abs=1e-5)


def test_grass_grows_only_where_there_is_ground(on_hill):
    on_hill.grass(area=(-2, -2, 6, 2), count=400, z="hill")
    _, arrays = described(on_hill)
    feet = arrays["vertices0"].reshape(-1, 5, 3)[:, :2].mean(axis=1)
    assert 150 < len(feet) < 250 and feet[:, 0].max() < 2.01
    with pytest.raises(ProgramError, match="no blade"):
        on_hill.grass("more", area=(3, -2, 6, 2), z="hill")
    with pytest.raises(ProgramError, match="nothing that stands still") as told:
        on_hill.grass("more", area=(3, -2, 6, 2), z="hil")
    assert "hill" in str(told.value.remedy if hasattr(told.value, "remedy") else told.value)


@pytest.mark.parametrize("kind", ["conifer", "broadleaf"])
def test_trees_keep_their_budget_stand_on_the_ground_and_are_the_same_again(on_hill, kind):
    on_hill.tree("wood", kind, at=[(-1, 0), (1.5, 1)], height=4, z="hill")
    facts, arrays = described(on_hill)
    assert [thing["name"] for thing in facts["things"]] == ["wood", "wood (leaves)"]
    assert len(arrays["faces0"]) + len(arrays["faces1"]) <= 2 * 6000
    feet = [arrays["vertices0"][np.abs(arrays["vertices0"][:, 0] - x) < 0.5][:, 2].min() for x in (-1, 1.5)]
    assert feet == pytest.approx([0.25 - 0.02, 0.875 - 0.02], abs=0.1)
    assert 0.8 * 4 + 0.8 < arrays["vertices1"][:, 2].max() < 1.1 * 4 + 1.2
    again = Film(on_hill.recorded)
    again.tree("wood", kind, at=[(-1, 0), (1.5, 1)], height=4, z="hill")
    assert (again.description()[1]["vertices1"] == arrays["vertices1"]).all()
    with pytest.raises(ProgramError, match="beside its ground"):
        on_hill.tree("more", kind, at=[(5, 0)], z="hill")
    with pytest.raises(ProgramError, match="conifer or broadleaf"):
        on_hill.tree("more", "baobab", at=[(0, 0)])


def test_a_limb_is_one_tapered_skin_over_a_chain_each_piece_fixed_to_its_body():
    slant = np.array([-0.5, 0.0, 0.8])
    ways = {f"branch_{k + 1}": np.tile([1.0, 2.0, 0.5] + 0.12 * k * slant, (8, 1)) for k in range(3)}
    film = Film(Recorded.rehearsal(ways, duration=1.0, radius=0.06))
    film.limb("branch", list(ways), (0.02, 0.008), twigs=2, leaf=sculpt.leaf(0.05, 0.03, veins=0))
    facts, arrays = film.description()
    things = {thing["name"]: thing for thing in facts["things"]}
    assert [thing["to"] for name, thing in things.items() if name[-1].isdigit()] == list(ways)
    assert {f"branch 2 {part}" for part in ("twigs", "leaves")} <= set(things) and not things["branch 2 twigs"][
        "instead"
    ]
    placed = [arrays[things[f"branch {k + 1}"]["vertices"]] + ways[f"branch_{k + 1}"][0] for k in range(3)]
    for one, other in itertools.pairwise(placed):  # at the start the pieces share the rings around each joint
        shared = sum(np.isclose(one, point, atol=1e-6).all(axis=1).any() for point in other)
        assert shared == 3 * 14
    thick = [np.linalg.norm(np.ptp(points, axis=0)[1]) for points in placed]
    assert 0.02 + 1e-6 >= thick[0] > thick[1] > thick[2] >= 0.008 - 1e-6
    for bodies, sizes in (
        (["branch_1"], (0.02, 0.01)),
        (["branch_1", "branch_1"], (0.02, 0.01)),
        (list(ways), (0.02, 0)),
    ):
        with pytest.raises(ProgramError, match="is no chain"):
            film.limb("bad", bodies, sizes)
    film.recorded.sized = True  # of bodies whose sizes are known, it is told where film.py draws it
    with pytest.raises(ProgramError, match=r"'bad 1' is \[.*\] times the size of 'branch_1'"):
        film.limb("bad", list(ways), (0.02, 0.008))


@pytest.mark.parametrize("smooth", [0.5, 3.5, "very", float("nan")])
def test_a_surface_is_once_to_three_times_as_smooth(smooth):
    film = Film(Recorded.rehearsal({"drop_1": [[0.0, 0, 0], [0.0, 0, 0]]}, duration=1.0))
    with pytest.raises(ProgramError, match="smooth"):
        film.surface("honey", of="drop_1", look="honey", smooth=smooth)
    film.surface("honey", of="drop_1", look="honey", smooth=2)
    assert film._surfaces[0]["smooth"] == 2.0


def test_the_bulb_of_a_lamp_may_be_left_unseen_as_a_panel_may() -> None:
    film = Film(Recorded.rehearsal({"ball": np.zeros((4, 3))}, duration=1.0))
    film.lamp("bulb", (0, 0, 1), radius=0.05)
    film.lamp("fill", (1, 0, 1), radius=0.05, seen=False)
    facts, _ = film.description()
    assert [thing["name"] for thing in facts["things"]] == ["bulb"]
    assert [lamp["name"] for lamp in facts["lamps"]] == ["bulb", "fill"]
