"""What stands still, or hangs on a joint, is not where and how the plan puts it.

What it does: compares the pose, at the start, of every body that is not free with the plan's draft, to 2 mm and half a degree;
and of the world's own geoms, such as the ground, their kind, size and pose.

Why is this bad: a floor that leans by two degrees makes a crate slide twice as far, a rail that stands ten centimetres
further away is never met, and no pair, mass or law says so.

Use instead: the poses of the plan's rows; to tilt a floor, tilt it in the plan.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import SOUND, changed, shown, twins

CODE = "WM172"
SEVERITY = "error"
SCOPE = "acts"
HILL = (
    "spec.delete(spec.geom('ground'))",
    "spec.add_mesh(name='hill', uservert=[-9, -9, -1, 9, -9, -1, -9, 9, -1, 9, 9, -1, -9, 0, 1, 9, 0, -0.5])",
    "spec.worldbody.add_geom(name='ground', type=mujoco.mjtGeom.mjGEOM_MESH, meshname='hill')",
)
LEANS = "spec.geom('ground').quat = (0.996, 0, 0.087, 0)"
GOOD = SOUND
BAD = (
    changed(LEANS),
    changed("spec.geom('ground').pos = (0, 0, -0.02)"),
    changed(*HILL),
    changed("spec.body('arm').pos = (1.5, 0, 0.6)"),
    changed("spec.body('arm').quat = (0.98, 0, 0, 0.2)"),
)
EVIDENCE = Measured(
    "the crate slides down a floor that leans",
    lambda s: float(after(s, 0.7)[1].body("crate").xpos[0]),
    0.02,
    "m",
    bad=changed(LEANS)[0],
    good=changed()[0],
)
NEAR_M, NEAR_RAD, SIZE_M = 2e-3, 0.01, 1e-3
FIX = "give it the pose of the plan's row"
ENDLESS = ("plane", "hfield")
"""Geoms whose size only says how far they are drawn, or comes from their data."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check bodies that are not free, then the world's own geoms."""
    planned = view.planned
    assert planned is not None
    free = {int(view.jnt_bodyid[joint]) for joint, kind in enumerate(view.joint_kind) if kind == "free"}
    for body, twin in twins(view, "body"):
        if body == 0 or body in free:
            continue
        here, there = (view.xpos[body], view.xmat[body]), (planned.xpos[twin], planned.xmat[twin])
        if said := _describe_distance(here, there):
            yield view.at("body", body, f"{view.name('body', body)} {said}", FIX)
    for geom, twin in twins(view, "geom"):
        if view.geom_bodyid[geom] or planned.geom_bodyid[twin] or not view.collides[geom]:
            continue
        kind, wanted = view.geom_kind[geom], planned.geom_kind[twin]
        name = view.name("geom", geom)
        if kind != wanted:
            yield view.at("geom", geom, f"{name} is a {kind}, by the plan a {wanted}", f"make it a {wanted}")
            continue
        built, size = view.geom_size[geom], planned.geom_size[twin]
        if kind not in ENDLESS and np.abs(built - size).max() > SIZE_M:
            yield view.at("geom", geom, f"{name} measures {shown(built)}, by the plan {shown(size)}", FIX)
        here = view.geom_xpos[geom], view.geom_xmat[geom]
        there = planned.geom_xpos[twin], planned.geom_xmat[twin]
        if said := _describe_distance(here, there, plane=kind == "plane"):
            yield view.at("geom", geom, f"{name} {said}", FIX)


def _describe_distance(
    here: tuple[np.ndarray, np.ndarray], there: tuple[np.ndarray, np.ndarray], plane: bool = False
) -> str:
    """Say how far two poses (place in m, axes) are apart; empty when they are not. For a plane the normal counts."""
    (place, axes), (wanted, planned) = here, there
    off, normal = place - wanted, planned[:, 2]
    away = abs(float(off @ normal)) if plane else float(np.linalg.norm(off))
    cosine = float(axes[:, 2] @ normal) if plane else (float(np.trace(axes.T @ planned)) - 1) / 2
    if (turn := float(np.arccos(np.clip(cosine, -1, 1)))) > NEAR_RAD:
        return f"is turned by {np.degrees(turn):.3g} degrees from how the plan puts it"
    return f"is {away * 1e3:.3g} mm from where the plan puts it" if away > NEAR_M else ""
