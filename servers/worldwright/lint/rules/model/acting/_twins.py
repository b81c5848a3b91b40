"""What the rules share that compare a world with its plan's own: cases, and which thing is which in the two worlds."""

from collections.abc import Callable, Iterator

import numpy as np

from worldkit.contacts import restitution_of

from .....model.plan.committed import Plan
from ....compiled.view import ModelView
from ....problem import Problem

PLAN: dict[str, object] = {
    "simulation_parameters": {
        "materials": {
            "wood": {"friction": 0.3, "restitution": 0.2, "source": "a table"},
            "ground": {"friction": 0.3, "restitution": 0.2, "source": "a table"},
        },
        "masses": {"mug": None, "crate": 12, "arm": 2},
        "initial_motion": {"crate": {"linear": [0.5, 0, 0]}},
    },
    "implementation_steps": None,
    "assets": None,
    "asset_dimensions": None,
    "scene_objects": [
        {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2], "material": "wood"},
        {"name": "arm", "primitive": "box", "size": [0.6, 0.1, 0.1], "material": "wood"},
    ],
    "topology": {
        "joints": [{"name": "pivot", "type": "hinge", "child": "arm", "range": [-60, 60], "damping": 0.5}],
        "actuators": [{"name": "push", "joint": "pivot", "control": 5.0}],
        "tendons": [{"name": "rope", "ends": [{"body": "crate"}, {"body": "arm"}], "slack": 0.5}],
        "scene_predicates": None,
        "body_positions": {"crate": {"x": 0, "y": 0, "z": 0.1}, "arm": {"x": 1.5, "y": 0, "z": 0.5}},
    },
}
"""A crate on the ground, tied by a slack rope to an arm on a hinge with a motor, as a change to the sound plan."""
HAND_MADE = """\
import mujoco
from worldkit import bodies, contacts, joints, motion, scene, tendons
SURFACE = contacts.surface(friction=0.3, restitution=0.2, time_constant=0.004)
def build():
    spec = scene.new("a", time_step=0.002, floor_surface=SURFACE)
    bodies.box(spec, "crate", size=(0.4, 0.3, 0.2), pos=(0, 0, 0.1), mass=12, surface=SURFACE)
    bodies.box(spec, "arm", size=(0.6, 0.1, 0.1), pos=(1.5, 0, 0.5), mass=2, surface=SURFACE,
               joint=joints.Hinge("pivot", range_deg=(-60, 60), damping=0.5))
    spec.body("crate").add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.03, 0, 0), contype=0, conaffinity=0, mass=0)
    spec.add_actuator(name="push", target="pivot", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    tendons.rope(spec, "rope", (("crate", (0, 0, 0.1)), ("arm", (1.5, 0, 0.5))), slack=0.5)
    motion.launch(spec, {"crate": motion.Launch(linear=(0.5, 0, 0))})
    CHANGES
    return spec
"""
ENGINE_S, ENGINE_SOLIMP = 0.02, np.array([0.9, 0.95])
"""MuJoCo's own time constant of a constraint, s, and its smallest and largest impedance."""
REBOUND = 0.05
GROUND = "ground"
"""The owner of the world's own geoms."""
Check = Callable[[ModelView], Iterator[Problem]]


def changed(*lines: str) -> tuple[str, dict[str, object]]:
    """A case: the hand-made world with these statements before its `return`, and the plan it was made for."""
    return HAND_MADE.replace("    CHANGES\n", "".join(f"    {line}\n" for line in lines)), PLAN


def sheet(*also: str) -> tuple[str, dict[str, object]]:
    """A case with a sheet of foam that by the plan is a thing like another, and that is built as a flex; `also`: of the flex `f`."""
    made = "f = spec.worldbody.make_flex('sheet', type='grid', dim=3, count=(2, 2, 2), spacing=(.1, .1, .1), mass=9, pos=(0, 3, 1))"
    text, plan = changed(made, "f.radius, f.friction[0] = 0.02, 0.3", *also)
    topology: dict = plan["topology"]  # type: ignore[assignment]
    places = topology["body_positions"] | {"sheet": {"x": 0, "y": 3, "z": 1}}
    row = {"name": "sheet", "primitive": "box", "size": [0.1, 0.1, 0.1], "material": "wood"}
    more = {"scene_objects": [*plan["scene_objects"], row], "topology": topology | {"body_positions": places}}  # type: ignore[misc]
    return text, plan | more


SOUND = (changed(),)
"""The hand-made world itself, which acts as its plan says although it is written otherwise."""


def names(view: ModelView, kind: str) -> list[str]:
    """Names of a kind of thing, by index; a free joint is called after its body."""
    found: list[str] = list(view.texts["names"][kind])
    if kind == "joint":
        for joint, body in enumerate(view.jnt_bodyid.tolist()):
            if view.joint_kind[joint] == "free":
                found[joint] = view.texts["names"]["body"][body]
    return found


def twins(view: ModelView, kind: str) -> list[tuple[int, int]]:
    """(index here, index in the plan's world) of each thing of one kind that both worlds have."""
    assert view.planned is not None
    other = {name: index for index, name in enumerate(names(view.planned, kind)) if name}
    return [(index, other[name]) for index, name in enumerate(names(view, kind)) if name in other]


def unplanned(view: ModelView, kind: str, *excused: str) -> Iterator[int]:
    """Things that the plan's world lacks and that no intervention of one of the `excused` kinds names."""
    assert view.planned is not None and view.plan is not None
    known = {name for name in names(view.planned, kind) if name} | acted_on(view.plan, *excused)
    for index, name in enumerate(names(view, kind)):
        if name not in known:
            yield index


def missing(view: ModelView, kind: str) -> Iterator[str]:
    """Names of the plan's things that the world does not have."""
    assert view.planned is not None
    there = set(names(view, kind))
    yield from (name for name in names(view.planned, kind) if name and name not in there)


def acted_on(plan: Plan, *kinds: str) -> set[str]:
    """The names in the plan's interventions of these kinds: one that declares a motor's control excuses no hidden weld."""
    return {name for item in plan.simulation_parameters.interventions if item.kind in kinds for name in item.bodies}


def flexed(view: ModelView) -> dict[str, list[int]]:
    """The flexes of each thing of the plan that is built of nothing else that can be touched: those that bear its name, or one
    that begins with it."""
    found: dict[str, list[int]] = {}
    things = view.things - {holder(view, int(body)) for body in view.geom_bodyid[view.collides]}
    for flex, name in enumerate(view.texts["names"]["flex"]):
        of = [it for it in things if name == it or name.startswith((f"{it}_", f"{it}/"))]
        if of:
            found.setdefault(max(of, key=len), []).append(flex)
    return found


def rebounds_otherwise(ratio: float, planned: float) -> bool:
    """Whether two damping ratios give rebounds that differ by more than 0.05 in speed, or in energy, of those before."""
    here, there = restitution_of(ratio), restitution_of(planned)
    return max(abs(here - there), abs(here**2 - there**2)) > REBOUND


def sprung(row: np.ndarray) -> tuple[float, float]:
    """Time constant, s, and damping ratio of a solref (2,) in either format."""
    if row[0] > 0:
        return float(row[0]), float(row[1])
    stiffness = max(-float(row[0]), 1e-9)
    return float(stiffness**-0.5), -float(row[1]) / (2 * float(stiffness**0.5))


def yields(solref: np.ndarray, solimp: np.ndarray, planned: tuple[np.ndarray, np.ndarray]) -> bool:
    """Whether a constraint gives way more than the plan's and than the engine's own, or throws back what pulls at it.

    Args:
        solref: (2,) time constant in s and damping ratio, or minus stiffness and minus damping.
        solimp: (5,) least and most impedance, width, midpoint, power.
        planned: `solref` and `solimp` of the plan's constraint.
    """
    (time, damping), (wanted, planned_damping) = sprung(solref), sprung(planned[0])
    soft = solimp[:2] < np.minimum(planned[1][:2], ENGINE_SOLIMP) - 0.01
    return time > 1.5 * max(wanted, ENGINE_S) or damping < 0.9 * min(planned_damping, 1.0) or bool(soft.any())


def holder(view: ModelView, body: int) -> str:
    """The thing of the plan that a body belongs to, in either world: itself or the nearest that carries it; else the ground."""
    bodies = view.texts["names"]["body"]
    while body > 0 and bodies[body] not in view.things:
        body = int(view.body_parentid[body])
    return str(bodies[body]) if body > 0 else GROUND


def named(plan: Plan, value: float, *names: str) -> bool:
    """Whether one of the plan's constants with these names has this value: `wood_density` says nothing about the air."""
    known = plan.simulation_parameters.constants
    values = [known[name].value for name in names if name in known]
    return any(np.isclose(np.abs(row), abs(value), rtol=1e-3).any() for row in values)


def stated(plan: Plan, value: float, *words: str, unit: str = "") -> bool:
    """Whether a constant of the plan has this value, and one of the words in its name (`belt_speed`: belt, speed).

    It serves what the plan has no field for. `window_width` does not speak of wind, and with a `unit` no thickness of a speed.
    """
    for name, constant in plan.simulation_parameters.constants.items():
        if unit and constant.unit.replace(" ", "") != unit:
            continue
        values = constant.value if isinstance(constant.value, tuple) else (constant.value,)
        if not {*name.lower().split("_")}.isdisjoint(words) and np.isclose(np.abs(values), abs(value), rtol=1e-3).any():
            return True
    return False


def shown(value: object) -> str:
    """A number, a flag or a row of numbers in short form."""
    array = np.ravel(np.asarray(value))
    texts = [f"{0.0 if abs(float(item)) < 1e-9 else float(item):.4g}" for item in array]
    while len(texts) > 1 and texts[-1] == "0":
        texts.pop()
    return texts[0] if len(texts) == 1 else f"({', '.join(texts)})"


def alike(one: object, other: object, rtol: float = 1e-3, atol: float = 1e-6) -> bool:
    """Whether two rows of numbers are the same, up to rounding."""
    a, b = np.ravel(np.asarray(one, float)), np.ravel(np.asarray(other, float))
    return a.shape == b.shape and bool(np.allclose(a, b, rtol=rtol, atol=atol, equal_nan=True))


Field = tuple[str, str]
"""A field of the engine, and what it is in words."""


def compared(
    view: ModelView, kind: str, fields: tuple[Field, ...], index: int, twin: int, *, of: tuple[int, int] | None = None
) -> Iterator[Problem]:
    """A problem for each field in which a thing and its twin differ.

    Args:
        of: rows of the fields, when other things carry them (a joint's first degree of freedom).
    """
    assert view.planned is not None
    here, there = of or (index, twin)
    name = names(view, kind)[index]
    for field, word in fields:
        value, planned = getattr(view, field)[here], getattr(view.planned, field)[there]
        if not alike(value, planned):
            message = f"the {word} of {kind} {name} is {shown(value)}, by the plan it is {shown(planned)}"
            if np.asarray(value).dtype == bool:
                has, should = ("a" if value else "no"), ("one" if planned else "none")
                message = f"{kind} {name} has {has} {word}, by the plan {should}"
            yield view.at(kind, index, message, "build it as the plan says, or change the plan and have it approved")
