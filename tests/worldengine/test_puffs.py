"""Puffs over a picture: soft, hidden by what stands before them, as bright as the light that comes through to them."""

from types import SimpleNamespace

import numpy as np
import pytest

from worldengine.film import directed, puffs, stand_ins, thick_puffs
from worldengine.film.renderers.preview.eye import View
from worldengine.film.treatment import Treatment

HEIGHT, WIDTH = 120, 160
VIEW = View(np.zeros(3), np.array([[1.0, 0, 0], [0, 0, -1.0], [0, 1.0, 0]]).T, (WIDTH / HEIGHT * 0.5, 0.5))
"""From the origin towards +y, z up."""
SUN = Treatment(light_azimuth_deg=0.0, light_elevation_deg=80.0)


def drawn(places, wide=0.4, opaque=0.5, wall_m=9.0, half_m=9.0):
    axes = np.stack([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]], axis=1)
    view = View(VIEW.eye, axes, VIEW.tangents)
    depth = np.full((HEIGHT, WIDTH), wall_m, np.float32)
    depth[:, : WIDTH // 2] = half_m
    count = len(places)
    arrays = {
        "p": np.array([places], np.float32),
        "w": np.full((1, count), wide, np.float32),
        "o": np.full((1, count), opaque, np.float32),
    }
    row = {"name": "mist", "rgb": (1.0, 1.0, 1.0), "places": "p", "wide": "w", "opaque": "o"}
    before = np.full((HEIGHT, WIDTH, 3), 40, np.uint8)
    return puffs.over(before, arrays, (row,), 0, SimpleNamespace(view=view, depth=depth), SUN).astype(float) - before


def test_one_is_brightest_in_its_middle_fades_evenly_and_is_nowhere_else() -> None:
    added = drawn([(0.0, 2.0, 0.0)])[:, :, 1]
    middle = added[HEIGHT // 2, WIDTH // 2]
    row = added[HEIGHT // 2, WIDTH // 2 :]
    assert middle > 8 and np.unravel_index(added.argmax(), added.shape)[0] in range(HEIGHT // 2 - 3, HEIGHT // 2 + 3)
    assert (np.diff(row) <= 1).all() and np.abs(np.diff(row)).max() < 0.35 * middle
    assert added[:10].max() == 0 and added[:, :10].max() == 0


def test_what_stands_before_it_hides_it() -> None:
    added = drawn([(0.0, 2.0, 0.0)], half_m=1.0)[:, :, 1]
    assert added[:, : WIDTH // 2 - 2].max() == 0 and added[:, WIDTH // 2 + 2 :].max() > 8


def test_a_cloud_is_dark_where_no_light_comes_through() -> None:
    rng = np.random.default_rng(0)
    cloud = rng.uniform((-0.3, 2.0, -0.5), (0.3, 2.6, 0.5), (1500, 3))
    added = drawn(cloud, wide=0.2, opaque=0.3)[:, :, 1]
    lit, shaded = added[25:45, 70:90].mean(), added[75:95, 70:90].mean()
    assert lit > shaded + 3


def test_many_cost_what_they_cover() -> None:
    rng = np.random.default_rng(1)
    added = drawn(rng.uniform((-1, 2, -1), (1, 4, 1), (20_000, 3)), wide=0.05, opaque=0.05)
    assert added.max() > 5


def test_what_is_at_one_edge_shades_nothing_at_the_other() -> None:
    columns = np.array([(x, 0.0, float(z)) for x in (0.0, 10.0) for z in range(2)])
    up = np.array([0.0, 0.0, 1.0])
    thin, thick = (puffs._lit(columns, np.ones(4), np.array([0.1, 0.1, 0.1, far]), up)[0] for far in (0.1, 0.98))
    assert thin == thick


def test_where_nothing_says_how_far_away_things_are_they_are_left_out_and_that_is_told(monkeypatch) -> None:
    film = SimpleNamespace(puffs=("mist",), treatments=SimpleNamespace(at=lambda at: SUN), captions=())
    screening = directed.Screening.__new__(directed.Screening)
    screening.film, screening.fps, screening.puffless, asked = film, 24, "", []
    screening.words = lambda frame: ()

    def surfaces(frame):
        asked.append(frame)
        raise RuntimeError("no context")

    screening.surfaces = surfaces
    monkeypatch.setattr(directed, "letter", lambda image, *words: image)
    assert [screening.lettered(frame, "plain") for frame in (0, 1)] == ["plain", "plain"]
    assert asked == [0] and screening.puffless == "RuntimeError: no context"


def cloud(places, wide, opaque):
    """One kind of puffs in one frame."""
    count = len(places)
    arrays = {"p": np.array([places], np.float32), "w": np.full((1, count), wide), "o": np.full((1, count), opaque)}
    return {"name": "mist", "rgb": (1, 1, 1), "places": "p", "wide": "w", "opaque": "o"}, arrays


def test_what_puffs_hide_half_of_is_behind_them() -> None:
    eye, ball = np.zeros(3), np.array([0.0, 4.0, 0.0])
    for places, opaque, hides in (
        ([(0, 2, 0)], 0.6, True),
        ([(0, 2, 0)], 0.4, False),
        ([(0, 2, 0), (0, 3, 0)], 0.4, True),  # two of them let 0.36 through
        ([(0, 5, 0)], 0.9, False),  # behind the ball
        ([(0, -2, 0)], 0.9, False),  # behind the eye
        ([(0.5, 2, 0)], 0.9, False),  # aside
    ):
        one, arrays = cloud(places, 0.4, opaque)
        assert thick_puffs.before((one,), arrays, 0, eye, ball) == ("mist" if hides else "")
    assert thick_puffs.before((), {}, 0, eye, ball) == ""


def test_thick_puffs_are_told_as_large_as_a_mover_and_thin_ones_are_not() -> None:
    boxed = {
        "name": "skin",
        "body": "ball",
        "type": "sphere",
        "aabb": [0, 0, 0, 0.1, 0.1, 0.1],
        "pos": [0, 0, 0],
        "quat": [1, 0, 0, 0],
    }
    recording = SimpleNamespace(
        meta={"movers": ["ball"], "geoms": [boxed], "movements": {}}, names=["ball"], time=np.zeros(2),
        pos=np.zeros((2, 1, 3)), quat=np.tile((1.0, 0, 0, 0), (2, 1, 1)),
    )  # fmt: skip
    row = [(0.1 * n, 0.0, 0.0) for n in range(2)]
    for places, opaque, told in ((row, 0.7, True), (row, 0.2, False), (row * 8, 0.2, True)):
        one, arrays = cloud(places, 0.15, opaque)
        (found,) = stand_ins.of_puffs((one,), arrays, recording)
        assert ("as large as ball" in found.get("like", "")) == told, (opaque, len(places))
        film = SimpleNamespace(things=(), puffs=(found,), arrays=arrays)
        assert stand_ins.words(film, 0) == ("drawn: mist" if told else "")


@pytest.mark.parametrize("eddies_m", [-1.0, np.nan, np.inf])
def test_eddies_of_no_size_are_refused(eddies_m: float) -> None:
    one, arrays = cloud([(0, 2, 0)], 0.1, 0.5)
    assert puffs.check({"puffs": [one | {"eddies_m": 0.1}]}, arrays, 1)[0]["eddies_m"] == 0.1
    with pytest.raises(ValueError, match="none that can be drawn"):
        puffs.check({"puffs": [one | {"eddies_m": eddies_m}]}, arrays, 1)


def test_beside_them_a_picture_of_every_shade_stays_as_it_is_and_is_not_written_into() -> None:
    axes = np.stack([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]], axis=1)
    shown = SimpleNamespace(view=View(VIEW.eye, axes, VIEW.tangents), depth=np.full((HEIGHT, WIDTH), 9.0, np.float32))
    before = np.resize(np.arange(256, dtype=np.uint8), (HEIGHT, WIDTH, 3))
    before.flags.writeable = False  # as a frame is that another process drew
    row, arrays = cloud([(-0.5, 2, 0), (0.4, 3, 0.3)], 0.3, 0.4)
    after = puffs.over(before, arrays, (row,), 0, shown, SUN)
    changed = (after != before).any(axis=2)
    assert 200 < changed.sum() < HEIGHT * WIDTH / 3 and changed[:, 90:].any() and changed[:, :60].any()
    light = (before.astype(np.float32) / 255.0) ** 2.2
    assert np.array_equal(np.rint(255 * light ** (1 / 2.2)).astype(np.uint8), before), "what is raised comes back"
