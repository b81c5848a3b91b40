"""The simulator itself warned.

What it means: it met numbers it could not use (bad position, velocity, acceleration: it resets the state, so the motion
afterwards is not a consequence of the one before), or ran out of room for contacts and constraints (some were dropped,
so bodies may pass through each other).

Formula: the recorded warnings, grouped by name.
Threshold: none. Bad state and dropped contacts block; the rest (nearly singular inertia, clipped control) warns.
Source: the manual's API reference, `mjtWarning`.
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.finding import AnomalySeverity
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS116"
NEEDS = ("warnings",)
GRAVE = ("bad", "full")


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each kind of warning once."""
    groups: dict[str, list[tuple[float, int]]] = {}
    for time, name, count in trajectory.warnings or ():
        groups.setdefault(name, []).append((time, count))
    for name, records in groups.items():
        key = name.lower().removeprefix("mjwarn_")
        grave = any(word in key for word in GRAVE) and "ctrl" not in key
        severity: AnomalySeverity = "blocking" if grave else "warn"
        count = sum(n for _, n in records)
        window = (records[0][0], records[-1][0])
        yield Sign("world", window, count, 0, "warnings", severity, f"the simulator warned of {name}, {count} times")


def _warned(name: str, severity: AnomalySeverity) -> Case:
    warned = replace(analytic.resting(), warnings=((0.1, name, 1), (0.2, name, 2)))
    return Case(name, warned, severity=severity)


GOOD = (lambda: Case("no warnings", replace(analytic.resting(), warnings=())),)
BAD = (
    lambda: _warned("BADQACC", "blocking"),
    lambda: _warned("CONTACTFULL", "blocking"),
    lambda: _warned("INERTIA", "warn"),
)
