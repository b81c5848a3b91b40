"""The body rests on the middle of the reference's top face.

    x = reference.center_x        y = reference.center_y        z = reference.max_z + half_z

The top face is the upper face of the bounding box. Yaw is not set.
Source: paper, relation patterns, "On-top"; ours: it takes no parameters.
"""

from ..anchors import Box, Derivation
from ..parameters import Parameter
from ..vocabulary import Case
from . import _on_top

CODE = "centered_on_ref"
FAMILY = "On-top templates"
REFERENCE = "required"
PARAMS: dict[str, Parameter] = {}
UNIT = "m"
SUPPORTS = True
BLOCK = {"name": "block", "size": (1.0, 2.0, 0.8), "x": 0.5, "y": 1.0, "z": 0.4, "yaw": 30}
GOOD = (Case({"size": (0.4, 0.6, 0.2)}, BLOCK, {}, {"x": 0.5, "y": 1.0, "z": 0.9}),)
BAD = (
    Case({"size": (0.4, 0.6, 0.2), "x": 0.52, "y": 1.0, "z": 0.9, "yaw": 0}, BLOCK),
    Case({"size": (0.4, 0.6, 0.2), "x": 0.5, "y": 1.0, "z": 0.8, "yaw": 0}, BLOCK),
)


def pins(params: dict) -> dict[str, tuple[str, ...]]:
    """It sets all three coordinates."""
    return {"x": ("reference.x", "reference.yaw"), "y": ("reference.y", "reference.yaw"), "z": ("reference.z",)}


def resolve(dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
    """Compute the centre over the reference's."""
    return _on_top.place(dof, subject, reference, 0.0, (0.0, 0.0))


def holds(subject: Box, reference: Box, params: dict) -> float:
    """Measure how well it rests in the middle, metres."""
    return _on_top.holds(subject, reference, 0.0, (0.0, 0.0))
