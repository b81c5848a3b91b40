"""Slides before the key light: their pictures, where they lie, and that both renderers throw the same shadow."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from worldengine.film import gobos
from worldengine.film.drawn_frames import Frames
from worldengine.film.gobos import Gobo
from worldengine.film.renderers.preview.lighting import relight
from worldengine.film.treatment import Treatment
from worldkit import scene
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded
from worldkit.filming.film_bounds import GOBOS
from worldkit.settings import OUTDOOR, ROOM

WAY = np.array(ROOM.key.direction)


@pytest.mark.parametrize("kind", GOBOS)
def test_a_slide_lets_some_light_through_and_all_at_its_edges(kind):
    share = gobos.slide(kind, 3, 0.02)
    assert share.shape == (gobos.PIXELS, gobos.PIXELS) and share.min() >= 0 and share.max() <= 1
    middle = share[256:-256, 256:-256]
    assert 0.1 < (middle < 0.3).mean() < 0.7 and 0.15 < (middle > 0.7).mean() < 0.9
    assert min(share[0].min(), share[-1].min(), share[:, 0].min(), share[:, -1].min()) == 1.0
    gobos.slide.cache_clear()
    assert np.array_equal(share, gobos.slide(kind, 3, 0.02)), "one seed, one picture"


def test_softer_light_softens_the_pattern():
    steep = [np.abs(np.diff(gobos.slide("window", 1, spread), axis=1)).max() for spread in (0.005, 0.05, 0.15)]
    assert steep[0] > 2 * steep[1] > 4 * steep[2]


def test_the_middle_of_the_pattern_lies_on_the_light_s_way_to_its_point():
    gobo = Gobo("window", 0.5, 20.0, 1, (0.3, -0.2, 0.7))
    across = gobo.across(WAY)

    def at(point):
        return across[:, :3] @ point + across[:, 3]

    for away in (-2.0, 0.0, 1.0):
        assert np.allclose(at(np.array(gobo.at) + away * WAY), (0, 0, -away), atol=1e-9)
    axes = across[:, :3] * np.array([[2.0], [2.0], [1.0]])  # its reach is two metres
    assert np.allclose(axes @ axes.T, np.eye(3), atol=1e-9)


def rehearsed() -> Film:
    t = np.linspace(0.0, 1.0, 30)[:, None]
    return Film(Recorded.rehearsal({"ball": np.hstack([t - 0.5, 0 * t, 0.3 + 0 * t])}, duration=1.0, radius=0.1))


def test_it_finds_its_place_and_size_by_the_action():
    film = rehearsed()
    film.gobo("blinds", softness_deg=0.8)
    facts, _ = film.description()
    told = facts["gobo"]
    assert told["kind"] == "blinds" and 1.0 < told["size_m"] < 1.6 and np.allclose(told["at"][:2], 0, atol=0.05)
    assert 0.1 < told["at"][2] < 0.3 and facts["air"][-1]["light_softness_deg"] == 0.8
    assert "gobo" not in rehearsed().description()[0], "a film without one is the film that it was"


@pytest.mark.parametrize(
    "words",
    [
        {"kind": "moon"},
        {"size": 0.0},
        {"size": np.nan},
        {"size": "x"},
        {"at": (0.0, 1.0)},
        {"at": 3.0},
        {"at": (0.0, 0.0, 1e6)},
        {"turn_deg": np.inf},
        {"turn_deg": None},
        {"turn_deg": 2**70},
        {"turn_deg": 1e300},
        {"seed": -1},
        {"seed": np.inf},
        {"seed": np.nan},
        {"seed": None},
        {"seed": "x"},
        {"seed": 1.9},
        {"seed": 1 << 32},
    ],
    ids=str,
)
def test_what_no_slide_can_be_is_refused(words):
    with pytest.raises(ProgramError):
        rehearsed().gobo(**({"kind": "window"} | words))


ASKEW = Gobo("leaves", 0.5, 30.0, 1, (0.1, -0.2, 0.0))
"""It is like none of its mirror images."""


def through(gobo: Gobo, way: np.ndarray, spread: float, points: np.ndarray) -> np.ndarray:
    """The share of the light from a way that comes to points (..., 3): that of the slide, blurred a little, where it lies there."""
    cv2 = pytest.importorskip("cv2")
    across, picture = gobo.across(way), gobos.slide(gobo.kind, gobo.seed, spread)
    right, up = (points @ across[k, :3] + across[k, 3] for k in (0, 1))
    column, row = (((side + 1) * gobos.PIXELS - 1) / 2 for side in (right, -up))
    soft = cv2.GaussianBlur(np.array(picture), (0, 0), 8.0)
    found = cv2.remap(soft, column.astype(np.float32), row.astype(np.float32), cv2.INTER_LINEAR, borderValue=1.0)
    return np.asarray(found)


def alike(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.corrcoef(one.ravel(), other.ravel())[0, 1])


def test_traced_light_through_a_slide_is_as_strong_as_its_picture_and_the_light_beside_it_is_whole():
    mi = pytest.importorskip("mitsuba")
    from worldengine.film.renderers.traced import daylight, variant

    variant.choose()
    lights = daylight.key_lights(ROOM, np.zeros(3), 2.0, ASKEW)
    # A white board that faces the light, seen from there.
    aim, wide, side = mi.ScalarTransform4f().look_at, 3.0, 48
    face = aim(origin=[0, 0, 0], target=WAY.tolist(), up=[0, 0, 1])
    white = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [1.0, 1.0, 1.0]}}
    board = {"type": "rectangle", "to_world": face @ mi.ScalarTransform4f().scale(8.0), "bsdf": white}
    lit = mi.load_dict({"type": "scene", **lights, "board": board})
    film = {"type": "hdrfilm", "width": side, "height": side, "rfilter": {"type": "box"}}
    eye = aim(origin=(5 * WAY).tolist(), target=[0, 0, 0], up=[0, 0, 1]) @ mi.ScalarTransform4f().scale([wide, wide, 1])
    sensor = mi.load_dict({"type": "orthographic", "to_world": eye, "film": film})
    seen = np.array(mi.render(lit, sensor=sensor, integrator=mi.load_dict({"type": "direct"}), spp=128))
    got = seen[..., 1] / ROOM.key.colour[1]
    corner, right, down = (
        np.array(sensor.sample_ray(0.0, 0.5, mi.Point2f(x, y), mi.Point2f(0.5, 0.5))[0].o, dtype=float).ravel()
        for x, y in ((0, 0), (1, 0), (0, 1))
    )
    share = ((np.arange(side) + 0.5) / side)[:, None]
    places = corner + share * (right - corner) + (share * (down - corner))[:, None]
    wanted = through(ASKEW, WAY, ROOM.key_spread, places - (places @ WAY)[..., None] * WAY)
    inner = np.s_[8:40, 8:40]  # 4 m of the 6 that are seen
    assert alike(got[inner], wanted[inner]) > 0.9 and got[inner].mean() == pytest.approx(wanted[inner].mean(), abs=0.05)
    assert alike(got[inner], wanted[inner][:, ::-1]) < 0.6, "nor is it its mirror image"
    assert np.concatenate([got[:5], got[-5:]]).mean() == pytest.approx(1.0, abs=0.06), "beside the slide"


@pytest.mark.gl
def test_the_preview_throws_the_same_pattern_at_the_same_place():
    spec = scene.new("yard", time_step=0.002, setting="outdoor", floor="plastic_white")
    spec.worldbody.add_camera(name="above", pos=(0, 0, 5.0), xyaxes=(1, 0, 0, 0, 1, 0), fovy=40)
    model = spec.compile()
    data, camera = mujoco.MjData(model), model.camera("above").id
    mujoco.mj_forward(model, data)
    told = Treatment(light_azimuth_deg=20.0, light_elevation_deg=50.0, light_softness_deg=0.8, light_gobo=ASKEW)
    pictures = []
    with Frames(model, 96, 54, "preview") as frames:
        for treatment in (told, replace(told, light_gobo=None)):
            frames.treat(treatment)
            pictures.append(frames.image(data, camera, "still").astype(float).mean(axis=-1))
        assert frames.renderer == "preview", frames.reason
    lit = relight(OUTDOOR, told)
    x, y = ((np.arange(n) + 0.5) / n * 2 - 1 for n in (96, 54))
    reach = 5.0 * np.tan(np.radians(20.0))
    across, up = np.meshgrid(x * reach * 96 / 54, -y * reach)
    wanted = through(ASKEW, np.array(lit.key.direction), lit.key_spread, np.stack([across, up, 0 * up], axis=-1))
    got = pictures[0] / pictures[1]
    assert alike(got, wanted) > 0.9
    assert max(alike(got, wanted[:, ::-1]), alike(got, wanted[::-1])) < 0.5


@pytest.mark.parametrize("size", [0.1, 0.8])
def test_far_beyond_a_slide_all_the_ground_is_lit(size):
    """Seen from above, 100 m each way: every ninth of it is as bright as without a slide, which hides little of the middle one."""
    mi = pytest.importorskip("mitsuba")
    from worldengine.film.renderers.traced import daylight, variant

    variant.choose()
    wide = 100.0
    lights = daylight.key_lights(ROOM, np.zeros(3), 1.5, Gobo("leaves", size, 0.0, 1, (0.0, 0.0, 0.2)))
    white = {"type": "diffuse", "reflectance": {"type": "rgb", "value": [1.0, 1.0, 1.0]}}
    board = {"type": "rectangle", "to_world": mi.ScalarTransform4f().scale(4 * wide), "bsdf": white}
    lit = mi.load_dict({"type": "scene", **lights, "board": board})
    film = {"type": "hdrfilm", "width": 33, "height": 33, "rfilter": {"type": "box"}}
    eye = mi.ScalarTransform4f().look_at(origin=[0, 0, 100], target=[0, 0, 0], up=[0, 1, 0])
    sensor = {"type": "orthographic", "to_world": eye @ mi.ScalarTransform4f().scale([wide, wide, 1]), "film": film}
    seen = np.array(mi.render(lit, sensor=mi.load_dict(sensor), integrator=mi.load_dict({"type": "direct"}), spp=64))
    ninths = (seen[..., 1] / (ROOM.key.colour[1] * WAY[2])).reshape(3, 11, 3, 11).mean(axis=(1, 3))
    assert np.abs(ninths - 1).max() < 0.15


def test_rings_of_light_lie_within_each_other_and_reach_all_of_the_scene():
    from worldengine.film.renderers.traced.daylight import RING, rings

    for half, far in ((0.04, 1000.0), (0.4, 1000.0), (4.8, 1200.0), (400.0, 1000.0)):
        times = rings(half, far)
        assert far <= half * np.prod(times) < 2 * far and min(times) >= 2 and max(times) <= RING
    assert rings(2000.0, 1000.0) == []


@pytest.mark.parametrize(
    "wrong", [{"kind": "moon"}, {"size_m": float("nan")}, {"at": [0, 0]}, {"seed": -1}, {"turn_deg": 1e9}]
)
def test_a_description_of_no_slide_is_refused(wrong):
    good = {"kind": "window", "size_m": 1.0, "turn_deg": 0.0, "seed": 1, "at": [0, 0, 0]}
    assert gobos.told({"gobo": good}) == Gobo("window", 1.0, 0.0, 1, (0.0, 0.0, 0.0)) and gobos.told({}) is None
    with pytest.raises(ValueError, match=r"pattern|unpack"):
        gobos.told({"gobo": good | wrong})
