"""Write plants: their numbers as a constant of the program, and where their roots are held."""

from math import cos, radians, sin

from ..model.plan.committed import AssetRow
from .python_text import Raw, call, comment, constant_name, exact
from .stances import Stances


def written(objects: Stances, row: AssetRow) -> str:
    """Each plant of a row; the plan places the middle of the box around it."""
    assert row.plant is not None
    objects.needs.use("plants")
    plant = row.plant.made()
    numbers: dict = {
        key: exact(value) if isinstance(value, float) else value for key, value in row.plant.numbers.items()
    }
    made = " ".join(call(f"plants.{row.plant.kind.capitalize()}", indent=0, **numbers).split())
    lines = [comment(f"{row.name}: {row.plant.source}")] if row.plant.source else []
    name_of = f"{constant_name(row.name).lower()}_grown"
    lines.append(f"    {name_of} = {made.replace('( ', '(').replace(', )', ')')}")
    for name in row.instances:
        keywords = objects.common(name, objects.scene[name])
        keywords.pop("mass", None)
        x, y, z = keywords["pos"]
        turn = radians(float(keywords.get("yaw_deg", 0.0)))
        a, b, up = plant.middle
        root = (x - a * cos(turn) + b * sin(turn), y - a * sin(turn) - b * cos(turn), z - up)
        keywords["pos"] = tuple(round(v, 6) + 0.0 for v in root)
        if row.look:
            keywords["look"] = row.look
        if row.material:
            keywords["surface"] = Raw(constant_name(row.material))
        joint = objects.joint(name)
        keywords |= {"parent": joint["parent"]} if "parent" in joint else {}
        lines.append(call("plants.add", Raw("spec"), Raw(name_of), name=name, **keywords))
    return "\n".join(lines)
