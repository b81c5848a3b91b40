"""How robust each claim is: it is measured again in worlds a little otherwise, and told in how many of them it holds.

Nobody knows a friction to a fifth, a mass or a start to a hundredth, and no world owes its outcome to its time step. A claim
that holds in some of these worlds only is no lie, but its reader should know: nothing here blocks.

Each world is a variant of the physics pass, in the clean process; a program with a `control` is asked anew in each (closed
loop). They are stepped plainly and not by `mujoco.batch`, which carries the columns of the state but neither contacts nor
their forces, on which most expectations rest.
"""

from collections.abc import Iterator

from ...model.evidence.audits import Held, RobustReport
from ...model.evidence.reports import ExpectReport
from ...model.plan.committed import Plan
from ...model.recording.trajectory import Trajectory
from ..objectives import expecting
from .refine import FACTOR
from .trials import Trials, label_of

WORLDS: tuple[tuple[str, ...], ...] = (
    *(("--vary", f"friction={factor}") for factor in (1.2, 0.8)),
    *(("--vary", f"{kind}={factor}") for kind in ("masses", "start") for factor in (1.01, 0.99)),
    ("--time-step-factor", f"{FACTOR:g}"),
)
DIVERGED = "diverged"
"""Code of a pass whose world came to no end: that is the world's own doing."""


def ask(trials: Trials) -> None:
    """Ask for every world."""
    for words in WORLDS:
        trials.ask(*words)


def report(trajectory: Trajectory, plan: Plan, trials: Trials) -> RobustReport:
    """What holds where; every repetition must have been made or have failed."""
    labels = [label_of(words) for words in WORLDS]
    made = {label: expecting.expect(trials.made[label], plan) for label in labels if label in trials.made}
    told = {row.label: row for row in trials.told()}
    diverged = {label: told[label].failed for label in labels if told[label].failed.startswith(DIVERGED)}
    return RobustReport(
        trajectory_sha256=trajectory.sha256,
        worlds=tuple(told[label] for label in labels),
        claims=tuple(claims(expecting.expect(trajectory, plan), made, diverged)),
    )


def claims(planned: ExpectReport, made: dict[str, ExpectReport], diverged: dict[str, str]) -> Iterator[Held]:
    """One row for every expectation that holds as planned; what only a still can show is left out.

    `diverged`: the labels of worlds that came to no end, and how.
    """
    for place, objective in enumerate(planned.objectives):
        for number, found in enumerate(objective.expectations):
            if found.status != "holds" or found.needs_stills:
                continue
            elsewhere = {label: other.objectives[place].expectations[number] for label, other in made.items()}
            unlike = {label: other.message for label, other in elsewhere.items() if other.status != "holds"} | diverged
            yield Held(
                objective=objective.index,
                name=found.name,
                holds=len(elsewhere) + len(diverged) - len(unlike),
                of=len(elsewhere) + len(diverged),
                not_in=tuple(unlike),
                message=next((f"{label}: {why}" for label, why in unlike.items()), ""),
            )
