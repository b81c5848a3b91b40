"""What is filled with water is there, and higher than the water: its level lies between the container's bottom and its rim."""

from ..anchors import shown
from .checked_layout import CheckedLayout


def check(layout: CheckedLayout) -> None:
    """Report WP329 for a level that no wall holds."""
    parameters = layout.plan.simulation_parameters
    for index, row in enumerate(parameters.interventions):
        water = row.solver
        if water is None or not water.container or water.container not in layout.placed:
            continue
        constant = parameters.constants.get(water.constants.get("level", ""))
        if constant is None or isinstance(constant.value, tuple):
            continue
        level, (low, high) = float(constant.value), layout.placed[water.container].bounds()
        path = ("simulation_parameters", "interventions", index, "solver")
        if not low[2] < level < high[2]:
            side = (
                f"{shown(level - high[2])} m over the rim"
                if level >= high[2]
                else f"{shown(low[2] - level)} m under the bottom"
            )
            layout.problems.add(
                "WP329",
                "not_held",
                f"the water in `{water.container}` would stand at {shown(level)} m, {side}; it reaches from {shown(low[2])} m to "
                f"{shown(high[2])} m",
                f"let `{water.constants['level']}` be between these, with walls above it",
                path,
            )
