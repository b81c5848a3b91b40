"""What a finished physics pass shows at a glance, so that nobody has to run, scan or ask again to learn it.

Speed, the engine's warnings, what acted besides the engine's step and whether the plan declares it, what was declared and
never acted, the deepest penetration, and the movers that never moved. A few short lines, read from the recording.
"""

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ..model.declared import declaration
from ..model.errors import WorldwrightError
from ..model.plan import Intervention, Plan
from ..model.plan_text import read_plan
from ..model.run import Run
from ..model.trajectory import Trajectory
from ..model.travel import stays_put
from .job import Job, JobStatus

MOST = 6
"""Rows of one kind that are told; of the others only the number."""
UNITS = {"force": "N", "torque": "N·m", "control": "N or N·m", "velocity": "m/s or rad/s"}
"""Of what is told with its size: the other kinds mix units."""


def with_account(run: Run, status: JobStatus) -> JobStatus:
    """The same status, with what its recording shows when it is a physics pass that has ended."""
    if status.stage != "physics" or status.state not in ("succeeded", "failed"):
        return status
    job = Job(run.jobs / status.job)
    folder = Path(status.result) if status.result else job.out
    snapshot = job.inputs / run.plan.name
    try:
        trajectory = Trajectory.read(folder / "trajectory")
    except WorldwrightError:
        return status  # there is none, or it is damaged: the pass says so itself
    plan = _plan(snapshot if snapshot.is_file() else run.plan)
    return status.model_copy(update={"account": tuple(account(trajectory, plan, _summary(folder)))})


def account(trajectory: Trajectory, plan: Plan | None, summary: dict[str, Any]) -> Iterator[str]:
    """The lines.

    Args:
        trajectory: what was recorded.
        plan: what was meant; None when there is none, and then nothing is called undeclared.
        summary: of the pass: `duration_s` and `wall_s`, when something was simulated.
    """
    simulated, wall = summary.get("duration_s"), summary.get("wall_s")
    if simulated and wall and "reused_from" not in summary:
        yield f"{simulated:g} s simulated in {wall:.3g} s: {simulated / wall:.3g} times real time"
    yield from _warned(trajectory)
    yield from _acted(trajectory, plan)
    yield from _deepest(trajectory)
    if trajectory.complete and (movers := _movers(trajectory, plan)):
        still = [name for name in movers if stays_put(trajectory, trajectory.index(name))]
        if still:
            yield f"never moved, though expected to: {_few(still)}"


def _warned(trajectory: Trajectory) -> Iterator[str]:
    counts: dict[str, tuple[int, float]] = {}
    for time, name, count in trajectory.warnings or ():
        known, first = counts.get(name, (0, time))
        counts[name] = (known + count, first)
    if counts:
        yield f"engine warnings: {_few([f'{name} x{n} from {first:.4g} s' for name, (n, first) in counts.items()])}"


def _acted(trajectory: Trajectory, plan: Plan | None) -> Iterator[str]:
    """What the ledger holds, and of what the plan declares, what it does not hold."""
    ledger = trajectory.interventions
    if ledger is None:
        return
    declared = plan.simulation_parameters.interventions if plan else ()
    rows: dict[tuple[str, str], list[int]] = {}
    for n, pair in enumerate(zip(ledger.kind, ledger.target, strict=True)):
        rows.setdefault((str(pair[0]), str(pair[1])), []).append(n)
    lines, seen = [], set()
    for (kind, target), mine in rows.items():
        row = declaration(kind, target, declared)
        if row is not None:
            seen.add(id(row))
        # A control's value is what was asked and the force it made of that; the force is what acts.
        values = ledger.value[mine][:, 1:2] if kind == "control" else ledger.value[mine]
        peak = f", up to {np.sqrt((values**2).sum(axis=1)).max():.3g} {UNITS[kind]}" if kind in UNITS else ""
        said = "" if plan is None else " (declared)" if row is not None else " (UNDECLARED)"
        lines.append(f"{kind} on {target} {_when(trajectory, ledger.time[mine])}{peak}{said}")
    if lines:
        yield f"acted besides the engine's step: {_few(sorted(lines, key=_undeclared_first), '; ')}"
    idle = [row for row in declared if id(row) not in seen and not _drives(trajectory, row)]
    if idle and trajectory.complete:
        named = [f"{row.kind} on {', '.join(row.bodies)} (trigger: {row.trigger})" for row in idle]
        yield f"declared, but never acted: {_few(named, '; ')}"


def _undeclared_first(line: str) -> bool:
    return not line.endswith("(UNDECLARED)")


def _drives(trajectory: Trajectory, row: Intervention) -> bool:
    """Whether a declared actuator exerts something by itself, which no control in the ledger shows."""
    loads, actuators = trajectory.loads, trajectory.meta.get("actuators") or ()
    if row.kind != "control" or loads is None or loads.actuator_force.shape[1:] != (len(actuators),):
        return False
    return any(
        {str(actuator["name"]), *(actuator.get("bodies") or ())} & set(row.bodies)
        and bool(np.any(loads.actuator_force[:, column]))
        for column, actuator in enumerate(actuators)
    )


def _when(trajectory: Trajectory, times: np.ndarray) -> str:
    """`throughout`, the instant, or the stretch and how much of it."""
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
    """Bodies that are expected to move, as the plan says, else as the program does."""
    named = plan.movers() if plan else trajectory.meta.get("movers") or ()
    return [name for name in named if name in trajectory.names]


def _few(texts: Sequence[str], between: str = ", ") -> str:
    more = f" and {len(texts) - MOST} more" if len(texts) > MOST else ""
    return between.join(texts[:MOST]) + more


def _summary(folder: Path) -> dict[str, Any]:
    """What the program reported of the pass; what it is not sure to have reported is not trusted to be a number."""
    try:
        facts = json.loads((folder / "result.json").read_text(encoding="utf-8")).get("summary")
    except (OSError, ValueError, AttributeError):
        return {}
    facts = facts if isinstance(facts, dict) else {}
    numbers = {k: v for k in ("duration_s", "wall_s") if isinstance(v := facts.get(k), int | float) and v > 0}
    return {**numbers, **({"reused_from": facts["reused_from"]} if "reused_from" in facts else {})}


def _plan(path: Path) -> Plan | None:
    try:
        return read_plan(path).plan
    except (WorldwrightError, OSError):
        return None
