"""The live pass: a world at the pace of the wall clock, driven by whoever is at the other end of a socket, and recorded.

What is recorded is the stream of its inputs, and now and then a whole row, so that an hour stays small; the full recording is
made by driving the world again by that stream (`physics --replay`), which must pass through the same rows, bit for bit. A kill
leaves what was driven until the last whole row that was flushed: rows are some 0.1 s apart in a small world, seconds in one of
a thousand bodies, and one is flushed half a second later.
"""

import argparse
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError

from .pacing import Pace

if TYPE_CHECKING:
    import mujoco

    from ..given import Given

TRAJECTORY = "trajectory"
ROWS_HZ = 10.0
"""Rows are recorded at most so often, 1/s of simulated time,"""
ROWS_BYTES_S = 100_000.0
"""and of a large world so seldom that they come to about so many bytes a simulated second, contacts apart."""
TELLS_HZ = 30.0
"""States are told so often, 1/s of wall-clock time."""
WAITS_S = 0.02


def run(given: "Given", options: argparse.Namespace) -> None:
    """Step the world live until the other end hangs up, the time is over, or its silence ends it as planned.

    Raises:
        WorldkitError: the world or its commands make no sense, or the simulation blew up; what was recorded is kept.
    """
    import mujoco

    from worldkit import world
    from worldkit.files import write_json
    from worldkit.vehicles.found_cars import find_cars

    from ..inputs import commands
    from ..inputs.operated import Operated
    from ..inputs.ports import Ports
    from ..recording import stored
    from ..recording.describing import describe
    from ..recording.record import Recorder
    from .simulate import prepare, simulate
    from .state_frames import EngineEnd

    if given.laws or given.solvers:
        names = ", ".join([*(row.name for row in given.laws), *(row.solver for row in given.solvers)])
        cause = f"{names} works beside the engine, and such a world is not stepped live"
        raise ProgramError(cause, "interventions", "take a world without `kind: solver`")
    out: Path = options.out
    model = given.model()
    most = world.steps_of(model, options.seconds)
    prepare(model)
    data = world.start(model)
    rows = commands.read(options.commands, model.nu)
    every = given.control_every
    ports = Ports(model, given.inputs)
    cars = {name: car for name, car in find_cars(model).items() if any(row.car == name for row in rows)}
    if lost := {row.car for row in rows if row.car} - set(cars):
        raise ProgramError(f"there is no car {', '.join(sorted(lost))}", str(options.commands), "begin the drive anew")
    console = commands.Console(rows, cars, data.ctrl, time.monotonic)
    inputs = Operated(model, data, ports, console, every, *_beside(model, given, options.replay, ports))
    row_every = _row_every(model)
    meta = {
        **describe(model, given.visual_only), "movers": list(given.movers), "visual_only": list(given.visual_only),
        "seed": given.seed, "fps": given.fps, "record_every": row_every, "inputs": ports.as_meta(),
        "control": {"every": every, "latency": 0}, "live": {"speed": options.speed},
    }  # fmt: skip
    end = EngineEnd(options.socket, model, data)
    talk = _Talk(end, console, data, options.waits)
    # RK4 takes its steps in another way than the engine by itself, so all of them here; see `simulate`.
    whole = model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
    pace = Pace(
        float(model.opt.timestep), every, options.speed, most, lambda step: talk.between(step, pace),
        rows=1 if whole else row_every, steady=not cars and options.replay is None,
    )  # fmt: skip
    started = time.perf_counter()
    with Recorder(model, data, out / TRAJECTORY, meta) as recorder:
        computed = time.thread_time()
        steps = simulate(model, data, recorder, pace, inputs, row_every, leap=lambda: pace.ahead)
        computed = time.thread_time() - computed
    wall = time.perf_counter() - started
    result = {
        "ok": True, "pass": "live", "steps": steps, "time_step": float(model.opt.timestep), "why": talk.why,
        "simulated_s": steps * float(model.opt.timestep), "wall_s": round(wall, 3), "cpu_s": round(computed, 4), "rows": recorder.rows,
        "record_every": row_every, "overruns": pace.overruns, "worst_s": round(pace.worst_s, 4),
        "lost_s": round(pace.lost_s, 4), "jumps": pace.jumps, "refused": talk.refused, "missed": end.missed,
        "inputs_sha256": stored.inputs_digest(out / TRAJECTORY), "trajectory_sha256": recorder.sha256(),
    }  # fmt: skip
    write_json(out / "result.json", result)
    talk.last(steps, pace)
    end.close()
    sys.stdout.write(f"{steps} steps, {result['simulated_s']:.2f} s driven in {wall:.1f} s: {talk.why}\n")


def _beside(model: "mujoco.MjModel", given: "Given", recording: Path | None, ports: Any) -> tuple[Any, int]:
    """What was recorded of the inputs, and its steps."""
    from worldkit.world import steps_of

    from ..inputs.strict_stream import Recorded
    from ..recording.stored import Replayable

    if recording is None:
        return None, 0
    steps = steps_of(model, given.duration)
    return Recorded(Replayable(recording), model, ports, steps, given.control_every), steps


def _row_every(model: "mujoco.MjModel") -> int:
    size = 8 * (20 * model.nbody + model.nq + model.nv + model.nsensordata + 3 * model.nu)
    steps = max(1, round(max(1 / ROWS_HZ, size / ROWS_BYTES_S) / float(model.opt.timestep)))
    return 1 << (steps - 1).bit_length()  # a power of two: a replay of any length then has rows at the same states


class _Talk:
    """What is said between the parts of a drive: commands in, states out."""

    def __init__(self, end: Any, console: Any, data: "mujoco.MjData", waits: bool) -> None:
        self._end, self._console, self._data, self._waits = end, console, data, waits
        self._began = self._next = time.monotonic()
        self._mark = (self._began, 0.0)
        self._factor = 0.0
        self.refused = 0
        self.why = "the time is over"

    def between(self, step: int, pace: Pace) -> bool:
        while self._once(step, pace):
            if not self._waits or self._console.spoken:
                self._waits = False
                return True
            time.sleep(WAITS_S)
        return False

    def _once(self, step: int, pace: Pace) -> bool:
        lines = self._end.lines()
        for line in lines or ():
            self.refused += not self._console.hear(line)
        if lines is None:
            self.why = "its driver's end was closed"
            return False
        if not self._console.settle():
            self.why = "nobody has driven for as long as the plan allows"
            return False
        now = time.monotonic()
        if now >= self._next:
            self._next = max(self._next + 1 / TELLS_HZ, now)
            if not self._end.tell(self._facts(step, pace, now)):
                self.why = "its driver's end was closed"
                return False
        return True

    def last(self, step: int, pace: Pace) -> None:
        """Tell the state at the end, and why it ended."""
        self._end.tell({**self._facts(step, pace, time.monotonic()), "ended": self.why})

    def _facts(self, step: int, pace: Pace, now: float) -> dict[str, Any]:
        since, at = self._mark
        if now - since >= 1.0:
            self._factor, self._mark = (float(self._data.time) - at) / (now - since), (now, float(self._data.time))
        return {
            "step": step, "time_s": float(self._data.time), "wall_s": now - self._began, "factor": self._factor,
            "overruns": pace.overruns, "worst_s": pace.worst_s, "lost_s": pace.lost_s, "jumps": pace.jumps,
            "waits": self._waits, "silent": self._console.silent, "commands": self._console.values, "refused": self.refused,
        }  # fmt: skip
