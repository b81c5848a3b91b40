"""A hand as bodies: it holds still, its digits bend towards the palm, it closes on a ball and opens when nobody pulls."""

import mujoco
import numpy as np
import pytest

from worldkit import bodies, scene, sculpt

DIGITS = ("index", "middle", "ring", "little", "thumb")


@pytest.mark.parametrize("side", ["left", "right"])
def test_it_closes_on_a_ball_with_a_stated_torque_and_opens_again(side):
    spec = scene.new("hand", time_step=0.001)
    parts = sculpt.hand_parts("relaxed", palm=(0, 0, 1), side=side, cells=32, sleeve="#334455")
    sculpt.assemble(spec, parts, pos=(0, 0, 0.5), origin=(0, 0, 0), fixed=True)
    bodies.sphere(spec, "ball", diameter=0.055, pos=(0.078, 0, 0.547), mass=0.06)
    for name in DIGITS:
        spec.add_actuator(name=name, target=name, trntype=mujoco.mjtTrn.mjTRN_JOINT).set_to_motor()
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert data.ncon == 0, "no part is in another"
    data.ctrl[:] = 0.3
    mujoco.mj_step(model, data, 600)
    bent = np.degrees([data.joint(name).qpos[0] for name in DIGITS])
    assert (bent[:4] > 20).all() and bent[4] > 5, "towards the palm, whichever hand it is"
    touching = {model.body(model.geom_bodyid[geom]).name for pair in data.contact.geom for geom in pair}
    assert {"ball", "palm"} <= touching and touching & set(DIGITS)
    assert np.linalg.norm(data.body("ball").xpos - (0.07, 0, 0.54)) < 0.05, "it is in the hand"
    data.ctrl[:] = 0.0
    mujoco.mj_step(model, data, 1500)
    assert (np.degrees([data.joint(name).qpos[0] for name in DIGITS[:4]]) < bent[:4] - 10).all()


def test_the_palm_looks_where_it_is_told_and_two_directions_alike_are_refused():
    palm, *digits = sculpt.hand_parts("flat", palm=(0, -1, 0), fingers=(0, 0, -1), cells=32)
    middle = next(part for part in digits if part.name == "middle")
    assert middle.shape.low[2] < -0.17 and palm.shape.high[2] > 0.1, "fingers hang down, the arm goes up"
    with pytest.raises(ValueError, match="right angles"):
        sculpt.hand_parts(palm=(1, 0, 0), fingers=(1, 0, 0))
