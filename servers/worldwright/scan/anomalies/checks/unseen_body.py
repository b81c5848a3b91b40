"""A body that the plan speaks of is simulated, but not drawn.

What it means: what the picture shows in its place is something else (a static twin, a decoration), so the picture is no
evidence of the state, nor the state of the picture.

Formula: a moving body named by the plan that has geoms, none of them visible (drawn group, not transparent), nor any of a
body below it; and no visible skin follows one of these.
Threshold: none. Blocking.
Source: the facts on staging (bodies simulated but drawn frozen).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.finding import AnomalySeverity
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
    skinned = [str(b) for skin in trajectory.meta.get("skins") or () if skin["visible"] for b in skin["bodies"]]
    for body in (*(str(geom["body"]) for geom in geoms if geom["visible"]), *skinned):
        while body and body not in shown:
            shown.add(body)
            body = parent.get(body, "")
    for row in trajectory.meta.get("bodies") or ():
        name = str(row["name"])
        if row.get("dynamic") and name in names and name in has and name not in shown:
            message = f"{name} is simulated, but none of its geoms is drawn, nor any skin over it"
            window = (trajectory.t[0], trajectory.t[-1])
            yield Sign(name, window, 0.0, 1.0, "visible geoms", weighs(context, False), message)


def _seen(visible: bool, skinned: bool | None = None) -> Trajectory:
    body = {"name": "body", "parent": "world", "dynamic": True, "joints": ["free"]}
    geom = {"name": "skin", "body": "body", "visible": visible, "collides": True}
    skins = [] if skinned is None else [{"name": "suit", "bodies": ["body"], "visible": skinned}]
    return replace(analytic.falling(), meta={"bodies": [body], "geoms": [geom], "skins": skins})


def _case(title: str, trajectory: Trajectory, severity: AnomalySeverity | None = None) -> Case:
    return Case(title, trajectory, Context(planned=True, movers=("body",)), severity)


GOOD = (
    lambda: _case("a body that is drawn", _seen(True)),
    lambda: _case("a body under a skin", _seen(False, skinned=True)),
)
BAD = (
    lambda: _case("a hidden body", _seen(False), "blocking"),
    lambda: _case("a hidden body under a hidden skin", _seen(False, skinned=False), "blocking"),
)
