"""What stands still, or hangs on a joint, is not where and how the plan puts it.

What it does: compares the pose, at the start, of every body that is not free with the plan's draft, to 2 mm and half a degree;
and of the world's own geoms, such as the ground, their kind, size and pose. What cannot move, and its geoms, also leans as
the plan says: to a tenth of a degree, and what the plan lays level is level up to rounding.

Why is this bad: a floor that leans by two degrees makes a crate slide twice as far, a rail that stands ten centimetres
further away is never met, and no pair, mass or law says so. On half a degree a ball begins to roll by itself.

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
SHELF = changed(
    "s = spec.worldbody.add_body(name='shelf', pos=(0, 3, 0.5))",
    "s.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 0.3, 0.25), euler=(0, TILT, 0), **SURFACE)",
)


def _shelf(tilt: float) -> tuple[str, dict[str, object]]:
    """A case with a fixed shelf that the plan has, too, and whose geom leans by `tilt` degrees."""
    text, plan = SHELF[0].replace("TILT", str(tilt)), SHELF[1]
    row = {"name": "shelf", "primitive": "box", "size": [2, 0.6, 0.5], "fixed": True, "material": "wood"}
    place = {"shelf": {"x": 0, "y": 3, "z": 0.5}}
    topology: dict = plan["topology"]  # type: ignore[assignment]
    return text, plan | {
        "scene_objects": [*plan["scene_objects"], row],  # type: ignore[misc]
        "topology": topology | {"body_positions": topology["body_positions"] | place},
    }


SLIGHTLY = "spec.geom('ground').quat = (1, 0, 0.0049, 0)"
"""0.56 degrees: within what poses are compared to."""
GOOD = (*SOUND, _shelf(0.0), changed("spec.geom('ground').quat = (0.8, 0, 0, 0.6)"))
BAD = (
    changed(LEANS),
    changed(SLIGHTLY),
    _shelf(0.56),
    _shelf(0.0098),
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
LEVEL_RAD, SLOPE_RAD = 2e-6, 2e-3
"""So far may lean what the plan lays level (in a minute a ball rolls 3 cm), and any other slope."""
FIX = "give it the pose of the plan's row"
ENDLESS = ("plane", "hfield")
"""Geoms whose size only says how far they are drawn, or comes from their data."""

SIDED, ROUND = ("box", "ellipsoid", "cylinder", "capsule"), ("cylinder", "capsule")
"""Geoms that have sides which lean, and those whose sides lean alike all round."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check bodies that are not free, then the world's own geoms."""
    planned = view.planned
    assert planned is not None
    free = {int(view.jnt_bodyid[joint]) for joint, kind in enumerate(view.joint_kind) if kind == "free"}
    for body, twin in twins(view, "body"):
        if body == 0 or body in free:
            continue
        here, there = (view.xpos[body], view.xmat[body]), (planned.xpos[twin], planned.xmat[twin])
        said = _describe_distance(here, there)
        if not said and view.body_weldid[body] == 0:
            said = _describe_lean(view.xmat[body][2], planned.xmat[twin][2])
        if said:
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
        said = _describe_distance(here, there, plane=kind == "plane")
        if not said and kind != "mesh":
            said = _describe_lean(view.geom_xmat[geom][2], planned.geom_xmat[twin][2])
        if said:
            yield view.at("geom", geom, f"{name} {said}", FIX)
    yield from _leaning_parts(view, planned)


def _leaning_parts(view: ModelView, planned: ModelView) -> Iterator[Problem]:
    """Geoms of bodies that cannot move, each held against the plan's geom of its kind that leans most as it does."""
    for body, twin in twins(view, "body"):
        if body == 0 or view.body_weldid[body]:
            continue
        for geom in np.flatnonzero((view.geom_bodyid == body) & view.collides):
            kind = view.geom_kind[geom]
            alike = [g for g in np.flatnonzero(planned.geom_bodyid == twin) if planned.geom_kind[g] == kind in SIDED]
            up = _steepness(view, int(geom))
            alike.sort(key=lambda g: float(np.linalg.norm(up - _steepness(planned, int(g)))))
            said = [_describe_lean(up, _steepness(planned, int(g))) for g in alike]
            if said and all(said):
                yield view.at("geom", int(geom), f"{view.name('geom', int(geom))} {said[0]}", FIX)


def _steepness(view: ModelView, geom: int) -> np.ndarray:
    """(3,) the upward direction along the sides of a geom, whichever of them is called x and whichever way it points."""
    up = np.abs(view.geom_xmat[geom][2])
    if view.geom_kind[geom] in ROUND:
        return np.array([0.0, np.hypot(up[0], up[1]), up[2]])
    found: np.ndarray = np.sort(up)
    return found


def _describe_lean(up: np.ndarray, planned: np.ndarray) -> str:
    """Say how far the upward direction (3,), in a thing's own axes, is from the plan's; empty when it is not."""
    level = np.sort(np.abs(planned))[1] < LEVEL_RAD
    lean = float(np.linalg.norm(up - planned))
    if lean <= (LEVEL_RAD if level else SLOPE_RAD):
        return ""
    return f"leans by {np.degrees(lean):.3g} degrees " + (
        "where the plan lays it level" if level else "from the plan's slope"
    )


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
