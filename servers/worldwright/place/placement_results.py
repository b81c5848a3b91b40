"""The typed results of this server's tools, which print themselves."""

from ..model.finding import Finding
from ..model.frozen import Frozen
from ..model.plan.committed import Vec3
from ..model.plan.layout import Scene


class Layout(Scene):
    """A resolved layout, the result of `resolve`."""

    plan: str = ""
    written: bool = False
    """Whether the plan file was changed."""
    at_start: tuple[str, ...] = ()
    """Ropes and springs against their ends' distance, and joints that do not start at rest as laid out."""

    def text(self) -> str:
        """A table of poses, then the findings."""
        width = max((len(o.name) for o in self.objects), default=6)
        lines = [f"{'object':<{width}}  {'x':>9} {'y':>9} {'z':>9}  {'deg_z':>8}  on"]
        for o in self.objects:
            x, y, z = o.position
            lines.append(f"{o.name:<{width}}  {x:9.4f} {y:9.4f} {z:9.4f}  {o.deg_z:8.2f}  {o.supported_by or '-'}")
        lines += [f"{o.name}: {o.weight}" for o in self.objects if o.weight]
        lines += self.at_start
        lines += [str(finding) for finding in self.findings]
        ending = f"poses written to {self.plan}" if self.written else "nothing written"
        return "\n".join([*lines, f"{len(self.objects)} objects placed; {ending}"])


ROWS, VIEWS = 12, 24
"""Rows and views that are printed; the data holds all."""


class RowMargin(Frozen):
    """How well one row holds at the resolved poses."""

    row: str
    line: int | None = None
    margin: float
    """The row holds by so much if positive, and is violated by so much if negative."""
    unit: str


class Seen(Frozen):
    """How one camera sees one object at the start, measured with rays on a coarse picture."""

    camera: str
    object: str
    pixels: int
    """The visible pixels at the recording's size."""
    share: float
    """The visible share of the picture, 0 to 1."""
    in_frame: float
    """The share of its outline inside the picture, 0 to 1."""
    hidden: float
    """The share of its part inside the picture that something else hides, 0 to 1."""
    length_px: int = 0
    """The longer side of the box around it in the picture, pixels."""


class CheckReport(Frozen):
    """The results of the checks of a layout."""

    objects: int
    rows: int
    pairs_tested: int = 0
    """The number of pairs whose boxes overlap, which were tested with their exact collision shapes."""
    findings: tuple[Finding, ...] = ()
    margins: tuple[RowMargin, ...] = ()
    """The margins of all rows, the tightest first."""
    at_start: tuple[str, ...] = ()
    """Ropes and springs against their ends' distance, and joints that do not start at rest as laid out; frictions in force of
    what meets and does not say the same."""
    views: tuple[Seen, ...] = ()
    """How each camera sees its subjects."""
    smallest: str = ""
    """What the plan speaks of and is smallest where it is seen largest, at the start."""

    @property
    def ok(self) -> bool:
        """Whether no finding is an error."""
        return not any(f.severity == "error" for f in self.findings)

    def text(self) -> str:
        """The findings, then the tightest rows."""
        lines = [str(finding) for finding in self.findings]
        lines += self.at_start
        lines += [f"{m.margin:+9.4f} {m.unit:<3} {m.row}" for m in self.margins[:ROWS]]
        if len(self.margins) > ROWS:
            left = len(self.margins) - ROWS
            lines.append(f"… and {left} more rows, none tighter (all of them: --format json)")
        lines += [
            f"{v.camera}: {v.object} {v.pixels} pixels ({v.share:.1%}), {v.in_frame:.0%} in frame, {v.hidden:.0%} hidden"
            for v in self.views[:VIEWS]
        ]
        lines += [f"smallest: {self.smallest}"] if self.smallest else []
        if self.views:
            lines.append("views are of the start; the run frames the whole way, and what moves far comes out smaller")
        if len(self.views) > VIEWS:
            lines.append(f"… and {len(self.views) - VIEWS} more views (all of them: --format json)")
        verdict = "holds" if self.ok else "does not hold"
        return "\n".join(
            [*lines, f"{self.objects} objects, {self.rows} rows, {self.pairs_tested} close pairs: the layout {verdict}"]
        )


class Settled(Frozen):
    """What one object did in the pre-roll."""

    name: str
    drop_m: float
    """How far its centre moved down, m."""
    slide_m: float
    """How far its centre moved sideways, m."""
    tilt_deg: float
    """Angle between its up axis before and after, degrees."""
    turn_deg: float
    """The yaw that it gained, degrees."""
    speed_m_s: float
    """Its speed at the end, m/s."""
    position: Vec3
    """Its place at the end, world frame, m."""
    moved: Vec3
    """Its displacement from the start, m."""


class SettleReport(Frozen):
    """What happens to a layout when it is released, without initial motion and control."""

    duration_s: float
    objects: tuple[Settled, ...] = ()
    """Those that moved most come first; a tool's answer has at most 60."""
    held: dict[str, str] = {}
    """The objects that were not released, and why: on a joint, carrying one, or only drawn."""
    findings: tuple[Finding, ...] = ()
    deepest_m: float = 0.0
    """The deepest penetration at the start, m."""
    written: tuple[str, ...] = ()
    """Objects whose settled displacement was written into the plan."""

    @property
    def ok(self) -> bool:
        """Whether nothing that should stand has toppled, slid or flown away."""
        return not any(f.severity == "error" for f in self.findings)

    def text(self) -> str:
        """A table of displacements, then the findings."""
        width = max((len(o.name) for o in self.objects), default=6)
        lines = [f"{'object':<{width}}  {'drop m':>8} {'slide m':>8} {'tilt deg':>8} {'turn deg':>8} {'m/s':>7}"]
        lines += [
            f"{o.name:<{width}}  {o.drop_m:8.4f} {o.slide_m:8.4f} {o.tilt_deg:8.2f} {o.turn_deg:8.2f} "
            f"{o.speed_m_s:7.3f}"
            for o in self.objects
        ]
        lines += [f"{name}: not let go, {why}" for name, why in list(self.held.items())[:ROWS]]
        lines += [f"… and {len(self.held) - ROWS} more are not let go"] if len(self.held) > ROWS else []
        lines += [str(finding) for finding in self.findings]
        return "\n".join(
            [
                *lines,
                f"after {self.duration_s:g} s: the layout {'settles' if self.ok else 'does not settle'}"
                + (f"; {len(self.written)} displacements written" if self.written else ""),
            ]
        )


class Explained(Frozen):
    """One object of a chain, with the formula behind each of its numbers."""

    name: str
    kind: str
    size: Vec3
    size_source: str
    position: Vec3
    deg_z: float
    formulas: tuple[str, ...]


class Explanation(Frozen):
    """The reasons for an object's pose, from the base to its own numbers."""

    object: str
    chain: tuple[Explained, ...]
    """The objects that it depends on, in dependency order; the object itself comes last."""

    def text(self) -> str:
        """One paragraph for each object of the chain."""
        lines = []
        for link in self.chain:
            sx, sy, sz = link.size
            lines.append(f"{link.name} ({link.kind}) {sx:.4g} x {sy:.4g} x {sz:.4g} m: {link.size_source}")
            lines += [f"  {formula}" for formula in link.formulas]
        return "\n".join(lines)


class Value(Frozen):
    """One reckoned row."""

    name: str
    expression: str
    value: float
    """The value to six digits; a comparison is 1 or 0."""


class Reckoned(Frozen):
    """The values of the expressions."""

    values: tuple[Value, ...] = ()
    g: float
    """The gravity that the closed forms used last, m/s^2."""
    forms: tuple[str, ...] = ()
    """Every closed form, when nothing was asked."""

    def text(self) -> str:
        """One line per value."""
        return "\n".join([*(f"{v.name} = {v.value:g}    # {v.expression}" for v in self.values), *self.forms])


class Drawing(Frozen):
    """A picture of the layout, and the findings that it marks."""

    out: str = ""
    """The file it was written to, if any."""
    objects: int
    unplaced: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()
    """The findings marked in red (errors) and amber (warnings)."""

    def text(self) -> str:
        """The place of the picture."""
        lines = [str(finding) for finding in self.findings]
        return "\n".join([*lines, f"{self.objects} objects drawn" + (f" in {self.out}" if self.out else "")])
