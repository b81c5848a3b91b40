"""What the checks look at: the plan, its layout, and what several of them need."""

from dataclasses import dataclass, field
from functools import cached_property

from ...model.plan import Plan
from ...model.scene import PlacedObject, Scene
from ..overlaps import overlapping
from ..reports import RowMargin, Seen
from ..resolution import Resolution
from ..statements import Problems
from ..world import drawn_only, jointed

OVERLAP_M = 1e-3
"""Penetration that a contact solver digests without a visible jolt."""
CONTACT_M = 2e-3
"""Two faces nearer than this touch."""


@dataclass
class Layout:
    """A plan and its resolution under check; findings are noted in `problems`."""

    plan: Plan
    resolution: Resolution
    problems: Problems
    exact: bool
    margins: list[RowMargin] = field(default_factory=list)
    views: list[Seen] = field(default_factory=list)
    pairs_tested: int = 0

    @property
    def scene(self) -> Scene:
        """Every placed object."""
        return self.resolution.scene

    @cached_property
    def hidden(self) -> set[str]:
        """Objects that are not simulated."""
        return drawn_only(self.plan)

    @cached_property
    def held(self) -> set[str]:
        """Objects on joints."""
        return jointed(self.plan)

    @cached_property
    def movers(self) -> set[str]:
        """Objects that some step expects to move."""
        return set(self.plan.movers())

    @cached_property
    def placed(self) -> dict[str, PlacedObject]:
        """Objects by name."""
        return {o.name: o for o in self.scene.objects}

    @cached_property
    def bounds(self) -> dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]]:
        """World boxes of what is simulated."""
        return {o.name: o.bounds() for o in self.scene.objects if o.name not in self.hidden}

    @cached_property
    def close(self) -> list[tuple[str, str, float]]:
        """Pairs whose world boxes touch or overlap, with the smallest of the three overlaps (negative: apart)."""
        rows = [(name, *corners) for name, corners in self.bounds.items()]
        return list(overlapping(rows, deeper_than_m=-CONTACT_M))

    @cached_property
    def row_of(self) -> dict[str, tuple[str | int, ...]]:
        """Path of the first row about each object."""
        found: dict[str, tuple[str | int, ...]] = {}
        for row in self.resolution.statements:
            found.setdefault(row.subject, row.path)
        return found

    def path(self, name: str) -> tuple[str | int, ...]:
        """The first row about an object."""
        return self.row_of.get(name, ("topology",))
