"""The view of a plan rule: the plan, and where in the file each of its rows stands."""

from collections.abc import Callable

from ..model.finding import Severity
from ..model.plan.committed import AssetRow, Plan, SceneObject
from .problem import Problem

LineOf = Callable[..., int | None]
Place = tuple[str | int, ...]
"""A path into the plan, section first."""


class PlanView:
    """A plan with the look-ups the rules share."""

    def __init__(self, plan: Plan, line_of: LineOf | None = None) -> None:
        self.plan = plan
        self._line_of = line_of

    def at(self, place: Place, message: str, fix: str = "", severity: Severity | None = None) -> Problem:
        """A problem at a path into the plan, e.g. `("objectives", 0, "expect")`; the nearest known line is taken."""
        line = None
        if self._line_of is not None:
            for length in range(len(place), 0, -1):
                line = self._line_of(*place[:length])
                if line is not None:
                    break
        return Problem(message, fix, line, section=str(place[0]), severity=severity)

    @property
    def rows(self) -> dict[str, SceneObject | AssetRow]:
        """The row that describes each object (every instance of an asset leads to its row)."""
        found: dict[str, SceneObject | AssetRow] = {row.name: row for row in self.plan.scene_objects}
        for asset in self.plan.assets:
            found.update(dict.fromkeys(asset.instances, asset))
            found.setdefault(asset.name, asset)
        return found

    def place(self, name: str) -> Place:
        """Where the row of an object stands."""
        for index, row in enumerate(self.plan.scene_objects):
            if row.name == name:
                return ("scene_objects", index)
        for index, asset in enumerate(self.plan.assets):
            if name == asset.name or name in asset.instances:
                return ("assets", index)
        return ("scene_objects",)

    @staticmethod
    def moves(row: SceneObject | AssetRow) -> bool:
        """Whether an object has degrees of freedom."""
        if isinstance(row, AssetRow):
            return row.is_dynamic and not row.fixed
        return row.dynamic and not row.fixed and row.visual_only is None
