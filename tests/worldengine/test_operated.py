"""Who drives has the controls, the rest acts as it was recorded, as far as that goes; the stream alone repeats all of it."""

import json

import mujoco
import numpy as np

from small_worlds import ball, empty, floor, record
from worldengine.clock.simulate import prepare, simulate
from worldengine.inputs.commands import Command, Console
from worldengine.inputs.operated import Operated
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Replayed
from worldengine.inputs.strict_stream import Recorded
from worldengine.recording import describing, stored
from worldengine.recording.record import Recorder
from worldkit.world import start

ROWS = (("control", frozenset({"motor"})), ("force", frozenset({"ball"})), ("velocity", frozenset({"ball"})), ("parameter", frozenset({"opt.gravity"})))  # fmt: skip
RECORDED, DRIVEN, EVERY = 120, 200, 4


def world():
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 1, 0.5))
    cart = spec.worldbody.add_body(name="cart", pos=(0, 0, 0.3))
    cart.add_joint(name="way", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    cart.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.1))
    spec.add_actuator(name="motor", target="way", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    return spec.compile()


def control(model, data):
    data.ctrl[0] = 1.0
    data.xfrc_applied[data.body("ball").id, 0] = 3.0 if data.time > 0.02 else 0.0
    if abs(data.time - 0.048) < 1e-9:
        data.joint("ball").qvel[1] = 1.5
    if data.time > 0.08:
        model.opt.gravity[2] = -3.0


def driven(folder, before):
    """The world under commands that swing, fall silent, and are spoken again, for longer than it was recorded."""
    model = world()
    prepare(model)
    data = start(model)
    ports = Ports(model, ROWS)
    wall = [0.0]
    console = Console((Command("motor", control=0, low=-2, high=2, timeout_s=0.02),), {}, data.ctrl, lambda: wall[0])
    beside = Recorded(before, model, ports, RECORDED, EVERY)

    def steps():
        for step in range(DRIVEN):
            wall[0] = step * 0.001
            if step % EVERY == 0 and not 60 <= step < 100:
                console.hear(json.dumps({"values": {"motor": 5 * np.sin(9 * wall[0])}}).encode())
            console.settle()
            yield step

    meta = {**describing.describe(model), "inputs": ports.as_meta()}
    with Recorder(model, data, folder, meta) as recorder:
        taken = simulate(model, data, recorder, steps(), Operated(model, data, ports, console, EVERY, beside, RECORDED))
    assert taken == DRIVEN
    return stored.open(folder)


def test_the_rest_acts_as_recorded_and_the_stream_repeats_it(tmp_path):
    before = record(world(), tmp_path / "before", RECORDED, control, rows=ROWS, control_every=EVERY)
    live = driven(tmp_path / "live", before)
    dof = slice(0, 7)
    assert np.array_equal(live.qpos[: RECORDED + 1, dof], before.qpos[:, dof]) and before.qvel[60, 1] > 1.0
    assert live.qvel[-1, 0] == live.qvel[RECORDED, 0] > 0.1, "nobody pushes any more"
    assert abs(live.ctrl[:, 0]).max() <= 2.0 and np.ptp(live.ctrl[:60, 0]) > 0.3
    assert (live.ctrl[84:100, 0] == 0).all() and live.ctrl[100, 0] != 0, "silence, and a word again"
    model = world()
    prepare(model)
    data = start(model)
    ports = Ports(model, ROWS)
    meta = {**describing.describe(model), "inputs": ports.as_meta()}
    with Recorder(model, data, tmp_path / "again", meta) as recorder:
        simulate(model, data, recorder, DRIVEN, Replayed(model, data, ports, live, DRIVEN, EVERY))
    again = stored.open(tmp_path / "again")
    assert again.sha256 == live.sha256 and np.array_equal(again.qpos, live.qpos)
    assert stored.inputs_digest(live.folder) == stored.inputs_digest(again.folder) != ""
