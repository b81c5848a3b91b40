"""`worldwright lessons RUN…` tells the root causes of a run's failures, and where each should be written back.

No cause should stop two runs: it belongs into the skill whose reader would have avoided it, or into a new lint rule. The
journal names the failures (lint codes, failed passes, reviews that ordered a repair), the table below the owner.
"""

import sys
from collections import Counter
from pathlib import Path

import click

from ..cli import report_errors
from ..model.evidence.run import Run

OWNERS = {
    "physical_parameters": "skills/plan-format/SKILL.md",
    "initial_motion": "skills/plan-format/SKILL.md",
    "object_settlement": "skills/coordinates/SKILL.md",
    "object_placement": "skills/coordinates/SKILL.md",
    "scale": "skills/dimensions/SKILL.md",
    "camera_placement": "skills/cameras/SKILL.md",
    "not_recognised": "skills/plan-format/SKILL.md",
    "look": "skills/film/SKILL.md",
    "visual_mismatch": "skills/plan-format/SKILL.md",
    "missing_object": "skills/layouts/SKILL.md",
    "simulator_symbol": "a lint rule: it can read the installed build",
    "solver_or_time_step": "a lint rule: it can measure stiffness against the time step",
    "undeclared_intervention": "skills/interventions/SKILL.md",
    "plan": "skills/plan-format/SKILL.md",
}


def collect(run: Run) -> list[tuple[str, str, str]]:
    """(what happened, why, who should learn it), in the journal's order."""
    found = []
    for entry in run.entries():
        action = entry.get("action")
        if action == "lint" and entry.get("ok") is False:
            codes = ", ".join(entry.get("codes") or ()) or "see lint.json"
            found.append(
                ("the program did not lint clean", codes, "the skill that shows the construct, with the right form")
            )
        elif action == "stage" and entry.get("ok") is False:
            why = str(entry.get("code") or entry.get("message") or "see the job's log")
            found.append((f"the {entry.get('stage')} pass failed", why, "a lint rule, if the program alone tells it"))
        elif action == "review" and entry.get("outcome") == "repair":
            target = str(entry.get("repair_target") or entry.get("target") or "unknown")
            found.append(("a review ordered a repair", target, OWNERS.get(target, "the skill of that target")))
        elif action == "block":
            found.append(
                ("the run was blocked", str(entry.get("cause", "")), "the plan skill: say early what cannot be built")
            )
    return found


@click.command("lessons")
@click.argument("runs", nargs=-1, required=True, type=click.Path(path_type=Path))
def command(runs: tuple[Path, ...]) -> None:
    """What went wrong in these runs, and which skill or rule should say so from now on."""

    def work() -> int:
        total: Counter[tuple[str, str, str]] = Counter()
        for name in runs:
            total.update(collect(Run.find(name)))
        for (what, why, owner), count in total.most_common():
            click.echo(f"{count} x {what}: {why}\n    write back to {owner}")
        if not total:
            click.echo("nothing went wrong")
        return 0

    sys.exit(report_errors(work))
