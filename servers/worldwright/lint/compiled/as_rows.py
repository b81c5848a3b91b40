"""A compiled world's things as rows of a plan: what the program built and the plan does not name.

A row says exactly what was built, in the plan's terms: a primitive or a compound of its geoms, its centre, mass, surface and joint.
What the plan has no terms for is named with the reason, and no row stands for it.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import sqrt
from typing import Any

import numpy as np

from worldkit.contacts import STEP_SHARE, restitution_of
from worldkit.turning import matrices

from ...model.plan.committed import Plan
from ...model.plan.imported import inner
from .view import ModelView

NAME = re.compile(r"[A-Za-z0-9_-]+")
SOURCE = "built: simulation.py"
"""What stands for the source of a surface that the program chose."""
SHAPES = ("sphere", "capsule", "ellipsoid", "cylinder", "box")
NEAR_M, NEAR = 1e-6, 1e-9
MIDDLE_M = 1e-4
"""How far the middle of a body's box may be from its origin: the plan places middles."""
TIME_CONSTANT_S, DAMPED = 0.02, 1.0
"""MuJoCo's own contact, which a plan has without saying so."""


@dataclass
class Rows:
    """Rows that complete a plan, section by section, and what no row can say."""

    objects: list[dict[str, Any]] = field(default_factory=list)
    joints: list[dict[str, Any]] = field(default_factory=list)
    places: list[dict[str, Any]] = field(default_factory=list)
    """Of `geometry_relations`: the new objects, and those of the plan that it places nowhere."""
    masses: dict[str, float] = field(default_factory=dict)
    materials: dict[str, dict[str, Any]] = field(default_factory=dict)
    left: list[str] = field(default_factory=list)


class CannotSayError(Exception):
    """The plan has no terms for a thing; the text says why."""


def rows(view: ModelView, plan: Plan) -> Rows:
    """What the world has and the plan does not name.

    Args:
        view: the program's compiled world; `view.planned`, where it is there, tells what belongs to model files.
        plan: the plan as it stands.
    """
    from ...place.tools import laid_out

    made = Rows()
    names, known = view.texts["names"]["body"], {*plan.object_names(), *view.planned_bodies}
    known |= {name for name in names if name.startswith(inner(plan))}  # of a model or sculpture, with names of its own
    flexed = {int(body) for body in view.flex_vertbodyid}
    for body in range(1, len(names)):
        if body in flexed or names[body] in known or not _own(view, body):
            continue
        try:
            _object(view, plan, body, made)
        except CannotSayError as why:
            made.left.append(f"{view.name('body', body)}: {why}")
    for joint, kind in enumerate(view.joint_kind):
        body = int(view.jnt_bodyid[joint])
        if kind != "free" and body not in flexed and view.texts["names"]["joint"][joint] not in _joints(view, plan):
            try:
                made.joints.append(_joint(view, joint, known | {row["name"] for row in made.objects}))
            except CannotSayError as why:
                made.left.append(f"{view.name('joint', joint)}: {why}")
    topology = plan.topology
    spoken = {row.subject for row in topology.scene_predicates} | {row.body_a for row in plan.geometry_relations}
    placed = (
        spoken | set(topology.body_positions) | {one.name for one in laid_out(plan).objects}
    )  # by copies of a group, too
    for name in plan.object_names():
        if name in names and name not in placed:
            try:
                body = names.index(name)
                made.places.append(_place(view, body, view.bare_low[body], view.bare_high[body]))
            except CannotSayError as why:
                made.left.append(f"{name}: {why}")
    made.left += _others(view, plan)
    return made


def _joints(view: ModelView, plan: Plan) -> set[str]:
    drafted = set() if view.planned is None else set(view.planned.texts["names"]["joint"])
    return {joint.name for joint in plan.topology.joints} | drafted


def _own(view: ModelView, body: int) -> bool:
    """Whether a body is a thing by itself (on the world, or on a joint) that acts: it can be touched, or moves."""
    apart = int(view.body_parentid[body]) == 0 or int(view.body_jntnum[body]) > 0
    touchable = bool((view.collides & (view.geom_bodyid == body)).any())
    return apart and (touchable or bool(view.moving[body]))


def _object(view: ModelView, plan: Plan, body: int, made: Rows) -> None:
    """The row of one body, its place, mass, surface, and the weld that holds it to a body of the plan."""
    name = view.texts["names"]["body"][body]
    if not NAME.fullmatch(name):
        raise CannotSayError("give it a name of letters, digits, _ and -")
    geoms = np.flatnonzero(view.geom_bodyid == body)
    acting = [int(geom) for geom in geoms if view.collides[geom]]
    if not acting:
        raise CannotSayError(
            "it moves and has nothing that can be touched: give it a shape, or weld it to what carries it"
        )
    carried = np.flatnonzero((view.body_parentid == body) & (view.body_jntnum == 0) & (view.body_parentid > 0))
    if len(carried):
        raise CannotSayError("bodies without joint hang on it: put their geoms into it")
    place = _place(view, body, view.touch_low[body], view.touch_high[body])
    shape = _shape(view, name, acting)
    material = _material(view, plan, acting, made)
    row = {"name": name, "role": "as the program builds it", **shape, "material": material}
    row |= {} if view.moving[body] else {"fixed": True}
    made.objects.append({**row, "built": True})
    made.places.append(place)
    if view.moving[body]:
        made.masses[name] = _tidy(view.body_mass[body])


def _place(view: ModelView, body: int, low: np.ndarray, high: np.ndarray) -> dict[str, Any]:
    """The middle of a body's box and its yaw, as a row of `geometry_relations`."""
    name, turn = view.texts["names"]["body"][body], view.home_xmat[body]
    if abs(turn[2, 2] - 1) > NEAR_M:
        raise CannotSayError("its frame is tilted: turn its geoms instead, a plan knows yaw alone")
    if not np.isfinite([low, high]).all():
        raise CannotSayError("it has no shape of its own")
    middle = (low + high) / 2
    if np.linalg.norm(middle) > MIDDLE_M:
        told = ", ".join(f"{float(v):.4g}" for v in middle)
        raise CannotSayError(
            f"its origin is not the middle of its box, which lies at ({told}) m in its frame: centre it"
        )
    parameters: dict[str, Any] = {"position": _row(view.home_xpos[body])}
    yaw = float(np.degrees(np.arctan2(turn[1, 0], turn[0, 0])))
    parameters |= {"deg_z": _tidy(yaw)} if abs(yaw) > NEAR_M else {}
    return {"relation_name": "base", "body_a": name, "parameters": parameters, "built": True}


def _shape(view: ModelView, name: str, geoms: list[int]) -> dict[str, Any]:
    """A primitive, upright or tilted about its own x; else a compound of all that can be touched."""
    parts = [_part(view, geom) for geom in geoms]
    if len(parts) == 1:
        (only,) = parts
        if not {"offset", "deg_y", "deg_z"} & set(only) and abs(only.get("deg_x", 0.0)) <= 180:
            return {"primitive": only["primitive"], "size": only["size"]} | {
                k: only[k] for k in ("deg_x",) if k in only
            }
    given = view.texts["names"]["geom"]
    for number, (part, geom) in enumerate(zip(parts, geoms, strict=True), 1):
        own = given[geom].removeprefix(f"{name}/").removeprefix(f"{name}_")
        part["name"] = own if NAME.fullmatch(own) and own != name else f"part_{number}"
    return {"primitive": "compound", "parts": [{"name": part.pop("name"), **part} for part in parts]}


def _part(view: ModelView, geom: int) -> dict[str, Any]:
    """One geom: what it is, its full extents, where it is in its body and how it is turned there."""
    kind, size = view.geom_kind[geom], view.geom_size[geom]
    if kind not in SHAPES:
        raise CannotSayError(
            f"a {kind} that can be touched is no primitive of a plan: bring it in as an asset or model file"
        )
    d = 2 * float(size[0])
    extents = {
        "sphere": (d, d, d),
        "capsule": (d, d, 2 * float(size[1]) + d),
        "cylinder": (d, d, 2 * float(size[1])),
    }.get(kind, tuple(2 * float(v) for v in size))
    found: dict[str, Any] = {"primitive": kind, "size": [_tidy(v) for v in extents]}
    if np.linalg.norm(view.geom_pos[geom]) > MIDDLE_M:
        found["offset"] = _row(view.geom_pos[geom])
    turn = matrices(view.geom_quat[geom]) if kind != "sphere" else np.eye(3)
    for key, angle in zip(("deg_x", "deg_y", "deg_z"), _angles(turn), strict=True):
        if abs(angle) > 1e-4:
            found[key] = _tidy(angle)
    return found


def _angles(turn: np.ndarray) -> tuple[float, float, float]:
    """Degrees about x, then y, then z (fixed axes) that make a rotation: turn = Rz Ry Rx."""
    level = float(np.hypot(turn[0, 0], turn[1, 0]))
    y = float(np.degrees(np.arctan2(-turn[2, 0], level)))
    if level < NEAR_M:  # looking straight up or down: x and z turn about one axis
        return float(np.degrees(np.arctan2(-turn[1, 2], turn[1, 1]))), y, 0.0
    x, z = np.arctan2(turn[2, 1], turn[2, 2]), np.arctan2(turn[1, 0], turn[0, 0])
    return float(np.degrees(x)), y, float(np.degrees(z))


def _material(view: ModelView, plan: Plan, geoms: list[int], made: Rows) -> str:
    """The name of a surface, of the plan or new; one for all geoms of a body."""
    surfaces = {
        (tuple(_row(view.geom_friction[g])), int(view.geom_condim[g]), tuple(_row(view.geom_solref[g]))) for g in geoms
    }
    if len(surfaces) > 1:
        raise CannotSayError("its geoms have several surfaces: give it one")
    ((slide, spin, roll), condim, solref) = surfaces.pop()
    wanted: dict[str, Any] = {"friction": slide if condim >= 3 else 0.0}
    if condim >= 4:
        wanted |= {"torsional_friction": spin, "rolling_friction": roll if condim >= 6 else 0.0}
    if (rebound := _rebound(*solref)) is not None:
        wanted["restitution"] = rebound
    for name, own in plan.simulation_parameters.materials.items():
        held = {key: getattr(own, key) for key in (*wanted, "restitution")}
        if condim < 4 and {"torsional_friction", "rolling_friction"} & own.model_fields_set:
            continue  # it says what does not act here
        if all(np.isclose(float(held[k] or 0), float(wanted.get(k) or 0), rtol=1e-3, atol=NEAR) for k in held):
            return name
    for name, there in made.materials.items():
        if {key: there.get(key) for key in ("friction", "torsional_friction", "rolling_friction", "restitution")} == {
            key: wanted.get(key) for key in ("friction", "torsional_friction", "rolling_friction", "restitution")
        }:
            return name
    name = f"built_{len(made.materials) + 1}"
    made.materials[name] = {**wanted, "source": SOURCE}
    return name


def _rebound(first: float, second: float) -> float | None:
    """Restitution of a contact in the engine's numbers; None for one that is nearly dead, as MuJoCo's own."""
    if first > 0:
        return None if second >= DAMPED - NEAR else _tidy(restitution_of(second))
    ratio = -second / (2 * sqrt(max(-first, NEAR)))
    found = restitution_of(ratio * (1 + STEP_SHARE * ratio))  # as `spring_and_damper` corrects it for the time step
    return None if found <= restitution_of(DAMPED) + 1e-3 else round(found, 3)


def _joint(view: ModelView, joint: int, known: set[str]) -> dict[str, Any]:
    """The row of a joint, its anchor and axis in the world where it was built."""
    body = int(view.jnt_bodyid[joint])
    names = view.texts["names"]
    child, name, kind = names["body"][body], names["joint"][joint], view.joint_kind[joint]
    parent = int(view.body_parentid[body])
    if not name or not NAME.fullmatch(name):
        raise CannotSayError("give it a name of letters, digits, _ and -")
    if child not in known or (parent and names["body"][parent] not in known):
        raise CannotSayError("what it joins is not in the plan")
    if int(view.body_jntnum[body]) > 1:
        raise CannotSayError(f"{child} hangs on several joints: a plan has one for each body")
    turn, first = view.home_xmat[body], int(view.jnt_dofadr[joint])
    row: dict[str, Any] = {"name": name, "type": kind}
    row |= {"parent": names["body"][parent]} if parent else {}
    row |= {"child": child, "anchor": _row(view.home_xpos[body] + turn @ view.jnt_pos[joint])}
    unit = 180 / np.pi if kind == "hinge" else 1.0
    if kind != "ball":
        row["axis"] = _row(turn @ view.jnt_axis[joint])
        if view.jnt_limited[joint]:
            row["range"] = _row(view.jnt_range[joint] * unit)
        numbers = {
            "stiffness": np.ravel(view.jnt_stiffness[joint])[0],
            "frictionloss": view.dof_frictionloss[first],
            "spring_rest": view.qpos_spring[int(view.jnt_qposadr[joint])] * unit if view.jnt_stiffness[joint] else 0.0,
        }
        row |= {key: _tidy(value) for key, value in numbers.items() if abs(value) > NEAR}
    damping = float(np.ravel(view.dof_damping[first])[0])
    return row | ({"damping": _tidy(damping)} if damping else {}) | {"built": True}


def _others(view: ModelView, plan: Plan) -> Iterator[str]:
    """What acts and has no rows of this kind: ropes, motors, ties, flexes, and geoms of the world itself."""
    topology = plan.topology
    known = {row.name for rows in (topology.tendons, topology.actuators, topology.joints) for row in rows}
    for kind, move in (
        ("tendon", "write it into topology.tendons"),
        ("actuator", "write it into topology.actuators, and declare its control"),
        ("equality", "write it as a loop of topology.joints, or declare an intervention of kind constraint"),
        ("flex", "write it into scene_objects under its name (skill flex-cloth-soft-rods)"),
    ):
        there = known | {*plan.object_names()} | ({*view.planned.texts["names"][kind]} if view.planned else set())
        acted = {name for item in plan.simulation_parameters.interventions for name in item.bodies}
        for index, name in enumerate(view.texts["names"].get(kind, ())):
            if not name or name not in there | acted:
                yield f"{view.name(kind, index)}: {move}"
    drafted = set(view.planned.texts["names"]["geom"]) if view.planned else {"ground"}
    for geom in np.flatnonzero(view.collides & (view.geom_bodyid == 0)):
        if view.texts["names"]["geom"][geom] not in drafted and view.geom_kind[geom] != "plane":
            yield f"{view.name('geom', int(geom))}: give it a body of its own, so that it has a name and a place"


def _tidy(value: Any) -> float:
    """A number of the engine without the last digits that only its arithmetic made."""
    return float(f"{float(value):.9g}") + 0.0


def _row(values: np.ndarray) -> list[float]:
    return [0.0 if abs(float(value)) < NEAR else _tidy(value) for value in np.ravel(values)]
