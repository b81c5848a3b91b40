"""The camera looks at the whole scene from outside the right (-Y) side of its bounding box.

    y = scene.min_y - distance        x = scene.center_x        z = scene.center_z + height
    deg_z = heading to the scene's centre, which it looks at

`scene` is the world AABB of every object. `distance` is metres from its right face; omitted, that face fills `fovy_deg`
(vertical, degrees; the camera's own) and `aspect` (width over height; the recording's) with a tenth to spare. `height`
raises the camera; omitted it is level. Source: paper, relation patterns, "Camera framing"; parameters are ours.
"""

from ..anchors import Box, Derivation
from ..vocabulary import SCENE, Case
from . import _camera

CODE = "camera_side_minus_y"
FAMILY = "Camera templates"
REFERENCE = "optional"
PARAMS = _camera.SIDE_PARAMS
UNIT = "deg"
WHOLE = {"name": SCENE, "size": (4.0, 2.0, 1.0), "x": 1.0, "y": 0.0, "z": 0.5, "yaw": 0}
GOOD = (
    Case(
        _camera.POINT,
        WHOLE,
        {"distance": 5.0, "height": 1.0, "fovy_deg": 60.0, "aspect": 1.5},
        {"x": 1.0, "y": -6.0, "z": 1.5, "yaw": 90.0},
    ),
    Case(_camera.POINT, WHOLE, {"fovy_deg": 90.0, "aspect": 1.0}, {"x": 1.0, "y": -3.2, "z": 0.5, "yaw": 90.0}),
)
BAD = (Case({**_camera.POINT, "x": 1.0, "y": -2.0, "z": 0.5, "yaw": 90}, WHOLE, {"fovy_deg": 60.0, "aspect": 1.5}),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets position and heading."""
    return _camera.PINS


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the point beside the scene."""
    return _camera.side("y", -1, dof, subject, reference, params)


def target(reference: Box, params: dict) -> tuple[float, float, float]:
    """The scene's centre."""
    return _camera.middle(reference)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how far the scene stays inside the frame, degrees."""
    return _camera.margin(subject, target(reference, params), reference, params)
