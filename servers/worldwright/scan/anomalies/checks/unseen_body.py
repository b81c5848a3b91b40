"""A body that the plan speaks of is simulated, but not drawn.

What it means: what the picture shows in its place is something else (a static twin, a decoration), so the picture is no
evidence of the state, nor the state of the picture.

Formula: a moving body named by the plan that has geoms, none of them visible (drawn group, not transparent), nor any of a
body below it.
Threshold: none. Blocking.
Source: the facts on staging (bodies simulated but drawn frozen).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import cast, weighs
from ..sign import Case, Context, Sign

CODE = "WS312"
STAGING = True
NEEDS = ("meta",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body that cannot be seen."""
    geoms, names = trajectory.meta.get("geoms") or (), cast(context)
    if any("visible" not in geom for geom in geoms):
        return
    parent = {str(b["name"]): str(b.get("parent") or "") for b in trajectory.meta.get("bodies") or ()}
    has, shown = {str(g["body"]) for g in geoms}, set()
    for geom in geoms:
        body = str(geom["body"]) if geom["visible"] else ""
        while body and body not in shown:
            shown.add(body)
            body = parent.get(body, "")
    for row in trajectory.meta.get("bodies") or ():
        name = str(row["name"])
        if row.get("dynamic") and name in names and name in has and name not in shown:
            message = f"{name} is simulated, but none of its geoms is drawn"
            window = (trajectory.t[0], trajectory.t[-1])
            yield Sign(name, window, 0.0, 1.0, "visible geoms", weighs(context, False), message)


def _seen(visible: bool) -> Trajectory:
    body = {"name": "body", "parent": "world", "dynamic": True, "joints": ["free"]}
    geom = {"name": "skin", "body": "body", "visible": visible, "collides": True}
    return replace(analytic.falling(), meta={"bodies": [body], "geoms": [geom]})


GOOD = (lambda: Case("a body that is drawn", _seen(True), Context(planned=True, movers=("body",))),)
BAD = (lambda: Case("a hidden body", _seen(False), Context(planned=True, movers=("body",)), severity="blocking"),)
