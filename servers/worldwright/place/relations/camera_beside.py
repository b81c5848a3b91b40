"""The four templates of a camera that looks at a reference from outside one of its side faces."""

from dataclasses import dataclass

from ..anchors import Box, Derivation
from ..vocabulary import Case
from . import _camera
from ._faces import MINUS_X, MINUS_Y, PLUS_X, PLUS_Y, Side

FAMILY = "Camera templates"
REFERENCE = "optional"
PARAMS = _camera.SIDE_PARAMS
UNIT = "deg"
SOFA = {"name": "sofa", "size": (2.0, 1.0, 1.0), "x": 1.0, "y": 2.0, "z": 0.5, "yaw": 0}
Place = dict[str, float]


@dataclass(frozen=True)
class Beside:
    """One template: a side face, and worked places of a camera that looks at `SOFA`."""

    side: Side
    far: Place
    """Its place at a distance of 3 m, m."""
    framing: Place
    """Its place when a square picture of 90 degrees frames the side, m."""
    near: Place
    """A place from which the sofa does not fit, m."""
    yaw: float
    """Its heading, degrees."""

    @property
    def CODE(self) -> str:
        """The code, e.g. `side_minus_x`."""
        return f"side_{self.side.name}"

    @property
    def name(self) -> str:
        """The name, which equals the code."""
        return self.CODE

    @property
    def doc(self) -> str:
        """The documentation, with its formulas."""
        axis, across = self.side.axis, self.side.across
        out, _ = self.side.signs()
        return f"""\
The camera looks at the reference from its {self.side.words} side ({self.side.called}).

    {axis} = reference.{self.side.bound}_{axis} {out} distance        {across} = reference.center_{across}        z = reference.center_z + height
    deg_z = heading to the reference's centre, which it looks at

`distance` is metres from the near face; omitted, the facing side fills `fovy_deg` (vertical, degrees; the camera's own)
and `aspect` (width over height; the recording's) with a tenth to spare. `height` raises the camera; omitted it is level.
Without a reference it frames the whole scene. Source: paper, relation patterns, "Camera framing"; parameters are ours."""

    @property
    def GOOD(self) -> tuple[Case, ...]:
        """A case at a distance, and one that frames the side."""
        given = {"distance": 3.0, "fovy_deg": 60.0, "aspect": 1.5}
        framed = {"height": 0.25, "fovy_deg": 90.0, "aspect": 1.0}
        return (
            Case(_camera.POINT, SOFA, given, {**self.far, "z": 0.5, "yaw": self.yaw}),
            Case(_camera.POINT, SOFA, framed, {**self.framing, "z": 0.75, "yaw": self.yaw}),
        )

    @property
    def BAD(self) -> tuple[Case, ...]:
        """A case that is too near."""
        camera = {**_camera.POINT, **self.near, "z": 0.5, "yaw": self.yaw}
        return (Case(camera, SOFA, {"fovy_deg": 60.0, "aspect": 1.5}),)

    def pins(self, params: dict) -> dict[str, tuple[str, ...]]:
        """It sets position and heading."""
        return _camera.PINS

    def resolve(self, dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
        """Compute the point in front of the face."""
        return _camera.side(self.side.axis, self.side.sign, dof, subject, reference, params)

    def target(self, reference: Box, params: dict) -> tuple[float, float, float]:
        """The reference's centre."""
        return _camera.middle(reference)

    def holds(self, subject: Box, reference: Box, params: dict) -> float:
        """Measure how far the reference stays inside the frame, degrees."""
        return _camera.margin(subject, self.target(reference, params), reference, params)


ENTRIES = (
    Beside(MINUS_X, {"x": -3.0, "y": 2.0}, {"x": -0.55, "y": 2.0}, {"x": -0.3, "y": 2.0}, 0.0),
    Beside(PLUS_X, {"x": 5.0, "y": 2.0}, {"x": 2.55, "y": 2.0}, {"x": 2.3, "y": 2.0}, 180.0),
    Beside(MINUS_Y, {"x": 1.0, "y": -1.5}, {"x": 1.0, "y": 0.4}, {"x": 1.0, "y": 1.2}, 90.0),
    Beside(PLUS_Y, {"x": 1.0, "y": 5.5}, {"x": 1.0, "y": 3.6}, {"x": 1.0, "y": 2.8}, -90.0),
)
