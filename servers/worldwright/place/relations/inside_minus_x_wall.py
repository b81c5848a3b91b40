"""The camera stands inside a container or room, by its minus x wall (-X, back), and looks across.

    x = inner.min_x + inset        y = inner.center_y        z = inner.floor + height
    deg_z = heading to the middle of the inside, which it looks at

`inner` is the free space inside the reference, which must have an inside and stand square to the world. `inset` is metres
from the wall's inner face, `height` metres above the inner floor; omitted, half the inner height. `fovy_deg` and `aspect`
are the camera's and the recording's own. Source: paper, relation patterns, "Camera framing"; parameters are ours.
"""

from ..anchors import Box, Derivation, Surface
from ..vocabulary import Case
from . import _camera

CODE = "inside_minus_x_wall"
FAMILY = "Camera templates"
REFERENCE = "required"
PARAMS = _camera.INSIDE_PARAMS
UNIT = "m"


def _floor(name: str | None) -> Surface:
    return Surface("inside", 0.1, (3.8, 5.8))


ROOM = {"name": "room", "size": (4.0, 6.0, 3.0), "x": 0.0, "y": 0.0, "z": 1.5, "yaw": 0, "surface": _floor}
LENS = {"fovy_deg": 60.0, "aspect": 1.5}
GOOD = (
    Case(_camera.POINT, ROOM, {"inset": 0.2, "height": 1.6, **LENS}, {"x": -1.7, "y": 0.0, "z": 1.7, "yaw": 0.0}),
    Case(_camera.POINT, ROOM, {"inset": 0.2, **LENS}, {"x": -1.7, "y": 0.0, "z": 1.55, "yaw": 0.0}),
)
BAD = (
    Case(
        {**_camera.POINT, "x": -2.0, "y": 0.0, "z": 1.7, "yaw": 0.0},
        ROOM,
        {"inset": 0.2, **LENS},
    ),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """Position and heading."""
    return _camera.PINS


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """The point by the wall."""
    return _camera.inside("x", -1, dof, subject, reference, params)


def target(reference: Box, params: dict) -> tuple[float, float, float]:
    """The middle of the inside."""
    return _camera.middle(_camera.inner(reference))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """How far the camera is inside the free space, metres."""
    return _camera.room(subject, reference)
