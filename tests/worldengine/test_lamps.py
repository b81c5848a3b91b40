"""Lamps of a film light what is near them, in both renderers, go along with what carries them, and are bounded."""

import json
from functools import cache

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, dressed, motion_facts, panel_lights
from worldengine.film.described import FilmError
from worldengine.film.directed import Screening
from worldengine.film.renderers.preview import scenery
from worldengine.film.renderers.traced import panel_emitters, variant
from worldkit import portable
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, still

SIZE = (96, 54)


class Lit:
    """A falling ball over a floor, and films of it in the dark."""

    def __init__(self, folder):
        spec = empty()
        floor(spec)
        ball(spec, "ball", (0.6, 0, 0.9))
        self.folder = folder
        portable.write(spec, folder / "world.mjz")
        self.recording = record(spec, folder / "trajectory", 200)
        self.plain = portable.read(folder / "world.mjz")
        motion_facts.write(self.recording, folder / "motion.npz", {"fps": 24, "size": list(SIZE), "movers": ["ball"]})
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def film(self, tell, change=None):
        film = Film(self.seen)
        film.light(strength=0.02)
        film.sky(zenith="#050505", horizon="#050505", ground="#050505", strength=0.1)
        tell(film)
        film.shot(still((0, -4, 2.5), (0, 0, 0.2), lens_mm=30), until=0.2)
        lay_film(self.folder, film, change and (lambda facts, _: change(facts)))
        return described.read(self.folder, self.recording)

    def picture(self, tell, renderer, frame=0):
        film = self.film(tell)
        with Screening(self.folder / "world.mjz", self.plain, self.recording, film, SIZE, 24, renderer) as screening:
            image = screening.picture(frame, 4).astype(float).mean(axis=-1)
            assert screening.frames.renderer == renderer, screening.frames.reason
            return image

    @cache  # noqa: B019 - one for the module
    def dark(self, renderer):
        """Without any lamp; drawn once."""
        return self.picture(lambda film: None, renderer)


@pytest.fixture(scope="module")
def lit(tmp_path_factory):
    return Lit(tmp_path_factory.mktemp("lit"))


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_a_lamp_lights_what_is_near_it(lit, renderer):
    dark = lit.dark(renderer)
    left = lit.picture(lambda film: film.lamp("left", (-1, 0, 0.6), strength=2), renderer) - dark
    right = lit.picture(lambda film: film.lamp("right", (1, 0, 0.6), strength=2), renderer) - dark
    assert left[30:, :48].mean() > 2 * left[30:, 48:].mean() > 0
    assert right[30:, 48:].mean() > 2 * right[30:, :48].mean() > 0
    spot = lit.picture(lambda film: film.lamp("s", (0, 0, 2), aim=(-1, 0, 0), cone_deg=12, strength=6), renderer) - dark
    assert spot[30:, 10:44].mean() > 4 * max(spot[30:, 60:].mean(), 0.1)


@pytest.mark.gl
def test_a_traced_lamp_within_its_bulb_gives_the_light_that_it_gives_without(lit):
    def lamp(radius):
        return lambda film: film.lamp("bulb", (-0.8, 0, 1.4), strength=2, radius=radius)

    bare, bulb = (lit.picture(lamp(radius), "traced")[34:48, 10:60].mean() for radius in (0.0, 0.08))
    assert bulb == pytest.approx(bare, rel=0.1) and bare > 30


@pytest.mark.gl
def test_a_carried_lamp_goes_along_in_the_scene_that_there_is(lit, monkeypatch):
    pytest.importorskip("mitsuba")
    variant.choose()
    import mitsuba

    built, load = [], mitsuba.load_dict

    def counted(told, *more, **options):
        built.extend([told] if told["type"] == "scene" else [])
        return load(told, *more, **options)

    monkeypatch.setattr(mitsuba, "load_dict", counted)

    def tell(film):
        film.lamp("torch", (0, 0, 0.3), to="ball", strength=2)
        film.lamp("beam", (0.6, 0.6, 0.9), aim=(0.6, 0, 0.3), to="ball", strength=2)

    film = lit.film(tell)
    with Screening(lit.folder / "world.mjz", lit.plain, lit.recording, film, SIZE, 24, "traced") as screening:
        drawing, seen = screening.frames._drawing, []
        for frame in (0, film.frames - 1):
            picture = screening.picture(frame, 1)
            (scene,) = drawing._scenes.values()
            (lamp,) = [e for e in scene.emitters() if "PointLight" in str(e)]
            seen.append(float(np.array(lamp.bbox().min).ravel()[2]))
        drawing._scenes.clear()
        apart = np.abs(screening.picture(film.frames - 1, 1).astype(int) - picture)
        assert apart.max() < 8 and apart.mean() < 0.2, "as in a scene that is built there"
        falls = lit.recording.pos[0, 0, 2] - screening._replay.data.body("ball").xpos[2]
    assert len(built) == 2, "once, and once more for the comparison"
    assert (
        seen[0] == pytest.approx(1.2, abs=0.01) and seen[0] - seen[1] == pytest.approx(falls, abs=0.01) and falls > 0.05
    )


def test_of_many_lamps_the_preview_takes_the_strongest(lit):
    def many(film):
        for number in range(12):
            film.lamp(f"lamp {number}", (number, 0, 1), strength=1 + number)

    film = lit.film(many)
    model = dressed.dress(lit.folder / "world.mjz", film)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    chosen = scenery.own_lights(model)
    assert model.light(chosen[0]).name == "drawn.lamp 11"
    rows, aims, count = scenery.light_rows(model, data, scenery.STUDIO, chosen)
    fills = len(scenery.STUDIO.fills)
    assert fills > 0 and count == fills + 8 <= len(aims) == len(rows) // 2, "the setting's own do not count"
    shown = rows[2 * fills : 2 * count : 2, 0]
    assert shown.tolist() == [11, 10, 9, 8, 7, 6, 5, 4]
    assert film.drawn_only()[:2] == ["lamp 0 (a lamp)", "lamp 1 (a lamp)"]


def test_lamps_are_bounded_by_the_author_and_by_us(lit):
    film = Film(lit.seen)

    def flood() -> None:
        for number in range(10_000):
            film.lamp(f"lamp {number}", (0, 0, 1))

    with pytest.raises(ProgramError, match="at most 64 lamps"):
        flood()
    for wrong in ({"pos": (0, 0, np.nan)}, {"pos": (0, 0, 1), "strength": 0}, {"pos": (0, 0, 1), "cone_deg": 120}):
        with pytest.raises(ProgramError, match="needs a place"):
            Film(lit.seen).lamp("lamp", **wrong)
    one = {"name": "x", "pos": [0, 0, 1], "aim": None, "strength": 1, "rgb": [1, 1, 1], "cone_deg": 40, "to": ""}
    with pytest.raises(FilmError, match="at most 64 lamps"):
        lit.film(lambda film: None, lambda facts: facts["lamps"].extend([one] * 10_000))
    for wrong in (
        {"pos": [0, 0, float("nan")]},
        {"to": "nobody"},
        {"strength": -1},
        {"rgb": [1, 1, 1e30]},
        {"rgb": [1, -1, 1]},
    ):
        with pytest.raises(FilmError, match="the lamp"):
            lit.film(lambda film: None, lambda facts, wrong=wrong: facts["lamps"].append(one | wrong))


DOWN = {"size": (0.4, 0.4), "towards": (-0.8, 0, 0)}


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_a_panel_lights_what_is_before_it_as_a_lamp_of_its_strength_does(lit, renderer):
    def panel(**more):
        return lambda film: film.panel("panel", (-0.8, 0, 1.6), **{**DOWN, "strength": 2, **more})

    dark = lit.dark(renderer)
    lamp = lit.picture(lambda film: film.lamp("l", (-0.8, 0, 1.6), strength=2, colour="#fff6e8"), renderer) - dark
    for seen in (True, False):
        shone = lit.picture(panel(seen=seen), renderer) - dark
        assert shone[30:, :48].mean() > 1.5 * shone[30:, 48:].mean() > 0
        assert shone[34:48, 20:40].mean() == pytest.approx(lamp[34:48, 20:40].mean(), rel=0.25)
    away = lit.picture(panel(towards=(-0.8, 0, 3.0), seen=False), renderer) - dark
    assert np.abs(away[30:]).mean() < 1.0, "from behind it is dark"


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
def test_a_panel_is_seen_unless_it_is_told_not_to_be(lit, renderer):
    def window(**more):
        return lambda film: film.panel("w", (-0.5, 1.0, 0.9), (0.5, 0.5), towards=(-0.5, -4, 0.9), **more)

    seen, unseen = (lit.picture(window(seen=there), renderer) for there in (True, False))
    dark = lit.dark(renderer)
    bright = seen - unseen > 60
    assert 20 < bright.sum() < 700
    rows, columns = np.nonzero(bright)
    assert columns.mean() < 48 and rows.mean() < 30
    assert np.abs(unseen - dark)[:20].mean() < 4
    behind = lit.picture(lambda film: film.panel("w", (-0.5, 1.0, 0.9), (0.5, 0.5), towards=(-0.5, 4, 0.9)), renderer)
    assert np.median(behind[bright]) < 12, "from behind it is dark"


@pytest.mark.gl
def test_a_carried_panel_goes_along_as_one_rectangle(lit):
    film = lit.film(lambda film: film.panel("box", (0, 0, 0.4), (0.3, 0.2), towards=(0, 0, 0), to="ball"))
    with Screening(lit.folder / "world.mjz", lit.plain, lit.recording, film, SIZE, 24, "traced") as screening:
        high = []
        for frame in (0, film.frames - 1):
            screening.picture(frame, 1)
            (scene,) = screening.frames._drawing._scenes.values()
            (shape,) = [s for s in scene.shapes() if "Rectangle" in type(s).__name__ or "Rectangle[" in str(s)]
            low, top = np.array(shape.bbox().min).ravel(), np.array(shape.bbox().max).ravel()
            assert top - low == pytest.approx([0.3, 0.2, 0.0], abs=1e-3) or top - low == pytest.approx(
                [0.2, 0.3, 0], abs=1e-3
            )
            high.append(low[2])
        falls = lit.recording.pos[0, 0, 2] - screening._replay.data.body("ball").xpos[2]
    assert high[0] == pytest.approx(1.3, abs=0.01) and high[0] - high[1] == pytest.approx(falls, abs=0.01)


def test_panels_are_bounded_by_the_author_and_by_us(lit):
    good = {"pos": (0, 0, 1), "size": (1, 1), "towards": (0, 0, 0)}
    film = Film(lit.seen)
    for number in range(16):
        film.panel(f"panel {number}", **good)
    with pytest.raises(ProgramError, match="at most 16 panels"):
        film.panel("one more", **good)
    for wrong, said in (
        ({"towards": (0, 0, 1)}, "another point"),
        ({"pos": (0, np.nan, 1)}, "needs a place"),
        ({"pos": (0, 1)}, "needs a place"),
        ({"strength": -1}, "a strength"),
        ({"size": (1, 0)}, "0.005 to 100"),
        ({"size": (1, 1, 1)}, "needs a place"),
        ({"colour": "blue"}, "#rrggbb"),
    ):
        with pytest.raises(ProgramError, match=said):
            Film(lit.seen).panel("panel", **{**good, **wrong})
    told = lit.film(lambda film: film.panel("window", **good))
    assert "window (a panel of light)" in told.drawn_only()
    one = {
        "name": "x",
        "pos": [0, 0, 1],
        "towards": [0, 0, 0],
        "size": [1, 1],
        "strength": 1,
        "rgb": [1, 1, 1],
        "seen": 1,
        "to": "",
    }
    with pytest.raises(FilmError, match="at most 16 panels"):
        lit.film(lambda film: None, lambda facts: facts["panels"].extend([one] * 17))
    for wrong in (
        {"size": [1, -1]},
        {"towards": [0, 0, 1]},
        {"to": "nobody"},
        {"rgb": [2, 0, 0]},
        {"pos": [0, 0, float("inf")]},
    ):
        with pytest.raises(FilmError, match="the panel"):
            lit.film(lambda film: None, lambda facts, wrong=wrong: facts["panels"].append(one | wrong))


def test_only_a_film_makes_panels_not_what_a_world_says_of_its_own_shapes(lit, tmp_path):
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0.6, 0, 0.9)).geoms[0].name = "drawn.sun"
    said = {"half": [1, 1], "radiance": [9e9, 9e9, 9e9], "seen": True}
    spec.add_text(name="film.panels", data=json.dumps({"drawn.sun": said} | {f"drawn.{n}": said for n in range(20)}))
    portable.write(spec, tmp_path / "world.mjz")
    assert panel_lights.of_model(portable.read(tmp_path / "world.mjz")) == []
    assert panel_lights.of_model(dressed.dress(tmp_path / "world.mjz", lit.film(lambda film: None))) == []
    film = lit.film(lambda film: film.panel("lid", (0, 0, 1), (0.4, 0.2), towards=(0, 0, 0), strength=2, seen=False))
    model = dressed.dress(tmp_path / "world.mjz", film)
    (panel,) = panel_lights.of_model(model)
    assert model.geom(panel.geom).name == "drawn.lid" and panel.half == (0.2, 0.1) and not panel.seen
    assert max(panel.radiance) == pytest.approx(2 * np.pi / 0.08, rel=0.01)


def test_an_unseen_panel_is_sampled_as_often_as_one_lamp(lit):
    pytest.importorskip("mitsuba")
    variant.choose()
    import mitsuba

    film = lit.film(lambda film: film.panel("lid", (0, 0, 1), (0.4, 0.2), towards=(0, 0, 0), seen=False))
    model = dressed.dress(lit.folder / "world.mjz", film)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    spots = panel_emitters.emitters(panel_lights.of_model(model), data).values()
    assert sum(mitsuba.load_dict(spot).sampling_weight() for spot in spots) == pytest.approx(1.0)
