"""Measured figures and their goals: each bench says its own, `make bench` gathers all of them in one table."""

import json
import os
from dataclasses import asdict, dataclass
from pathlib import Path

TO = "WORLDWRIGHT_FIGURES"
"""Variable that names the file to which figures are added, one JSON object a line."""


@dataclass(frozen=True)
class Figure:
    """What was measured, beside what it should be."""

    name: str
    value: float | None
    """None: it could not be measured here, and `unit` says why."""
    goal: float
    unit: str = "x"
    at_least: bool = False
    """More is better."""

    @property
    def ratio(self) -> float | None:
        """Of the goal; 1 and less is met."""
        if self.value is None:
            return None
        return self.goal / max(self.value, 1e-12) if self.at_least else self.value / max(self.goal, 1e-12)

    @property
    def missed(self) -> bool:
        """It was measured, and misses its goal."""
        return self.ratio is not None and self.ratio > 1


def report(*figures: Figure) -> int:
    """Print figures, hand them to `make bench`, and answer the exit code: 1 when one misses its goal."""
    for figure in figures:
        print(line(figure))
    if path := os.environ.get(TO):
        with Path(path).open("a", encoding="utf-8") as stream:
            stream.writelines(json.dumps(asdict(figure)) + "\n" for figure in figures)
    return int(any(figure.missed for figure in figures))


def line(figure: Figure) -> str:
    """One row of the table: figure, value, goal, share of the goal."""
    sign = ">=" if figure.at_least else "<="
    if figure.value is None or figure.ratio is None:
        return f"{figure.name:<44} {'-':>9} {sign} {figure.goal:<8g} not measured: {figure.unit}"
    verdict = "MISSED" if figure.missed else "met"
    return f"{figure.name:<44} {figure.value:>9.4g} {sign} {figure.goal:<8g} {figure.unit:<4} {figure.ratio:6.2f}  {verdict}"
