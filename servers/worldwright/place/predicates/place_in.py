"""The subject is inside a container: on its inner floor, between its inner walls.

    z = inside.floor + gap + half_z
    (x, y) = inside.center + Rz(reference.yaw) offset        when `offset` is given

The container's inner extents count: those of a box_container's walls, or the `inside` that the catalog gives an asset. `offset`
[dx, dy] runs along the container's own axes, metres; omitted, other rows set x and y. `gap` lifts the subject; omitted it is on
the floor. It must keep `clearance` metres from the walls (omitted: 0) with its whole footprint; it may look out over
the rim unless `headroom` demands that many metres from its top to the rim.
Source: paper, predicate algebra, special: containment (the excerpt is silent on parameters; these are ours).
"""

from ..anchors import TOLERANCE_M, Box, CannotResolveError, Derivation, Surface, shown, total
from ..parameters import Parameter
from ..vocabulary import Case

CODE = "PLACE-IN"
FAMILY = "Containment and free placement"
REFERENCE = "required"
PARAMS = {
    "offset": Parameter("pair", "metres from the middle of the inside, along the container's own x and y"),
    "gap": Parameter("number", "metres between the inner floor and the lowest point; omitted: 0", 0.0),
    "clearance": Parameter("number", "metres to the inner walls, at least; omitted: 0", 0.0),
    "headroom": Parameter("number", "metres from the top to the rim, at least; omitted: it may look out", 0.0),
}
UNIT = "m"
INSIDE = True
SUPPORTS = True
DROP = "gap"


def _bin(name: str | None) -> Surface:
    return Surface("inside", 0.05, (0.9, 1.9))


BIN = {"name": "bin", "size": (1.0, 2.0, 0.7), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0, "surface": _bin}
GOOD = (
    Case({"size": (0.2, 0.4, 0.1), "yaw": 0}, BIN, {"offset": (0.1, 0.2)}, {"x": 0.6, "y": 1.2, "z": 0.1}),
    Case(
        {"size": (0.2, 1.8, 0.3), "yaw": 90},
        {**BIN, "yaw": 90},
        {"offset": (0.0, 0.0), "gap": 0.1, "clearance": 0.04, "headroom": 0.2},
        {"x": 0.5, "y": 1.0, "z": 0.3},
    ),
)
BAD = (
    Case({"size": (0.2, 0.4, 0.1), "x": 0.9, "y": 1.0, "z": 0.1, "yaw": 0}, BIN),
    Case({"size": (0.2, 1.2, 0.1), "x": 0.5, "y": 1.0, "z": 0.1, "yaw": 90}, BIN),
    Case({"size": (0.2, 0.4, 0.6), "x": 0.5, "y": 1.0, "z": 0.35, "yaw": 0}, BIN, {"headroom": 0.1}),
)


def inside(reference: Box) -> Surface:
    """The inner floor, with its free extents."""
    try:
        return reference.surface("inside")
    except KeyError as cause:
        raise CannotResolveError(
            f"{reference.name} is no container: {cause.args[0]}", "refer to a box_container, or use PLACE-ON"
        ) from cause


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets the height always; x and y when `offset` is given."""
    plane = {a: (f"reference.{a}", "reference.yaw") for a in ("x", "y")} if "offset" in params else {}
    return {"z": ("reference.z",), **plane}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre of something that lies on the inner floor."""
    floor = inside(reference)
    if dof == "z":
        terms = [(f"{reference.name}.inside.floor", reference.low("z") + floor.height_m)]
        if "gap" in params:
            terms.append(("gap", params["gap"]))
        return total("z", *terms, (f"{subject.name}.half_z", subject.half("z")))
    own = (floor.centre[0] + params["offset"][0], floor.centre[1] + params["offset"][1])
    turned = "" if reference.get("yaw") % 360 == 0 else f" turned by {shown(reference.get('yaw'))} deg"
    shift = reference.to_world(*own)["xy".index(dof)]
    return total(dof, (f"{reference.name}.center_{dof}", reference.get(dof)), (f"offset{turned}", shift))


def free(subject: Box, reference: Box, floor: Surface) -> float:
    """Distance of the subject's footprint to the inner walls, metres; negative when it is in one."""
    x, y = reference.to_own(subject.get("x"), subject.get("y"))
    across, along = subject.spread(subject.get("yaw") - reference.get("yaw"))
    if subject.round and floor.shape == "ellipse":
        return floor.inset(x, y) - max(across, along)
    return min(floor.inset(x + i * across, y + j * along) for i in (-1, 1) for j in (-1, 1))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Return the smallest of: height, distance to the walls beyond `clearance`, room below the rim, offset; metres."""
    floor = inside(reference)
    level = reference.low("z") + floor.height_m
    margins = [
        TOLERANCE_M - abs(subject.low("z") - level - params.get("gap", 0.0)),
        free(subject, reference, floor) - params.get("clearance", 0.0) + TOLERANCE_M,
        reference.high("z") - subject.low("z"),
    ]
    if "headroom" in params:
        margins.append(reference.high("z") - subject.high("z") - params["headroom"] + TOLERANCE_M)
    if "offset" in params:
        x, y = reference.to_own(subject.get("x"), subject.get("y"))
        errors = (x - floor.centre[0] - params["offset"][0], y - floor.centre[1] - params["offset"][1])
        margins.append(TOLERANCE_M - max(map(abs, errors)))
    return min(margins)
