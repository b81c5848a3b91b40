"""What robots that walk, pick or fly declare by that: the actuators that come with their models, and the inputs to those."""

from typing import Any

from .declared_inputs import Intervention
from .drives import Actuator

Written = Any
"""A plan, or a part of it, whose module imports this one."""


def does(row: Written) -> Any:
    """What a robot's row says that it does: `Walks`, `Picks` or `Flies`; None of any other row."""
    return row.walks or row.picks or row.flies


def controlled(row: Written) -> tuple[str, ...]:
    """The actuators of all robots of a row."""
    return tuple(actuator for name in row.instances for actuator in does(row).driven(name))


def check(plan: Written) -> None:
    """Refuse what an arm is to pick or put it on, where that is no single thing, or one that no hand moves; and half a match.

    Raises:
        ValueError: the message names it.
    """
    rows = {row.name: row for row in (*plan.scene_objects, *plan.assets)}
    for row in (row for row in plan.assets if row.picks is not None):
        for key, name in (("thing", row.picks.thing), ("places_on", row.picks.places_on)):
            said, other = f"`picks.{key}` of `{row.name}` is `{name}`", rows.get(name)
            if name == row.name or (key == "places_on" and name == row.picks.thing):
                raise ValueError(f"{said} itself: name another object")
            if other is None:  # one of several, or unknown, which `plan_references` tells
                continue
            if other.instances != (name,):
                raise ValueError(f"{said}, of which there are several: name one, such as `{other.instances[0]}`")
            if getattr(other, "soft", None) is not None:
                raise ValueError(f"{said}, which is soft: an arm picks hard things and puts them on hard ones")
            if key == "thing" and other.fixed:
                raise ValueError(f"{said}, which is `fixed`: remove that, or name what is free to move")
    for ball, teams in matches(plan).items():
        said, other = f"`plays.ball` of `{teams[0].name}` is `{ball}`", rows.get(ball)
        if other is not None and (other.fixed or other.instances != (ball,)):
            raise ValueError(f"{said}, which is no single thing that is free to move")
        alike = {(row.walks.policy, row.walks.gait, row.walks.sha256, row.walks.speed_m_s) for row in teams}
        if len(teams) != 2 or len(alike) != 1 or teams[0].walks.plays.goal == teams[1].walks.plays.goal:
            raise ValueError(
                f"{said}: a match is two rows with one policy, gait and speed, and a goal each; here are {len(teams)} rows"
            )


def matches(plan: Written) -> dict[str, tuple[Written, ...]]:
    """The rows of the teams that play each ball."""
    found: dict[str, tuple[Written, ...]] = {}
    for row in plan.assets:
        if row.walks is not None and row.walks.plays is not None:
            found[row.walks.plays.ball] = (*found.get(row.walks.plays.ball, ()), row)
    return found


def actuators(plan: Written) -> tuple[Actuator, ...]:
    """The actuators of a plan with those of its robots, which come with their models."""
    given = list(plan.topology.actuators)
    taken = {row.name for row in given}
    for row in plan.assets:
        for name in row.instances if does(row) is not None else ():
            given += [
                Actuator(name=actuator, joint=joint, kind="imported")
                for actuator, joint in does(row).driven(name).items()
                if actuator not in taken
            ]
    return tuple(given)


def interventions(plan: Written) -> tuple[Intervention, ...]:
    """What a plan declares to act, with what acts on its robots."""
    given = list(plan.simulation_parameters.interventions)
    for row in plan.assets:
        if does(row) is not None:
            given += [acting for acting in _declared(row) if acting not in given]
    return tuple(given)


def _declared(row: Written) -> list[Intervention]:
    told = does(row)
    acting = [
        Intervention(kind="control", bodies=controlled(row), law=told.law, source=f"assets: {row.name}, {told.source}")
    ]
    if row.flies is not None and row.flies.gusts is not None:
        acting.append(
            Intervention(
                kind="force",
                bodies=row.instances,
                law=row.flies.gusts.law,
                source=f"assets: {row.name}, flies.gusts",
            )
        )
    return acting
