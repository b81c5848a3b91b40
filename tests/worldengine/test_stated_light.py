"""Pictures begin with the light that the world states; a film may light it otherwise, and that is listed."""

import json

import numpy as np
import pytest

from small_worlds import lay_film, record
from worldengine.film import described, motion_facts
from worldengine.film.directed import Screening
from worldengine.film.drawn_frames import Frames
from worldengine.film.renderers.preview.lighting import relight
from worldengine.film.treatment import PLAIN, Treatments
from worldkit import bodies, lights, portable, scene
from worldkit.filming import Film, Recorded, still
from worldkit.settings import STUDIO

SIZE = (96, 54)
STATED = {"sky": "clear", "azimuth_deg": 0.0, "elevation_deg": 12.0}


def world(**stated):
    """A pole on a lawn, and a ball beside it."""
    spec = scene.new("lawn", time_step=0.002, setting="outdoor", floor="concrete")
    bodies.box(spec, "pole", size=(0.1, 0.1, 1.0), pos=(0, 0, 0.5), look="#884422", fixed=True)
    bodies.sphere(spec, "ball", diameter=0.2, pos=(0.0, 0.8, 0.5), mass=0.5, look="#cc3333")
    spec.worldbody.add_camera(name="above", pos=(0, 0, 7.0), xyaxes=(1, 0, 0, 0, 1, 0), fovy=40)
    if stated:
        lights.add(spec, **stated)
    return spec


def picture(spec, renderer=""):
    import mujoco

    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with Frames(model, *SIZE, renderer) as frames:
        return frames.image(data, "above", "video" if renderer != "traced" else 8).astype(float).mean(axis=-1)


@pytest.mark.gl
def test_a_still_shows_the_long_shadow_on_the_side_away_from_the_sun():
    """Seen from above, x to the right: the sun stands at +x, then at -x."""
    left, right = (slice(22, 32), slice(12, 40)), (slice(22, 32), slice(56, 84))
    for azimuth, dark, bright in ((0.0, left, right), (180.0, right, left)):
        seen = picture(world(**{**STATED, "azimuth_deg": azimuth}))
        assert seen[dark].mean() < 0.97 * seen[bright].mean(), azimuth


@pytest.mark.gl
def test_night_is_darker_than_dusk_and_dusk_than_day():
    day, dusk, night = (picture(world(sky=sky)).mean() for sky in ("clear", "dusk", "night"))
    assert day > 1.2 * dusk and dusk > 1.2 * night


def test_a_weak_light_leaves_a_room_to_its_lamps():
    """Without a sky the surroundings and the fill lights go down with it."""
    own = STUDIO.fills[0].colour[0]
    weak = relight(STUDIO, PLAIN.started_from(lights.treated(strength=0.03)))
    assert weak.sky == 0.03 * STUDIO.sky and weak.fills[0].colour[0] == pytest.approx(0.03 * own)
    assert relight(STUDIO, PLAIN).fills == STUDIO.fills


@pytest.mark.gl
def test_a_lamp_of_the_world_is_seen_where_it_stands():
    spec = world(sky="night")
    dark = picture(spec)
    lights.lamp(spec, "bulb", (1.5, 0, 0.5), strength=2.0)
    lit = picture(spec) - dark
    assert lit[:, 70:].mean() > 3 * max(lit[:, :26].mean(), 0.5)


class Filmed:
    """The recorded world, and films of it."""

    def __init__(self, folder):
        self.folder = folder
        spec = world(**STATED)
        portable.write(spec, folder / "world.mjz")
        self.recording = record(spec, folder / "trajectory", 200)
        self.plain = portable.read(folder / "world.mjz")
        facts, told = {"fps": 24, "size": list(SIZE), "movers": ["ball"]}, {"light": json.dumps(STATED)}
        motion_facts.write(self.recording, folder / "motion.npz", facts, told)
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def film(self, tell):
        film = Film(self.seen)
        tell(film)
        film.shot(still((3, -4, 2.5), (0, 0, 0.2), lens_mm=30), until=0.2)
        lay_film(self.folder, film)
        return described.read(self.folder, self.recording, lights.of(self.plain))


@pytest.fixture(scope="module")
def filmed(tmp_path_factory):
    return Filmed(tmp_path_factory.mktemp("filmed"))


def departs(film):
    return [line for line in film.drawn_only() if "the world states" in line]


def test_a_film_that_says_nothing_of_light_is_lit_as_stated(filmed):
    film = filmed.film(lambda film: None)
    assert film.treatments.at(0.1).light_elevation_deg == 12.0 and not departs(film)
    assert film.treatments.at(0.1).lit == PLAIN.started_from(lights.treated(**STATED)).lit


@pytest.mark.parametrize("name", ["meadow", "living_room", "workshop", "still_life", "night_sky"])
def test_a_set_brings_its_own_light_only_where_none_is_stated(filmed, name):
    film = filmed.film(lambda film: film.set(name))
    stated = PLAIN.started_from(lights.treated(**STATED))
    assert lit(film.treatments.at(0.1)) == lit(stated) and not departs(film)


def lit(treatment):
    return {name: getattr(treatment, name) for name in lights.treated(**STATED)}


@pytest.mark.parametrize(
    ("tell", "listed"),
    [
        (lambda film: film.light(elevation_deg=40), "elevation"),
        (lambda film: film.light(elevation_deg=40, colour="#00ff00", at=0.1), "colour, elevation"),
        (lambda film: film.sky(zenith="#000000", horizon="#000000"), "sky"),
        (lambda film: film.light(fill=0.5), "sky"),
        (lambda film: (film.set("meadow"), film.mood("night")), "sky"),
    ],
    ids=["height", "height and colour", "sky", "fill", "mood"],
)
def test_a_film_may_light_it_otherwise_and_that_is_listed(filmed, tell, listed):
    said = departs(filmed.film(tell))
    assert len(said) == 1
    assert set(listed.split(", ")) <= set(said[0].split(": ")[1].split(", "))


def test_a_sky_of_the_films_own_leaves_the_stated_air_and_developing_behind():
    night = lights.treated(sky="night")
    own = Treatments([{"at_s": 0.0, "sky_zenith": [0.2, 0.4, 0.8]}], night).at(0.0)
    assert own.grade_exposure_stops == 0.0 and own.light_strength == night["light_strength"]
    assert Treatments([], night).at(0.0).grade_exposure_stops == night["grade_exposure_stops"]


@pytest.mark.gl
def test_the_film_is_drawn_in_the_stated_light(filmed):
    film = filmed.film(lambda film: None)
    with Screening(filmed.folder / "world.mjz", filmed.plain, filmed.recording, film, SIZE, 24) as screening:
        stated = screening.picture(0).astype(float)
    film = filmed.film(lambda film: film.mood("night"))
    with Screening(filmed.folder / "world.mjz", filmed.plain, filmed.recording, film, SIZE, 24) as screening:
        cold = screening.picture(0).astype(float)
    warmth = [float(picture[..., 0].mean() / picture[..., 2].mean()) for picture in (stated, cold)]
    assert warmth[0] > 1.3 * warmth[1], "a low sun is warm, and the moon is not"
