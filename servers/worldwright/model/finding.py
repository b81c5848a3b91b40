"""What a rule or a check found: in a source file (`Finding`) or in a recorded motion (`Anomaly`)."""

from collections.abc import Iterable
from typing import Literal

from .frozen import Frozen

Severity = Literal["error", "warning", "info"]
AnomalySeverity = Literal["blocking", "warn", "info"]
FEW = 2
"""So many of one kind are told one by one."""


class Finding(Frozen):
    """One problem in a plan or a program: its place, its cause and its fix."""

    code: str
    """Stable identifier, e.g. `WL101`; never reused."""
    name: str
    """The shelf module's name, e.g. `zero_timestep`."""
    severity: Severity
    message: str
    """The cause, in one sentence."""
    fix: str = ""
    """What to do about it, in one sentence."""
    file: str = ""
    line: int | None = None
    """1-based."""
    column: int | None = None
    """1-based."""
    section: str | None = None
    """The plan section, when the file is a plan."""

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        section = f" [{self.section}]" if self.section else ""
        fix = f"\n    fix: {self.fix}" if self.fix else ""
        return f"{place}: {self.severity} {self.code} {self.name}{section}: {self.message}{fix}"


class Anomaly(Frozen):
    """One implausible stretch of a recorded motion: who, when, how much, against which threshold."""

    code: str
    name: str
    severity: AnomalySeverity
    body: str
    """The body, geom pair, joint or channel concerned; `world` when it is the whole system."""
    window_s: tuple[float, float]
    measured: float
    threshold: float
    unit: str
    message: str
    extent_m: float | None = None
    """How large what is wrong is in the world, m, where `measured` is in another unit."""

    def __str__(self) -> str:
        start, end = self.window_s
        return (
            f"{self.severity} {self.code} {self.name}: {self.body} at {start:.3f}-{end:.3f} s: {self.message} "
            f"(measured {self.measured:.4g} {self.unit}, threshold {self.threshold:.4g} {self.unit})"
        )


def by_kind(anomalies: Iterable[Anomaly]) -> list[str]:
    """A line for each; of one kind that does not block and comes more than twice, as in a crowd, one line for the worst."""
    lines, kinds = [], dict[tuple[str, AnomalySeverity], list[Anomaly]]()
    for anomaly in anomalies:
        kinds.setdefault((anomaly.code, anomaly.severity), []).append(anomaly)
    for (_, severity), found in kinds.items():
        if severity == "blocking" or len(found) <= FEW:
            lines += [str(one) for one in found]
            continue
        worst = max(found, key=_off)
        others = list(dict.fromkeys(one.body for one in found if one is not worst))
        more = f", and {len(others) - FEW} more" if len(others) > FEW else ""
        lines.append(f"{worst}; the same, less, of {', '.join(others[:FEW])}{more}")
    return lines


def _off(one: Anomaly) -> float:
    """How far off it is, as a factor of its threshold, whichever side is the bad one; as it stands where that is 0."""
    if not one.threshold:
        return abs(one.measured)
    ratio = abs(one.measured / one.threshold)
    return max(ratio, 1 / ratio) if ratio else float("inf")
