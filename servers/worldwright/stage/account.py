"""Tell at a glance what a finished physics pass shows, so that nobody has to run, scan or ask again to learn it.

Speed, the engine's warnings, what acted besides the engine's step and whether the plan declares it, what was declared and
never acted, the deepest penetration, and the movers that never moved. A few short lines, read from the recording.
"""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..model.errors import WorldwrightError
from ..model.evidence import rounding
from ..model.evidence.run import Run
from ..model.plan.committed import Intervention, Plan
from ..model.plan.declaration import DRIVES, covering, declaration
from ..model.plan.plan_text import read_plan
from ..model.plan.trigger import always
from ..model.recording.trajectory import Trajectory
from ..model.recording.trajectory_files import read_trajectory
from ..model.recording.travel import stays_put
from .job import Job, JobStatus

MOST = 6
"""So many rows of one kind are told, and the number of the others."""
UNITS = {"force": "N", "torque": "N·m", "control": "N or N·m", "velocity": "m/s or rad/s"}
"""Units of the kinds that are told with their size; the other kinds mix units."""


def with_account(run: Run, status: JobStatus) -> JobStatus:
    """The job's status, with the account of its recording if it is a physics pass that has ended."""
    if status.stage != "physics" or status.state not in ("succeeded", "failed"):
        return status
    job = Job(run.jobs / status.job)
    folder = Path(status.result) if status.result else job.out
    snapshot = job.inputs / run.plan.name
    try:
        trajectory = read_trajectory(folder / "trajectory")
    except WorldwrightError:
        return status  # without a recording, or with a damaged one, the pass itself says so
    plan = _plan(snapshot if snapshot.is_file() else run.plan)
    told = tuple(account(trajectory, plan, _summary(folder)))
    return status.model_copy(update={"account": (*status.account, *_unconfined(status.sandbox), *told)})


def _unconfined(level: str) -> Iterator[str]:
    if level == "rlimits":
        yield (
            "NO SANDBOX confined the program: it could read and write all that you may; `worldwright doctor` says why none "
            "does here"
        )


def account(trajectory: Trajectory, plan: Plan | None, summary: dict[str, Any]) -> Iterator[str]:
    """The lines of the account.


    Args:
        trajectory: what was recorded.
        plan: the plan; without one, nothing is called undeclared.
        summary: the pass's own: `duration_s` and `wall_s`, when something was simulated.
    """
    simulated, wall = summary.get("duration_s"), summary.get("wall_s")
    if simulated and wall and "reused_from" not in summary:
        yield f"{simulated:g} s simulated in {wall:.3g} s: {simulated / wall:.3g} times real time"
    if rounded := rounding.told(summary):
        yield rounded
    yield from _warned(trajectory)
    yield from _acted(trajectory, plan)
    if summary.get("not_asked"):
        yield "control was not asked: the plan declares no input that it may write"
    if strays := summary.get("went_nowhere"):
        told = [f"{row['array']} (simulation.py:{row['line']})" for row in strays]
        yield f"control writes what is no declared input, to no effect: {_first_few(told)}"
    yield from _deepest(trajectory)
    if trajectory.complete and (movers := _movers(trajectory, plan)):
        still = [name for name in movers if stays_put(trajectory, trajectory.index(name))]
        if still:
            yield f"never moved, though expected to: {_first_few(still)}"


def _warned(trajectory: Trajectory) -> Iterator[str]:
    counts: dict[str, tuple[int, float]] = {}
    for time, name, count in trajectory.warnings or ():
        known, first = counts.get(name, (0, time))
        counts[name] = (known + count, first)
    if counts:
        yield f"engine warnings: {_first_few([f'{name} x{n} from {first:.4g} s' for name, (n, first) in counts.items()])}"


def _acted(trajectory: Trajectory, plan: Plan | None) -> Iterator[str]:
    """What the ledger holds, and which declarations of the plan it does not hold."""
    ledger = trajectory.interventions
    if ledger is None:
        return
    declared = covering(plan.declared() if plan else (), trajectory.flex_points)
    lines, seen = [], set()
    for (kind, target), mine in ledger.groups.items():
        row = declaration(kind, target, declared)
        if row is not None:
            seen.add(id(row))
        # A control's value is what was asked and the force that came of it; the force is what acts.
        values = ledger.value[mine][:, 1:2] if kind == "control" else ledger.value[mine]
        peak = f", up to {np.sqrt((values**2).sum(axis=1)).max():.3g} {UNITS[kind]}" if kind in UNITS else ""
        said = "" if plan is None else " (declared)" if row is not None else " (UNDECLARED)"
        lines.append(f"{kind} on {target} {_time_words(trajectory, ledger.time[mine])}{peak}{said}")
    if lines:
        yield f"acted besides the engine's step: {_first_few(sorted(lines, key=_undeclared_first), '; ')}"
    asked = declared[: len(plan.simulation_parameters.interventions)] if plan else ()
    idle = [row for row in asked if id(row) not in seen and not _acts_unseen(trajectory, row)]
    if idle and trajectory.complete:
        named = [f"{row.kind} on {', '.join(row.bodies)} (trigger: {row.trigger})" for row in idle]
        yield f"declared, but never acted: {_first_few(named, '; ')}"


def _undeclared_first(line: str) -> bool:
    return not line.endswith("(UNDECLARED)")


def _acts_unseen(trajectory: Trajectory, row: Intervention) -> bool:
    """Whether a declared actuator pushes by itself, a declared wind blows, or a belt runs or something sticks all the time."""
    geoms = trajectory.meta.get("geoms") or ()
    if (
        row.kind in DRIVES
        and always(row.trigger)
        and any(
            (geom.get("surfacevel") or geom.get("adhesion"))
            and {str(geom["name"]), str(geom.get("body"))} & set(row.bodies)
            for geom in geoms
        )
    ):
        return True
    if "wind" in row.bodies and always(row.trigger) and np.any((trajectory.meta.get("option") or {}).get("wind", 0)):
        return True
    loads, actuators = trajectory.loads, trajectory.meta.get("actuators") or ()
    if row.kind != "control" or loads is None or loads.actuator_force.shape[1:] != (len(actuators),):
        return False
    return any(
        {str(actuator["name"]), *(actuator.get("bodies") or ())} & set(row.bodies)
        and bool(np.any(loads.actuator_force[:, column]))
        for column, actuator in enumerate(actuators)
    )


def _time_words(trajectory: Trajectory, times: np.ndarray) -> str:
    """`throughout`, the instant, or the stretch and its share."""
    step = trajectory.time_step or trajectory.interval_s
    first, last = float(times.min()), float(times.max())
    instants = len(np.unique(times))
    if instants == 1:
        return f"at {first:.4g} s"
    if instants * step > 0.99 * trajectory.duration_s:
        return "throughout"
    gaps = int((np.diff(np.unique(times)) > 1.5 * step).sum())
    return f"{first:.4g}-{last:.4g} s" + (f" in {gaps + 1} stretches" if gaps else "")


def _deepest(trajectory: Trajectory) -> Iterator[str]:
    contacts = trajectory.contacts
    if contacts is None or not len(contacts.row) or float(contacts.depth_m.max()) <= 0:
        return
    n = int(np.argmax(contacts.depth_m))
    pair = sorted((int(contacts.body1[n]), int(contacts.body2[n])), reverse=True)
    names = " and ".join(trajectory.names[i] if i >= 0 else "world" for i in pair)
    depth, time = float(contacts.depth_m[n]), float(trajectory.t[contacts.row[n]])
    yield f"deepest penetration: {names}, {1000 * depth:.3g} mm at {time:.4g} s"


def _movers(trajectory: Trajectory, plan: Plan | None) -> list[str]:
    """Bodies that should move, by the plan or, without one, by the program."""
    named = plan.movers() if plan else trajectory.meta.get("movers") or ()
    return [name for name in named if name in trajectory.names]


def _first_few(texts: Sequence[str], between: str = ", ") -> str:
    more = f" and {len(texts) - MOST} more" if len(texts) > MOST else ""
    return between.join(texts[:MOST]) + more


def _summary(folder: Path) -> dict[str, Any]:
    """The program's report of the pass; its numbers are checked to be numbers."""
    try:
        facts = json.loads((folder / "result.json").read_text(encoding="utf-8")).get("summary")
    except (OSError, ValueError, AttributeError):
        return {}
    facts = facts if isinstance(facts, dict) else {}
    numbers: dict[str, Any] = {
        k: v for k in ("duration_s", "wall_s") if isinstance(v := facts.get(k), int | float) and v > 0
    }
    strays = facts.get("went_nowhere")
    numbers |= {"went_nowhere": strays} if isinstance(strays, list) else {}
    numbers |= {"not_asked": True} if facts.get("not_asked") else {}
    return {**numbers, **({"reused_from": facts["reused_from"]} if "reused_from" in facts else {})}


def _plan(path: Path) -> Plan | None:
    try:
        return read_plan(path).plan
    except (WorldwrightError, OSError):
        return None
