"""An objective's cause names nothing that the plan has, or nothing that could be taken away.

What it does: resolves every `cause` of an objective: objects, asset rows, joints, tendons, actuators, `gravity`, `wind`,
`friction`, `control`, or `kind:target` of an intervention; of a body also `.weight`, `.friction` (at its contacts), and
`.velocity` where it starts with one. Several may be
joined by `+`. A solver or a law by its own name is an error: what it does to a body is taken away, `solver:BODY`. So is that of
a solver which pushes nothing (`heat`), and `gravity` with water in the world, which does not lie without it.

Why is this bad: the causal audit takes the cause away and looks whether the effect vanishes. What is not there cannot be
taken away, so the objective stays without that proof; without a starting velocity the weakened world is the same world.

Use instead: the plan's own names; declare an intervention before naming it as a cause.
"""

from collections.abc import Iterator
from difflib import get_close_matches

from ....model.plan.committed import Plan
from ....model.plan.declared_inputs import Intervention
from ....model.plan.imported import all_of, is_sculpt
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP115"
SEVERITY = "warning"
CLAIM = {"claim": "It slides.", "expect": [{"moves": {"body": "crate", "min_m": 0.1}}]}
PUSH = {"interventions": [{"kind": "force", "bodies": ["crate"], "law": "F = 3 N", "source": "catalogue of the winch"}]}
RUBBER = {
    "interventions": [
        {"kind": "solver", "bodies": ["crate", "world"], "law": "Hooke, 3 N/m", "source": "the prompt's band", "solver": {"name": "rubber", "file": "laws/rubber.py"}}
    ]
}  # fmt: skip


WATER = {
    "interventions": [{"kind": "solver", "bodies": ["crate"], "law": "Archimedes", "source": "CRC", "solver": {"name": "water"}}]
}  # fmt: skip

HEAT = {
    "interventions": [{"kind": "solver", "bodies": ["crate", "ramp"], "law": "Newton", "source": "CRC", "solver": {"name": "heat"}}]
}  # fmt: skip


def _tow(name: str) -> dict:
    return {"name": name, "ends": [{"body": "crate"}, {"offset": [3.0, 0.0, 0.2]}], "slack": 0.5}


GOOD: Changes = (
    {"objectives": [{**CLAIM, "cause": "gravity"}]},
    {"objectives": [{**CLAIM, "cause": ["ramp + gravity"]}]},
    {"objectives": [{**CLAIM, "cause": "crate.velocity"}]},
    {"objectives": [{**CLAIM, "cause": ["friction", "crate.friction", "ground.friction"]}]},
    {"objectives": [{**CLAIM, "cause": "force:crate"}], "simulation_parameters": PUSH},
    {"objectives": [{**CLAIM, "cause": "solver:crate"}], "simulation_parameters": RUBBER},
    {"objectives": [{**CLAIM, "cause": ["crate", "solver:crate"]}], "simulation_parameters": WATER},
    {"objectives": [{**CLAIM, "cause": "ramp"}], "simulation_parameters": HEAT},
    {"objectives": [{**CLAIM, "cause": "tow+tow_2"}], "topology": {"tendons": [_tow("tow"), _tow("tow_2")]}},
)
BAD: Changes = (
    {"objectives": [{**CLAIM, "cause": "gravity"}], "simulation_parameters": WATER},
    {"objectives": [{**CLAIM, "cause": "slope"}]},
    {"objectives": [{**CLAIM, "cause": "force:crate"}]},
    {"objectives": [{**CLAIM, "cause": ["gravity + wnid"]}]},
    {"objectives": [{**CLAIM, "cause": "crate.colour"}]},
    {"objectives": [{**CLAIM, "cause": "gravity.velocity"}]},
    {"objectives": [{**CLAIM, "cause": "mug.velocity"}]},
    {"objectives": [{**CLAIM, "cause": "gravity + crate.velocity"}], "simulation_parameters": {"initial_motion": None}},
    {"objectives": [{**CLAIM, "cause": "solver:crate"}], "simulation_parameters": HEAT},
    {"objectives": [{**CLAIM, "cause": "solver:rubber"}], "simulation_parameters": RUBBER},
)
EVIDENCE = Argued("no run can be made without a thing that is not in it; the audit refuses the name")
WORLD = ("gravity", "wind", "friction", "control", "ground.friction")
ASPECTS = ("velocity", "weight", "friction")
"""Properties that can be taken away from a body while the body stays."""
BUILT = ("actuator", "constraint", "equality", "tendon", "body", "geom", "joint", "flex")
"""Kinds that only the program declares: `actuator:winch` is believed."""


def check(view: PlanView) -> Iterator[Problem]:
    """Check each part of each cause."""
    plan = view.plan
    bodies = {*plan.object_names(), *(a.name for a in plan.assets)}
    known = {*WORLD, *plan.object_names(), *(a.name for a in plan.assets), *(j.name for j in plan.topology.joints)}
    known |= {row.name for row in plan.topology.tendons} | {row.name for row in plan.topology.actuators}
    known |= {name for _, _, model in all_of(plan) for name in model.names()}
    sculpted = tuple(f"{name}_" for row in plan.assets if is_sculpt(row) for name in row.instances)
    for item in plan.simulation_parameters.interventions:
        known |= {f"{item.kind}:{target}" for target in item.bodies} | {item.kind, *item.bodies}
    for index, objective in enumerate(plan.objectives):
        for cause in objective.cause:
            for part in (p.strip() for p in cause.split("+")):
                if part == "gravity" and (wet := _lies_by_weight(plan)):
                    fix = f"name what falls into it, or what it does to a body: {', '.join(f'{b}, solver:{b}' for b in wet)}"
                    what = "the cause `gravity` can't be taken away: the solver `water` has no surface without it"
                    yield view.at(("objectives", index, "cause"), what, fix, severity="error")
                    continue
                kind, _, target = part.partition(":")
                if kind == "solver" and (still := _pushing_nothing(plan, target)):
                    others = [body for row in still for body in row.bodies if body != target]
                    fix = f"name the body that it is warmed or cooled by, and does not touch without it: {', '.join(others)}; or leave `cause` out"
                    what = f"the cause `{part}` can take nothing away: `{still[0].solver.name}` pushes nothing"  # type: ignore[union-attr]
                    yield view.at(("objectives", index, "cause"), what, fix, severity="error")
                    continue
                whole, _, aspect = part.rpartition(".")
                if whole in bodies and aspect == "velocity" and part not in known and not _starts_moving(plan, whole):
                    fix = f"name {whole}, {whole}.weight or what sets it moving; or give it an `initial_motion`"
                    what = f"the cause `{part}` can take nothing away: {whole} starts at rest"
                    yield view.at(("objectives", index, "cause"), what, fix)
                    continue
                if (
                    part in known
                    or part.startswith(sculpted)
                    or (":" in part and kind in BUILT)
                    or (whole in bodies and aspect in ASPECTS)
                ):
                    continue
                if bodies_of := _acts_on(plan, part):
                    fix = f"name what it does to a body: {', '.join(bodies_of)}"
                    what = f"the cause `{part}` is the name of what steps beside the engine, which nothing takes away"
                    yield view.at(("objectives", index, "cause"), what, fix, severity="error")
                    continue
                near = get_close_matches(part, sorted(known), n=3, cutoff=0.5)
                fix = (
                    "did you mean " + ", ".join(near) + "?" if near else "name one of: " + ", ".join(sorted(known)[:30])
                )
                yield view.at(("objectives", index, "cause"), f"the cause `{part}` is not in the plan", fix)


def _lies_by_weight(plan: Plan) -> list[str]:
    """The bodies of a solver that refuses a world without gravity; none where no such solver steps."""
    from worldengine.solvers import SEAM

    beside = plan.simulation_parameters.interventions
    rows = [row for row in beside if row.solver and not row.solver.file and row.solver.name in SEAM.names()]
    return [
        b for row in rows if row.solver and getattr(SEAM.find(row.solver.name), "WEIGHTY", False) for b in row.bodies
    ]


def _pushing_nothing(plan: Plan, body: str) -> list[Intervention]:
    """The solvers' rows of a body, where none of them pushes anything; nothing where one does, or a law of the author's steps."""
    from worldengine.solvers import SEAM

    rows = [row for row in plan.simulation_parameters.interventions if row.kind == "solver" and body in row.bodies]
    told = [row.solver for row in rows]
    still = all(one and not one.file and one.name in SEAM.names() and not _pushes(one.name) for one in told)
    return rows if still else []


def _pushes(name: str) -> bool:
    from worldengine.solvers import SEAM

    return bool(getattr(SEAM.find(name), "PUSHES", True))


def _acts_on(plan: Plan, cause: str) -> list[str]:
    """What can be taken away of a solver or law that a cause calls by its own name: `solver:BODY`; nothing of any other cause."""
    kind, _, name = cause.partition(":")
    rows = [row for row in plan.simulation_parameters.interventions if row.solver and row.solver.name == (name or kind)]
    return [f"solver:{body}" for row in rows for body in row.bodies] if kind == "solver" or not name else []


def _starts_moving(plan: Plan, name: str) -> bool:
    """Whether a body, one of its copies, or a joint that carries it has a velocity at the start."""
    parameters = plan.simulation_parameters
    rows = {asset.name: asset.instances for asset in plan.assets}
    families = [(family, *copies) for family, copies in (*plan.families.items(), *rows.items())]
    called = {name, *(n for family in families if name in family for n in family)}
    called |= {joint.name for joint in plan.topology.joints if joint.child in called}
    models = tuple(f"{asset.name}_" for asset in plan.assets if asset.name in called or called & set(asset.instances))
    moving = [
        body
        for body, motion in parameters.initial_motion.items()
        if any(motion.linear) or any(motion.angular) or motion.joint_velocity
    ]
    moving += [body for row in parameters.interventions if row.kind in ("velocity", "solver") for body in row.bodies]
    return any(body in called or body.startswith(models) for body in moving)
