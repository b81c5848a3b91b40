"""A body that the plan makes claims about can touch nothing.

What it means: none of its geoms can collide, so it passes through whatever it meets; what looks like a contact is
something else, a hand-written spring or a written pose.

Formula: a body that moves, has visible geoms, and none that collides (by mask or by pair), and is not welded to one that
does (a label on a box; what passes through the label itself, `seen_through` reports); declared `visual_only` it is scenery.
Threshold: none. Blocking for a body of the plan; without a plan a warning for loose bodies.
Source: the facts on staging (contype 0, a body passing through the floor).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import cast, drawn_only, weighs
from ..sign import Case, Context, Sign
from ..wholes import head_names

CODE = "WS303"
STAGING = True
NEEDS = ("meta",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body that nothing can touch."""
    meta, names = trajectory.meta, cast(context)
    window = (trajectory.t[0], trajectory.t[-1])
    head = head_names(trajectory)
    shown: dict[str, int] = {}
    collides: set[str] = set()
    for geom in meta.get("geoms") or ():
        if "visible" not in geom:
            return
        shown[geom["body"]] = shown.get(geom["body"], 0) + bool(geom["visible"])
        if geom["collides"]:
            collides.add(head.get(str(geom["body"]), str(geom["body"])))
    for body in meta.get("bodies") or ():
        name = str(body["name"])
        loose = body.get("joints") == ["free"]
        if (
            not body.get("dynamic")
            or not shown.get(name)
            or head.get(name, name) in collides
            or drawn_only(context, meta, name)
        ):
            continue
        if not (name in names if context.planned else loose):
            continue
        declared = context.acts_on(name, ("parameter", "solver"))
        message = f"no geom of {name} can collide with anything, though it is drawn"
        yield Sign(name, window, 0.0, 1.0, "geoms that collide", weighs(context, declared), message)


def _ghost(collides: bool) -> Trajectory:
    geom = {"name": "skin", "body": "body", "visible": True, "collides": collides}
    body = {"name": "body", "dynamic": True, "joints": ["free"]}
    return replace(analytic.falling(), meta={"bodies": [body], "geoms": [geom]})


GOOD = (lambda: Case("a body that can be touched", _ghost(True), Context(planned=True, movers=("body",))),)
BAD = (lambda: Case("a ghost", _ghost(False), Context(planned=True, movers=("body",)), severity="blocking"),)
