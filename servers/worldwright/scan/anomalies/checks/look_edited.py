"""The looks of something are edited while it is simulated: it appears, vanishes or changes colour.

What it means: damage, wetness, flames or a broken part that is swapped in are painted on rather than simulated; the
picture then stands for evidence that no state supports.

Formula: recorded edits of arrays that only change the picture, grouped by array and element. Declared by an intervention
of kind `parameter` on the owning body.
Threshold: none. Blocking with a plan when opacity, material, group or size changes; else a warning. Cameras and lights
are free.
Source: the facts on staging (wrinkles, debris, stems drawn without state behind them).
"""

from collections.abc import Iterator
from dataclasses import replace

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..declared import weighs
from ..sign import Case, Context, Sign
from .seen_through import carrying

CODE = "WS307"
STAGING = True
NEEDS = ("loads",)
SHOWS = ("geom_rgba", "geom_matid", "geom_group", "mat_", "site_", "flex_rgba", "flex_matid", "skin_", "tendon_rgba",
         "tendon_width")  # fmt: skip


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each edited look once."""
    assert trajectory.loads is not None
    geoms = trajectory.meta.get("geoms") or ()
    groups: dict[tuple[str, str, bool], list[tuple[float, float]]] = {}
    for time, array, index, value in trajectory.loads.edits:
        if not array.startswith(SHOWS):
            continue
        owner, opacity = array, array.endswith("rgba") and index % 4 == 3
        if array.startswith("geom_") and geoms:
            owner = str(geoms[index // max(1, {"geom_rgba": 4}.get(array, 1))]["body"])
        groups.setdefault((array, owner, opacity or not array.endswith("rgba")), []).append((time, value))
    for (array, owner, grave), edits in groups.items():
        declared = context.declares("parameter", owner)
        message = f"{array} of {owner} is edited {len(edits)} times while it is simulated: its looks are not its state"
        window = (edits[0][0], edits[-1][0])
        severity = weighs(context, declared, claimed=grave)
        yield Sign(owner, window, float(len(edits)), 0.0, "edits", severity, message)


def _painted(*edits: tuple[float, str, int, float]) -> Trajectory:
    meta = {"geoms": [{"name": "skin", "body": "body"}, {"name": "crack", "body": "body"}]}
    return replace(analytic.resting(), loads=replace(carrying(), edits=edits), meta=meta)


GOOD = (
    lambda: Case("nothing edited", _painted(), Context(planned=True)),
    lambda: Case("a light that follows", _painted((1.0, "light_pos", 0, 3.0)), Context(planned=True)),
)
BAD = (
    lambda: Case("a crack appears", _painted((1.0, "geom_rgba", 7, 1.0)), Context(planned=True), severity="blocking"),
    lambda: Case("it turns red", _painted((1.0, "geom_rgba", 4, 1.0)), Context(planned=True), severity="warn"),
)
