"""The recording ends before the plan says it should.

What it means: the program crashed, was stopped by a limit, or stopped itself before the part that would have failed.

Formula: last recorded time against the plan's `simulation_duration`; and whether the recorder finished its file.
Threshold: two recorded rows of slack. Blocking.
Source: the reference paper's plan format, `simulation_duration` (user-owned).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS117"
NEEDS = ("t",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield once when the end is missing."""
    end = float(trajectory.t[-1])
    if not trajectory.complete:
        yield Sign("world", (end, end), end, end, "s", "blocking", f"the recording was cut off at {end:.4g} s")
    wanted = context.duration_s
    if wanted is not None and end < wanted - 2 * trajectory.interval_s - 1e-9:
        message = f"the recording ends at {end:.4g} s, the plan asks for {wanted:.4g} s"
        yield Sign("world", (end, wanted), end, wanted, "s", "blocking", message)


GOOD = (lambda: Case("all of it", analytic.resting(2.0), Context(planned=True, duration_s=2.0)),)
BAD = (
    lambda: Case("half of it", analytic.resting(2.0), Context(planned=True, duration_s=4.0), "blocking"),
    lambda: Case("a torn recording", replace(analytic.resting(), complete=False), severity="blocking"),
)
