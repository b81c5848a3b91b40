"""Comparing the world that was simulated with the plan: only a world that acts as planned is stamped, whoever built it.

Lint compares the world that a program builds for lint; here it is the file that the engine simulated.
"""

from pathlib import Path

from ..model.plan.committed import Plan


def from_plan(world: Path, plan: Plan) -> list[str]:
    """The ways in which the world in a file (`world.mjz`) departs from its plan, one line each; empty when it acts as planned."""
    from ..lint.tools import acts_as_planned

    return [f"{f.code} {f.message}" for f in acts_as_planned(world, plan) if f.severity == "error"]
