"""The points of a law as a cloud: where they were recorded, from when they set out, soft and uneven."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from hung_springs import Springs, run, world
from small_worlds import lay_film
from worldengine.film import described, motion_facts, puffs, thick_puffs, wisps
from worldengine.film.described import FilmError
from worldengine.film.directed import Screening
from worldengine.film.dressed import HIDDEN_GROUP, dress
from worldengine.film.renderers.preview.eye import View
from worldengine.film.treatment import Treatment
from worldengine.inputs.declared_media import Medium
from worldkit import portable
from worldkit.filming import Film, Recorded, still


def drops() -> mujoco.MjSpec:
    spec = world()
    body = spec.worldbody.add_body(name="drops")
    for _ in range(3):
        body.add_geom(size=(0.02, 0, 0), contype=0, conaffinity=0)
    return spec


class Made:
    def __init__(self, folder):
        self.folder, law = folder, Springs()
        law.shown_by = "drops"
        row = Medium("springs", ("weight",), "drops", world=True)
        self.recording = run(folder / "trajectory", law, drops(), (row,))
        portable.write(drops(), folder / "world.mjz")
        motion_facts.write(self.recording, folder / "motion.npz", {"fps": 24, "size": [64, 36], "movers": ["weight"]})
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def film(self, change=None, **words):
        film = Film(self.seen)
        film.cloud("mist", of="springs", **words)
        film.shot(still((0, -2, 1), (0, 0, 1)), until=self.seen.duration)
        lay_film(self.folder, film, change)
        return described.read(self.folder, self.recording)


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return Made(tmp_path_factory.mktemp("wisps"))


def test_its_puffs_are_where_the_points_were_recorded_and_its_balls_are_not_drawn(made) -> None:
    film = made.film(diameter=(0.01, 0.011), life=9.0)
    (cloud,) = film.clouds
    at, wide, opaque = cloud.puffs(3)
    points = made.seen.points("springs", film.arrays["time"][3])
    near = np.linalg.norm(at[:, None] - points, axis=2).argmin(axis=1)
    assert set(near) == {0, 1, 2}
    assert np.linalg.norm(at - points[near], axis=1).max() < 0.012, "wisps keep to their puff"
    assert 0 < wide.max() < 0.01 and 0 < opaque.max() < 1
    again = cloud.puffs(3)
    assert all((one == other).all() for one, other in zip(again, (at, wide, opaque), strict=True))
    model = dress(made.folder / "world.mjz", film)
    drawn = model.geom_bodyid == model.body("drops").id
    assert drawn.sum() == 3 and (model.geom_group[drawn] == HIDDEN_GROUP).all()


def test_the_statement_says_of_which_law_it_is_and_the_picture_needs_no_mark(made) -> None:
    film = made.film(diameter=(0.5, 0.6), opacity=0.9, life=0.1)
    assert film.drawn_only() == [
        "mist (the points of the law springs as a cloud in place of drops, each until 0.1 s after it set out)"
    ]
    assert film.puffs == () and described.stand_ins.words(film, 1) == ""


def test_the_statement_says_when_it_comes_up_and_how_thick() -> None:
    ages = np.linspace(0.0, 1.5, 151)

    def said(opaque: np.ndarray) -> str:
        told = np.stack([ages, np.full(151, 0.4), opaque])
        return wisps.Cloud("mist", "drops", "springs", (1, 1, 1), told, np.zeros(0), None, np.zeros(1)).said()

    blinks = said(np.where((ages > 0.245) & (ages < 0.655), 1.0, 0.0))
    assert blinks.endswith("each from 0.25 to 0.65 s after it set out, thickest at 0.25 s, where each hides 100%)")
    assert said(np.where(ages < 0.245, 0.01, 0.9)).endswith(
        "when it sets out, thickest at 0.25 s, where each hides 90%)"
    )
    assert said(np.clip(ages / 0.06, 0.0, 1.0) * (1.5 - ages)).endswith("each until 1.5 s after it set out)")


def test_what_wisps_hide_half_of_is_behind_them() -> None:
    eye, ball = np.array([0.0, -2.0, 0.0]), np.zeros(3)
    for opaque, name in ((0.9, "steam"), (0.1, "")):
        wisp = ("steam", np.array([[0.0, -1.0, 0.0]]), np.array([0.1]), np.array([opaque]))
        assert thick_puffs.before((), {}, 0, eye, ball, (wisp,)) == name
    behind = ("steam", np.array([[0.0, 1.0, 0.0]]), np.array([0.1]), np.array([0.9]))
    assert thick_puffs.before((), {}, 0, eye, ball, (behind,)) == ""


def test_a_film_says_whom_a_cloud_hides(made, monkeypatch) -> None:
    monkeypatch.setitem(made.recording.meta, "movers", ["weight"])
    film = made.film(opacity=lambda age: 1.0 + 0 * age, diameter=lambda age: 1.5 + 0 * age)
    world, frame = made.folder / "world.mjz", film.frames - 1
    with Screening(world, portable.read(world), made.recording, film, (64, 36), 24) as screening:
        screening.placed(frame)
        assert "weight behind mist" in screening.hidden()


@pytest.mark.parametrize(
    "change",
    [
        lambda facts, arrays: facts["clouds"][0].update(of="weight"),
        lambda facts, arrays: facts["clouds"].append(facts["clouds"][0]),
        lambda facts, arrays: arrays["cloud0"].__imul__(-1),
        lambda facts, arrays: arrays.update(cloud0=np.ones((2, 4))),
        lambda facts, arrays: facts["surfaces"].append(
            {"name": "skin", "of": ["drops"], "look": "wax", "blended": False}
        ),
    ],
    ids=["a body of no law", "twice", "negative", "no table", "under a surface"],
)
def test_what_no_film_may_say_of_it_is_refused(made, change) -> None:
    with pytest.raises(FilmError, match="cloud"):
        made.film(change)


def test_a_point_that_waits_is_not_seen_until_it_sets_out() -> None:
    times = np.array([0.0, 0.1, 0.2, 0.3])
    places = np.zeros((4, 3, 3))
    places[1:, 0, 2] = 0.5
    places[3:, 1, 2] = 0.5
    assert wisps.set_out(times, places).tolist() == [0.0, 0.2, np.inf]
    assert wisps.set_out(np.zeros(0), np.zeros((0, 0, 3))).shape == (0,)
    laws = SimpleNamespace(points=lambda law, at: np.array([np.interp(t, times, range(4)) + places[0] for t in at]))
    ages = np.array([[0.0, 9.0], [0.1, 0.1], [0.5, 0.5]])
    began = wisps.set_out(times, places)
    cloud = wisps.Cloud("m", "b", "law", (1, 1, 1), ages, began, laws, np.array([0.1, 0.25]))
    assert [len(cloud.puffs(frame)[0]) / wisps.EACH for frame in (0, 1)] == [1, 2]
    nothing = wisps.Cloud("m", "b", "law", (1, 1, 1), ages, np.zeros(0), None, np.array([0.1]))
    assert [len(part) for part in nothing.puffs(0)] == [0, 0, 0], "a recording without its points"


def test_it_is_uneven_and_bright_where_a_smear_is_neither() -> None:
    """Before, a few wide puffs in a row ran into one smooth grey band."""
    height, width = 180, 240
    axes = np.stack([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]], axis=1)
    shown = SimpleNamespace(
        view=View(np.zeros(3), axes, (width / height * 0.5, 0.5)), depth=np.full((height, width), 9.0)
    )
    before, sun = np.full((height, width, 3), 40, np.uint8), Treatment(light_azimuth_deg=0.0, light_elevation_deg=60.0)
    count = 30
    places = np.stack([np.zeros(count), np.full(count, 2.0), np.linspace(-0.6, 0.6, count)], axis=1)
    wide, opaque = np.full(count, 0.4), np.full(count, 0.3)
    whole = (places, wide / 2, opaque)
    torn = wisps.spun(places, np.zeros((count, 3)), wide, opaque, np.ones(count), np.arange(count), count, 0.4)

    def middle(parts):
        cloud = SimpleNamespace(puffs=lambda frame: parts, rgb=(1.0, 1.0, 1.0))
        added = puffs.over(before, {}, (), 0, shown, sun, (cloud,)).astype(float)[:, :, 1] - 40
        return added[50:130, 110:130]

    smooth, uneven = middle(whole), middle(torn)
    assert uneven.std() > 3 * smooth.std()
    assert uneven.mean() > 0.6 * smooth.mean() and uneven.max() >= smooth.max()


def test_from_frame_to_frame_wisps_go_with_their_puff_and_do_not_tremble() -> None:
    count, random = 40, np.random.default_rng(2)
    places, way = random.uniform(-0.5, 0.5, (count, 3)), np.tile([0.0, 0.0, 0.3], (count, 1))
    wide, numbers = np.full(count, 0.1), np.arange(count)

    def at(seconds: float, wider: float) -> np.ndarray:
        found = places + seconds * way
        return wisps.spun(found, way, wide + wider, np.full(count, 0.3), 1.0 + seconds + 0 * wide, numbers, count, 0.1)[
            0
        ]

    gone = np.linalg.norm(at(1 / 24, 0.002) - at(0.0, 0.0), axis=1)
    assert gone.max() < 3 * 0.3 / 24


def test_what_an_emitter_gives_is_torn_to_wisps_but_for_what_is_too_many() -> None:
    few, many = (np.zeros((count, 3)) for count in (50, 20_000))
    at, radius, opaque = wisps.torn(few, np.full(50, 0.2), np.where(np.arange(50) < 25, 0.3, 0.0), 0.1)
    assert len(at) == len(radius) == len(opaque) == 25 * wisps.EACH and np.linalg.norm(at, axis=1).max() < 0.2
    assert wisps.torn(many, np.full(20_000, 0.2), np.full(20_000, 0.3), 0.1)[0] is many
    assert len(wisps.torn(few, np.zeros(50), np.zeros(50), 0.1)[0]) == 50
