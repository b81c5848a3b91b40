"""A world that is driven live: what its loop costs beside a bare one, and what the pictures of its page cost.

The loop is the confined engine's own, of a car with nobody at the wheel, which reads a socket, tells states, keeps its pace
and records; the bare one steps the same model by `mj_step`, with the same pedals as often, and does nothing else. Both are measured in
processor time of their one thread, alternating, and the ratio is that of the medians: what else runs on the machine counts as
little as can be. At the pace of the wall clock the loop sleeps and wakes 250 times a second besides; that is told as a share of a
processor. Pictures are told as the share of a processor that fifteen of them a second take, drawn and encoded; the end that speaks
ROS 2 as the share that all its topics take 25 times a second, with the lidar's ring and without a listener.

    python tests/bench/live_drive.py [--seconds 20] [--repeats 5]
"""

import argparse
import json
import os
import resource
import statistics
import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace

from figures import Figure, report

sys.path.insert(0, str(Path(__file__).parents[2] / "servers"))
sys.path.insert(0, str(Path(__file__).parents[1]))

import cv2
import mujoco
import numpy as np

from small_worlds import empty, floor
from worldengine.clock.simulate import prepare
from worldengine.clock.state_frames import signature
from worldkit import portable, vehicles
from worldkit.vehicles.found_cars import find_cars
from worldwright.ends import chase_pictures
from worldwright.ends.live_source import LiveSource
from worldwright.ends.live_world import LiveWorld
from worldwright.ends.ros_live import RATE_HZ, RosAsked, RosEnd
from worldwright.ends.seats import Seats
from worldwright.model.evidence.run import Run
from worldwright.model.plan.plan_text import read_plan
from worldwright.stage import tools as stage

PLAN = Path(__file__).parents[1] / "worldwright/world/driven_car_plan.md"
LOOP, LIGHT, REAL_TIME, PICTURES, NETWORK = 1.15, 1.3, 0.1, 0.5, 0.25
"""A car alone on a plane is stepped in 12 us, so light that asking for its pedals and recording ten rows a second show."""
BOXES = 25
EVERY = 10
"""Steps of 2 ms from one question to the next."""


def driven(folder: Path, boxes: int = 0) -> LiveSource:
    """A car on a plane, with its pedals declared, and a pile of boxes before it."""
    spec = empty(time_step=0.002)
    floor(spec)
    for number in range(boxes):
        place = (12 + 0.3 * (number % 5), 0.3 * (number // 5 % 5), 0.2 + 0.3 * (number // 25))
        body = spec.worldbody.add_body(name=f"box_{number}", pos=place)
        body.add_freejoint()
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.12, 0.1, 0.08))
    vehicles.add(spec, vehicles.Car(), name="car")
    portable.write(spec, folder / "world.mjz")
    (folder / "plan.md").write_bytes(PLAN.read_bytes())
    facts = {
        "duration": 9.0,
        "fps": 24,
        "size": (640, 360),
        "movers": ["car"],
        "visual_only": [],
        "seed": 0,
        "laws": [],
    }
    facts |= {"control": "control", "control_every": EVERY, "latency": 0}
    (folder / "program.json").write_text(json.dumps(facts))
    (folder / "inputs.json").write_text(json.dumps(stage.declared_inputs(PLAN)))
    plan = read_plan(PLAN).plan
    return LiveSource(Run(folder), plan, PLAN, folder / "world.mjz", folder, None, folder / "no motion")


def live(source: LiveSource, seconds: float, speed: float) -> dict:
    """Drive it to its end with nobody at the wheel, so that it brakes; what the engine says of it."""
    world = LiveWorld(source, speed, seconds, waits=False)
    world.wait(600)
    world.close()
    return dict(json.loads((world.folder / "live/result.json").read_bytes()))


def bare(source: LiveSource, steps: int) -> float:
    """Processor time of as many plain steps, with the same pedals as often, s."""
    model = source.given.model()
    prepare(model)
    data = mujoco.MjData(model)
    ((name, car),) = find_cars(model).items()
    began = time.thread_time()
    for step in range(steps):
        if step % EVERY == 0:
            vehicles.pedals(car, model, data, name, brake=1.0)
        mujoco.mj_step(model, data)
    return time.thread_time() - began


def overhead(source: LiveSource, seconds: float, repeats: int) -> tuple[float, float]:
    """Processor time of the live loop over that of a bare one; that of a bare step, s."""
    loops, bares, steps = [], [], 1
    for _ in range(repeats):
        said = live(source, seconds, 100.0)
        steps = said["steps"]
        loops.append(said["cpu_s"])
        bares.append(bare(source, steps))
    return statistics.median(loops) / statistics.median(bares), statistics.median(bares) / steps


def pictures(source: LiveSource, look: str, count: int = 15) -> float:
    """Processor time of so many pictures of the page, drawn and encoded, s."""
    view = chase_pictures.LiveView(source, look=look)
    model = source.model
    data, state = mujoco.MjData(model), np.zeros(mujoco.mj_stateSize(model, signature()))
    began = 0.0
    for number in range(-2, count):
        if number == 0:
            began = _computed()
        data.time, data.qpos[0] = 0.05 * number, 0.3 * number
        mujoco.mj_getState(model, data, state, signature())
        cv2.imencode(".jpg", view.draw(state)[..., ::-1], [cv2.IMWRITE_JPEG_QUALITY, chase_pictures.QUALITY])
    spent = _computed() - began
    view.close()
    return spent


def network(source: LiveSource, rounds: int = 100) -> float:
    """Processor time a second of the end that speaks ROS 2, s: of a car that moves, in a domain where nobody is."""
    model = source.model
    data, state = mujoco.MjData(model), np.zeros(mujoco.mj_stateSize(model, signature()))
    world = SimpleNamespace(source=source, commands=(), newest=({}, None))
    end = RosEnd(world, Seats([], print, print, lambda: 0.0), RosAsked(domain=231, lidar=True), "car")
    told, began, topics = end.told, _computed(), len(end._publishers)
    while end.told < told + rounds * topics:
        data.time, data.qpos[0] = data.time + 0.02, 0.3 * data.time
        mujoco.mj_getState(model, data, state, signature())
        world.newest = ({}, state.copy())
        time.sleep(0.02)
    spent = (_computed() - began) / ((end.told - told) / topics)
    end.close()
    return spent * RATE_HZ


def _computed() -> float:
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def main() -> int:
    """Measure, print, and answer the exit code."""
    os.environ.setdefault("LP_NUM_THREADS", "1")  # as the page's own thread has it
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--repeats", type=int, default=5)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place, tempfile.TemporaryDirectory() as other:
        source = driven(Path(place))
        alone, step_s = overhead(source, options.seconds, options.repeats)
        piled, _ = overhead(driven(Path(other), BOXES), options.seconds, options.repeats)
        slow = live(source, 4.0, 1.0)
        quick = pictures(source, chase_pictures.QUICK)
        film = pictures(source, chase_pictures.FILM)
        ros = network(source)
    print(
        f"bare {1e6 * step_s:.1f} us a step; a picture {1000 * quick / 15:.1f} ms, as a film {1000 * film / 15:.1f} ms"
    )
    return report(
        Figure(f"live loop over a bare one, a car and {BOXES} boxes", piled, LOOP),
        Figure("live loop over a bare one, a car alone", alone, LIGHT),
        Figure("processors of a car driven in real time", slow["cpu_s"] / slow["simulated_s"], REAL_TIME, "core"),
        Figure("processors of 15 pictures a second", quick, PICTURES, "core"),
        Figure("processors of a ROS 2 network, 25 times a second", ros, NETWORK, "core"),
        Figure("the film's look over the quick one", film / quick, 3.0, at_least=True),
    )


if __name__ == "__main__":
    sys.exit(main())
