"""The twelve adjacent templates: the body's side meets one of four side faces of the reference, at one of three levels."""

from dataclasses import dataclass

from ..anchors import TOLERANCE_M, Box, Derivation, total
from ..parameters import Parameter
from ..vocabulary import Case
from ._faces import MINUS_X, MINUS_Y, PLUS_X, PLUS_Y, Side

REFERENCE = "required"
UNIT = "m"
PARAMS = {
    "gap": Parameter("number", "metres between the two facing sides; omitted: 0, flush", 0.0),
    "offset": Parameter("number", "metres along the face, from the reference's centre; omitted: 0, centred"),
}
BLOCK = {"name": "block", "size": (1.0, 2.0, 0.8), "x": 0.5, "y": 1.0, "z": 0.4, "yaw": 0}
Place = tuple[float, float]


@dataclass(frozen=True)
class Level:
    """The heights at which body and reference meet."""

    name: str
    anchor: str
    """The height of the reference that counts."""
    sign: int
    """The body's centre is below it by the half height times this: 1 for tops, -1 for bottoms, 0 for centres."""
    words: str
    z: float
    """The worked centre height of a body 0.2 m high beside `BLOCK`, m."""

    def of(self, box: Box) -> float:
        """The height of a box that counts, m."""
        if not self.sign:
            return box.get("z")
        return box.high("z") if self.sign > 0 else box.low("z")


BOTTOMS = Level("bottom_flush", "min_z", -1, "bottoms", 0.1)
CENTRES = Level("centers", "center_z", 0, "centres", 0.4)
TOPS = Level("top_flush", "max_z", 1, "tops", 0.7)


@dataclass(frozen=True)
class Adjacent:
    """One template: a side face, a level, and worked places of a body of 0.4 x 0.6 m beside `BLOCK`."""

    side: Side
    level: Level
    straight: Place
    """x and y of its centre, m."""
    turned: Place
    """x and y when it is turned by 90 degrees, with a gap of 0.1 m and an offset of -0.3 m."""
    away: Place
    """A place that leaves a gap."""

    @property
    def CODE(self) -> str:
        """The code, e.g. `adjacent_minus_x_bottom_flush`."""
        return f"adjacent_{self.side.name}_{self.level.name}"

    @property
    def name(self) -> str:
        """The name, which equals the code."""
        return self.CODE

    @property
    def FAMILY(self) -> str:
        """The paper's row of the level."""
        return f"Adjacent {self.level.name.replace('_', '-')}"

    @property
    def doc(self) -> str:
        """The documentation, with its formulas."""
        axis, across = self.side.axis, self.side.across
        out, _ = self.side.signs()
        z = f"reference.{self.level.anchor}" + {-1: " + half_z", 0: "", 1: " - half_z"}[self.level.sign]
        return f"""\
The body is flush against the reference's {self.side.words} face ({self.side.called}) and their {self.level.words} are at one height.

    {axis} = reference.{self.side.bound}_{axis} {out} gap {out} half_{axis}        {across} = reference.center_{across} + offset        z = {z}

Faces are those of the world AABBs, so a yawed body counts with its rotated extents. `gap` keeps the sides apart and
`offset` slides the body along the face, both in metres; omitted they are 0. Yaw is not set.
Source: paper, relation patterns, "Adjacent-outside"; parameters are ours."""

    @property
    def GOOD(self) -> tuple[Case, ...]:
        """A straight case, and a turned one with both parameters."""
        size, z = (0.4, 0.6, 0.2), self.level.z
        moved = {"gap": 0.1, "offset": -0.3}
        return (
            Case({"size": size, "yaw": 0}, BLOCK, {}, {"x": self.straight[0], "y": self.straight[1], "z": z}),
            Case({"size": size, "yaw": 90}, BLOCK, moved, {"x": self.turned[0], "y": self.turned[1], "z": z}),
        )

    @property
    def BAD(self) -> tuple[Case, ...]:
        """A case off the face, and one a centimetre off the level."""
        body = {"size": (0.4, 0.6, 0.2), "yaw": 0}
        return (
            Case({**body, "x": self.away[0], "y": self.away[1], "z": self.level.z}, BLOCK),
            Case({**body, "x": self.straight[0], "y": self.straight[1], "z": self.level.z + 0.01}, BLOCK),
        )

    def pins(self, params: dict) -> dict[str, tuple[str, ...]]:
        """It sets all three coordinates."""
        axis, across = self.side.axis, self.side.across
        return {
            axis: (f"reference.{axis}", "reference.extents", "self.extents"),
            across: (f"reference.{across}",),
            "z": ("reference.z",),
        }

    def resolve(self, dof: str, subject: Box, reference: Box, params: dict) -> Derivation:
        """Compute the centre beside the face."""
        axis, sign = self.side.axis, self.side.sign
        if dof == axis:
            minus = "" if sign > 0 else "-"
            face = reference.high(axis) if sign > 0 else reference.low(axis)
            return total(
                axis,
                (f"{reference.name}.{self.side.bound}_{axis}", face),
                (f"{minus}gap", params.get("gap", 0.0)),
                (f"{minus}{subject.name}.half_{axis}", subject.half(axis)),
            )
        if dof == "z":
            terms = [(f"{reference.name}.{self.level.anchor}", self.level.of(reference))]
            if self.level.sign:
                terms.append((f"{'-' if self.level.sign > 0 else ''}{subject.name}.half_z", subject.half("z")))
            return total("z", *terms)
        terms = [(f"{reference.name}.center_{dof}", reference.get(dof))]
        return total(dof, *terms, *([("offset", params["offset"])] if "offset" in params else []))

    def holds(self, subject: Box, reference: Box, params: dict) -> float:
        """Return the tolerance minus the largest error of gap, offset and level, metres."""
        axis, across = self.side.axis, self.side.across
        near = (
            subject.low(axis) - reference.high(axis) if self.side.sign > 0 else reference.low(axis) - subject.high(axis)
        )
        errors = (
            near - params.get("gap", 0.0),
            subject.get(across) - reference.get(across) - params.get("offset", 0.0),
            self.level.of(subject) - self.level.of(reference),
        )
        return TOLERANCE_M - max(abs(error) for error in errors)


ENTRIES = tuple(
    Adjacent(side, level, straight, turned, away)
    for side, straight, turned, away in (
        (MINUS_X, (-0.2, 1.0), (-0.4, 0.7), (-0.25, 1.0)),
        (PLUS_X, (1.2, 1.0), (1.4, 0.7), (1.25, 1.0)),
        (MINUS_Y, (0.5, -0.3), (0.2, -0.3), (0.5, -0.35)),
        (PLUS_Y, (0.5, 2.3), (0.2, 2.3), (0.5, 2.35)),
    )
    for level in (BOTTOMS, CENTRES, TOPS)
)
