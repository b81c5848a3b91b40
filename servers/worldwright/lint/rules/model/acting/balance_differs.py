"""A body is weighted otherwise than the plan's: its centre of mass or its inertia is another.

What it does: compares mass, centre of mass and inertia of each moving thing of the plan, with what is fixed to it, with the
world of the plan's draft: more than 2 % of the mass, 1 mm and 2 % of its size, or 5 % of the inertia apart.

Why is this bad: the mass may be right and the weight at the foot: what should tip stands, what should roll rocks.

Use instead: the plan's shape with its mass; parts with their own masses as a `compound`.
"""

from collections.abc import Iterator

import numpy as np

from worldkit.turning import matrices

from ....compiled.view import ModelView
from ....harm import Measured, model_of
from ....problem import Problem
from ._twins import SOUND, changed, holder, shown, twins

CODE = "WM162"
SEVERITY = "error"
SCOPE = "acts"
LOW = "b = spec.body('crate'); b.explicitinertial = 1; b.mass = 12; b.ipos = (0, 0, -.09); b.inertia = (.13, .2, .25)"
GOOD = SOUND
BAD = (
    changed(LOW),
    changed("spec.geom('arm').typeinertia = mujoco.mjtGeomInertia.mjINERTIA_SHELL"),
    changed("spec.geom('crate').mass = 13"),
    changed("spec.body('arm').add_body(name='weight', pos=(.3, 0, 0)).add_geom(size=(.02, 0, 0), mass=1)"),
)
EVIDENCE = Measured(
    "the centre of mass lies elsewhere",
    lambda s: float(model_of(s).body("crate").ipos[2]),
    0.05,
    "m",
    bad=changed(LOW)[0],
    good=changed()[0],
)
MASS, AWAY, LEAST_M, INERTIA = 0.005, 0.01, 1e-3, 0.03


def check(view: ModelView) -> Iterator[Problem]:
    """Check moving bodies of both worlds; what belongs to a body is counted with it."""
    assert view.planned is not None
    parts: dict[str, list[int]] = {}
    for body in range(1, len(view.body_mass)):
        parts.setdefault(holder(view, body), []).append(body)
    for body, twin in twins(view, "body"):
        name = view.texts["names"]["body"][body]
        if body == 0 or not view.moving[body] or not view.planned.moving[twin]:
            continue
        mass, centre, inertia = _weighed(view, body, parts[name])
        wanted, there, planned = _weighed(view.planned, twin, [twin])
        size = np.nan_to_num(view.body_high[body] - view.body_low[body])
        if abs(mass - wanted) > MASS * wanted:
            message = f"{name} has a mass of {mass:.4g} kg, by the plan {wanted:.4g} kg"
        elif np.linalg.norm(centre - there) > max(LEAST_M, AWAY * float(np.linalg.norm(size))):
            message = (
                f"the centre of mass of {name} is at {shown(centre)} m in its frame, by the plan at {shown(there)} m"
            )
        elif np.abs(inertia - planned).max() > INERTIA * max(float(np.abs(planned).max()), 1e-12):
            here, wished = (shown(np.sort(np.linalg.eigvalsh(matrix))) for matrix in (inertia, planned))
            message = f"the moments of inertia of {name} are {here} kg m^2, by the plan {wished} kg m^2"
        else:
            continue
        yield view.at("body", body, message, "build it in the plan's shape, with the plan's mass")


def _weighed(view: ModelView, body: int, parts: list[int]) -> tuple[float, np.ndarray, np.ndarray]:
    """Mass (kg), centre of mass (3,) and inertia about it (3, 3), in the frame of `body`, of all `parts` together."""
    masses = view.body_mass[parts]
    total = float(masses.sum())
    turn, origin = view.home_xmat[body], view.home_xpos[body]
    centres = np.array([view.home_xpos[p] + view.home_xmat[p] @ view.body_ipos[p] for p in parts])
    centre = (masses @ centres) / total if total else origin
    inertia = np.zeros((3, 3))
    for part, mass, place in zip(parts, masses, centres, strict=True):
        axes = view.home_xmat[part] @ matrices(view.body_iquat[part])
        arm = place - centre
        inertia += axes @ np.diag(view.body_inertia[part]) @ axes.T + mass * (
            arm @ arm * np.eye(3) - np.outer(arm, arm)
        )
    return total, turn.T @ (centre - origin), turn.T @ inertia @ turn
