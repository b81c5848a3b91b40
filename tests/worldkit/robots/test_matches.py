"""A match asks one policy once a tick for both teams; robots of the wheel play the ball and push each other."""

from pathlib import Path

import mujoco
import numpy as np
import pytest

from worldkit import contacts, model_files, models, scene
from worldkit.beside_program import below
from worldkit.robots import GAITS, Match, Walkers, packaged
from worldkit.robots.policies import opened

T1 = GAITS["t1"]
POLICY = next(
    (
        path
        for place in Path(__file__).parents
        if (path := place / "shared/data/policies/playground/t1_policy.onnx").is_file()
    ),
    None,
)


class Heard:
    """A policy that keeps what it is shown, and moves every servo by a tenth."""

    name, observation, action = "heard", T1.observation, len(T1.joints)

    def __init__(self):
        self.shown = []

    def __call__(self, rows):
        self.shown.append(rows)
        return np.full((len(rows), self.action), 0.1)


def still(name, x):
    """A trunk with the joints of a T1, each on a part of its own."""
    parts = "".join(
        f'<body><joint name="{name}_{joint}" axis="0 0 1"/><geom size="0.01"/></body>' for joint in T1.joints
    )
    trunk = f'<body name="{name}" pos="{x} 0 1"><freejoint/><geom size="0.1"/><site name="{name}_torso"/>{parts}</body>'
    servos = "".join(f'<position name="{name}_{T1.servo(joint)}" joint="{name}_{joint}"/>' for joint in T1.joints)
    return trunk, servos


def test_one_call_a_tick_for_both_teams_and_none_for_who_lies():
    (red, reds), (blue, blues) = still("red", -2), still("blue", 2)
    ball = '<body name="ball"><freejoint/><geom size="0.1"/></body>'
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody>{red}{blue}{ball}</worldbody><actuator>{reds}{blues}</actuator></mujoco>"
    )
    data, heard = mujoco.MjData(model), Heard()
    match = Match(Walkers(("red", "blue"), T1, heard), {"red": (5.0, 0.0), "blue": (-5.0, 0.0)}, "ball", 0.6)
    blue_at = model.joint(model.body("blue").jntadr[0]).qposadr[0]
    for step in range(25):
        data.time = 0.002 * step
        if step == 15:  # it lies on its side
            data.qpos[blue_at + 3 : blue_at + 7] = (np.sqrt(0.5), np.sqrt(0.5), 0, 0)
        mujoco.mj_forward(model, data)
        match(model, data)
    assert [rows.shape for rows in heard.shown] == [(2, T1.observation)] * 3
    assert np.allclose(heard.shown[0][:, 9:12], [(0.6, 0, 0), (-0.3, 0, -0.8)]), "blue looks away from the ball"
    assert match.falls.at[1] == pytest.approx(0.04) and match.falls.count == 1
    home = np.asarray(T1.home)
    assert np.allclose(data.ctrl[: len(home)], home + 0.1) and np.allclose(data.ctrl[len(home) :], home)


def test_a_match_has_two_goals():
    walkers = Walkers(("red", "blue"), T1, Heard())
    with pytest.raises(ValueError, match="here are 1"):
        Match(walkers, {"red": (5.0, 0.0), "blue": (5.0, 0.0)}, "ball", 0.6)


if "t1" in packaged.found() and POLICY:

    @pytest.fixture(scope="module")
    def pitch(tmp_path_factory):
        """A function that stands robots on a pitch with a ball in the middle, and returns model, data and walkers."""
        folder = tmp_path_factory.mktemp("run")
        made = model_files.whole(packaged.lay("t1", folder / "t1"), folder)
        walk = opened(POLICY, observation=T1.observation, action=len(T1.joints))
        grip = contacts.surface(friction=0.8, rolling=0, torsional=0, time_constant=0.008)

        def build(places, ball):
            spec = scene.new("pitch", time_step=0.002, floor_surface=grip)
            with below(folder):
                for name, (x, y, yaw) in places.items():
                    half = packaged.ROBOTS["t1"].extents[2] / 2
                    models.attach(
                        spec, made.text, name=name, pos=(x, y, half), yaw_deg=yaw, files=made.files, surface=grip
                    )
            spec.worldbody.add_body(name="ball", pos=(*ball, 0.11)).add_freejoint()
            spec.body("ball").add_geom(
                name="ball", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.11, 0, 0), mass=0.43, friction=(0.5, 0, 0)
            )
            model = spec.compile()
            data = mujoco.MjData(model)
            mujoco.mj_forward(model, data)
            return model, data, Walkers(tuple(places), T1, walk)

        return build

    def test_four_robots_play_the_ball_and_stay_on_their_feet(pitch):
        places = {"red_1": (-0.7, 0, 0), "red_2": (-3, 2, 0), "blue_1": (2, 0.5, 180), "blue_2": (4, -2, 180)}
        model, data, walkers = pitch(places, (0.0, 0.0))
        assert model.nmesh <= 29 and model.nu == 4 * len(T1.joints), "one set of meshes for all"
        goals = {name: (10.0 if name[0] == "r" else -10.0, 0.0) for name in places}
        match, touched = Match(walkers, goals, "ball", 0.6), set()
        while data.time < 2.5:
            match(model, data)
            mujoco.mj_step(model, data)
            pairs = [{model.body(model.geom_bodyid[g]).name for g in contact.geom} for contact in data.contact]
            touched |= {name for pair in pairs if "ball" in pair for name in pair}
        assert match.falls.count == 0 and data.body("ball").xpos[0] > 0.3
        assert any(name.startswith("red_1") for name in touched), "it was a robot that moved it"

    def test_two_robots_that_walk_into_each_other_touch_and_do_not_pass(pitch):
        model, data, walkers = pitch({"a": (-0.45, 0, 0), "b": (0.45, 0, 180)}, (0.0, 3.0))
        deepest, met = 0.0, False
        while data.time < 2.5:
            walkers(model, data, [(0.5, 0, 0), (0.5, 0, 0)])
            mujoco.mj_step(model, data)
            for contact in data.contact:
                whose = {model.body(model.geom_bodyid[g]).name[0] for g in contact.geom}
                if whose == {"a", "b"}:
                    met, deepest = True, max(deepest, -contact.dist)
        assert met and deepest < 0.01
        assert data.body("a").xpos[0] < data.body("b").xpos[0], "neither is on the other's side"
