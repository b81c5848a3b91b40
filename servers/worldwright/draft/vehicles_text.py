"""Write vehicles: their numbers and drivers as constants of the program, where they stand, and what their drivers do."""

from math import cos, radians, sin

from ..model.plan.committed import AssetRow, Plan
from ..model.plan.imported import is_road, road_box
from ..model.plan.layout import Scene
from ..model.plan.vehicle_rows import Vehicle, drawn_by
from .python_text import Raw, call, comment, constant_name, exact, literal
from .requirements import Needs
from .stances import Stances


def made(plan: Plan, scene: Scene, needs: Needs) -> str:
    """Roads, the numbers of each vehicle, and its driver, as constants."""
    parts = [f"{_road(row)} = roads.read({literal(row.filename)})" for row in plan.assets if is_road(row)]
    for row in plan.assets:
        if row.vehicle is None:
            continue
        needs.use("vehicles")
        if row.vehicle.source:
            parts.append(comment(f"{row.name}: {row.vehicle.source}", 0))
        numbers: dict = {
            key: exact(value) if isinstance(value, float) else value for key, value in row.vehicle.numbers.items()
        }
        parts.append(call(f"{_numbers(row)} = vehicles.{row.vehicle.kind.capitalize()}", indent=0, **numbers))
        parts += [
            f"{_driver(name)} = {_drives(plan, scene, row, row.vehicle)}"
            for name in row.instances
            if row.vehicle.driven
        ]
    return "".join(f"{part}\n" for part in parts)


def written(objects: Stances, row: AssetRow) -> str:
    """Where each of the vehicles of a row stands: on the ground below the middle of its wheelbase."""
    assert row.vehicle is not None
    objects.needs.use("vehicles")
    vehicle, lines = row.vehicle.made(), []
    for name in row.instances:
        keywords = objects.common(name, objects.scene[name])
        keywords.pop("mass", None)
        x, y, z = keywords["pos"]
        turn = radians(float(keywords.get("yaw_deg", 0.0)))
        back = vehicle.middle_x_m
        ground = (x - back * cos(turn), y - back * sin(turn), z - vehicle.extents[2] / 2)
        keywords["pos"] = tuple(round(v, 6) + 0.0 for v in ground)
        if row.look:
            keywords["look"] = row.look
        keywords |= objects.joint(name)
        lines.append(call("vehicles.add", Raw("spec"), Raw(_numbers(row)), name=name, **keywords))
    return "\n".join(lines)


def road(objects: Stances, row: AssetRow) -> str:
    """A surveyed road as ground."""
    objects.needs.use("roads")
    keywords = {"name": row.name, **_origin(row, objects.scene, objects.plan)}
    if row.material:
        keywords["surface"] = Raw(constant_name(row.material))
    return call("roads.add", Raw("spec"), Raw(_road(row)), **keywords)


def _origin(row: AssetRow, scene: Scene, plan: Plan) -> dict:
    """Where the origin of a road's own frame lies, and its turn: the plan places the middle of the box around it."""
    low, high = road_box(row, plan.folder)
    placed = scene[row.name]
    turn = radians(float(placed.deg_z))
    x, y, z = ((a + b) / 2 for a, b in zip(low, high, strict=True))
    away = (x * cos(turn) - y * sin(turn), x * sin(turn) + y * cos(turn), z)
    pos = tuple(round(float(a) - b, 6) + 0.0 for a, b in zip(placed.position, away, strict=True))
    return {"pos": pos, **({"yaw_deg": float(placed.deg_z)} if placed.deg_z else {})}


def commanded(plan: Plan) -> dict[tuple[str, ...], str]:
    """The line of `control` that lets each driver drive, by the actuators of the vehicle."""
    found = {}
    for row in plan.assets:
        if row.vehicle is None or not row.vehicle.driven:
            continue
        for name in row.instances:
            asked, behind = f"{_driver(name)}.commands(data, {literal(name)})", _drawn(plan, name)
            given = f"{_numbers(row)}, model, data, {literal(name)}"
            found[row.vehicle.made().actuators(name)] = (
                f"    asked = {asked}\n    vehicles.pedals({given}, **vars(asked))"
                if behind
                else f"    vehicles.pedals({given}, **vars({asked}))"
            )
            for trailer, one in behind:
                assert trailer.vehicle is not None
                found[trailer.vehicle.made().actuators(one)] = (
                    f"    vehicles.pedals({_numbers(trailer)}, model, data, {literal(one)}, brake=asked.brake)"
                )
    return found


def _drawn(plan: Plan, name: str) -> list[tuple[AssetRow, str]]:
    """The trailers behind a vehicle, by row and name."""
    drawn = [(row, one) for row in plan.assets if row.vehicle for one in row.instances]
    return [(row, one) for row, one in drawn if (by := drawn_by(plan, one)) is not None and by[0] == name]


def _drives(plan: Plan, scene: Scene, row: AssetRow, vehicle: Vehicle) -> str:
    """The driver of one vehicle."""
    if (way := vehicle.follows) is None:
        steps = []
        for t, values in vehicle.commands():
            said: dict = {key: value for key, value in values.items() if value}
            steps.append(f"({literal(t)}, {_flat(call('vehicles.Commands', indent=0, **said))})")
        return call("vehicles.Timed", Raw(f"({', '.join(steps)},)"), indent=0)
    if way.road:
        of = next(one for one in plan.assets if one.name == way.road)
        lane: dict = {"left_m": way.left_m, **_origin(of, scene, plan)}
        lane["at"] = lane.pop("pos")
        line = _flat(call(f"{_road(of)}.lane", indent=0, **lane))
        course = f"vehicles.Course({line}, closed={_road(of)}.closed)"
    else:
        closed: dict = {"closed": True} if way.closed else {}
        course = _flat(call("vehicles.Course", way.path, indent=0, **closed))
    keywords = {"top_m_s": way.speed_m_s} | {
        key: value
        for key in ("across_m_s2", "faster_m_s2", "slower_m_s2")
        if (value := getattr(way, key)) != type(way).model_fields[key].default
    }
    return call("vehicles.Driver", Raw(_numbers(row)), Raw(course), indent=0, **keywords)


def _flat(text: str) -> str:
    return " ".join(text.split()).replace("( ", "(").replace(", )", ")")


def _road(row: AssetRow) -> str:
    return f"{constant_name(row.name)}_ROAD"


def _numbers(row: AssetRow) -> str:
    return f"{constant_name(row.name)}_VEHICLE"


def _driver(name: str) -> str:
    return f"{constant_name(name)}_DRIVER"
