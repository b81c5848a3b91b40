"""Shared arithmetic of the camera templates: where a camera stands so that a box fills its picture.

A camera is a point with a heading (yaw of its horizontal direction) that looks at a target. The picture is a pinhole
projection: a point at depth d along the viewing axis is inside when its offsets to the right and up are below
d tan(fovx / 2) and d tan(fovy / 2), with tan(fovx / 2) = aspect tan(fovy / 2). Source: Hartley and Zisserman, Multiple
View Geometry, section 6.1.
"""

import math

from ..anchors import TOLERANCE_DEG, TOLERANCE_M, Box, CannotResolveError, Derivation, shown, total
from ..parameters import Parameter

SPARE = 1.1
"""A camera stands further away by this factor than where the box touches the picture's edge."""
POINT = {"name": "camera", "size": (0.0, 0.0, 0.0)}
PINS: dict[str, tuple[str, ...]] = {"x": (), "y": (), "z": (), "yaw": ("self.x", "self.y")}
_LENS = {
    "fovy_deg": Parameter("number", "vertical field of view, degrees; omitted: the camera's own", 1.0),
    "aspect": Parameter("number", "width over height of the picture; omitted: the recording's", 0.1),
}
DISTANCE = Parameter("number", "metres from the near face; omitted: as far as framing it needs", 0.0)
SIDE_PARAMS = {
    "distance": DISTANCE,
    "height": Parameter("number", "metres above the reference's centre; omitted: 0, level"),
    **_LENS,
}
TOP_PARAMS = {"distance": DISTANCE, **_LENS}
PERSPECTIVE_PARAMS = {
    "azimuth_deg": Parameter(
        "number", "where the camera stands, degrees from +X towards +Y; omitted: -45, front right"
    ),
    "elevation_deg": Parameter("number", "how high it stands, degrees above the horizon; omitted: 24", 0.0),
    "distance": Parameter("number", "metres from the reference's centre; omitted: as far as framing it needs", 0.0),
    **_LENS,
}
INSIDE_PARAMS = {
    "inset": Parameter("number", "metres from the inner face of the wall", 0.0, required=True),
    "height": Parameter("number", "metres above the inner floor; omitted: half the inner height", 0.0),
    **_LENS,
}


def tangents(params: dict) -> tuple[float, float]:
    """tan(fovx / 2) and tan(fovy / 2)."""
    if not params["fovy_deg"] < 170:
        raise CannotResolveError(f"a field of view of {shown(params['fovy_deg'])} deg", "use less than 170 degrees")
    up = math.tan(math.radians(params["fovy_deg"]) / 2)
    return up * params["aspect"], up


def middle(box: Box) -> tuple[float, float, float]:
    """A box's centre."""
    return (box.get("x"), box.get("y"), box.get("z"))


def framing(half_across: float, half_up: float, params: dict) -> float:
    """The distance at which a flat face fills the picture with a tenth to spare, m."""
    right, up = tangents(params)
    return max(half_across / right, half_up / up) * SPARE


def heading(subject: Box, target: tuple[float, float, float]) -> Derivation:
    """Compute the yaw towards the target; 0 when it is straight above or below."""
    dx, dy = target[0] - subject.get("x"), target[1] - subject.get("y")
    value = math.degrees(math.atan2(dy, dx)) if math.hypot(dx, dy) > 1e-9 else 0.0
    return Derivation(value, f"deg_z = heading to the target = {shown(value)}")


def side(axis: str, sign: int, dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Place a camera outside one face of the reference's world AABB."""
    across = "y" if axis == "x" else "x"
    if dof == "yaw":
        return heading(subject, middle(reference))
    if dof == "z":
        terms = [(f"{reference.name}.center_z", reference.get("z"))]
        return total("z", *terms, *([("height", params["height"])] if "height" in params else []))
    if dof == across:
        return total(dof, (f"{reference.name}.center_{dof}", reference.get(dof)))
    far = params.get("distance")
    word = "distance" if far is not None else "framing distance"
    far = framing(reference.half(across), reference.half("z"), params) if far is None else far
    face = "max" if sign > 0 else "min"
    edge = reference.high(axis) if sign > 0 else reference.low(axis)
    return total(dof, (f"{reference.name}.{face}_{axis}", edge), (word if sign > 0 else f"-{word}", far))


def inner(reference: Box) -> Box:
    """The free space inside a container or room, as a box."""
    if reference.get("yaw") % 90:
        raise CannotResolveError(
            f"{reference.name} is turned by {shown(reference.get('yaw'))} deg, so its walls have no world side",
            "turn it by a multiple of 90 degrees, or give the camera a position and a target",
        )
    try:
        surface = reference.surface("inside")
    except KeyError as cause:
        raise CannotResolveError(str(cause.args[0]), "name a box_container, or use side_*") from cause
    dx, dy = reference.to_world(*surface.centre)
    floor, rim = reference.low("z") + surface.height_m, reference.high("z")
    return Box(
        f"inside of {reference.name}",
        (*surface.extents, rim - floor),
        x=reference.get("x") + dx,
        y=reference.get("y") + dy,
        z=(floor + rim) / 2,
        yaw=reference.get("yaw"),
    )


def inside(axis: str, sign: int, dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Place a camera by one inner face."""
    room_ = inner(reference)
    if dof == "yaw":
        return heading(subject, middle(room_))
    if dof == "z":
        height = params.get("height", room_.half("z"))
        word = "height" if "height" in params else "half the inner height"
        return total("z", ("inner.floor", room_.low("z")), (word, height))
    if dof != axis:
        return total(dof, (f"inner.center_{dof}", room_.get(dof)))
    if sign > 0:
        return total(dof, (f"inner.max_{axis}", room_.high(axis)), ("-inset", params["inset"]))
    return total(dof, (f"inner.min_{axis}", room_.low(axis)), ("inset", params["inset"]))


def room(subject: Box, reference: Box) -> float:
    """The distance to the nearest inner face, m; negative outside."""
    space = inner(reference)
    return TOLERANCE_M + min(min(subject.get(a) - space.low(a), space.high(a) - subject.get(a)) for a in "xyz")


def margin(camera: Box, target: tuple[float, float, float], box: Box, params: dict) -> float:
    """How far the corner of the world AABB that is nearest to the picture's edge is inside it, degrees; negative outside.

    The angle of a corner from the viewing axis is measured across the width and across the height of the picture.
    """
    right, up, forward = axes(middle(camera), target)
    tan_x, tan_y = tangents(params)
    worst = 180.0
    for i in (-1, 1):
        for j in (-1, 1):
            for k in (-1, 1):
                corner = (
                    box.get("x") + i * box.half("x"),
                    box.get("y") + j * box.half("y"),
                    box.get("z") + k * box.half("z"),
                )
                offset = tuple(c - e for c, e in zip(corner, middle(camera), strict=True))
                depth = _dot(offset, forward)
                if depth <= 0:
                    return -180.0
                for axis, tangent in ((right, tan_x), (up, tan_y)):
                    angle = math.degrees(math.atan(tangent) - math.atan(abs(_dot(offset, axis)) / depth))
                    worst = min(worst, angle)
    return worst + TOLERANCE_DEG


Vec3 = tuple[float, ...]


def axes(eye: Vec3, target: Vec3) -> tuple[Vec3, Vec3, Vec3]:
    """(right, up, forward) of a camera that looks from `eye` at `target`; straight down, +X is to the right."""
    forward = tuple(t - e for t, e in zip(target, eye, strict=True))
    length = math.sqrt(_dot(forward, forward))
    if length < 1e-9:
        raise CannotResolveError("the camera stands in its own target", "give a distance")
    forward = tuple(v / length for v in forward)
    flat = math.hypot(forward[0], forward[1])
    right = (forward[1] / flat, -forward[0] / flat, 0.0) if flat > 1e-6 else (1.0, 0.0, 0.0)
    up = (
        right[1] * forward[2] - right[2] * forward[1],
        right[2] * forward[0] - right[0] * forward[2],
        right[0] * forward[1] - right[1] * forward[0],
    )
    return right, up, forward


def _dot(a: Vec3, b: Vec3) -> float:
    return sum(p * q for p, q in zip(a, b, strict=True))
