"""What is around things in a traced picture: without edges of its own, however it lights them, and at one with the ground far away."""

import mujoco
import numpy as np
import pytest

from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.traced import darkroom, daylight, glimpses, variant
from worldengine.film.renderers.traced.walked import Rays
from worldengine.film.treatment import Treatment
from worldkit import scene
from worldkit.settings import OUTDOOR, STUDIO


def test_surroundings_are_looked_up_as_the_tracer_sees_them() -> None:
    variant.choose()
    import mitsuba as mi

    chance = np.random.default_rng(0)
    picture = chance.random((8, 16, 3)).astype(np.float32)
    ways = np.concatenate([chance.normal(size=(40, 3)), np.eye(3), -np.eye(3), [(1e-6, 1, 0), (-1e-6, 1, 0)]])
    ways /= np.linalg.norm(ways, axis=1, keepdims=True)
    there = mi.load_dict({"type": "scene", "around": daylight.environment(picture)}).environment()
    seen = []
    for way in ways:
        place = mi.SurfaceInteraction3f()
        place.wi = (-way).tolist()
        seen.append(np.array(there.eval(place)).ravel())
    assert np.abs(daylight.looked_up(picture, ways[None])[0] - seen).max() < 1e-3


@pytest.mark.parametrize(
    ("setting", "told"),
    [(STUDIO, Treatment()), (STUDIO, Treatment(fog_rgb=(0.3, 0.4, 0.5), fog_density=1.0)), (OUTDOOR, Treatment())],
    ids=["studio", "fog", "outdoor"],
)
def test_far_ground_that_covers_half_a_pixel_lets_no_light_of_its_own_through(setting, told) -> None:
    sky = np.full((1, 1, 3), 0.42, np.float32)
    half, ways = np.full((1, 1), 0.5), np.array([[(0.0, 1.0, 1e-4)]])
    world = darkroom.Scene(setting, np.zeros(3), 1.0, 0.0, 1.0, sky[0])
    found = [
        darkroom.air(
            0.5 * ground + 0.5 * sky, sky, np.array([[(0, 4000.0, 0)]]), half, np.array((0, 0, 1.0)), ways, world, told
        )
        for ground in (0.0, 1.0)
    ]
    left = 0.05 * 1.01 if setting is OUTDOOR else 1e-6  # a tenth of it comes through the haze
    assert np.abs(found[1] - found[0]).max() <= left


def test_only_what_lies_in_the_plane_of_the_key_light_is_taken_for_it() -> None:
    way = np.array(STUDIO.key.direction)
    beside = np.cross(way, (0, 0, 1.0))
    beside /= np.linalg.norm(beside)
    middle, radius = 30.0 * way, 9.0
    around = glimpses.Around(STUDIO, Treatment(), 4, 1, (middle, radius))
    places = np.array([[middle, middle + 8.9 * beside, middle - 8.0 * way, middle + 0.2 * way]], np.float32)
    blank = np.zeros((1, 4, 3), np.float32)
    _, hidden = around._without_key(Rays(blank, blank, blank, places, np.ones((1, 4), np.float32)))
    assert hidden.tolist() == [[1, 1, 0, 0]], "the ground before it and behind it stays"


@pytest.mark.gl
def test_a_backdrop_has_no_edges_where_its_lamps_are_not_seen() -> None:
    spec = scene.new("empty", time_step=0.002, setting="studio", floor="concrete")
    spec.worldbody.add_camera(name="eye", pos=(0, 2.5, 0.5), xyaxes=(-1, 0, 0, 0, 0.35, 0.94), fovy=60)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, 128, 72, "traced") as frames:
        image = frames.image(data, "eye", 2).astype(int)
        assert frames.renderer == "traced", frames.reason
    sky = image[:50]
    assert np.ptp(sky) > 30, "it darkens upward"
    for axis in (0, 1):
        assert np.abs(np.diff(sky, 2, axis=axis)).max() <= 3
