"""A declared intervention names something that the plan does not have.

What it does: resolves what each row of `interventions` speaks of. Its `bodies`, for forces, torques, poses, velocities and
mocap motion (objects, the numbered points of one such as `cloth_12`, or `wind`), and for controls where the plan declares actuators; the body or tendon in a `trigger` such
as `speed of cart > 2 m/s`; a `parameter` on `wind` or `gravity`, which is `opt.wind`; and every `constants.NAME`, `materials.NAME` and `masses.NAME` in its law, trigger and source.

Why is this bad: a declaration covers what it names and nothing else. One that names nothing is never seen to act, and what
really acts is undeclared, which blocks acceptance after the run. A source that leads nowhere is no source.

Use instead: the names as the plan has them; `worldwright lint check-plan` lists those that are near.
"""

import re
from collections.abc import Iterator
from difflib import get_close_matches

from ....model.plan.plan_references import WITH_PARTS
from ....model.plan.trigger import threshold, touching
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP127"
SEVERITY = "error"
ON_BODIES = ("force", "torque", "pose", "velocity", "mocap")
EVERYWHERE = ("wind", "gravity", "world")
"""Names of what acts on all bodies at once."""
OPTIONS = ("wind", "gravity", "density", "viscosity", "magnetic")
"""What `control` may write of the world as a whole, as `opt.wind`: without `opt.` a row opens none of it."""
WITH_A_BODY = ("contact force", "speed", "height")
POINT = re.compile(r"(.+?)(?:_\d+){1,3}")
"""What the points of a flex are called; the flex' own name stands for all of them."""
PATH = re.compile(r"\b(constants|materials|masses)\.([A-Za-z_]\w*)")


def _with(**changes: object) -> dict[str, object]:
    row = {"kind": "force", "bodies": ["crate"], "law": "F = 3 N", "source": "catalogue of the winch", **changes}
    return {"simulation_parameters": {"interventions": [row]}}


GOOD: Changes = (
    _with(),
    _with(bodies=["wind"]),
    _with(bodies=["crate_12", "crate_0_0_3"]),  # points of a flex
    _with(trigger="speed of crate > 2 m/s"),
    _with(source="materials.wood.density of the crate"),
    _with(kind="control", bodies=["winch_motor"]),  # an actuator that the program makes
    _with(kind="parameter", bodies=["opt.wind"], law="from 1 m/s to 4 m/s along +x"),
)
BAD: Changes = (
    _with(bodies=["locomotive"]),
    _with(kind="velocity", bodies=["crate", "locomotive"]),
    _with(bodies=["locomotive_3"]),
    _with(trigger="speed of locomotive > 2 m/s"),
    _with(source="constants.pull, inferred"),
    _with(law="F = constants.pull along +X"),
    _with(trigger="height of crate < constants.brim"),
    _with(kind="parameter", bodies=["wind"], law="from 1 m/s to 4 m/s along +x"),
)
EVIDENCE = Argued("what is meant by a name that nobody has, no run tells; what acts undeclared is WS108 after the run")


def check(view: PlanView) -> Iterator[Problem]:
    """Check bodies, triggers, and paths in words."""
    plan, parameters = view.plan, view.plan.simulation_parameters
    objects = [*plan.object_names(), *(row.name for row in plan.assets)]
    joints = [row.name for row in plan.topology.joints]
    tendons = [row.name for row in plan.topology.tendons]
    actuators = [row.name for row in plan.topology.actuators]
    inner = tuple(f"{row.name}_" for row in plan.assets if row.type in WITH_PARTS)
    soft = {row.name for row in plan.scene_objects if row.dynamic and not row.fixed and not row.parts}
    known = [*objects, *joints, *tendons, *actuators]
    paths = {
        "constants": list(parameters.constants),
        "materials": list(parameters.materials),
        "masses": list(parameters.masses),
    }
    for index, row in enumerate(parameters.interventions):
        place = ("simulation_parameters", "interventions", index)
        closed = row.kind in ON_BODIES or (row.kind == "control" and bool(actuators))
        for n, name in enumerate(row.bodies if closed else ()):
            point = POINT.fullmatch(name)
            if point and point[1] in soft:
                continue
            if name not in known and name not in EVERYWHERE and not name.startswith(inner):
                what = f"the {row.kind} acts on `{name}`, which the plan does not have"
                yield view.at((*place, "bodies", n), what, _fix(name, known))
        for n, name in enumerate(row.bodies if row.kind == "parameter" else ()):
            if name in OPTIONS and name not in known:
                what = f"a parameter `{name}` opens nothing: `model.opt.{name}`, which control writes, is another name"
                yield view.at((*place, "bodies", n), what, f"write opt.{name}")
        found = threshold(row.trigger)
        if found is not None and found.name:
            near = objects if found.quantity in WITH_A_BODY else tendons if found.quantity == "tension" else []
            if near and found.name not in near and not found.name.startswith(inner):
                what = f"the trigger waits for the {found.quantity} of `{found.name}`, which the plan does not have"
                yield view.at((*place, "trigger"), what, _fix(found.name, near))
        for name in touching(row.trigger) or ():
            if name not in (*objects, "ground") and not name.startswith(inner):
                what = f"the trigger waits for a touch of `{name}`, which the plan does not have"
                yield view.at((*place, "trigger"), what, _fix(name, objects))
        for field, text in (("law", row.law), ("trigger", row.trigger), ("source", row.source)):
            for kind, name in dict.fromkeys(PATH.findall(text)):
                if name not in paths[kind]:
                    what = f"its {field} speaks of {kind}.{name}, which the plan does not have"
                    yield view.at((*place, field), what, _fix(name, paths[kind]))


def _fix(name: str, known: list[str]) -> str:
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    return f"did you mean {', '.join(near)}?" if near else f"known: {', '.join(known[:20]) or '(none)'}"
