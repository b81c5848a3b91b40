"""What acts all the time from inside the engine's step: wind, surfaces that run, things that stick. The ledger tells it beside what was
sent, with who declares it.

They are numbers of the model, which nobody sends. What is written to them while the world runs stands in the ledger as it is written.
The law of each is the plan's own row, or its medium or material: the plan names it, the program does not.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...model.evidence.audits import Standing
from ...model.plan.declaration import DRIVES, declaration
from ...model.recording.trajectory import Trajectory
from ..anomalies.sign import Context
from ..anomalies.wholes import head_names


def standing(trajectory: Trajectory, context: Context) -> Iterator[Standing]:
    """Each wind, running surface and sticking geom of a recording's world."""
    option = trajectory.meta.get("option") or {}
    plan = context.plan
    wind = np.asarray(option.get("wind") or (0.0, 0.0, 0.0), float)
    if wind.any() and (option.get("density") or option.get("viscosity")):
        medium = plan.simulation_parameters.medium if plan else None
        own = medium is not None and np.allclose(medium.wind, wind, atol=1e-6)
        said = {"declared": True, "law": "the plan's medium", "source": medium.source} if own and medium else {}
        yield _row(context, ("wind", "world"), said, "wind", "world", float(np.linalg.norm(wind)), "m/s")
    stuff = {row.name: row.material for row in plan.scene_objects} if plan else {}
    materials, head = plan.simulation_parameters.materials if plan else {}, head_names(trajectory)
    for geom in trajectory.meta.get("geoms") or ():
        body, name = str(geom.get("body")), str(geom["name"])
        names = (body, head.get(body, body), name)
        for part, unit in ((slice(0, 3), "m/s"), (slice(3, 6), "rad/s")):
            speed = float(np.linalg.norm(np.asarray(geom.get("surface") or (0.0,) * 6, float)[part]))
            if speed:
                yield _row(context, names, {}, "running surface", name, speed, unit)
        if pull := float(geom.get("adhesion_n") or 0.0):
            known = materials.get(stuff.get(body) or "")
            sticks = known is not None and bool(known.adhesion)
            said = {"declared": True, "law": "the plan's material", "source": known.source} if sticks and known else {}
            yield _row(context, names, said, "adhesion", name, pull, "N")


def _row(
    context: Context, names: tuple[str, ...], said: dict[str, Any], kind: str, target: str, peak: float, unit: str
) -> Standing:
    if not said:
        rows = (declaration(one, name, context.interventions) for name in names for one in DRIVES)
        row = next(filter(None, rows), None)
        said = {} if row is None else {"declared": True, "law": row.law, "source": row.source}
    return Standing(kind=kind, target=target, peak=peak, unit=unit, **said)
