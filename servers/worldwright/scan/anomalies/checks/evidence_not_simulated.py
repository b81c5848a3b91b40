"""A claim is measured on something that is only drawn, or that the program poses itself.

What it means: an expectation about a `visual_only` body, or about a mocap body, measures what the program put there, not
what physics made of it: it proves nothing.

Formula: bodies named by an objective's expectations that are declared `visual_only`; or that are mocap bodies whose poses
the program writes, unless the plan declares that (then the reader judges).
Threshold: none. Blocking; a remark for a declared mocap body.
Source: the facts on staging (debris and stems drawn without state behind them).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.plan.committed import Plan
from ....model.plan.in_view import mentioned
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import drawn_only
from ..sign import Case, Context, Sign

CODE = "WS313"
STAGING = True
NEEDS = ("meta",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each such body once."""
    if context.plan is None:
        return
    rows = {str(b["name"]): b for b in trajectory.meta.get("bodies") or ()}
    window, told = (trajectory.t[0], trajectory.t[-1]), set()
    for index, objective in enumerate(context.plan.objectives):
        for name in sorted({n for row in objective.expect for n in mentioned(row)} & rows.keys() - told):
            drawn = rows[name].get("visual_only") or drawn_only(context, trajectory.meta, name)
            if not drawn and not rows[name].get("mocap"):
                continue
            told.add(name)
            declared = not drawn and context.declares("mocap", name)
            what = "only drawn" if drawn else "posed by the program"
            message = f"objective {index} is measured on {name}, which is {what}: that proves nothing"
            yield Sign(name, window, 1.0, 0.0, "claims", "info" if declared else "blocking", message)


def _claimed(**body: bool) -> Case:
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 2},
            "objectives": [{"claim": "it rests", "expect": [{"stays": {"body": "body", "max_m": 0.1}}]}],
        }
    )
    still = replace(analytic.resting(), meta={"bodies": [{"name": "body", "dynamic": True, **body}]})
    return Case(f"measured on a body {', '.join(body) or 'that is simulated'}", still, Context.of(plan), "blocking")


GOOD = (_claimed,)
BAD = (lambda: _claimed(visual_only=True), lambda: _claimed(mocap=True))
