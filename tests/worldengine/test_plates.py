"""Of a still camera's pictures only what differs is traced anew, and the picture is the one that is traced as a whole."""

from functools import partial
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from worldengine.film import renderers
from worldengine.film.renderers import Before
from worldengine.film.renderers.preview.eye import View
from worldengine.film.renderers.traced import figures, plates, rounded, walked
from worldengine.film.renderers.traced.shutter import Lens, Shutter
from worldengine.film.treatment import Treatment
from worldkit import bodies, scene
from worldkit.settings import STUDIO

AHEAD = View(np.zeros(3), np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]]), (1.0, 0.5))
"""Looks along +y, z up, twice as wide as high."""


PLAIN = plates.Look(np.ones(3, np.float32), 1.0, -4.0, np.array((0.6, 0.0, 0.8)))
"""Its ground lies 4 m below the eye."""


def test_a_change_of_light_is_found_where_it_is():
    before = np.full((40, 80, 3), 0.3, np.float32)
    assert not plates.differing(before, before.copy(), PLAIN).any()
    now = before.copy()
    now[20, 50] = 0.6
    found = plates.differing(before, now, PLAIN)
    assert found[20, 50] and found.sum() < 80
    assert not plates.differing(before, before * 1.002, PLAIN).any(), "nobody sees so little"
    assert plates.differing(before, before * 1.1, PLAIN).all()


def test_what_chance_makes_brighter_here_and_darker_there_is_no_change_and_as_much_of_one_sign_is():
    """So is the bounce light near whatever moves: each path that met it ends elsewhere now."""
    before, random = np.full((90, 160, 3), 0.3, np.float32), np.random.default_rng(1)
    chance = random.normal(scale=0.03, size=(90, 160, 1)).astype(np.float32)
    assert plates.differing(before, before + chance, PLAIN).mean() < 0.05
    assert plates.differing(before, before + np.abs(chance), PLAIN).mean() > 0.9
    shadow = before + chance
    shadow[40:44, 60:100] *= 0.8
    found = plates.differing(before, shadow, PLAIN)
    assert found[40:44, 60:100].mean() > 0.9 and found.mean() < 0.12


def test_what_the_film_grades_plainer_is_found_too():
    before = np.full((40, 80, 3), 1e-4, np.float32)
    now = before * 1.5
    for told, seen in (
        (Treatment(), False), (Treatment(grade_exposure_stops=6), True), (Treatment(grade_contrast=3), True),
        (Treatment(grade_contrast=3, grade_exposure_stops=-8), False), (Treatment(grade_saturation=3), True),
    ):  # fmt: skip
        assert plates.differing(before, now, plates.Look.of(STUDIO, told, 0.0, AHEAD)).all() == seen, told


class Grains:
    """So many geoms that all moved, one a row of the picture; it counts those that are asked for."""

    def __init__(self, count: int) -> None:
        self.count, self.asked = count, 0

    def moved(self, before, now):
        row = np.array([(-20.0, 10, 0.0), (20, 10, 0), (20, 10, 0.2), (-20, 10, 0.2)])
        for number in range(self.count):
            self.asked += 1
            yield tuple(row + np.array((0, 0, 0.25 * (number % 40) - 5 - x)) for x in (0.0, 0.01))


def test_where_most_has_moved_nothing_more_is_searched():
    sight = plates.Sight(np.zeros((40, 80, 3), np.float32), (), {})
    plate = plates.Plate("key", (sight,), walked.Rays(*[np.zeros((160, 320, 3), np.float32)] * 5), sight.light)
    grains, none = Grains(10000), Grains(0)
    assert plates.kept([sight], [plate], grains, none, AHEAD, PLAIN) is None and grains.asked < 100
    assert plates.kept([sight], [plate], Grains(3), none, AHEAD, PLAIN) is not None


def test_of_a_figure_of_many_each_geom_that_moved_is_found_by_itself():
    figure = figures.Figure(None, np.zeros(3))
    figure.meshes = [rounded.box(np.full(3, 0.1 * (k + 1))) for k in range(3)]
    figure.owner = np.repeat(np.arange(3), [len(mesh.points) for mesh in figure.meshes])
    figure.points = np.concatenate([mesh.points for mesh in figure.meshes])
    figure._ends = np.cumsum([0, *(len(mesh.points) for mesh in figure.meshes)])
    before = np.tile([*np.eye(3).ravel(), 0.0, 0, 0, 1], (3, 1))
    now = before.copy()
    now[0, 9], now[1, 10] = 1e-9, 2.0
    ((was, stands),) = figure.moved(before, now)
    assert np.allclose(was, figure.meshes[1].points) and np.allclose(stands - was, (0, 2, 0))
    some = SimpleNamespace(all=[figures.Figure(None, np.zeros(3), strip=number == 4) for number in range(9)])
    assert figures.Figures.how_many_moved(some, (before,) * 9, (*(before,) * 8, now)) == 1
    assert figures.Figures.how_many_moved(some, (before,) * 9, (now,) * 9) == 8, (
        "loose things are one each, with their edges"
    )


def test_a_thing_is_drawn_anew_where_it_was_and_where_it_is_however_small():
    mask = np.zeros((40, 80), np.uint8)
    small = np.array([(0.0, 10, 0), (0.01, 10, 0), (0, 10, 0.01)])
    plates.outline(mask, [(small, small + np.array((5, 0, 1.9)))], AHEAD)
    assert [tuple(place) for place in np.argwhere(mask)] == [(12, 60), (19, 40), (20, 40)]
    mask[...] = 0
    plates.outline(mask, [(small, small + 1e-5)], AHEAD)
    assert not mask.any(), "what trembles unseen stands"
    plates.outline(mask, [(-small - 1.0, -small - 2.0), (small[:0], small[:0])], AHEAD)
    assert not mask.any(), "behind the camera nothing is seen"
    plates.outline(mask, [(small, small * (1, -1, 1) + np.array([(0, 20, 0), (0, 0, 0), (0, 0, 0)]))], AHEAD)
    assert mask.all(), "what reaches the camera may be anywhere"


def test_out_of_focus_it_is_drawn_anew_as_far_as_its_light_is_spread():
    lens = Lens.of(AHEAD, Treatment(aperture=0.01, focus_m=5.0))  # an opening as wide as a barrel
    wide = lens.radius_m * (1 / 5 - 1 / 10) * 40  # places of the mask, of a point 10 m ahead
    assert 2 < wide < 5
    point = np.array([(0.0, 10.0, 0.0)])
    found = {}
    for name, through in (("sharp", Lens()), ("soft", lens), ("in focus", lens._replace(focus_m=10.0))):
        found[name] = np.zeros((40, 80), np.uint8)
        plates.outline(found[name], [(point, point - 100.0)], AHEAD, lens=through)
    assert found["sharp"].sum() == found["in focus"].sum() == 1
    rows, columns = np.mgrid[:40, :80] - np.array([[[19.5]], [[39.5]]])
    away = np.hypot(rows, columns)
    assert found["soft"][away < wide - 1].all() and not found["soft"][away > wide + 2].any()
    beside = point - (10.0 + 10 / 40, 0, 0)  # one place to the left of the picture
    mask = np.zeros((40, 80), np.uint8)
    plates.outline(mask, [(beside, beside - 100.0)], AHEAD, lens=lens)
    assert mask[20, 0] and not mask[:, 10:].any(), "what is beside the picture may be spread into it"
    small = np.zeros((40, 80), np.uint8)
    plates.outline(small, [(point, point - 100.0)], AHEAD, 2, lens)
    assert np.array_equal(small, found["soft"]), "what would be small were it sharp"


def test_so_are_its_shadow_and_its_image_in_the_ground():
    small = np.array([(0.0, 10, 0), (0.01, 10, 0), (0, 10, 0.01)])
    dark = np.zeros((40, 80, 3), np.float32)

    class Moved(Grains):
        def moved(self, before, now):
            yield small, small + np.array((1.0, 0, 0))

    plate = plates.Plate("key", (plates.Sight(dark, (), {}),), walked.Rays(*[np.zeros((160, 320, 3))] * 5), dark)
    found = plates.changed([plate.sights[0]], plate, Moved(1), Grains(0), AHEAD, PLAIN._replace(floor_z=-2.0))
    for column, row, what in (
        (40, 20, "itself"),
        (34, 28, "its shadow, 1.5 m aside"),
        (40, 36, "its image, 4 m below"),
    ):
        assert found[row - 1 : row + 1, column - 1 : column + 1].any(), what
    tall = small * (1, 1, 500)
    big, mask = plates.echoes((tall, tall + 1.0), PLAIN), np.zeros((40, 80), np.uint8)
    plates.outline(mask, big, AHEAD, 5)
    assert not mask.any(), "those of a large thing are seen"


def test_plates_of_another_shot_make_room_and_what_does_not_fit_is_not_begun():
    rays = walked.Rays(*[np.zeros((4, 4, 3), np.float32)] * 4, np.zeros((4, 4), np.float32))
    one, shelf = plates.Plate("key", (), rays, rays.light), plates.Shelf()
    assert sum(part.nbytes for part in (*rays, one.clean)) == 16 * plates.PIXEL_BYTES
    for name in "ab":
        shelf.put(name, one)
    shelf.keep({"b", "c"})
    assert shelf.find("a") is None and shelf.find("b") is one
    assert [plates.samples(each) for each in (2, 6, 18, 54)] == [6, 18, 18, 54]
    hd, soft = 1280 * 720, 6 << 20
    assert plates.fitting(hd, 0, 8) > 2
    assert plates.fitting(hd, soft, 64) == 1, "where skins were, at each of so many moments"
    assert plates.fitting(9 * hd, 0, 1) == 2 and plates.fitting(hd, soft, 200) == 0


def test_a_mask_is_spread_over_pictures_of_any_size():
    mask = np.array([[True, False], [False, True]])
    assert walked.spread(mask, 4, 6).astype(int).tolist() == [[1, 1, 1, 0, 0, 0]] * 2 + [[0, 0, 0, 1, 1, 1]] * 2


@pytest.mark.parametrize(
    ("samples", "moments", "each", "guides"), [(0.5, 1, 2, 2), (6, 1, 6, 4), (18, 8, 2, 2), (2, 2, 1, 2)]
)
def test_samples_are_shared_out_among_the_moments(samples, moments, each, guides):
    shutter = Shutter.of(samples, moments)
    assert (shutter.each, shutter.guides, shutter.coarser) == (each, guides, 2 if samples < 1 else 1)


@pytest.mark.gl
def test_what_stands_is_not_traced_again_and_the_picture_is_the_same(monkeypatch):
    spec = scene.new("two", time_step=0.002, setting="studio")
    for name, x in (("ball", -0.5), ("still", 0.8)):
        bodies.sphere(spec, name, diameter=0.3, pos=(x, 0, 0.15), look="phenolic_red")
    spec.worldbody.add_camera(name="eye", pos=(0, -4, 1), xyaxes=(1, 0, 0, 0, 0.2, 1))
    model = spec.compile()
    data = mujoco.MjData(model)

    set_up = []

    def at(x: float, camera: float = 0.0) -> mujoco.MjData:
        set_up.append(x)
        data.qpos[0] = x
        mujoco.mj_forward(model, data)
        data.cam_xpos[0, 0] += camera
        return data

    asked, some = [], walked._some

    def watched(*given):
        asked.append(float(given[-1].mean()))
        return some(*given)

    monkeypatch.setattr(walked, "_some", watched)
    monkeypatch.setattr(plates, "SAMPLES", 2)  # one kernel less to be compiled
    monkeypatch.setattr(plates, "FINER", 4)  # so many samples as the whole picture
    drawing = renderers.SEAM.find("traced").take(model, 160, 90)

    def open_at(x: float, camera: float = 0.0) -> list[renderers.Moment]:
        """Two moments of an open shutter, through which the ball goes on."""
        return [partial(at, x, camera), partial(at, x + 0.02, camera)]

    def whole(x: float) -> np.ndarray:
        return drawing.blurred((moment() for moment in open_at(x)), 2, 0, 4).astype(int)

    before = [Before(n, open_at(x)) for n, x in enumerate((0.4, -0.5))]
    there = drawing.over(before, open_at(-0.1), 0, 4)
    assert len(asked) % 2 == 0 and len(set(asked)) == 1, "of each moment the same is walked"
    assert 0.005 < asked[0] < 0.25
    apart = np.abs(there - whole(-0.1))
    assert apart.mean() < 0.2 and np.percentile(apart, 99.5) <= 3
    assert np.abs(there - whole(0.4)).max() > 60, "the ball stands elsewhere"

    asked.clear()
    aside = drawing.over(before, open_at(-0.1, 0.3), 0, 4)
    assert asked == [] and np.abs(aside - whole(-0.1)).mean() > 1, "another view is drawn as a whole"
    before = [Before("at rest", [partial(at, 0.0)] * 2)]
    same = [drawing.over(before, [partial(at, 0.0)] * 2, 0, 4) for _ in range(2)]
    assert np.array_equal(*same) and asked == [], "nothing differs"
    set_up.clear()
    assert np.array_equal(drawing.over(before, [partial(at, 0.0)] * 2, 0, 4), same[0])
    assert len(set_up) == 3, "the first moment for the view, and each for its coarse look"

    assert drawing.beside(2, 4) >= (2, 1.0) and drawing.beside(2, 2)[1] == 2.0
    assert drawing.beside(2, 0.5)[0] == 0, "none beside a draft"
    set_up.clear(), asked.clear()
    drawing.treat(Treatment(aperture=0.4, focus_m=2.5))  # all that is seen is soft
    before = [Before(n, open_at(x)) for n, x in enumerate((0.4, -0.5))]
    soft = drawing.over(before, open_at(-0.1), 0, 4)
    assert 0.02 < asked[0] < 0.5
    apart = np.abs(soft - whole(-0.1))
    assert apart.mean() < 0.2 and np.percentile(apart, 99.5) <= 3
    assert np.abs(soft.astype(int) - there).max() > 30, "and it is another picture"
    drawing.close()
