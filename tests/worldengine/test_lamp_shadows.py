"""Lamps cast shadows in the preview: of what stands between, each its own, none of what holds the lamp."""

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, motion_facts
from worldengine.film.directed import Screening
from worldengine.film.renderers.preview import lamp_reach, painter, shaded
from worldengine.film.renderers.preview.finish import plain
from worldengine.film.renderers.preview.things import Batch, Things
from worldengine.film.treatment import Treatment
from worldkit import portable
from worldkit.filming import Film, Recorded, Surface, still

SIZE = (96, 64)
CORNERS = ((-0.6, -0.5), (0.8, -0.5), (-0.6, 0.5), (0.8, 0.5))


class Floor:
    """A floor seen from above, 3.3 m by 2.2 m in the picture, a ball over its middle or far away, and films of it in the dark."""

    def __init__(self, folder):
        self.worlds = {}
        for shown, pos in ((True, (0.0, 0.0, 0.5)), (False, (30.0, 30.0, 0.5))):
            spec, place = empty(gravity=0.0), folder / str(shown)
            floor(spec)
            ball(spec, "ball", pos, radius=0.15)
            place.mkdir()
            portable.write(spec, place / "world.mjz")
            recording = record(spec, place / "trajectory", 100)
            motion_facts.write(recording, place / "motion.npz", {"fps": 24, "size": list(SIZE), "movers": ["ball"]})
            self.worlds[shown] = place, recording, portable.read(place / "world.mjz")
        with np.load(place / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def picture(self, *lamps, sky="#050505", draw=None, shown=True, **key):
        """Brightness of the picture, 0 to 255 (64, 96): +x right and +y up, with the ball or without."""
        folder, recording, plain_model = self.worlds[shown]
        film = Film(self.seen)
        film.light(**{"strength": 0.001, **key})
        film.sky(zenith=sky, horizon=sky, ground="#050505", strength=0.1 if sky == "#050505" else 1.0)
        for number, (place, more) in enumerate(lamps):
            film.lamp(f"lamp {number}", place, colour="#ffffff", **{"strength": 2.0, **more})
        if draw:
            draw(film)
        film.shot(still((0, -0.01, 4.0), (0, 0, 0), lens_mm=44), until=0.1)
        lay_film(folder, film, None)
        told = described.read(folder, recording)
        with Screening(folder / "world.mjz", plain_model, recording, told, SIZE, 24, "preview") as screening:
            image = screening.picture(0, "video").astype(float).mean(axis=-1)
            assert screening.frames.renderer == "preview", screening.frames.reason
            return image


@pytest.fixture(scope="module")
def level(tmp_path_factory):
    return Floor(tmp_path_factory.mktemp("level"))


def spots(dark):
    """Middles (column, row) of what is dark, from left to right."""
    import cv2

    count, _, stats, middles = cv2.connectedComponentsWithStats(dark.astype(np.uint8), connectivity=8)
    return sorted(tuple(middles[n]) for n in range(1, count) if stats[n][4] >= 12)


@pytest.mark.gl
def test_what_is_between_a_lamp_and_the_floor_darkens_the_floor_there_and_nowhere_else(level):
    lamp = ((-0.9, 0, 1.2), {})
    shaded, bare = level.picture(lamp), level.picture(lamp, shown=False)
    rows, columns = np.mgrid[:64, :96]
    (one,) = spots((shaded < 0.6 * bare) & (columns > 56))
    # Of what touches the ball from (-0.9, 1.2), the one meets the floor at 0.28 m, the other at 1.15 m; 3.27 m are in the picture.
    assert one[0] == pytest.approx(48 + 0.72 * 96 / 3.27, abs=3.5) and one[1] == pytest.approx(32, abs=2)
    away = (columns < 40) | (columns > 90) | (abs(rows - 32) > 18)
    assert np.abs(shaded - bare)[away].max() < 3
    assert (bare > 20).all(), "its fall-off alone leaves light everywhere"


@pytest.mark.gl
def test_two_lamps_two_shadows_and_a_moon_by_night_hardly_one(level):
    pair = [((-0.9, 0, 1.2), {}), ((0.9, 0, 1.2), {})]
    bare = level.picture(*pair, shown=False)
    lit = level.picture(*pair)
    two = [spot for spot in spots(lit < 0.92 * bare) if abs(spot[0] - 48) > 6]
    assert len(two) == 2 and two[0][0] < 40 and two[1][0] > 56, "each on the far side of its lamp"
    moon = {"strength": 0.1, "azimuth_deg": 90, "elevation_deg": 45}
    alone = level.picture(**moon) / level.picture(**moon, shown=False)
    beside = level.picture(*pair, **moon) / level.picture(*pair, **moon, shown=False)
    below = np.s_[38:52, 42:54]
    assert alone[below].min() < 0.7, "without a lamp the moon throws a shadow to -y"
    assert beside[below].min() > 0.93


@pytest.mark.gl
def test_four_lamps_that_shine_all_round_cast_shadows_on_every_side(level):
    """Each near the floor, so that it is seen through five faces of its cube: twenty together."""
    lamps = [((x, y, 0.3), {"strength": 2.0 - 0.1 * n}) for n, (x, y) in enumerate(CORNERS)]

    def posts(film):
        for n, (x, y) in enumerate(CORNERS):
            film.draw(f"post {n}", "box", (0.06, 0.2, 0.5), pos=(x - 0.2, y, 0.25), look=Surface(colour="#202020"))

    share = level.picture(*lamps, draw=posts, shown=False) / level.picture(*lamps, shown=False)
    for x, y in CORNERS:
        column, row = round(48 + 96 / 3.27 * (x - 0.45)), round(32 - 96 / 3.27 * y)
        assert share[row - 1 : row + 2, column - 1 : column + 2].mean() < 0.9, (x, y)


@pytest.mark.gl
def test_a_lamp_by_day_leaves_the_shadow_of_the_sun_as_it_is(level):
    sun, day = {"strength": 1.0, "azimuth_deg": 90, "elevation_deg": 45}, "#8090b0"
    faint = [((-0.9, 0, 1.2), {"strength": 0.05})]
    below = np.s_[38:52, 42:54]
    alone = level.picture(sky=day, **sun)[below].min()
    assert level.picture(*faint, sky=day, **sun)[below].min() == pytest.approx(alone, abs=8)


@pytest.mark.gl
def test_what_holds_a_lamp_does_not_darken_all(level):
    lamp = ((-0.5, 0, 1.5), {})
    bare = level.picture(lamp)

    def globe(look):
        return lambda film: film.draw("globe", "sphere", 0.2, pos=lamp[0], look=look)

    def shade(film):
        """A board beside the lamp."""
        film.draw("shade", "box", (0.5, 0.02, 0.6), pos=(-0.5, 0.25, 1.2), look=Surface(colour="#202020"))

    floor_right = np.s_[8:56, 60:92]
    for look in (Surface(colour="#ffffff", glow=2.0), "glass_clear", Surface(colour="#808080")):
        held = level.picture(lamp, draw=globe(look))
        assert held[floor_right].mean() == pytest.approx(bare[floor_right].mean(), rel=0.06), look
    beside = level.picture(lamp, draw=shade)
    assert beside[1:9, 24:50].mean() < 0.5 * bare[1:9, 24:50].mean(), "what stands beside it does"


@pytest.mark.gl
def test_a_lamp_has_softer_shadows_the_wider_it_shines(level):
    def edge(radius):
        """How many pixels across the shadow are neither lit nor dark."""
        lamp = ((-0.5, 0, 1.5), {"radius": radius})
        row = (level.picture(lamp) / level.picture(lamp, shown=False))[32, 46:75]
        return int(((row > 0.25) & (row < 0.9)).sum())

    assert edge(0.2) >= edge(0.0) + 4


def test_lamps_that_stand_together_share_a_map_and_the_strongest_come_first():
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody>"
        + "".join(
            f"<light pos='{x} 0 {z}' type='point'/>" for x, z in ((0, 1), (0.02, 1), (0, 2), (4, 1), (0, 3), (5, 5))
        )
        + "<light pos='0 0 1.5' type='spot' cutoff='20' dir='0 0 -1'/><light type='directional'/></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    rows = np.zeros((16, 4))
    aims = np.tile([0.0, 0, -1], (8, 1))
    for light in range(8):
        near = model.light_type[light] != mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
        rows[2 * light] = *data.light_xpos[light], float(near)
        rows[2 * light + 1] = 1, 1, 1, np.cos(np.radians(20)) if light == 6 else -1.0
    seen = np.array([[x, y, 0, 0, 0, 1] for x in np.linspace(-1, 1, 9) for y in np.linspace(-1, 1, 9)], dtype=float)
    found = lamp_reach.gather(model, rows, aims, list(range(8)), seen)
    assert [lamp.lights for lamp in found] == [[0, 1], [2], [4], [6]]
    assert all(0 < lamp.share <= 1 for lamp in found) and found[0].share == 1
    spot = found[3]
    assert spot.axes[2] == pytest.approx([0, 0, 1]) and set(spot.facing(seen[spot.light > 0, :3])) == {5}
    clip = spot.clip(5, 1.3, 0.02) @ [0, 0, 0, 1]
    assert clip[:3] / clip[3] == pytest.approx([0, 0, 1 - 0.02 / 1.5])


def test_only_what_may_cast_a_shadow_is_drawn_for_a_face():
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><geom type='plane' size='0 0 1'/>"
        + "".join(f"<geom type='box' size='.1 .1 .1' pos='{x} 0 .1'/>" for x in (-3, 0, 0.1, 3))
        + "<geom type='sphere' size='.1' pos='0 0 2'/></worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    things = Things(model)
    things.update(data)
    casters = lamp_reach.Casters(things)
    casters.move()
    lamp = lamp_reach.Lamp([0], np.array([0, 0, 2.02]), np.eye(3), np.ones(1))
    kinds = {int(geom): int(kind) for geom, kind in zip(things.geoms, model.geom_type[things.geoms], strict=True)}
    held = {int(things.geoms[row]) for row in np.flatnonzero(casters.holders(lamp))}
    assert held == {5} and kinds[5] == mujoco.mjtGeom.mjGEOM_SPHERE
    down = {int(things.geoms[row]) for row in np.flatnonzero(casters.seen_through(lamp, 5, 1.0))}
    assert {2, 3} <= down and not {1, 4} & down
    batch = Batch(("box", -1), plain((1, 1, 1, 1)), False, rows=[2, 3, 4, 5, 6], first=2)
    wanted, barred = np.zeros(8, bool), np.zeros(8, bool)
    wanted[[3, 4, 6]], barred[5] = True, True
    assert list(painter.spans(batch, wanted, barred)) == [(3, 2), (6, 1)]


@pytest.mark.gl
def test_the_glow_around_a_lamp_is_round():
    side, at = 256, (132, 120)
    opened = shaded.context(side, side)
    opened.make_current()
    from OpenGL import GL

    from worldengine.film.renderers.preview import develop, gl

    gl.prepare_depth()
    scene = np.zeros((side, side, 4), np.float32)
    y, x = np.mgrid[:side, :side]
    away = np.hypot(x - at[0], y - at[1])
    scene[away < 10] = 12.0
    handle = gl.texture(GL.GL_RGBA16F, side, side)
    GL.glTexSubImage2D(GL.GL_TEXTURE_2D, 0, 0, 0, side, side, GL.GL_RGBA, GL.GL_FLOAT, scene)
    developer, uneven = develop.Developer(side, side), []
    for rounded in (False, True):
        told = Treatment(grade_glow=0.2, grade_vignette=0.0)
        picture = developer.draw(handle, 1.0, 0.0, told, rounded=rounded)[::-1].mean(axis=-1)
        rings = [picture[(away > r) & (away < r + 1)] for r in range(16, 34, 3)]
        uneven.append(float(np.mean([ring.std() / max(ring.mean(), 1.0) for ring in rings])))
    opened.free()
    assert uneven[1] < 0.6 * uneven[0]
