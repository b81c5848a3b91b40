"""The four templates of a camera that stands inside a container or room, by one of its walls."""

from dataclasses import dataclass

from ..anchors import Box, Derivation, Surface
from ..vocabulary import Case
from . import _camera
from ._faces import MINUS_X, MINUS_Y, PLUS_X, PLUS_Y, Side

FAMILY = "Camera templates"
REFERENCE = "required"
PARAMS = _camera.INSIDE_PARAMS
UNIT = "m"
LENS = {"fovy_deg": 60.0, "aspect": 1.5}
Place = dict[str, float]


def _floor(name: str | None) -> Surface:
    return Surface("inside", 0.1, (3.8, 5.8))


ROOM = {"name": "room", "size": (4.0, 6.0, 3.0), "x": 0.0, "y": 0.0, "z": 1.5, "yaw": 0, "surface": _floor}


@dataclass(frozen=True)
class Inside:
    """One template: a wall of the reference, and worked places of a camera in `ROOM`."""

    side: Side
    by_wall: Place
    """Its place 0.2 m from the wall, m."""
    in_wall: Place
    """A place inside the wall, m."""
    yaw: float
    """Its heading, degrees."""

    @property
    def CODE(self) -> str:
        """The code, e.g. `inside_minus_x_wall`."""
        return f"inside_{self.side.name}_wall"

    @property
    def name(self) -> str:
        """The name, which equals the code."""
        return self.CODE

    @property
    def doc(self) -> str:
        """The documentation, with its formulas."""
        axis, across = self.side.axis, self.side.across
        _, inwards = self.side.signs()
        return f"""\
The camera stands inside a container or room, by its {self.side.words} wall ({self.side.called}), and looks across.

    {axis} = inner.{self.side.bound}_{axis} {inwards} inset        {across} = inner.center_{across}        z = inner.floor + height
    deg_z = heading to the middle of the inside, which it looks at

`inner` is the free space inside the reference, which must have an inside and stand square to the world. `inset` is metres
from the wall's inner face, `height` metres above the inner floor; omitted, half the inner height. `fovy_deg` and `aspect`
are the camera's and the recording's own. Source: paper, relation patterns, "Camera framing"; parameters are ours."""

    @property
    def GOOD(self) -> tuple[Case, ...]:
        """A case at a height, and one half way up."""
        return (
            Case(
                _camera.POINT, ROOM, {"inset": 0.2, "height": 1.6, **LENS}, {**self.by_wall, "z": 1.7, "yaw": self.yaw}
            ),
            Case(_camera.POINT, ROOM, {"inset": 0.2, **LENS}, {**self.by_wall, "z": 1.55, "yaw": self.yaw}),
        )

    @property
    def BAD(self) -> tuple[Case, ...]:
        """A case inside the wall."""
        camera = {**_camera.POINT, **self.in_wall, "z": 1.7, "yaw": self.yaw}
        return (Case(camera, ROOM, {"inset": 0.2, **LENS}),)

    def pins(self, params: dict) -> dict[str, tuple[str, ...]]:
        """It sets position and heading."""
        return _camera.PINS

    def resolve(self, dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
        """Compute the point by the wall."""
        return _camera.inside(self.side.axis, self.side.sign, dof, subject, reference, params)

    def target(self, reference: Box, params: dict) -> tuple[float, float, float]:
        """The middle of the inside."""
        return _camera.middle(_camera.inner(reference))

    def holds(self, subject: Box, reference: Box, params: dict) -> float:
        """Measure how far the camera is inside the free space, metres."""
        return _camera.room(subject, reference)


ENTRIES = (
    Inside(MINUS_X, {"x": -1.7, "y": 0.0}, {"x": -2.0, "y": 0.0}, 0.0),
    Inside(PLUS_X, {"x": 1.7, "y": 0.0}, {"x": 2.0, "y": 0.0}, 180.0),
    Inside(MINUS_Y, {"x": 0.0, "y": -2.7}, {"x": 0.0, "y": -3.0}, 90.0),
    Inside(PLUS_Y, {"x": 0.0, "y": 2.7}, {"x": 0.0, "y": 3.0}, -90.0),
)
