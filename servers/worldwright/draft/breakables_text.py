"""Write the objects that break: all pieces of one by one call of `worldkit.breaking`, and the rule that lets their bonds go."""

from ..model.plan.breakage import pieces
from ..model.plan.committed import Plan, SceneObject
from ..model.plan.layout import Scene
from .python_text import Raw, call, comment, constant_name, exact
from .requirements import Needs


def written(plan: Plan, scene: Scene, needs: Needs, row: SceneObject) -> str:
    """The text of an object that breaks, as it is written in the plan."""
    needs.use("breaking")
    assert row.breaks is not None
    first, placed = pieces(row)[0], scene[row.instances[0]]
    middle = tuple(round(float(a) - b, 5) + 0.0 for a, b in zip(placed.position, first.offset, strict=True))
    maker, values, keywords = row.breaks.call(row)
    made = " ".join(call(f"breaking.{maker}", *(Raw(repr(v)) for v in values), indent=0, **keywords).split())
    parameters = plan.simulation_parameters
    material = parameters.materials.get(row.material or "")
    stuff = {
        "strength_pa": Raw(constant_name(row.breaks.strength)),
        "density": exact(material.density if material is not None and material.density else 1000.0),
        "look": row.look or "plastic_white",
        "friction": exact(material.friction if material is not None else 0.5),
        "source": parameters.constants[row.breaks.strength].source
        if row.breaks.strength in parameters.constants
        else "",
    }
    given: dict = {"pos": middle}
    if row.deg_x:
        given["tilt_deg"] = row.deg_x
    whole = [name for name in row.instances if name in parameters.masses]
    if len(whole) == len(row.instances):
        given["mass"] = round(sum(parameters.masses[name] for name in whole), 12)
    if row.material:
        given["surface"] = Raw(constant_name(row.material))
    if row.breaks.inside:
        given["inside"] = row.breaks.inside
    if row.breaks.held:
        given["held"] = dict(row.breaks.held)
    brittle = " ".join(call("breaking.Brittle", indent=0, **stuff).split())
    note = row.description or row.role
    lines = [comment(note)] if note else []
    lines.append(call("breaking.add", Raw("spec"), row.name, _tight(made), _tight(brittle), **given))
    return "\n".join(lines)


def _tight(text: str) -> Raw:
    return Raw(text.replace("( ", "(").replace(", )", ")"))
