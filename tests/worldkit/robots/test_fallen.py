"""Who has fallen is told, held in its home pose, and forgotten when the world starts anew."""

import mujoco
import numpy as np

from worldkit.robots import GAITS
from worldkit.robots.fallen import Falls

TWO = """<mujoco><worldbody>
  <body name="a" pos="0 0 1"><freejoint/><geom size="0.1"/></body><body name="b" pos="1 0 1"><freejoint/><geom size="0.1"/></body>
</worldbody></mujoco>"""


def test_one_that_tips_is_counted_from_then_on():
    model = mujoco.MjModel.from_xml_string(TWO)
    data, falls = mujoco.MjData(model), Falls(("a", "b"), GAITS["t1"])
    for time, tilt, up in ((0.0, 0.0, True), (1.0, 30.0, True), (1.5, 60.0, False), (2.0, 0.0, False)):
        data.time, half = time, np.radians(tilt) / 2
        data.qpos[10:14] = (np.cos(half), np.sin(half), 0, 0)
        mujoco.mj_kinematics(model, data)
        able, held = falls(data)
        assert able.tolist() == [True, up]
    assert falls.count == 1 and falls.at[1] == 1.5 and np.isnan(falls.at[0])
    assert np.isnan(held[0]).all() and np.array_equal(held[1], GAITS["t1"].home)
    data.time = 0.0
    able, _ = falls(data)
    assert able.all() and falls.count == 0
