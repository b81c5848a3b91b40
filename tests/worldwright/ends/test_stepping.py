"""What is declared beside the controls acts as it was recorded, step by step; nothing of one episode is left in the next."""

import dataclasses
import json

import mujoco
import numpy as np

from small_worlds import ball, empty, floor, record
from worldengine.given import Given
from worldkit import portable
from worldwright.ends.accepted_world import AcceptedWorld
from worldwright.ends.observations import columns
from worldwright.ends.stepping import Stepped

ROWS = (("control", frozenset({"motor"})), ("force", frozenset({"ball"})), ("velocity", frozenset({"ball"})), ("parameter", frozenset({"opt.gravity"})))  # fmt: skip


def control(model, data):
    data.ctrl[0] = np.sin(9 * data.time)
    data.xfrc_applied[data.body("ball").id, 0] = 3.0 if data.time > 0.02 else 0.0
    if abs(data.time - 0.05) < 1e-9:
        data.joint("ball").qvel[2] = 1.5
    if data.time > 0.08:
        model.opt.gravity[2] = -3.0


def pushed(folder, every=1):
    """The world of a cart with a motor and a ball that is pushed, kicked, and made lighter; and its recording."""
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 1, 0.1))
    cart = spec.worldbody.add_body(name="cart", pos=(0, 0, 0.3))
    cart.add_joint(name="way", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    cart.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.1))
    spec.add_actuator(name="motor", target="way", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    facts = folder / "world"
    facts.mkdir()
    portable.write(spec, folder / "world.mjz")
    said = {"duration": 0.12, "fps": 24, "size": [64, 48], "movers": [], "visual_only": [], "seed": 0, "latency": 0}
    (facts / "program.json").write_text(json.dumps({**said, "control": "control", "control_every": every}))
    (facts / "inputs.json").write_text(json.dumps([{"kind": kind, "bodies": sorted(of)} for kind, of in ROWS]))
    recording = record(
        portable.read(folder / "world.mjz"), folder / "recording", 120, control, rows=ROWS, control_every=every
    )
    for name in ("inputs", "edits"):
        (facts / f"{name}.arrows").write_bytes((recording.folder / f"{name}.arrows").read_bytes())
    given = Given.read(folder / "world.mjz", facts / "program.json", facts / "inputs.json")
    return AcceptedWorld(folder, given, None), recording


def test_the_rest_acts_as_recorded_in_every_episode(tmp_path):
    world, recording = pushed(tmp_path)
    stepped = Stepped(world)
    controls = stepped.recorded_controls()
    assert controls[:, 0].std() > 0.1 and stepped.others > 0 and recording.edits.step.size
    for _ in range(2):
        stepped.begin()
        stepped.look()
        for row, action in enumerate(controls):
            seen = columns(stepped.model, stepped.data)
            assert all(np.array_equal(seen[name], getattr(recording, name)[row]) for name in ("qpos", "pos")), row
            stepped.act(action)
        assert np.array_equal(stepped.data.qpos, recording.qpos[-1])
    assert recording.qvel[60, 2] > 1.0


def test_a_program_that_answers_nothing_leaves_no_action(tmp_path):
    world, _ = pushed(tmp_path)
    silent = dataclasses.replace(world, given=dataclasses.replace(world.given, control=""))
    stepped = Stepped(silent)
    assert stepped.indices == () and stepped.others == 0


def test_a_world_that_blows_up_is_sick_until_it_begins_anew(tmp_path):
    stepped = Stepped(pushed(tmp_path)[0])
    stepped.begin()
    stepped.data.qvel[0] = 1e12
    stepped.look()
    stepped.act(np.zeros(1))
    assert stepped.sick
    stepped.begin()
    assert not stepped.sick


def test_the_last_action_ends_with_the_plans_duration(tmp_path):
    world, recording = pushed(tmp_path, every=50)
    stepped = Stepped(world)
    controls = stepped.recorded_controls()
    stepped.begin()
    stepped.look()
    for action in controls:
        stepped.act(action)
    assert len(controls) == 3 and stepped.step_number == 120
    assert np.array_equal(stepped.data.qpos, recording.qpos[-1])
