"""The layout agrees with what was seen in the reference image (`topology.image_observation`), from where it was seen.

A camera at azimuth a looks along -(cos a, sin a); right in its picture is (-sin a, cos a). In a view from straight above,
right is +X,
and what is farther up in the picture (+Y) is behind.
"""

import math

from ...model.plan.layout import PlacedObject
from ...model.plan.observation import ImageObservation, SeenFacing, SeenRelation
from ..anchors import TOLERANCE_M, cos_sin, shown, wrap
from ..placement_results import RowMargin
from .checked_layout import CONTACT_M, CheckedLayout

FACING_DEG = 45.0
"""Half of the range of headings that one word covers, degrees."""
BESIDE = 1.0
"""Things farther apart than this, times the larger of two extents, are not beside each other."""


def check(layout: CheckedLayout) -> None:
    """Report WP322 for what is seen and not planned, WP321 for a relation or a heading that the layout does not have."""
    seen = layout.plan.topology.image_observation
    if seen is None:
        return
    path = ("topology", "image_observation")
    names = [v.name for v in seen.visible] + [n for r in seen.relations for n in (r.subject, r.object)]
    names += [n for f in seen.facing for n in (f.subject, f.toward) if n]
    known = layout.plan.object_names()
    for name in dict.fromkeys(n for n in names if n not in known):
        layout.problems.add(
            "WP322", "seen_but_absent", f"`{name}` was seen in the image, and no object is called so",
            f"add it to scene_objects or assets; known: {', '.join(known)}", path,
        )  # fmt: skip
    right, away = _picture(layout, seen)
    for index, relation in enumerate(seen.relations):
        pair = layout.placed.get(relation.subject), layout.placed.get(relation.object)
        if pair[0] is not None and pair[1] is not None:
            _relation(layout, relation, pair[0], pair[1], right, away, (*path, "relations", index))
    for index, facing in enumerate(seen.facing):
        if facing.subject in layout.placed and (facing.toward is None or facing.toward in layout.placed):
            _facing(layout, facing, right, away, (*path, "facing", index))


def _picture(layout: CheckedLayout, seen: ImageObservation) -> tuple[tuple[float, float], tuple[float, float]]:
    """Unit vectors of the ground plane: right in the picture, and away from the viewer."""
    first = next(iter(layout.plan.cameras()), None)
    placed = next((c for c in layout.scene.cameras if first is not None and c.name == first.name), None)
    if placed is not None:
        dx, dy = placed.target[0] - placed.position[0], placed.target[1] - placed.position[1]
        flat = math.hypot(dx, dy)
        away = (dx / flat, dy / flat) if flat > 1e-6 else (0.0, 1.0)
    else:
        from worldkit.cameras.views import VIEWS

        c, s = cos_sin(VIEWS[seen.viewpoint].azimuth_deg)
        away = (-c, -s)
    return (away[1], -away[0]), away


def _relation(
    layout: CheckedLayout,
    seen: SeenRelation,
    subject: PlacedObject,
    other: PlacedObject,
    right: tuple[float, float],
    away: tuple[float, float],
    path: tuple[str | int, ...],
) -> None:
    margin = _margin(layout, seen.relation, subject, other, right, away)
    label = f"image: {seen.subject} {seen.relation} {seen.object}"
    layout.margins.append(RowMargin(row=label, margin=round(margin, 6), unit="m"))
    if margin < 0:
        layout.problems.add(
            "WP321",
            "image_disagrees",
            f"the image shows `{seen.subject}` {seen.relation} `{seen.object}`; the layout misses that by {shown(-margin)} m",
            f"change the rows of `{seen.subject}`: {_row_words(layout, seen.subject)}",
            path,
        )


def _margin(
    layout: CheckedLayout,
    relation: str,
    subject: PlacedObject,
    other: PlacedObject,
    right: tuple[float, float],
    away: tuple[float, float],
) -> float:
    """How far a relation holds, metres; negative when it does not."""
    dx, dy, dz = (a - b for a, b in zip(subject.position, other.position, strict=True))
    across, along = dx * right[0] + dy * right[1], dx * away[0] + dy * away[1]
    if relation in ("left_of", "right_of"):
        return -across if relation == "left_of" else across
    if relation in ("in_front_of", "behind"):
        return -along if relation == "in_front_of" else along
    if relation in ("above", "below"):
        return dz if relation == "above" else -dz
    (low, high), (low_b, high_b) = subject.bounds(), other.bounds()
    box = layout.resolution.boxes[other.name]
    if relation == "on":
        levels = [(box.low("z") + s.height_m, s.inset(*box.to_own(*subject.position[:2]))) for s in box.surfaces()]
        return max(
            min(CONTACT_M + _gap_below(layout, subject) - abs(low[2] - z), inset + TOLERANCE_M) for z, inset in levels
        )
    if relation == "inside":
        walls = min(min(a - b, d - c) for a, b, c, d in zip(low[:2], low_b[:2], high[:2], high_b[:2], strict=True))
        return min(walls + TOLERANCE_M, high_b[2] - low[2] - CONTACT_M, low[2] - low_b[2] + TOLERANCE_M)
    gap = math.hypot(*(max(low[i] - high_b[i], low_b[i] - high[i], 0.0) for i in (0, 1)))
    reach = BESIDE * max(*subject.size[:2], *other.size[:2])
    return min(reach - gap, high[2] - low_b[2], high_b[2] - low[2])


def _gap_below(layout: CheckedLayout, subject: PlacedObject) -> float:
    """How far its rows lift an object above what it is on, m."""
    rows = [r for r in layout.resolution.statements if r.subject == subject.name]
    return max((float(r.params.get(r.entry.DROP, 0.0)) for r in rows if r.entry.SUPPORTS), default=0.0)


def _facing(
    layout: CheckedLayout,
    seen: SeenFacing,
    right: tuple[float, float],
    away: tuple[float, float],
    path: tuple[str | int, ...],
) -> None:
    placed = layout.placed[seen.subject]
    if seen.toward is not None:
        other = layout.placed[seen.toward]
        wanted = (other.position[0] - placed.position[0], other.position[1] - placed.position[1])
    else:
        sign = {"right": (1, 0), "left": (-1, 0), "away": (0, 1), "toward_viewer": (0, -1)}[str(seen.direction)]
        wanted = (sign[0] * right[0] + sign[1] * away[0], sign[0] * right[1] + sign[1] * away[1])
    off = abs(wrap(placed.deg_z - math.degrees(math.atan2(wanted[1], wanted[0]))))
    words = f"toward `{seen.toward}`" if seen.toward else str(seen.direction)
    label = f"image: {seen.subject} faces {seen.toward or seen.direction}"
    layout.margins.append(RowMargin(row=label, margin=round(FACING_DEG - off, 6), unit="deg"))
    if off > FACING_DEG:
        layout.problems.add(
            "WP321",
            "image_disagrees",
            f"the image shows `{seen.subject}` facing {words}; its front is {shown(round(off, 2))} deg from that",
            f"add or change its FACING-* row: {_row_words(layout, seen.subject)}",
            path,
        )


def _row_words(layout: CheckedLayout, name: str) -> str:
    return "; ".join(str(r) for r in layout.resolution.statements if r.subject == name) or "(it has none)"
