"""Nothing is inside anything else: boxes first, then the exact collision shapes of those that overlap."""

import math
from itertools import groupby

from ...model.plan.belonging import welded
from ..anchors import shown
from ..asking import RefusedLayoutError, simulate
from .checked_layout import OVERLAP_M, CheckedLayout


def check(layout: CheckedLayout) -> None:
    """Report WP302 for each pair that penetrates by more than a millimetre, or than the plan lets it; WP327 for what it may not let.

    Parts on joints may overlap each other, and so may the boxes around the pieces of what breaks: the pieces themselves fit.
    """
    held = layout.held
    _too_much(layout)

    whole = {piece: name for name in layout.plan.broken for piece in layout.plan.families[name]}

    # What drives on a road is within its box, which tells nothing: its surface does.
    roads = {name for row in layout.plan.assets if row.type == "road" for name in row.instances} - set(
        layout.bounds if layout.exact else ()
    )

    def deep(pair: tuple[str, str, float]) -> bool:
        if roads & {*pair[:2]}:
            return False
        if pair[0] in whole and whole[pair[0]] == whole.get(pair[1]):
            return False
        return pair[2] > max(OVERLAP_M, layout.belonging.allowed_m(*pair[:2]))

    pairs = [p for p in layout.close if deep(p) and not (p[0] in held and p[1] in held)]
    layout.pairs_tested = len(pairs)
    if not pairs:
        return
    if layout.exact:
        names = {name for pair in pairs for name in pair[:2]}
        close = {pair[:2] for pair in pairs}
        try:
            touching = simulate(layout.plan, layout.scene, only=names, loose=True)["contacts"]
        except RefusedLayoutError as error:
            layout.problems.add(
                "WP302", "overlap", f"overlaps could not be tested exactly: {error.cause}", error.next_move
            )
        else:
            pairs = [(a, b, depth) for a, b, depth in touching if (a, b) in close and deep((a, b, depth))]
    rows_of: dict[str, list[str]] = {}
    for row in layout.resolution.statements:
        rows_of.setdefault(row.subject, []).append(str(row))
    for first, second, depth in pairs:
        rows = [*rows_of.get(first, []), *rows_of.get(second, [])]
        allowed = layout.belonging.allowed_m(first, second)
        more = round(depth - allowed, 6)
        layout.problems.add(
            "WP302",
            "overlap",
            f"`{first}` and `{second}` penetrate each other by {shown(depth)} m"
            + (f", {shown(more)} m more than `topology.overlaps` lets them" if allowed else ""),
            f"move one of them by {shown(more)} m or more: {'; '.join(rows[:4]) or 'see body_positions'}"
            + ("" if allowed else "; where they belong together, say so in `topology.overlaps`"),
            layout.path(second),
        )


def _too_much(layout: CheckedLayout) -> None:
    """Report each row of `topology.overlaps`, as it is written, that would hide that one thing is half inside the other.

    What is welded together is one thing, whose parts may lie in each other as they like; what a joint joins does not collide.
    """
    one_thing = welded(layout.plan)
    joined = {frozenset((joint.parent, joint.child)): joint.name for joint in layout.plan.topology.joints}
    whole = {copy: name for name, copies in layout.plan.families.items() for copy in copies}
    rows = groupby(layout.plan.topology.overlaps, lambda r: (*(whole.get(n, n) for n in r.between), r.up_to_m, r.why))
    for index, ((one, other, up_to_m, _), copied) in enumerate(rows):
        pairs = [row.between for row in copied]
        if all(a in one_thing and one_thing[a] == one_thing.get(b) for a, b in pairs):
            continue
        sizes: dict[str, float] = {}
        for name in (name for pair in pairs for name in pair if name in layout.placed):
            said = whole.get(name, name)
            sizes[said] = min(sizes.get(said, math.inf), *layout.placed[name].size)
        if unknown := [name for name in (one, other) if name not in sizes]:
            layout.problems.add(
                "WP327",
                "overlap_too_large",
                f"`topology.overlaps` lets {one} and {other} overlap, but the size of `{unknown[0]}` is not known here",
                "name an object that the layout places; what its geoms measure is held against it once it is built (`WM112`)",
                ("topology", "overlaps", index),
                severity="warning",
            )
            continue
        thinner = min(sizes, key=lambda name: sizes[name])
        if up_to_m > sizes[thinner] / 2:
            joint = next((joined[pair] for pair in map(frozenset, pairs) if pair in joined), "")
            without = f"leave the row out (what joint `{joint}` joins does not collide)" if joint else ""
            without = without or "weld them (`type: weld`), or make room for one in the other"
            layout.problems.add(
                "WP327",
                "overlap_too_large",
                f"`topology.overlaps` lets {one} and {other} overlap by {shown(up_to_m)} m, more than half of "
                f"`{thinner}` ({shown(sizes[thinner])} m)",
                f"let it be {shown(sizes[thinner] / 2)} m at most, or {without}",
                ("topology", "overlaps", index),
            )
