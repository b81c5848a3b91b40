"""A second group has the layout of a first one, moved and turned as a whole.

    leader, when `offset` is given:  x = reference.x + dx        y = reference.y + dy        bottom = reference.bottom
                                     deg_z = reference.deg_z + turn_deg
    each member:  (x, y) = leader + Rz(leader.deg_z - reference.deg_z) (original - reference)
                  bottom = leader.bottom + original.bottom - reference.bottom
                  deg_z = original.deg_z + leader.deg_z - reference.deg_z

The object of the row is the leader of the first group (see GROUP), the subject leads the copy and `members` are its
other objects, in the order of the originals and of the same sizes. `offset` [dx, dy] (world axes, metres) and `turn_deg`
place the new leader relative to the old one; without `offset` the leader has rows of its own (a plate at another seat)
and the members follow it.
Source: paper, predicate algebra, grouping (the excerpt is silent on parameters; these are ours).
"""

from ..anchors import TOLERANCE_DEG, TOLERANCE_M, Box, CannotResolveError, Derivation, cos_sin, shown, total, wrap
from ..parameters import Parameter
from ..vocabulary import Case, Expansion

CODE = "COPY-GROUP"
FAMILY = "Grouping"
REFERENCE = "required"
PARAMS = {
    "members": Parameter("objects", "the other objects of the copy, in the order of the originals", required=True),
    "offset": Parameter("pair", "metres from the old leader to the new one, world x and y"),
    "turn_deg": Parameter("number", "yaw of the new leader on top of the old one's, degrees; omitted: 0"),
}
UNIT = "m"
GROUPS = COPIES = True
PLATE = {"name": "plate", "size": (0.3, 0.3, 0.02), "x": 1.0, "y": 0.0, "z": 0.76, "yaw": 0}
FORK = {"name": "fork", "size": (0.2, 0.02, 0.04), "x": 1.1, "y": 0.2, "z": 0.77, "yaw": 10}
SECOND = {"name": "second", "size": (0.3, 0.3, 0.02), "x": 3.0, "y": 0.0, "z": 0.86, "yaw": 90}
GOOD = (
    Case(
        {"size": (0.3, 0.3, 0.02)},
        PLATE,
        {"offset": (0.0, 1.0), "turn_deg": 180.0},
        {"x": 1.0, "y": 1.0, "z": 0.76, "yaw": 180.0},
    ),
    Case(
        {"size": (0.2, 0.02, 0.04)},
        PLATE,
        {"original": FORK, "leader": SECOND},
        {"x": 2.8, "y": 0.1, "z": 0.87, "yaw": 100.0},
    ),
)
BAD = (
    Case(
        {"size": (0.2, 0.02, 0.04), "x": 2.8, "y": 0.12, "z": 0.87, "yaw": 100},
        PLATE,
        {"original": FORK, "leader": SECOND},
    ),
)


def expand(row: Expansion) -> list[tuple[str, dict]]:
    """Expand to the leader, if this row places it, and every member."""
    originals = row.groups.get(str(row.reference))
    if originals is None:
        raise CannotResolveError(
            f"`{row.reference}` leads no group",
            f"add `- {{subject: {row.reference}, predicate: GROUP, params: {{members: [...]}}}}`; "
            f"leaders: {', '.join(row.groups) or '(none)'}",
        )
    members = row.params["members"]
    if len(members) != len(originals):
        raise CannotResolveError(
            f"it has {len(members)} members, the group of `{row.reference}` has {len(originals)}",
            f"name one object for each of: {', '.join(originals)}",
        )
    if "turn_deg" in row.params and "offset" not in row.params:
        raise CannotResolveError(
            "`turn_deg` turns a leader that `offset` places", "add `offset`, or turn the leader by FACING-* instead"
        )
    pairs = list(zip((row.subject, *members), (str(row.reference), *originals), strict=True))
    for copy, original in pairs:
        if copy == original:
            raise CannotResolveError(f"`{copy}` would be a copy of itself", "name another object")
        if original not in row.boxes:
            raise CannotResolveError(f"the size of `{original}` is not known", f"fix the finding about `{original}`")
        sizes = row.boxes[copy].size, row.boxes[original].size
        if any(abs(a - b) > TOLERANCE_M for a, b in zip(*sizes, strict=True)):
            raise CannotResolveError(
                f"`{copy}` and `{original}` are of different sizes", "copies are of the same size: check their order"
            )
    leader = {key: row.params[key] for key in ("offset", "turn_deg") if key in row.params}
    parts: list[tuple[str, dict]] = [(row.subject, leader)] if leader else []
    boxes = row.boxes
    return parts + [(copy, {"original": boxes[original], "leader": boxes[row.subject]}) for copy, original in pairs[1:]]


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the whole pose."""
    if "offset" in params:
        return {dof: (f"reference.{dof}",) for dof in ("x", "y", "z", "yaw")}
    plane = ("original.x", "original.y", "reference.x", "reference.y", "reference.yaw", "leader.yaw")
    return {
        "x": (*plane, "leader.x"),
        "y": (*plane, "leader.y"),
        "z": ("original.z", "reference.z", "leader.z"),
        "yaw": ("original.yaw", "reference.yaw", "leader.yaw"),
    }


def _pose(dof: str, subject: Box, reference: Box, params: dict) -> float:
    if "offset" in params:
        if dof == "yaw":
            return wrap(reference.get("yaw") + params.get("turn_deg", 0.0))
        if dof == "z":
            return reference.low("z") + subject.half("z")
        return float(reference.get(dof) + params["offset"]["xy".index(dof)])
    original, leader = params["original"], params["leader"]
    if dof == "z":
        return float(leader.low("z") + original.low("z") - reference.low("z") + subject.half("z"))
    turn = leader.get("yaw") - reference.get("yaw")
    if dof == "yaw":
        return wrap(original.get("yaw") + turn)
    dx, dy = original.get("x") - reference.get("x"), original.get("y") - reference.get("y")
    c, s = cos_sin(turn)
    return float(leader.get(dof) + (c * dx - s * dy if dof == "x" else s * dx + c * dy))


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the copied coordinate."""
    value = _pose(dof, subject, reference, params)
    if "offset" in params:
        if dof == "yaw":
            turn_deg = ("turn_deg", params.get("turn_deg", 0.0))
            return _angle(value, (f"{reference.name}.deg_z", reference.get(dof)), turn_deg)
        if dof == "z":
            return total(
                "z", (f"{reference.name}.min_z", reference.low("z")), (f"{subject.name}.half_z", subject.half("z"))
            )
        return total(
            dof, (f"{reference.name}.center_{dof}", reference.get(dof)), ("offset", params["offset"]["xy".index(dof)])
        )
    original, leader = params["original"], params["leader"]
    between = f"({original.name} - {reference.name})"
    if dof == "yaw":
        gained = original.get("yaw") - reference.get("yaw")
        return _angle(value, (f"{leader.name}.deg_z", leader.get("yaw")), (between, gained))
    if dof == "z":
        rise = original.low("z") - reference.low("z")
        half = (f"{subject.name}.half_z", subject.half("z"))
        return total("z", (f"{leader.name}.min_z", leader.low("z")), (f"{between}.min_z", rise), half)
    turn = wrap(leader.get("yaw") - reference.get("yaw"))
    turned = f" turned by {shown(turn)} deg" if turn else ""
    return total(dof, (f"{leader.name}.center_{dof}", leader.get(dof)), (f"{between}{turned}", value - leader.get(dof)))


def _angle(value: float, first: tuple[str, float], second: tuple[str, float]) -> Derivation:
    """Derive a sum of two angles within (-180, 180]."""
    formula = total("deg_z", first, second).formula
    again = "" if formula.endswith(f" = {shown(value)}") else f" = {shown(value)}"
    return Derivation(value, formula + again)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the tolerance minus the distance from the copied pose, metres; a degree too much counts as a tolerance."""
    errors = [subject.get(dof) - _pose(dof, subject, reference, params) for dof in ("x", "y", "z")]
    turn = wrap(subject.get("yaw") - _pose("yaw", subject, reference, params))
    return TOLERANCE_M - max(*(abs(e) for e in errors), abs(turn) * TOLERANCE_M / TOLERANCE_DEG)
