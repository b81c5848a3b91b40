"""The camera looks at the reference from a direction given by two angles.

    (x, y, z) = reference.center + distance (cos e cos a, cos e sin a, sin e)        deg_z = a + 180

with a = `azimuth_deg` (where the camera stands, from +X towards +Y; omitted -45, front right) and e = `elevation_deg`
above the horizon (omitted 24). `distance` is metres from the centre; omitted, the box's bounding sphere of radius r
fills the smaller of the two fields of view: distance = 1.1 r / sin(fov / 2), from `fovy_deg` (vertical; the camera's
own) and `aspect` (width over height; the recording's). Without a reference it frames the whole scene.
Source: paper, relation patterns, "Camera framing"; parameters are ours.
"""

import math

from ..anchors import Box, Derivation, cos_sin, shown, total, wrap
from ..vocabulary import Case
from . import _camera

CODE = "perspective"
FAMILY = "Camera templates"
REFERENCE = "optional"
PARAMS = _camera.PERSPECTIVE_PARAMS
UNIT = "deg"
SOFA = {"name": "sofa", "size": (2.0, 1.0, 1.0), "x": 1.0, "y": 2.0, "z": 0.5, "yaw": 0}
LENS = {"fovy_deg": 60.0, "aspect": 1.5}
GOOD = (
    Case(
        _camera.POINT,
        SOFA,
        {"azimuth_deg": -90.0, "elevation_deg": 0.0, "distance": 4.0, **LENS},
        {"x": 1.0, "y": -2.0, "z": 0.5, "yaw": 90.0},
    ),
    Case(
        _camera.POINT,
        SOFA,
        {"azimuth_deg": 0.0, "elevation_deg": 90.0, "distance": 4.0, **LENS},
        {"x": 1.0, "y": 2.0, "z": 4.5, "yaw": 180.0},
    ),
)
BAD = (
    Case(
        {**_camera.POINT, "x": 1.0, "y": 0.5, "z": 0.5, "yaw": 90},
        SOFA,
        {"azimuth_deg": -90.0, "elevation_deg": 0.0, **LENS},
    ),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets position and heading."""
    return _camera.PINS


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the point in that direction."""
    azimuth, elevation = params.get("azimuth_deg", -45.0), params.get("elevation_deg", 24.0)
    if dof == "yaw":
        value = wrap(azimuth + 180)
        return Derivation(value, f"deg_z = azimuth_deg + 180 = {shown(azimuth)} + 180 = {shown(value)}")
    (ca, sa), (ce, se) = cos_sin(azimuth), cos_sin(elevation)
    far = params.get("distance")
    if far is None:
        radius = math.sqrt(sum(reference.half(axis) ** 2 for axis in "xyz"))
        far = _camera.SPARE * radius / math.sin(math.atan(min(_camera.tangents(params))))
    shift = {"x": ce * ca, "y": ce * sa, "z": se}[dof] * far
    return total(dof, (f"{reference.name}.center_{dof}", reference.get(dof)), ("distance along the view", shift))


def target(reference: Box, params: dict) -> tuple[float, float, float]:
    """The reference's centre."""
    return _camera.middle(reference)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how far the reference stays inside the frame, degrees."""
    return _camera.margin(subject, target(reference, params), reference, params)
