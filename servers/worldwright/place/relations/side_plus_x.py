"""The camera looks at the reference from its plus x side (+X, front).

    x = reference.max_x + distance        y = reference.center_y        z = reference.center_z + height
    deg_z = heading to the reference's centre, which it looks at

`distance` is metres from the near face; omitted, the facing side fills `fovy_deg` (vertical, degrees; the camera's own)
and `aspect` (width over height; the recording's) with a tenth to spare. `height` raises the camera; omitted it is level.
Without a reference it frames the whole scene. Source: paper, relation patterns, "Camera framing"; parameters are ours.
"""

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _camera

CODE = "side_plus_x"
FAMILY = "Camera templates"
REFERENCE = "optional"
PARAMS = _camera.SIDE_PARAMS
UNIT = "deg"
SOFA = {"name": "sofa", "size": (2.0, 1.0, 1.0), "x": 1.0, "y": 2.0, "z": 0.5, "yaw": 0}
GOOD = (
    Case(
        _camera.POINT,
        SOFA,
        {"distance": 3.0, "fovy_deg": 60.0, "aspect": 1.5},
        {"x": 5.0, "y": 2.0, "z": 0.5, "yaw": 180.0},
    ),
    Case(
        _camera.POINT,
        SOFA,
        {"height": 0.25, "fovy_deg": 90.0, "aspect": 1.0},
        {"x": 2.55, "y": 2.0, "z": 0.75, "yaw": 180.0},
    ),
)
BAD = (
    Case(
        {**_camera.POINT, "x": 2.3, "y": 2.0, "z": 0.5, "yaw": 180.0},
        SOFA,
        {"fovy_deg": 60.0, "aspect": 1.5},
    ),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """Position and heading."""
    return _camera.PINS


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """The point in front of the face."""
    return _camera.side("x", 1, dof, subject, reference, params)


def target(reference: Box, params: dict) -> tuple[float, float, float]:
    """The reference's centre."""
    return _camera.middle(reference)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """How far the reference stays inside the frame, degrees."""
    return _camera.margin(subject, target(reference, params), reference, params)
