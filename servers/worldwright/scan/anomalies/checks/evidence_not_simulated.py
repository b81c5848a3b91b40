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
from typing import Any

import numpy as np

from ....model.plan.committed import Plan
from ....model.plan.in_view import mentioned
from ....model.recording import laws_told
from ....model.recording.trajectory import Trajectory
from ...known import analytic, own_laws
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
    massless = _massless(trajectory)
    for index, objective in enumerate(context.plan.objectives):
        said = {n for row in objective.expect for n in mentioned(row) - _media(row, trajectory)} & rows.keys()
        said |= {n for row in objective.expect for n in _media(row, trajectory)} & massless
        for name in sorted(said - told):
            drawn = name in massless or rows[name].get("visual_only") or drawn_only(context, trajectory.meta, name)
            if not drawn and not rows[name].get("mocap"):
                continue
            told.add(name)
            declared = not drawn and context.declares("mocap", name)
            what = "only drawn" if drawn else "posed by the program"
            message = f"objective {index} is measured on {name}, which is {what}: that proves nothing"
            yield Sign(name, window, 1.0, 0.0, "claims", "info" if declared else "blocking", message)


def _media(row: dict[str, Any], trajectory: Trajectory) -> set[str]:
    """What an expectation measures by the points of a law, which are recorded, and not by the body that shows them."""
    words = {args.get(key) for args in row.values() if isinstance(args, dict) for key in ("medium", "parts")}
    return {word for word in words if isinstance(word, str)} & {*trajectory.media.names}


def _massless(trajectory: Trajectory) -> set[str]:
    """What shows points without mass: no balance holds them, so they go where their law says."""
    weightless = {balance.name for balance in trajectory.balances if not balance.mass.any()}
    return {law.shown_by for law in laws_told.of(trajectory.meta) if law.name in weightless}


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


def _covered(mass: float) -> Case:
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 2},
            "objectives": [
                {"claim": "it spreads", "expect": [{"covers": {"medium": "paint", "body": "body", "min_share": 0.5}}]}
            ],
        }
    )
    poured, law = own_laws.pouring(), replace(own_laws.spring(), name="paint")
    rows = {
        "bodies": [{"name": "body", "dynamic": True}, {"name": "paint", "visual_only": True}],
        "laws": [{"bodies": ["world"], "law": {"name": "paint", "shown_by": "paint", "file": "laws/paint.py"}}],
    }
    law = replace(law, mass=np.full_like(law.mass, mass))
    poured = replace(poured, meta={**poured.meta, **rows}, balances=(law,))
    return Case(f"measured on points of {mass} kg in all", poured, Context.of(plan), "blocking")


GOOD = (_claimed, lambda: _covered(0.5))
BAD = (lambda: _claimed(visual_only=True), lambda: _claimed(mocap=True), lambda: _covered(0.0))
