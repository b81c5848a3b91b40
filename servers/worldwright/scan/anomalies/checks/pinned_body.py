"""A body that the plan speaks of is held by a constraint, or a cloth by pins, that the plan does not mention.

What it means: a weld or a connection to the world carries what the picture ascribes to something else, or holds what an
objective says is free.

Formula: an equality that is on at the start and ties a body of the plan (or a part welded to one) to the world or to
scenery; a flex with vertices on static bodies. Declared by an intervention of kind `constraint` naming the equality, the
body or the flex, by a `weld` among the plan's joints, or by the `held` sides of what the plan calls `soft`.
Threshold: none. Blocking with a plan; without one silent for equalities (models are full of them).
Source: the facts on staging (cloth pinned to static poles; a part pinned that the objective says is free).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording import laws_told
from ....model.recording.trajectory import Trajectory
from ...known import analytic, own_laws
from ..declared import cast
from ..sign import Case, Context, Sign
from ..wholes import head_names
from .seen_through import carrying

CODE = "WS306"
STAGING = True
NEEDS = ("loads",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each tie and each pinned flex that the plan does not declare."""
    if not context.planned:
        return
    meta, names, head = trajectory.meta, cast(context), head_names(trajectory)
    fixed = {"world", *(b["name"] for b in meta.get("bodies") or () if not b.get("dynamic") and not b.get("mocap"))}
    welds = {j.child for j in context.plan.topology.joints if j.type == "weld"} if context.plan else set()
    for column, tie in enumerate(meta.get("equalities") or ()):
        ends = list(tie.get("bodies") or ())
        free = [name for name in ends if name not in fixed]
        wholes = {*free, *(head.get(name, name) for name in free)}  # what holds a part holds the body it is welded to
        if not tie.get("active") or len(free) == len(ends) or not wholes & names or wholes & welds:
            continue
        held = free[0]
        if any(context.declares("constraint", name) for name in (tie["name"], *wholes)):
            continue
        force = trajectory.loads.eq_force[:, column] if trajectory.loads is not None else np.zeros(1)
        peak = float(force.max(initial=0.0))
        message = (
            f"{held} is held by the {tie['type']} {tie['name']} (up to {peak:.3g} N); the plan does not mention it"
        )
        yield Sign(held, (trajectory.t[0], trajectory.t[-1]), peak, 0.0, "N", "blocking", message)
    moved = laws_told.drawn(meta)  # by an author's law, or water: only drawn, held by nothing
    objects = context.plan.scene_objects if context.plan else ()
    moved |= {
        row.name for row in objects if row.soft is not None and row.soft.held
    }  # which ones is held against the model
    for flex in meta.get("flexes") or ():
        if flex.get("pinned") and flex["name"] not in moved and not context.declares("constraint", flex["name"]):
            message = f"{flex['pinned']} of {flex['vertices']} vertices of {flex['name']} are pinned to "
            message += f"{', '.join(flex['pinned_to'])}; the plan does not mention it"
            window = (trajectory.t[0], trajectory.t[-1])
            yield Sign(flex["name"], window, float(flex["pinned"]), 0.0, "vertices", "blocking", message)


def _held(**meta: object) -> Trajectory:
    still = analytic.resting()
    loads = carrying(eq_force=np.full((len(still.t), 1), 9.81))
    return replace(still, loads=loads, meta={"bodies": [{"name": "body", "dynamic": True}], **meta})


WELD = {"name": "pin", "type": "weld", "bodies": ["body", "world"], "active": True}
CLOTH = {"name": "sail", "vertices": 81, "pinned": 9, "pinned_to": ["pole"]}
LAW = {"bodies": ["body"], "law": {"name": "canvas", "shown_by": "sail"}}


def _canvas() -> Trajectory:
    return replace(_held(flexes=[CLOTH], laws=[LAW]), balances=(own_laws.spring(),))


GOOD = (
    lambda: Case("nothing is tied", _held(), Context(planned=True, rests=("body",))),
    lambda: Case("a sail that a law moves", _canvas(), Context(planned=True)),
    lambda: Case("a tie that is off", _held(equalities=[{**WELD, "active": False}]), Context(True, rests=("body",))),
)
BAD = (
    lambda: Case("a secret weld", _held(equalities=[WELD]), Context(True, rests=("body",)), severity="blocking"),
    lambda: Case("a pinned cloth", _held(flexes=[CLOTH]), Context(planned=True), severity="blocking"),
)
