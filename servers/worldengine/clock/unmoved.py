"""A recording of a world that nobody has simulated: its start, again and again, for as long as it will last.

A film is tried on it before anything is paid for (`worldwright.stage.film_trial`). What shows an author's law, or the
water of a solver, lies as it is built.
"""

import argparse
import sys
from typing import TYPE_CHECKING

from ..given import Given

if TYPE_CHECKING:
    import mujoco

    from ..recording.record import Recorder

RATE_HZ, MOST_ROWS = 60.0, 600


def run(given: Given, options: argparse.Namespace) -> None:
    """Write it into `options.out`.

    Raises:
        ProgramError: the world does not compile, or the facts beside it are of another one.
    """
    import mujoco
    import numpy as np

    from worldkit import world
    from worldkit.files import write_json

    from ..recording import still_surfaces
    from ..recording.describing import describe
    from ..recording.record import Recorder
    from .beside import Beside

    model = given.model()
    world.check_cast(model, given.movers, given.visual_only)
    data = world.start(model)
    cast = {"movers": list(given.movers), "visual_only": list(given.visual_only)}
    about = {"seed": given.seed, "duration": given.duration, "fps": given.fps, "record_every": 1}
    meta = {**describe(model, given.visual_only), **cast, **about}
    if given.laws:
        meta["laws"] = [row.written() for row in given.laws]
    mujoco.mj_forward(model, data)
    beside = Beside(model, data, given.solvers) if given.solvers else None
    if beside and beside.shown:
        meta["shown"] = beside.shown
    rows = int(np.clip(given.duration * RATE_HZ, 1, MOST_ROWS)) + 1
    with Recorder(model, data, options.out, meta) as recorder:
        if given.laws:
            _lay(recorder, model, data, given)
        if beside:
            beside.lay(recorder, len(given.laws))
        for time in np.linspace(0.0, given.duration, rows):
            data.time = time
            recorder.before()
            recorder.after()
    still_surfaces.write(model, options.out)
    write_json(options.out / "result.json", {"ok": True, "pass": "unmoved", "rows": rows})
    sys.stdout.write(f"the start of {model.nbody - 1} bodies, {rows} times\n")


def _lay(recorder: "Recorder", model: "mujoco.MjModel", data: "mujoco.MjData", given: Given) -> None:
    """Record the points of each law where what shows them stands."""
    import numpy as np

    from ..inputs.declared_media import Place

    for medium, row in enumerate(given.laws):
        points = Place(model, row).places(data)
        count = len(points)
        lies = {"step": np.zeros(count), "medium": np.full(count, medium), "point": np.arange(count)}
        told = lies | {"place": points, "colour": np.full(count, -1)}
        recorder.later("media", lambda told=told: told)  # type: ignore[misc]
        sums = (0, medium, 0.0, np.zeros(3), 0.0, 0.0, 0.0, 0.0, np.zeros(3))
        recorder.event("balances", *sums)
