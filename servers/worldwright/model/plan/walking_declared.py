"""What robots that walk declare by that: the servos that come with their models, and the control of those."""

from typing import Any

from worldkit.robots.gaits import GAITS

from .declared_inputs import Intervention
from .drives import Actuator

Written = Any
"""A plan, or a part of it, whose module imports this one."""


def actuators(plan: Written) -> tuple[Actuator, ...]:
    """The actuators of a plan with the servos of its robots that walk, which come with their models."""
    given = list(plan.topology.actuators)
    taken = {row.name for row in given}
    for row in plan.assets:
        for name in row.instances if row.walks is not None else ():
            joints = GAITS[row.walks.gait].joints
            given += [
                Actuator(name=servo, joint=f"{name}_{joint}", kind="imported")
                for servo, joint in zip(row.walks.servos(name), joints, strict=True)
                if servo not in taken
            ]
    return tuple(given)


def interventions(plan: Written) -> tuple[Intervention, ...]:
    """What a plan declares to act, with the control of its robots that walk."""
    given = list(plan.simulation_parameters.interventions)
    for row in plan.assets:
        if row.walks is not None:
            control = _declared(row)
            given += [] if control in given else [control]
    return tuple(given)


def _declared(row: Written) -> Intervention:
    walks, gait = row.walks, GAITS[row.walks.gait]
    law = (
        f"position servos, at most {max(servo.limit for servo in gait.servos):g} N·m, whose targets the policy {walks.policy} sets every "
        f"{gait.tick:g} s: the home pose plus {', '.join(f'{scale:g}' for scale in sorted({*gait.scale}))} rad times its action, for "
        f"{walks.speed_m_s:g} m/s along {walks.heading_deg:g} degrees"
    )
    return Intervention(
        kind="control",
        bodies=tuple(servo for name in row.instances for servo in walks.servos(name)),
        law=law,
        trigger="always",
        source=f"assets: {row.name}, walks.policy {walks.policy}" + (f", {walks.address}" if walks.address else ""),
    )
