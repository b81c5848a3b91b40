"""Estimate from its first steps what the physics pass of a world will cost; runs in the sandbox beside `compile_world.py`.

The steps are taken and recorded as the engine's process does it, without asking the program's control. An author's laws, of which a
medium's takes more time than the engine does, are asked as often as they will be.
"""

import copy
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

STEPS, LEAST_S, MOST_S = 50, 0.3, 3.0
"""It takes so many steps, more if they are quick until the first time (s) is over, fewer if they are slow at the second:
by then what falls has landed."""


class Enough(BaseException):
    """Stops the rehearsal: its time is over."""


def rehearse(
    model: Any, duration_s: float, folder: Path, laws: Sequence[Any] = (), control_every: int = 1
) -> dict[str, float]:
    """Take the first steps of a compiled model.

    Args:
        model: compiled; it is copied.
        duration_s: how long the whole simulation lasts, s.
        folder: the recording of the rehearsal is kept here.
        laws: the author's own (`worldkit.laws.Law`).
        control_every: steps from one question to them to the next.

    Returns:
        `taken` steps lasted `seconds`, of `steps` in all. Only the later half of the rehearsal counts: it is more like the
        rest.
    """
    from worldengine.clock.simulate import prepare, simulate
    from worldengine.recording.describing import describe
    from worldengine.recording.record import Recorder
    from worldkit import world
    from worldkit.laws import WORLD

    steps = world.steps_of(model, duration_s)
    every = world.record_every(model, steps)
    model = copy.copy(model)
    prepare(model)
    data = world.start(model)
    asked = [(law, [model.body(name).id if name != WORLD else 0 for name in law.bodies]) for law in laws]
    for law, _ in asked:
        law.start(model, data)
        law.step(model, data, control_every * model.opt.timestep)  # some are compiled when they are asked first
    marks: list[float] = []
    began = time.perf_counter()

    def tick(step: int) -> None:
        if step % control_every == 0:
            for law, bodies in asked:
                data.xfrc_applied[bodies] = law.step(model, data, control_every * model.opt.timestep)
            data.xfrc_applied[0] = 0.0
        marks.append(time.perf_counter())
        elapsed = marks[-1] - began
        if elapsed > MOST_S or (elapsed > LEAST_S and len(marks) >= STEPS):
            raise Enough

    meta = {**describe(model, ()), "record_every": every}
    try:
        with Recorder(model, data, folder / "rehearsal", meta) as recorder:
            simulate(model, data, recorder, steps, None, every, tick)
    except Enough:
        pass
    half = len(marks) // 2
    taken = len(marks) - 1 - half
    return {"taken": taken, "seconds": marks[-1] - marks[half], "steps": steps} if taken > 0 else {}
