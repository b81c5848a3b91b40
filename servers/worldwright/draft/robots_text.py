"""Write what drives robots: policies, arms and drones as constants, and the lines of `control` that tell them what to do."""

from math import radians
from typing import Any

from worldkit.robots.gaits import GAITS

from ..model.plan.committed import Plan
from ..model.plan.robots_declared import controlled, does, matches
from ..model.plan.scene_objects import AssetRow
from .python_text import Raw, call, comment, constant_name, literal
from .requirements import Needs


def made(plan: Plan, needs: Needs) -> str:
    """What drives the robots of each row, as constants."""
    parts = []
    for row in plan.assets:
        if does(row) is None:
            continue
        needs.use("robots")
        given: tuple[Any, ...] = ()
        known: dict[str, Any] = {}
        make = ""
        if (walks := row.walks) is not None:
            said = ", ".join(part for part in (walks.address, walks.licence) if part)
            parts += [comment(f"{walks.policy}: {said}", 0)] if said else []
            known = {"sha256": walks.sha256} if walks.sha256 else {}
            make, given = "walkers", (row.instances, walks.gait, walks.policy)
            if walks.plays is not None:
                teams = matches(plan)[walks.plays.ball]
                if row is not teams[0]:
                    continue  # both teams are one match, and are asked together
                goals = {name: team.walks.plays.goal for team in teams for name in team.instances}
                known |= {"ball": walks.plays.ball, "speed": walks.speed_m_s}
                make, given = "match", (goals, walks.gait, walks.policy)
        elif (picks := row.picks) is not None:
            make, given = "picker", (row.name, picks.arm, picks.thing, picks.places_on)
            known = _changed(picks, board="board", from_s="from_s", speed_m_s="speed")
        elif (flies := row.flies) is not None:
            make, given = "flier", (row.name, flies.drone, flies.through)
            known = _changed(flies, speed_m_s="speed", hover_s="hover_s")
            if (gusts := flies.gusts) is not None:
                parts.append(comment(f"{row.name}, gusts: {gusts.source}", 0))
                known["gusts"] = Raw(call("robots.Gusts", gusts.mean_m_s, gusts.strength_m_s, indent=0))
        parts.append(call(f"{_constant(row)} = robots.{make}", *given, indent=0, **known))
    return "\n".join(parts) + "\n" if parts else ""


def commanded(plan: Plan) -> dict[tuple[str, ...], str]:
    """The lines of `control` that tell the robots of each row what to do, by what is declared to act on them."""
    found = {}
    for row in plan.assets:
        if does(row) is None:
            continue
        found[controlled(row)] = f"    {_constant(row)}(model, data)"
        if (walks := row.walks) is None:
            continue
        if walks.plays is not None:
            once = row is matches(plan)[walks.plays.ball][0]
            found[controlled(row)] = f"    {_constant(row)}(model, data)" if once else ""
            continue
        speed = literal(walks.speed_m_s)
        if walks.until_s is not None:
            speed += f" if data.time < {literal(walks.until_s)} else 0.0"
        line: dict[str, Any] = {"speed": Raw(speed)}
        line |= {"y": walks.y_m} if walks.y_m is not None else {}
        line |= {"heading": round(radians(walks.heading_deg), 9)} if walks.heading_deg else {}
        along = call("robots.along", Raw("data"), Raw("name"), indent=0, **line)
        found[controlled(row)] = (
            f"    told = [{along} for name in {_constant(row)}.names]\n    {_constant(row)}(model, data, told)"
        )
    return found


def asked_every(plan: Plan) -> int:
    """Steps from one question to `control` to the next: a match's tick, where nothing else acts that would have to be asked."""
    acting = [row for row in plan.assets if row.vehicle is not None or does(row) is not None]
    playing = [row.walks for row in acting if row.walks is not None and row.walks.plays is not None]
    parameters = plan.simulation_parameters
    if not playing or len(playing) != len(acting) or len(parameters.interventions) != len(acting) or plan.broken:
        return 1
    steps = GAITS[playing[0].gait].tick / float(parameters.time_step)
    return round(steps) if abs(steps - round(steps)) < 1e-9 else 1


def blown(plan: Plan) -> frozenset[str]:
    """The laws of the gusts that drones make act themselves."""
    return frozenset(
        row.flies.gusts.law for row in plan.assets if row.flies is not None and row.flies.gusts is not None
    )


def _changed(told: Any, **names: str) -> dict[str, Any]:
    """What a row says otherwise than by default, by the names that the program has for it."""
    fields = type(told).model_fields
    return {own: value for key, own in names.items() if (value := getattr(told, key)) != fields[key].default}


def _constant(row: AssetRow) -> str:
    if row.walks is not None and row.walks.plays is not None:
        return f"{constant_name(row.walks.plays.ball)}_MATCH"
    made = "WALKERS" if row.walks is not None else "PICKER" if row.picks is not None else "FLIER"
    return f"{constant_name(row.name)}_{made}"
