"""Write what a world imports: catalog meshes, models (URDF, MJCF) whose text becomes part of the program, and what files sculpt."""

from ..model.errors import PlanError
from ..model.plan.committed import AssetRow
from ..model.plan.imported import is_model, is_road, is_sculpt, load, sculpture
from . import plants_text, vehicles_text
from .python_text import Raw, call, constant_name, literal
from .stances import Stances


def written(objects: Stances, row: AssetRow) -> str:
    """Write an asset row; several instances without joints become a table of poses and one loop."""
    if is_road(row):
        return vehicles_text.road(objects, row)
    if row.vehicle is not None:
        return vehicles_text.written(objects, row)
    if row.plant is not None:
        return plants_text.written(objects, row)
    own_of = _models(objects, row) if is_model(row) else {}
    keywords = {} if is_model(row) else _sculpt(objects, row) if is_sculpt(row) else _mesh(objects, row)
    function, what = (
        ("models.attach", Raw(_constant(row)))
        if is_model(row)
        else ("sculpt.from_file", row.sculpted[0])
        if is_sculpt(row)
        else ("assets.add", row.filename)
    )
    if row.material:
        keywords["surface"] = Raw(constant_name(row.material))
    if row.look:
        keywords["look"] = row.look
    if row.fixed or not row.is_dynamic:
        keywords["fixed"] = True
    alike = all(own == own_of[row.instances[0]] for own in own_of.values())
    if row.count == 1 or not alike or any(name in objects.joint_of for name in row.instances):
        lines = []
        for name in row.instances:
            own = objects.common(name, objects.scene[name])
            mass = objects.parameters.masses.get(name, objects.parameters.masses.get(row.name))
            if mass is not None and not is_model(row):
                own["mass"] = mass
            if is_model(row):
                own.pop("mass", None)
            own |= keywords | own_of.get(name, {}) | objects.joint(name)
            lines.append(call(function, Raw("spec"), what, name=name, **own))
        return "\n".join(lines)
    return _table(objects, row, function, what, keywords | own_of.get(row.instances[0], {}))


def _table(objects: Stances, row: AssetRow, function: str, what: str, keywords: dict) -> str:
    """Write poses by name, and a loop over them."""
    table = constant_name(row.name).lower() + "_poses"
    lines = [f"    {table} = {{  # name: (centre, yaw in degrees)"]
    for name in row.instances:
        placed = objects.scene[name]
        pose = f"({literal(tuple(map(float, placed.position)))}, {float(placed.deg_z)})"
        lines.append(f"        {literal(name)}: {pose},")
    lines += ["    }", f"    for name, (pos, yaw_deg) in {table}.items():"]
    masses = {objects.parameters.masses.get(n, objects.parameters.masses.get(row.name)) for n in row.instances}
    if len(masses) == 1 and (mass := masses.pop()) is not None and not is_model(row):
        keywords["mass"] = mass
    pose_of = {"name": Raw("name"), "pos": Raw("pos"), "yaw_deg": Raw("yaw_deg")}
    lines.append(call(function, Raw("spec"), what, indent=8, **pose_of, **keywords))
    return "\n".join(lines)


def _mesh(objects: Stances, row: AssetRow) -> dict:
    """Keywords of a catalog mesh, scaled to its height."""
    objects.needs.use("assets")
    return {"height": objects.plan.asset_dimensions[row.name]}


def _sculpt(objects: Stances, row: AssetRow) -> dict:
    """Keywords of what a file beside the plan sculpts.

    Raises:
        PlanError: the file is not there.
    """
    objects.needs.use("sculpt")
    sculpture(row, objects.plan.folder)
    of = row.sculpted[1]
    return {"of": of} if of else {}


def _models(objects: Stances, row: AssetRow) -> dict[str, dict]:
    """Keywords of a model file, whose text becomes a constant and whose joints the initial motion may name.

    Returns:
        keywords of each instance: the catalog's folder, and the actuators that the plan asks for if those are not all.

    Raises:
        PlanError: it does not load, or something else in the plan has a name from inside it.
    """
    objects.needs.use("models")
    plan = objects.plan
    taken = {*plan.object_names(), *(j.name for j in plan.topology.joints)}
    taken |= {a.name for a in plan.topology.actuators if a.kind != "imported"}
    asked = {a.name for a in plan.topology.actuators if a.kind == "imported"}
    keywords: dict[str, dict] = {}
    for name in row.instances:
        model = load(row, plan.folder, name)
        if twice := sorted((model.names() - {name}) & taken):
            raise PlanError(
                f"asset `{row.name}`: `{twice[0]}` is in {row.filename} and in the plan",
                next_move="rename it in one of the two",
            )
        objects.needs.joint_kinds |= model.joints
        keywords[name] = {} if model.folder is None else {"folder": model.folder}
        if model.files:
            objects.needs.texts[_constant(row, "FILES")] = model.files
            keywords[name]["files"] = Raw(_constant(row, "FILES"))
        if not asked.issuperset(model.actuators):
            keywords[name]["actuators"] = tuple(a.removeprefix(f"{name}_") for a in model.actuators if a in asked)
    objects.needs.texts[_constant(row)] = model.text
    return keywords


def _constant(row: AssetRow, what: str = "MODEL") -> str:
    return f"{constant_name(row.name)}_{what}"
