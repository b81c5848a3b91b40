"""An author's own laws, stepped for the first fifth of a second before the physics is paid for: do they balance, what do they cost?

A law that fails, blows up or makes momentum or energy shows within milliseconds of simulated time, and would else show after the
whole of them. What it says is of these first steps: `scan` judges the recording.
"""

import contextlib
import io
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...model import companions, json_object
from ...model.errors import CallOverError
from ...model.finding import Finding
from ...model.plan import law_costs

if TYPE_CHECKING:
    from ...model.plan.committed import Plan
    from .fetch import Outcome

UNTRIED = "what its laws cost is not known: this call's time went into building the world; ask again"
MEND = "return to each body what pushes back, and tell in energy() the store whose slope the forces are"
MEND_SUITES = "its forces are the suite's, so resolve it more finely: a shorter `step`, then a smaller `spacing`"
TRIED_S, WALL_S, LEAST_WALL_S, OWN_S, MEMORY_MB = 0.2, 20.0, 3.0, 12.0, 4096
"""A law is given `OWN_S` of its own however long its world took to build, and the memory of a physics pass."""


@dataclass(frozen=True)
class Tried:
    """What came of it."""

    said: str
    findings: tuple[Finding, ...] = ()


def of(program: Path, plan: "Plan | None", outcome: "Outcome", found: list[Finding], wall_s: float) -> Tried | None:
    """What the author's laws of a program do in their first steps; None without any. A world that is wrong is not stepped.

    `wall_s` is what is left of the time in which the world was built.
    """
    from .. import main_call

    rows = plan.simulation_parameters.interventions if plan is not None else ()
    wrong = any(finding.severity == "error" for finding in found)
    if wrong or outcome.status != "compiled" or not any(row.solver and row.solver.file for row in rows):
        return None
    lasting = main_call.facts(program).get("duration", plan and plan.simulation_parameters.simulation_duration)
    if not isinstance(lasting, int | float):
        return Tried("what its laws cost is not known: the duration of `program.main` is no plain number")
    try:
        return tried(program, float(lasting), max(wall_s, OWN_S))
    except CallOverError:  # what is found already stands
        return Tried(UNTRIED)


def tried(program: Path, lasting_s: float, wall_s: float = WALL_S) -> Tried | None:
    """Step the laws of a program; None where nothing confines it or nothing came of it.

    Args:
        program: `simulation.py`, its laws beside it.
        lasting_s: how long the whole of it lasts, s.
        wall_s: the attempt ends after so many seconds of its own.
    """
    from ...scan.tools import unbalanced
    from ...stage.tools import compile_laws, run_confined

    if wall_s < LEAST_WALL_S:
        return Tried(UNTRIED)
    compile_laws(program.parent)
    here = Path(__file__).parent
    reads = [*(here / f"{name}.py" for name in ("step_laws", "compile_world", "measure", "rehearse")), program]
    with contextlib.suppress(companions.CompanionError, OSError):  # refused in words where evidence is kept
        reads += [program.parent / name for name in companions.of(program)]
    seconds = min(TRIED_S, lasting_s)
    call = [sys.executable, "-s", str(here / "step_laws.py"), str(program), "{out}", repr(seconds), repr(lasting_s)]
    wanted, wall_s = ("outcome.json", "sums.npz"), min(wall_s, WALL_S)
    done = run_confined(call, program=program, reads=reads, wanted=wanted, wall_s=wall_s, memory_mb=MEMORY_MB)
    told = json_object.told(done.files.get("outcome.json", b"")) or {}
    names = ("points", "reached_s", "wall_s", "grows")
    points, reached, wall, grows = (v if isinstance(v := told.get(n), int | float) else 0.0 for n in names)
    cost = law_costs.told(int(points), reached, wall, grows, lasting_s) if reached > 0 else ""
    if "failure" in told:
        return Tried("its laws fail in their first steps", (_failed(told, program),))
    if done.status == "out_of_memory":
        heavy = law_costs.heavy(MEMORY_MB, ended=True)
        return Tried(f"{heavy}; {cost}" if cost else heavy)
    held = told.get("memory_mb")
    if held and isinstance(held, int | float) and (heavy := law_costs.heavy(held)):
        cost = f"{cost}; {heavy}" if cost else heavy
    if done.status == "timed_out":
        many = f" of {points:,} points" if points else ""
        return Tried(cost or f"its laws{many} did not come to a step within {wall_s:.0f} s; {law_costs.CHEAPER}")
    if done.status == "refused":
        return None
    if done.status != "ended":  # it says what it costs as far as it came
        many = f" of {points:,} points" if points else ""
        word = f"its laws{many} end in the first steps: {done.status.replace('_', ' ')} ({MEMORY_MB / 1024:g} GB)"
        return Tried(f"{word}; {cost}" if cost else f"{word}; {law_costs.CHEAPER}")
    if odd := _not_finite(told, data := done.files.get("sums.npz", b"")):
        message = f"the law {odd} blows up: its sums are not finite"
        return Tried("its laws blow up in their first steps", (_unbalanced(message, reached, program, MEND),))
    balances = _balances(told, data)
    if not balances:
        return None
    rows = zip(told["laws"], balances, strict=True)
    found = tuple(
        _unbalanced(message, reached, program, MEND_SUITES if row.get("suites") else MEND)
        for row, law in rows
        for message in unbalanced((law,))
    )
    return Tried(cost if found else f"{cost}; their sums balance", found)


def _not_finite(told: dict[str, Any], data: bytes) -> str:
    """The name of the first law whose sums are no numbers; empty where all are."""
    import numpy as np

    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as kept:
            rows = zip(told["laws"], np.asarray(kept["sums"], float), strict=True)
            return next((str(row["name"]) for row, sums in rows if not np.isfinite(sums).all()), "")
    except (OSError, ValueError, KeyError, TypeError, EOFError):
        return ""


def _balances(told: dict[str, Any], data: bytes) -> tuple[Any, ...]:
    """What the sums say of each law; nothing where they are none."""
    import numpy as np

    from ...model.recording.law_balances import LawBalance

    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as kept:
            t, sums, pushed, gravity = (np.asarray(kept[n], float) for n in ("t", "sums", "pushed", "gravity"))
        if not np.isfinite(sums).all() or sums.shape != (len(told["laws"]), len(t), 15):
            return ()
        return tuple(
            LawBalance(
                str(row["name"]), tuple(map(str, row["bodies"])), t, mass=s[:, 0], momentum=s[:, 1:4], energy=s[:, 4],
                weight=s[:, 5], stored=s[:, 6], volume=s[:, 7], held=s[:, 8:11], given=s[:, 11:14], work=s[:, 14],
                pushed=float(push), gravity=gravity, cell=float(row.get("cell", 0.0)),
            )
            for row, s, push in zip(told["laws"], sums, pushed, strict=True)
        )  # fmt: skip
    except (OSError, ValueError, KeyError, TypeError, EOFError):
        return ()


def _unbalanced(message: str, seconds: float, program: Path, move: str) -> Finding:
    return Finding(
        code="WS318",
        name="unbalanced_law",
        severity="warning",
        message=f"within the first {seconds:.2g} s {message}",
        fix=f"{move}: see `worldwright lint explain WS318`; `scan` blocks what stays so",
        file=str(program),
    )


def _failed(told: dict[str, Any], program: Path) -> Finding:
    place, line = str(told.get("place") or told.get("file") or ""), told.get("line")
    own = told.get("file") == program.name
    where = f"{place}:{line}: " if place and line and ":" not in place and not own else f"{place}: " if place else ""
    return Finding(
        code="WR101",
        name="program_fails",
        severity="error",
        message=f"{where}{told.get('failure')}: {told.get('message')}"[:1000],
        fix=str(told.get("next_move") or "correct it there"),
        file=str(program),
        line=line if own and isinstance(line, int) else None,
    )
