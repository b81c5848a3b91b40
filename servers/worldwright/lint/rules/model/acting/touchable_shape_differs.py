"""What can be touched of a body is not the shape that the plan gives it.

What it does: compares the colliding geoms of each thing of the plan with those of its draft: the box around them (3 % and
1 mm), the volume inside them (10 %), where in the box that volume lies, each part of a compound, and for models, sculptures, roads and catalog meshes the collision meshes and height fields themselves, by hash.

Why is this bad: the size that is checked may be that of what is drawn; what collides may be smaller, elsewhere, or round: a
crate on a hidden ball rolls. A ramp that rises towards the other side has the same box and the same volume.

Use instead: the plan's primitive, or hulls that fill it; a catalog asset as `assets.add` brings it.
"""

from collections.abc import Iterator

import numpy as np

from .....model.plan.plan_references import WITH_PARTS
from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._part_points import FORMED, uncovered
from ._twins import SOUND, changed, holder, shown, twins

CODE = "WM170"
SEVERITY = "error"
SCOPE = "acts"
BALL = "spec.geom('crate').type, spec.geom('crate').size = mujoco.mjtGeom.mjGEOM_ELLIPSOID, (0.2, 0.15, 0.1)"
RAMP = """\
from worldkit import bodies, forms, scene
def build():
    spec = scene.new("a", time_step=0.002)
    bodies.formed(spec, "slope", form=forms.wedge(size=(0.8, 0.4, 0.4)), pos=(0, 0, 0.2), fixed=True)
    for geom in spec.body("slope").geoms:
        w, x, y, z = geom.quat
        geom.pos, geom.quat = (-geom.pos[0], -geom.pos[1], geom.pos[2]), (-z, -y, x, w)
    return spec
"""
SLOPED: dict[str, object] = {
    "simulation_parameters": {"materials": None, "masses": None, "initial_motion": None},
    "implementation_steps": None,
    "assets": None,
    "asset_dimensions": None,
    "scene_objects": [{"name": "slope", "primitive": "wedge", "size": [0.8, 0.4, 0.4], "fixed": True}],
    "topology": {"scene_predicates": None, "body_positions": {"slope": {"x": 0, "y": 0, "z": 0.2}}},
}


def _track(hurdle: float) -> tuple[str, dict[str, object]]:
    """A case with a track whose hurdle, 8 cm high by the plan, is built so high, m."""
    text, plan = changed(
        "t = spec.worldbody.add_body(name='track', pos=(0, 3, 0.15))",
        "b = lambda size, pos: t.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=pos, **SURFACE)",
        "b((1.2, 0.5, 0.1), (0, 0, -0.05)), b((1.2, 0.02, 0.15), (0, -0.48, 0)), b((1.2, 0.02, 0.15), (0, 0.48, 0))",
        f"b((0.02, 0.45, {hurdle} / 2), (0.2, 0, 0.05 + {hurdle} / 2))",
    )
    boxes = (
        ("base", [2.4, 1.0, 0.2], [0, 0, 0.1]),
        ("right", [2.4, 0.04, 0.3], [0, -0.48, 0.15]),
        ("left", [2.4, 0.04, 0.3], [0, 0.48, 0.15]),
        ("hurdle", [0.04, 0.9, 0.08], [0.2, 0, 0.24]),
    )
    parts = [{"name": name, "primitive": "box", "size": size, "offset": at} for name, size, at in boxes]
    row = {"name": "track", "primitive": "compound", "fixed": True, "material": "wood", "parts": parts}
    topology: dict = plan["topology"]  # type: ignore[assignment]
    places = topology["body_positions"] | {"track": {"x": 0, "y": 3, "z": 0.15}}
    more = {"scene_objects": [*plan["scene_objects"], row], "topology": topology | {"body_positions": places}}  # type: ignore[misc]
    return text, plan | more


GOOD = (*SOUND, _track(0.08), _track(0.082))
BAD = (
    _track(0.005),
    changed(BALL),
    changed("spec.geom('crate').size = (0.19, 0.15, 0.1)"),
    changed("spec.geom('arm').pos = (0.05, 0, 0)"),
    changed("spec.body('crate').add_geom(size=(0.01, 0, 0), pos=(0, 0, -0.2), mass=0)"),
    (RAMP, SLOPED),
)
EVIDENCE = Measured(
    "the crate rocks where it should slide flat",
    lambda s: float(abs(after(s, 1.0)[1].body("crate").xquat[1:3]).max()),
    0.01,
    bad=changed(BALL)[0],
    good=changed()[0],
)
SHARE, LEAST_M, VOLUME = 0.03, 1e-3, 0.1
MIDDLE, SPREAD = 0.03, 0.01
"""Shares of its box by which the middle of what is inside may be off, and of the box's area its spread (1/12 of a full box)."""
FIX = "let what collides have the plan's shape"


def check(view: ModelView) -> Iterator[Problem]:
    """Check things of both worlds."""
    planned = view.planned
    assert planned is not None and view.plan is not None
    meshed = {name for row in view.plan.assets for name in row.instances if row.type in ("mesh", "road", *WITH_PARTS)}
    here, there = _volumes(view), _volumes(planned)
    for body, twin in twins(view, "body"):
        name = view.texts["names"]["body"][body]
        if body == 0 or name not in here or name not in there:
            continue  # whether it can be touched at all is told by the rule about contacts
        low, high = (
            np.abs(a - b)
            for a, b in (
                (view.touch_low[body], planned.touch_low[twin]),
                (view.touch_high[body], planned.touch_high[twin]),
            )
        )
        size = planned.touch_high[twin] - planned.touch_low[twin]
        room = np.maximum(SHARE * size / 2, LEAST_M)
        if (low > room).any() or (high > room).any():
            built = view.touch_high[body] - view.touch_low[body]
            message = f"what can be touched of {name} measures {shown(built)} m, by the plan {shown(size)} m, or lies elsewhere in it"
            yield view.at("body", body, message, FIX)
        elif abs(here[name] - there[name]) > VOLUME * there[name]:
            message = f"what can be touched of {name} fills {here[name] * 1e3:.4g} litres, by the plan {there[name] * 1e3:.4g}"
            yield view.at("body", body, message, FIX)
        elif there[name] and _elsewhere(_inside(view, body, name), _inside(planned, twin, name), size):
            message = f"what can be touched of {name} fills its box otherwise than the plan's {name}"
            yield view.at("body", body, message, FIX)
        elif said := _part_differs(view, body, planned, twin, name):
            yield view.at("body", body, said, "build each part in the plan's size and place")
        elif name in meshed and _meshes(view, name) != _meshes(planned, name):
            fix = "use the catalog's hulls, or make it by `sculpt.from_file` (a road: `roads.read`) of the file that the plan names"
            yield view.at("body", body, f"the collision meshes of {name} are not those of its model", fix)


def _part_differs(view: ModelView, body: int, planned: ModelView, twin: int, name: str) -> str:
    """How a part of a thing of several differs from the plan's; empty when none does, or where meshes are compared."""
    mine, theirs = _touchable(view, name), _touchable(planned, name)
    if len(theirs) < 2 or any(w.geom_kind[g] not in FORMED for w, of in ((view, mine), (planned, theirs)) for g in of):
        return ""
    if (part := uncovered(planned, theirs, twin, view, mine, body)) is not None:
        return f"{planned.name('geom', part)} is built smaller than the plan's, or elsewhere"
    if (part := uncovered(view, mine, body, planned, theirs, twin)) is not None:
        return f"{view.name('geom', part)} reaches beyond the parts of the plan's {name}"
    return ""


def _touchable(view: ModelView, name: str) -> list[int]:
    return [int(g) for g in np.flatnonzero(view.collides) if holder(view, int(view.geom_bodyid[g])) == name]


def _volumes(view: ModelView) -> dict[str, float]:
    """The volume inside the colliding geoms of each thing, m^3."""
    found: dict[str, float] = {}
    for geom in np.flatnonzero(view.collides):
        name = holder(view, int(view.geom_bodyid[geom]))
        found[name] = found.get(name, 0.0) + float(view.geom_solid[geom])
    return found


def _inside(view: ModelView, body: int, name: str) -> tuple[np.ndarray, np.ndarray]:
    """Middle (3,), m, and covariance (3, 3), m^2, of the points inside what can be touched of a thing, in its frame."""
    mine = _touchable(view, name)
    share = view.geom_solid[mine] / view.geom_solid[mine].sum()
    turns, back = view.geom_xmat[mine], view.xmat[body].T
    middles = (view.geom_xpos[mine] + np.einsum("nij,nj->ni", turns, view.geom_middle[mine]) - view.xpos[body]) @ back.T
    axes = back @ turns
    spread = np.einsum("n,nij,njk,nlk->il", share, axes, view.geom_spread[mine], axes)
    middle = share @ middles
    off = middles - middle
    return middle, spread + np.einsum("n,ni,nj->ij", share, off, off)


def _elsewhere(here: tuple[np.ndarray, np.ndarray], there: tuple[np.ndarray, np.ndarray], size: np.ndarray) -> bool:
    """Whether two shapes of one box and volume fill another part of the box; `size` (3,) is the box's, m."""
    away, wider = np.abs(here[0] - there[0]), np.abs(here[1] - there[1])
    return bool(
        (away > np.maximum(MIDDLE * size, LEAST_M)).any() or (wider > SPREAD * np.outer(size, size) + LEAST_M**2).any()
    )


def _meshes(view: ModelView, name: str) -> set[tuple[str, ...]]:
    """Of each mesh of a thing its hash, and of each height field that and how it lies in the thing, 1e-4 m and 1e-3."""
    found = set[tuple[str, ...]]()
    for geom in _touchable(view, name):
        if view.geom_kind[geom] == "mesh":
            found.add((view.texts["mesh_sha256"][int(view.geom_dataid[geom])],))
        elif view.geom_kind[geom] == "hfield":
            body = int(view.geom_bodyid[geom])
            turn = view.xmat[body].T @ view.geom_xmat[geom]
            place = np.round(np.concatenate([view.geom_pos[geom] * 1e4, turn.ravel() * 1e3])).astype(int)
            found.add((view.texts["hfield_sha256"][int(view.geom_dataid[geom])], *map(str, place)))
    return found
