import math

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.model.plan.committed import Plan
from worldwright.model.plan.drives import End
from worldwright.model.plan.fastening import SIDES, point
from worldwright.model.plan.layout import PlacedObject, Scene

SIZE = (0.4, 0.2, 0.1)


def world(deg_x: float, deg_z: float) -> tuple[Plan, Scene]:
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0},
            "objectives": [{"claim": "It hangs."}],
            "scene_objects": [{"name": "plank", "primitive": "box", "size": SIZE, "deg_x": deg_x}],
        }
    )
    placed = PlacedObject(
        name="plank", kind="scene_object", size=plan.scene_objects[0].extents, position=(1, 2, 3), deg_z=deg_z
    )
    return plan, Scene(objects=(placed,))


@settings(max_examples=25, deadline=None)
@given(st.floats(-180, 180), st.floats(-180, 180), st.sampled_from(sorted(SIDES)))
def test_an_end_lies_on_the_side_of_the_tilted_shape_that_worldkit_builds(deg_x, deg_z, side):
    from worldkit import bodies

    plan, scene = world(deg_x, deg_z)
    spec = mujoco.MjSpec()
    bodies.box(spec, "plank", size=SIZE, pos=(1, 2, 3), yaw_deg=deg_z, tilt_deg=deg_x)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    offset = (0.01, -0.02, 0.03)
    own = np.array(SIDES[side]) * SIZE / 2 + offset
    # The compiler may turn the geom into its principal axes only for meshes: a box keeps the frame it was given,
    # but drops a tilt of a ten-thousandth of a degree, which is why this is not exact.
    wanted = data.geom("plank").xpos + data.geom("plank").xmat.reshape(3, 3) @ own
    assert point(End(body="plank", at=side, offset=offset), plan, scene) == pytest.approx(wanted, abs=1e-5)


def test_the_order_is_tilt_then_yaw():
    plan, scene = world(90, 90)
    # +Z of the plank turns to -Y by the tilt, and that to +X by the yaw.
    assert point(End(body="plank", at="top"), plan, scene) == pytest.approx((1.05, 2, 3))
    assert math.dist(point(End(body="plank", at="left"), plan, scene), (1, 2, 3.1)) < 1e-9


def test_an_end_on_a_tilted_compound_moves_with_its_box():
    from worldkit import bodies

    row = {
        "name": "plank",
        "primitive": "compound",
        "deg_x": 40,
        "parts": [
            {"name": "bar", "primitive": "box", "size": [0.4, 0.2, 0.1], "offset": [0, 0, 0.05]},
            {"name": "hook", "primitive": "box", "size": [0.02, 0.02, 0.2], "offset": [0, 0.09, 0.2]},
        ],
    }
    base, scene = world(0, 25)
    plan = Plan.model_validate(base.model_dump() | {"scene_objects": [row]})
    made = plan.scene_objects[0]
    spec = mujoco.MjSpec()
    bodies.compound(spec, "plank", parts=[p.part() for p in made.parts], pos=(1, 2, 3), yaw_deg=25, tilt_deg=40)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    hook = data.geom("plank/hook")
    tip = hook.xpos + hook.xmat.reshape(3, 3) @ (0, 0, 0.1)
    assert point(End(body="plank", at="top", offset=(0, 0.09, 0)), plan, scene) == pytest.approx(tip, abs=1e-8)
