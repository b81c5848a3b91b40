"""Write what walks robots: one policy for all robots of a row as a constant, and the line of `control` that commands them."""

from math import radians
from typing import Any

from ..model.plan.committed import Plan
from ..model.plan.scene_objects import AssetRow
from .python_text import Raw, call, comment, constant_name, literal
from .requirements import Needs


def made(plan: Plan, needs: Needs) -> str:
    """The walkers of each row, as constants."""
    parts = []
    for row in plan.assets:
        if (walks := row.walks) is None:
            continue
        needs.use("robots")
        said = ", ".join(part for part in (walks.address, walks.licence) if part)
        parts += [comment(f"{walks.policy}: {said}", 0)] if said else []
        known = {"sha256": walks.sha256} if walks.sha256 else {}
        parts.append(
            call(f"{_walkers(row)} = robots.walkers", row.instances, walks.gait, walks.policy, indent=0, **known)
        )
    return "\n".join(parts) + "\n" if parts else ""


def commanded(plan: Plan) -> dict[tuple[str, ...], str]:
    """The lines of `control` that tell the robots of each row where to go, by their servos."""
    found = {}
    for row in plan.assets:
        if (walks := row.walks) is None:
            continue
        servos = tuple(servo for name in row.instances for servo in walks.servos(name))
        speed = literal(walks.speed_m_s)
        if walks.until_s is not None:
            speed += f" if data.time < {literal(walks.until_s)} else 0.0"
        line: dict[str, Any] = {"speed": Raw(speed)}
        line |= {"y": walks.y_m} if walks.y_m is not None else {}
        line |= {"heading": round(radians(walks.heading_deg), 9)} if walks.heading_deg else {}
        along = call("robots.along", Raw("data"), Raw("name"), indent=0, **line)
        found[servos] = (
            f"    told = [{along} for name in {_walkers(row)}.names]\n    {_walkers(row)}(model, data, told)"
        )
    return found


def _walkers(row: AssetRow) -> str:
    return f"{constant_name(row.name)}_WALKERS"
