"""The view of the checks: the plan, its layout, and what several of them need."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

from ...model.plan.belonging import Belonging
from ...model.plan.committed import AssetRow, Plan, SceneObject
from ...model.plan.layout import PlacedObject, Scene
from .. import categories
from ..asking import drawn_only, jointed
from ..built_world import BuiltWorld
from ..overlaps import overlapping
from ..placement_results import RowMargin, Seen
from ..resolution import Resolution
from ..start import Motion, motions
from ..statements import Problems

OVERLAP_M = 1e-3
"""A contact solver resolves this penetration without a visible jolt."""
CONTACT_M = 2e-3
"""Two faces that are nearer than this touch."""


@dataclass
class CheckedLayout:
    """A plan and its resolution under check; findings are noted in `problems`."""

    plan: Plan
    resolution: Resolution
    problems: Problems
    exact: bool
    margins: list[RowMargin] = field(default_factory=list)
    views: list[Seen] = field(default_factory=list)
    smallest: str = ""
    pairs_tested: int = 0
    at_start: list[str] = field(default_factory=list)
    built: BuiltWorld | None = None
    """The world as its program has built it, where there is one."""

    @property
    def scene(self) -> Scene:
        """Every placed object."""
        return self.resolution.scene

    @cached_property
    def hidden(self) -> set[str]:
        """Objects that are not simulated."""
        return drawn_only(self.plan)

    @cached_property
    def belonging(self) -> Belonging:
        """What the plan lets overlap."""
        return Belonging(self.plan)

    @cached_property
    def held(self) -> set[str]:
        """Objects on joints."""
        return jointed(self.plan)

    @cached_property
    def moved(self) -> dict[str, Motion]:
        """The motion of each object on joints from its layout to its start."""
        return motions(self.plan, self.scene)

    @cached_property
    def movers(self) -> set[str]:
        """Objects that some step expects to move."""
        return set(self.plan.movers())

    @cached_property
    def placed(self) -> dict[str, PlacedObject]:
        """Objects by name."""
        return {o.name: o for o in self.scene.objects}

    @cached_property
    def rows(self) -> dict[str, SceneObject | AssetRow]:
        """The row that declares each object."""
        found: dict[str, SceneObject | AssetRow] = {row.name: row for row in self.plan.scene_objects}
        return found | {name: row for row in self.plan.assets for name in row.instances}

    @cached_property
    def categories(self) -> dict[str, categories.Category]:
        """The category of each placed object that has one."""
        found = ((name, categories.of(self.rows[name], self.rows[name].name)) for name in self.placed)
        return {name: category for name, category in found if category is not None}

    def reach(self, placed: PlacedObject, more_m: float) -> tuple[tuple[float, float], tuple[float, float]]:
        """Its world box in the plane, m, enlarged on every side by `more_m`."""
        (x0, y0, _), (x1, y1, _) = placed.bounds()
        return (x0 - more_m, y0 - more_m), (x1 + more_m, y1 + more_m)

    @cached_property
    def bounds(self) -> dict[str, tuple[tuple[float, float, float], tuple[float, float, float]]]:
        """World boxes (m) of what is simulated."""
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


def others(alike: Sequence[object]) -> str:
    """The words after the first of several objects in one finding: ` and 7 more`."""
    return f" and {len(alike) - 1} more" if len(alike) > 1 else ""
