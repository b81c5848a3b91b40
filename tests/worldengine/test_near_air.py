"""What is near is drawn without the haze, which would not show: the same picture to the last bit."""

import mujoco
import numpy as np
import pytest

from worldengine.film.renderers import preview
from worldengine.film.renderers.preview.near_air import CLEAR_M, Reach
from worldengine.film.treatment import Treatment
from worldkit import bodies, cameras, scene

pytestmark = pytest.mark.gl
SIZE = (160, 90)
SKY = Treatment(sky_zenith=(0.2, 0.4, 0.8), sky_horizon=(0.7, 0.8, 0.9), sky_ground=(0.3, 0.3, 0.3))
CLOTH = '<mujoco><worldbody><flexcomp name="cloth" type="grid" count="6 6 1" spacing=".1 .1 .1" pos="0 .8 .5" radius=".01" dim="2"/></worldbody></mujoco>'
AWAY = {"near": 0.0, "edge": 9.0, "far": 40.0}


@pytest.fixture(scope="module")
def world():
    spec = scene.new("air", time_step=0.002)
    for number, (name, away) in enumerate(AWAY.items()):
        size = 0.3 * (1 + away)
        bodies.sphere(spec, name, diameter=size, pos=((0.4 + size) * number - 0.4, away, size / 2))
    spec.attach(mujoco.MjSpec.from_string(CLOTH), prefix="", frame=spec.worldbody.add_frame())
    cameras.add(spec, "eye", subjects=("near",))
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    drawing = preview.take(model, *SIZE)
    yield drawing, model, data
    drawing.close()


def test_the_picture_is_as_with_haze_over_all(world, monkeypatch):
    drawing, _, data = world
    drawing.treat(SKY)
    found = drawing.image(data, 0, "video")
    painter = drawing._pipeline.painter
    assert 0 < painter._hazed.sum() < len(painter._hazed) and not painter._hazed[-1], "the cloth is near"
    monkeypatch.setattr(Reach, "hazed", lambda self, rows, balls, eye: np.ones(len(rows), bool))
    assert np.array_equal(drawing.image(data, 0, "video"), found)


def test_only_what_lies_wholly_within_clear_air_is_without_haze(world):
    drawing, model, data = world
    drawing.treat(SKY)
    drawing.image(data, 0, "video")
    painter, things = drawing._pipeline.painter, drawing._pipeline.things
    for name in AWAY:
        body = model.body(name)
        row = int(np.flatnonzero(things.geoms == body.geomadr[0])[0])
        farthest = np.linalg.norm(data.xpos[body.id] - data.cam_xpos[0]) + model.geom_rbound[body.geomadr[0]]
        assert painter._hazed[row] or farthest <= CLEAR_M
        assert painter._hazed[row] == (name != "near")
    assert painter._hazed[things.ground], "it has no end"


def test_of_strands_and_of_what_lies_between_nobody_knows_how_far_they_reach(world):
    drawing = world[0]
    reach, rows = Reach(drawing._pipeline.things), drawing._pipeline.painter._rows
    count = len(drawing._pipeline.things.rows)
    more = np.concatenate([rows[:count], np.zeros((3, rows.shape[1]))])
    balls = np.array([[0.0, 0, 0, 1.0], [np.inf] * 4])
    assert reach.hazed(more, balls, np.zeros(3))[count:].tolist() == [True, False, True]
    assert reach.hazed(more, balls, np.array([0.0, 11.5, 0]))[count + 1]
