"""The camera looks straight down at the reference; +X is to the right of the picture, +Y up.

    x = reference.center_x        y = reference.center_y        z = reference.max_z + distance        deg_z = 0

`distance` is metres above the top face; omitted, the top face fills `fovy_deg` (vertical, degrees; the camera's own) and
`aspect` (width over height; the recording's) with a tenth to spare. Without a reference it frames the whole scene.
Source: paper, relation patterns, "Camera framing"; parameters are ours.
"""

from ..anchors import Box, Derivation, total
from ..vocabulary import Case
from . import _camera

CODE = "top_down"
FAMILY = "Camera templates"
REFERENCE = "optional"
PARAMS = _camera.TOP_PARAMS
UNIT = "deg"
SOFA = {"name": "sofa", "size": (2.0, 1.0, 1.0), "x": 1.0, "y": 2.0, "z": 0.5, "yaw": 0}
GOOD = (
    Case(
        _camera.POINT,
        SOFA,
        {"distance": 3.0, "fovy_deg": 60.0, "aspect": 1.5},
        {"x": 1.0, "y": 2.0, "z": 4.0, "yaw": 0.0},
    ),
    Case(_camera.POINT, SOFA, {"fovy_deg": 90.0, "aspect": 1.0}, {"x": 1.0, "y": 2.0, "z": 2.1}),
)
BAD = (Case({**_camera.POINT, "x": 1.0, "y": 2.0, "z": 1.2, "yaw": 0}, SOFA, {"fovy_deg": 60.0, "aspect": 1.5}),)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets position and heading."""
    return _camera.PINS


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the point above the middle."""
    if dof == "yaw":
        return Derivation(0.0, "deg_z = 0 (straight down)")
    if dof != "z":
        return total(dof, (f"{reference.name}.center_{dof}", reference.get(dof)))
    far = params.get("distance")
    word = "distance" if far is not None else "framing distance"
    far = _camera.framing(reference.half("x"), reference.half("y"), params) if far is None else far
    return total("z", (f"{reference.name}.max_z", reference.high("z")), (word, far))


def target(reference: Box, params: dict) -> tuple[float, float, float]:
    """The reference's centre."""
    return _camera.middle(reference)


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how far the reference stays inside the frame, degrees."""
    return _camera.margin(subject, target(reference, params), reference, params)
