"""A world with an author's law: three points on springs hang from a fixed place, and a weight from them."""

from pathlib import Path

import mujoco
import numpy as np

from small_worlds import ball, empty
from worldengine.clock.simulate import prepare, simulate
from worldengine.inputs.author_link import Local
from worldengine.inputs.declared_media import Media, Medium
from worldengine.inputs.ports import Ports
from worldengine.inputs.replayed_inputs import Asked, Replayed
from worldengine.recording import describing, stored
from worldengine.recording.record import Recorder
from worldkit.world import start

ROW = Medium("springs", ("weight",), "net", world=True)
STEPS = 150


class Springs:
    """Three points in a row, hung from a fixed place, the last of which carries a weight."""

    name, bodies, shown_by = "springs", ("weight", "world"), "net"
    stiffness, length = 200.0, 0.1

    def start(self, model, data):
        self.points = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, 0.9], [0.0, 0.0, 0.8]])
        self.velocities, self.mass = np.zeros((3, 3)), np.full(3, 0.1)
        self.gravity, self.carried = model.opt.gravity, data.xpos[1].copy()

    def step(self, model, data, seconds):
        self.carried = data.xpos[1].copy()
        away = np.diff(np.concatenate([[[0.0, 0.0, 1.1]], self.points, [self.carried]]), axis=0)
        apart = np.linalg.norm(away, axis=1, keepdims=True)
        pull = self.stiffness * (apart - self.length) * away / apart
        force = self.mass[:, None] * self.gravity + pull[1:] - pull[:-1]
        self.velocities = self.velocities + seconds * force / self.mass[:, None]
        self.points = self.points + seconds * self.velocities
        return np.array([-pull[-1], pull[0]])

    def energy(self):
        chain = np.concatenate([[[0.0, 0.0, 1.1]], self.points, [self.carried]])
        stretch = np.linalg.norm(np.diff(chain, axis=0), axis=1) - self.length
        return self.stiffness / 2 * float((stretch**2).sum())


def world(points: int = 3, **flex) -> mujoco.MjSpec:
    spec = empty(time_step=0.001)
    ball(spec, "weight", (0, 0, 0.7), radius=0.03, mass=0.2)
    net = spec.add_flex(name="net")
    net.dim, net.vertbody, net.elem = 1, ["world"], [n for k in range(points - 1) for n in (k, k + 1)]
    net.vert = [x for k in range(points) for x in (0.0, 0.0, 1.0 - 0.1 * k)]
    net.radius, net.contype, net.conaffinity = 0.005, flex.get("contype", 0), 0
    return spec


def motor() -> mujoco.MjSpec:
    """A cart with a motor beside it."""
    spec = world()
    cart = spec.worldbody.add_body(name="cart", pos=(1, 0, 0))
    cart.add_joint(name="x", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    cart.add_joint(name="y", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(0, 1, 0))
    cart.add_geom(size=(0.05, 0, 0))
    spec.add_actuator(name="pull", target="x", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    return spec


def run(
    folder: Path, law=None, spec=None, rows=(ROW,), others=(), drive=None, steps: int = STEPS, control=None
) -> stored.Recording:
    model = (spec or world()).compile()
    prepare(model)
    data = start(model)
    ports = Ports(model, tuple(others), Media(model, rows, model.opt.timestep, others, steps))
    inputs = (
        Asked(model, data, ports, Local(model, data, ports, control, [law or Springs()]))
        if drive is None
        else Replayed(model, data, ports, drive, steps)
    )
    meta = {**describing.describe(model), "inputs": ports.as_meta(), "laws": [row.written() for row in rows]}
    with Recorder(model, data, folder, meta) as recorder:
        simulate(model, data, recorder, steps, inputs)
    return stored.open(folder)
