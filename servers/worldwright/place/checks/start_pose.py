"""What holds at the very start: ropes are long enough, and what `initial_motion` swings aside swings into nothing."""

from worldkit.tendons import ROUNDED_M

from ..anchors import shown
from ..asking import RefusedLayoutError, drawn_only, simulate
from ..start import Hung, filtered, hung, told
from .checked_layout import OVERLAP_M, CheckedLayout

STRETCH_M = 1e-3
"""`initial_motion` may stretch a taut rope by so much, which its softness takes."""
GROUND = "ground"


def check(layout: CheckedLayout) -> None:
    """Report WP324 for a rope shorter than its way at the start, or a rod of another length, WP325 for parts on joints that collide there."""
    plan = layout.plan
    layout.at_start += told(plan, layout.scene)
    for index, tendon in enumerate(plan.topology.tendons):
        rope = next((one for one in hung(plan, layout.scene) if one.tendon.name == tendon.name), None)
        if rope is None or tendon.stiffness:
            continue
        if tendon.rod:
            _rod(layout, index, rope)
            continue
        too_short = rope.length_m < rope.laid_m - ROUNDED_M
        if too_short or rope.slack_m < -STRETCH_M:
            where = "as laid out" if too_short else "at the start angle of its joint"
            way_m = rope.laid_m if too_short else rope.way_m
            layout.problems.add(
                "WP324",
                "rope_too_short",
                f"rope `{tendon.name}` is {shown(round(rope.length_m, 4))} m long, but {where} its ends are "
                f"{shown(round(way_m, 4))} m apart",
                f"give `length: {shown(round(way_m, 4) + 1e-4)}` or more, say `slack` instead, or bring its ends nearer",
                ("topology", "tendons", index),
            )
    if layout.moved and layout.exact:
        _collisions(layout)


def _rod(layout: CheckedLayout, index: int, rod: Hung) -> None:
    """Report a rod that is longer or shorter than the way between its ends where `initial_motion` starts them."""
    if abs(rod.slack_m) <= STRETCH_M:
        return
    layout.problems.add(
        "WP324",
        "rope_too_short",
        f"rod `{rod.tendon.name}` is {shown(round(rod.length_m, 4))} m long, but at the start angle of its joint its ends are "
        f"{shown(round(rod.way_m, 4))} m apart",
        "lay both ends out where the rod fits between them, or start the joint at its laid-out position",
        ("topology", "tendons", index),
    )


def _collisions(layout: CheckedLayout) -> None:
    """Report exact shapes that overlap at the start pose, unless the engine lets them or they overlap as laid out."""
    fixed = {o.name for o in layout.scene.objects if o.fixed}
    free = filtered(layout.plan, fixed)
    moved = {n for n in layout.moved if n not in drawn_only(layout.plan)}
    try:
        found = simulate(layout.plan, layout.scene, loose=True, ground=True, moved=layout.moved)["contacts"]
        touching = [
            (a, b, depth)
            for a, b, depth in found
            if depth > max(OVERLAP_M, layout.belonging.allowed_m(a, b))
            and {a, b} & moved
            and (GROUND in (a, b) or not free(a, b))
        ]
        if not touching:
            return
        laid = simulate(layout.plan, layout.scene, loose=True, ground=True)["contacts"]
    except RefusedLayoutError as error:
        layout.problems.add(
            "WP325", "collides_at_start", f"the start pose could not be tested: {error.cause}", error.next_move
        )
        return
    before = {(a, b): depth for a, b, depth in laid}
    path = ("simulation_parameters", "initial_motion")
    for first, second, depth in touching:
        if depth > before.get((first, second), 0.0) + OVERLAP_M:
            layout.problems.add(
                "WP325",
                "collides_at_start",
                f"where `initial_motion` starts them, `{first}` and `{second}` are {shown(round(depth, 4))} m inside each other",
                "start the joint at another position, or move one of them aside (`place draw` shows the start pose)",
                path,
            )
