"""The light that a plan states is kept in the model, and says what pictures begin with."""

import mujoco
import numpy as np
import pytest

from worldkit import lights, scene
from worldkit.errors import ProgramError


def low(found):
    """How much redder than blue the light is."""
    return found["light_rgb"][0] - found["light_rgb"][2]


def test_a_clear_sky_reddens_as_the_sun_sinks():
    heights = (60, 30, 14, 8, 3)
    found = [lights.treated(sky="clear", elevation_deg=height) for height in heights]
    assert [one["light_elevation_deg"] for one in found] == list(heights)
    warmth = [low(one) for one in found]
    assert warmth == sorted(warmth) and warmth[-1] > warmth[0] + 0.4
    assert found[0]["sky_zenith"][2] > found[0]["sky_zenith"][0]


def test_what_is_stated_of_the_sun_goes_over_what_the_sky_brings():
    plain = lights.treated(sky="night")
    assert "light_azimuth_deg" not in plain  # the setting's own
    own = lights.treated(sky="night", azimuth_deg=30, elevation_deg=20, colour="#ff0000", strength=0.5)
    assert own["light_azimuth_deg"] == 30 and own["light_elevation_deg"] == 20 and own["light_strength"] == 0.5
    assert own["light_rgb"] == [1, 0, 0] and own["sky_zenith"] == plain["sky_zenith"]
    assert set(lights.treated(azimuth_deg=5)) == {"light_azimuth_deg"}


@pytest.mark.parametrize(
    "stated",
    [{"sky": "storm"}, {"elevation_deg": 0}, {"azimuth_deg": 1e9}, {"colour": "red"}, {"strength": -1}],
    ids=lambda stated: next(iter(stated)),
)
def test_what_no_light_may_have_is_refused(stated):
    with pytest.raises(ProgramError):
        lights.treated(**stated)


def test_it_stays_in_the_compiled_model_and_moves_nothing():
    spec = scene.new("dusk", time_step=0.002, setting="outdoor")
    before = spec.compile()
    lights.add(spec, sky="dusk", azimuth_deg=90)
    lights.add(spec, sky="clear", elevation_deg=8, azimuth_deg=0)  # the last word counts
    lights.lamp(spec, "bulb", (0, 0, 2), colour="#ffffff", strength=3)
    model = spec.compile()
    assert lights.of(model) == lights.treated(sky="clear", elevation_deg=8, azimuth_deg=0)
    assert lights.of(before) == {} and (model.nbody, model.ngeom) == (before.nbody, before.ngeom)
    assert model.light("lamp.bulb").diffuse == pytest.approx(3 / lights.LIGHT_GAIN)
    key = model.light("worldkit.key").dir  # for MuJoCo's own viewers
    assert np.degrees(np.arcsin(-key[2])) == pytest.approx(8) and key[0] < 0 and abs(key[1]) < 1e-9


def test_a_lamp_is_on_a_body_that_there_is():
    spec = scene.new("room", time_step=0.002, setting="room")
    spec.worldbody.add_body(name="post", pos=(0, 0, 1))
    lights.lamp(spec, "lantern", (0, 0, 0.2), to="post")
    assert spec.compile().light("lamp.lantern").bodyid[0] == 1
    for told in ({"to": "nobody"}, {"strength": 0}, {"strength": 1e6}):
        with pytest.raises(ProgramError):
            lights.lamp(spec, "other", (0, 0, 0), **told)


@pytest.mark.parametrize("text", ["[1]", '{"sky": 3}', '{"wind": 1}', "no json", '{"elevation_deg": "high"}'])
def test_a_foreign_models_text_states_nothing(text):
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.1, 0, 0))
    spec.add_text(name=lights.TEXT, data=text)
    assert lights.of(spec.compile()) == {}


def test_a_clear_sky_changes_evenly_with_the_sun():
    for here, there in ((29.4, 29.6), (8.4, 8.6)):
        below, above = (lights.treated(sky="clear", elevation_deg=at) for at in (here, there))
        assert below.keys() == above.keys()
        for name, value in below.items():
            if name.startswith("grade_"):
                assert value == pytest.approx(above[name], abs=0.02), name
