"""The model itself drives bodies, by wind, moving surfaces, adhesion or a plugin, and the plan does not say so.

What it means: these do work on bodies from inside the engine, so the ledger of interventions cannot show them. A conveyor or
a gust can be what the prompt asks for; then the plan says it.

Formula: `option.wind` is not 0 in a medium with density or viscosity; a geom has a surface velocity or adhesion; the
model has engine plugins. Declared by an intervention of kind `force`, `parameter`, `control` or `solver` naming the body
or the one it is welded to (for wind: `wind` or `world`; for plugins: `world`), as an objective's cause (never
the ground, and never a moving surface: a cause declares no drive), as the wind of the plan's `medium`, or by a material
with `adhesion`.
Threshold: none. Blocking with a plan; without one a remark.
Source: MuJoCo manual, option/wind, geom/surfacevel, geom/adhesion; the facts on staging.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace

from ....model.plan.committed import Intervention
from ....model.plan.declaration import DRIVES
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from ..wholes import head_names

CODE = "WS315"
STAGING = True
NEEDS = ("meta",)
RUNS = "has a moving surface"
GROUND = {"ground", "floor"}
"""As a cause they explain no drive: every world has one."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each drive that nobody declared."""
    option = trajectory.meta.get("option") or {}
    drives = []
    filled = option.get("density") or option.get("viscosity")
    if any(option.get("wind") or ()) and filled and not _planned(context, option["wind"]):
        drives.append(("wind", "a wind blows", ("wind", "world")))
    told, head, sticky = set(), head_names(trajectory), _sticky(context)
    for geom in trajectory.meta.get("geoms") or ():
        for key, what in (("surfacevel", RUNS), ("adhesion", "attracts what it touches")):
            body = str(geom.get("body"))
            if geom.get(key) and (body, key) not in told and not (key == "adhesion" and body in sticky):
                told.add((body, key))
                drives.append((body, f"{body} {what}", (body, head.get(body, body), str(geom["name"]))))
    if trajectory.meta.get("has_plugin"):
        drives.append(("world", "an engine plugin acts", ("world", "plugin")))
    causes = {name for objective in context.plan.objectives for name in objective.cause} if context.plan else set()
    causes -= GROUND
    for body, message, names in drives:
        runs = message.endswith(RUNS)
        if (causes.intersection(names) and not runs) or any(context.acts_on(name, DRIVES) for name in names):
            continue
        severity = "blocking" if context.planned else "info"
        window = (trajectory.t[0], trajectory.t[-1])
        yield Sign(body, window, 1.0, 0.0, "drives", severity, f"{message}; no intervention says so")


def _sticky(context: Context) -> set[str]:
    """The objects whose material the plan says to stick."""
    if context.plan is None:
        return set()
    materials = context.plan.simulation_parameters.materials
    sticks = {name for name, row in materials.items() if row.adhesion}
    return {row.name for row in context.plan.scene_objects if row.material in sticks}


def _planned(context: Context, wind: Sequence[float]) -> bool:
    """Whether it is the wind of the plan's own medium."""
    medium = context.plan.simulation_parameters.medium if context.plan else None
    return medium is not None and all(abs(a - b) < 1e-6 for a, b in zip(medium.wind, wind, strict=True))


def _belt(made: Trajectory | None = None, **geom: bool) -> Trajectory:
    return replace(made or analytic.resting(), meta={"geoms": [{"name": "belt", "body": "body", **geom}]})


def _caused() -> Context:
    """A plan that only says that the body is the cause."""
    from ....model.plan.committed import Objective, Plan, SimulationParameters

    objective = Objective.model_construct(claim="It moves.", cause=("body",))
    parameters = SimulationParameters.model_construct(
        time_step=0.002, simulation_duration=1.0, materials={}, medium=None
    )
    made = Plan.model_construct(
        plan_type="mbs_in_scene", objectives=(objective,), simulation_parameters=parameters, scene_objects=()
    )
    return Context(planned=True, plan=made)


def _windy(density: float) -> Trajectory:
    return replace(analytic.resting(), meta={"option": {"wind": [3.0, 0, 0], "density": density, "viscosity": 0.0}})


BELT = Intervention(kind="force", bodies=("body",), law="a belt of 0.5 m/s", trigger="always", source="the prompt")
GOOD = (
    lambda: Case("glue that the plan names as the cause", _belt(adhesion=True), _caused()),
    lambda: Case("a belt that the plan declares", _belt(surfacevel=True), Context(planned=True, interventions=(BELT,))),
    lambda: Case("a still surface", _belt(surfacevel=False), Context(planned=True)),
    lambda: Case("wind in a vacuum", _windy(0.0), Context(planned=True)),
)
BAD = (
    lambda: Case("a belt that is its own cause", _belt(surfacevel=True), _caused()),
    lambda: Case("a crate on tracks that is its own cause", _belt(analytic.falling(), surfacevel=True), _caused()),
    lambda: Case("a secret conveyor", _belt(surfacevel=True), Context(planned=True), severity="blocking"),
    lambda: Case("a secret wind", _windy(1.2), Context(planned=True), severity="blocking"),
)
