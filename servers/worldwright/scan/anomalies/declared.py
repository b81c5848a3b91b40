"""What the plan says that it does to the world, for the checks of staging."""

import re
from collections.abc import Iterable
from typing import Any

import numpy as np

from ...model.evidence.audits import Trigger
from ...model.finding import AnomalySeverity
from ...model.plan.belonging import Belonging
from ...model.plan.committed import Plan
from ...model.plan.in_view import mentioned
from ...model.plan.trigger import always
from ...model.recording.trajectory import Trajectory
from .sign import Context

TIME = re.compile(
    r"^\s*(at\b|after\s+[\d.]|from\b.*\bs\b|until\b|between\b|t\b|time\b|every\b|[\d.]+\s*(s|ms|seconds?)\b|start\b|\W*t\s*=)",
    re.IGNORECASE,
)
"""A trigger that looks at the clock alone: `t >= 3 s`, `at 3 s`, `after 2 s`, `0.5 s`."""


ENDS = re.compile(r"\b(until|till|before|up to)\b|<", re.IGNORECASE)
SECONDS = re.compile(r"(\d+(?:\.\d+)?)\s*(ms|s\b|seconds?)")


def times(trigger: str) -> tuple[float, float]:
    """(begin, end) in s of what a trigger by the clock allows; infinite where it does not say."""
    if when(trigger) != "time":
        return -np.inf, np.inf
    text = re.sub(r"(\d+(?:\.\d+)?)\s*(?:\.\.|to|and|-|–)\s*(?=\d+(?:\.\d+)?\s*(?:ms|s))", r"\1 s to ", trigger)
    said = sorted(float(number) * (1e-3 if unit == "ms" else 1.0) for number, unit in SECONDS.findall(text))
    if len(said) == 1:
        return (-np.inf, said[0]) if ENDS.search(trigger) else (said[0], np.inf)
    return (said[0], said[-1]) if said else (-np.inf, np.inf)


def when(trigger: str) -> Trigger:
    """Whether a declared trigger holds always, looks at the clock, or at the state of the world."""
    if always(trigger):
        return "always"
    return "time" if TIME.match(trigger) else "state"


def cast(context: Context) -> frozenset[str]:
    """Every name the plan makes a claim about: its objects, its movers, and what its expectations name."""
    plan = context.plan
    found = {*context.movers, *context.rests}
    if plan is not None:
        found |= {*plan.object_names(), *(joint.child for joint in plan.topology.joints), *plan.topology.body_positions}
        for objective in plan.objectives:
            for row in objective.expect:
                found.update(mentioned(row))
    return frozenset(found)


def weighs(context: Context, declared: bool, *, claimed: bool = True) -> AnomalySeverity:
    """The severity of what may stage an outcome: a remark if it is declared, else blocking for a plan that claims it."""
    if declared:
        return "info"
    return "blocking" if context.planned and claimed else "warn"


def overlap_m(context: Context, trajectory: Trajectory, one: str, other: str) -> float:
    """How far the plan lets two bodies be inside each other, m; 0 where it says nothing of it."""
    if context.plan is None or not context.plan.topology.overlaps:
        return 0.0
    names, above = trajectory.names, trajectory.mechanics.parent
    parents = {} if above is None else {n: names[p] if p >= 0 else "world" for n, p in zip(names, above, strict=True)}
    return Belonging(context.plan, parents).allowed_m(one, other)


def hideable_m(trajectory: Trajectory, bodies: Iterable[str], geoms: Iterable[str]) -> float:
    """How much of an overlap of two geoms may be declared, m: half the thickness of the thinner one; 0 where it is not known.

    A body's box stands for a geom of which the recording tells nothing.
    """
    facts, thin, found = trajectory.mechanics, trajectory.mechanics.half_thickness(), []
    for body, geom in zip(bodies, geoms, strict=True):
        if geom in facts.geom_names and facts.geom_half_extents is not None:
            found.append(float(facts.geom_half_extents[facts.geom_names.index(geom)].min()))
        elif body in trajectory.names and thin is not None:
            found.append(float(thin[trajectory.names.index(body)]))
        else:
            return 0.0
    least = float(np.min(found, initial=np.inf))
    return least if np.isfinite(least) else 0.0


def drawn_only(context: Context, meta: Any, name: str) -> bool:
    """Whether the program or the plan declares a body or geom to be drawn without being simulated."""
    plan: Plan | None = context.plan
    listed = meta.get("visual_only") or ()
    return name in listed or (plan is not None and any(o.name == name and o.visual_only for o in plan.scene_objects))
