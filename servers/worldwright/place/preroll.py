"""The physics behind `check` and `settle`, run as a process of its own: `python -m worldwright.place.preroll`.

An engine error may end its process, and engines print, so the server never steps a world itself. The process reads one
JSON request on standard input (`asking.simulate`) and writes its answer to the file `out` named there.

Its world has a ground plane and every object with its real collision shapes at its resolved pose, and nothing else: no
initial motion, no control. A vehicle stands on its wheels, a road is its surface. While it is at work it says where in the file `out`.progress, which its caller watches.
"""

import json
import math
import sys
import time
from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from typing import Any

EVERY_S = 0.25
FAR_M = 1e3
"""What is deeper below is not looked for."""


def answer(request: dict[str, Any], advanced: Callable[[str], None] = lambda _: None) -> dict[str, Any]:
    """Find contacts at the start and, if `duration_s` is positive, what each object does until then.

    Args:
        request: see `asking.simulate`.
        advanced: told where it is, at every step of the way.

    Returns:
        `contacts`: [name, name, depth in metres] for each pair of objects that penetrate at the start, deepest first;
        `objects`: for each, `start` and `end` position (m), `quat` (w, x, y, z) at the end, and `speed` (m/s);
        `distances`: [name, name, metres] for each of `pairs`, at most `far_m`; `drops`: [name, metres, what is there] for
        each of `falling`, straight down; `views`: what `cameras` see (`visibility.seen`).
    """
    import mujoco
    import numpy as np

    from . import visibility

    model = _build(request)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    advanced("built")
    distances, drops = [], []
    for a, b in request["pairs"]:
        distances.append([a, b, _distance(model, data, a, b, request["far_m"])])
        advanced(f"distance {len(distances)} of {len(request['pairs'])}")
    for name in request["falling"]:
        drops.append([name, *_drop(model, data, name)])
        advanced(f"drop {len(drops)} of {len(request['falling'])}")
    deepest: dict[tuple[str, str], float] = {}
    for geoms, distance in zip(data.contact.geom, data.contact.dist, strict=True):
        first, second = sorted(_owner(model, geom) for geom in geoms)
        if distance < 0 and first != second:
            depth = _depth(model, data, geoms, float(distance))
            deepest[first, second] = max(deepest.get((first, second), 0.0), depth)
    ids = {row["name"]: model.body(row["name"]).id for row in request["objects"]}
    start = {name: data.xpos[i].copy() for name, i in ids.items()}
    steps = math.ceil(request["duration_s"] / model.opt.timestep)
    for step in range(steps):
        mujoco.mj_step(model, data)
        advanced(f"step {step + 1} of {steps}")
        if not np.isfinite(data.qpos).all():
            raise FloatingPointError(f"the pre-roll diverged at t = {data.time:.3f} s")
    if steps:
        mujoco.mj_forward(model, data)
    velocity = np.zeros(6)
    objects = {}
    for name, i in ids.items():
        mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, i, velocity, 0)
        objects[name] = {
            "start": start[name].tolist(),
            "end": data.xpos[i].tolist(),
            "quat": data.xquat[i].tolist(),
            "speed": float(np.linalg.norm(velocity[3:])),
        }
    contacts = sorted(deepest.items(), key=lambda row: -row[1])
    views = []
    for camera in request["cameras"]:
        views += visibility.seen(model, data, [camera])
        advanced(f"camera {camera['name']}")
    return {
        "contacts": [[a, b, depth] for (a, b), depth in contacts],
        "objects": objects,
        "distances": distances,
        "drops": drops,
        "views": views,
    }


def _distance(model: Any, data: Any, first: str, second: str, far_m: float) -> float:
    """The smallest distance between the collision shapes of two objects, metres; negative when they penetrate."""
    import numpy as np

    from worldengine.recording import gaps

    owners = np.array([_owner(model, geom) for geom in range(model.ngeom)])
    geoms = [np.flatnonzero(owners == name) for name in (first, second)]
    return min((gaps.distance(model, data, int(a), int(b), far_m) for a in geoms[0] for b in geoms[1]), default=far_m)


def _depth(model: Any, data: Any, geoms: Any, distance: float) -> float:
    """How deep a contact is, metres: what sinks into a height field meets cells of it, none of which tells the whole depth."""
    import mujoco

    from worldengine.recording import gaps

    if mujoco.mjtGeom.mjGEOM_HFIELD not in model.geom_type[geoms]:
        return -distance
    return max(-distance, -gaps.distance(model, data, int(geoms[0]), int(geoms[1]), 0.0))


def _drop(model: Any, data: Any, name: str) -> tuple[float, str | None]:
    """How far an object is above what stops it straight below, metres, and what that is; None where nothing but the ground is."""
    import mujoco
    import numpy as np

    from worldengine.recording import gaps

    owners = np.array([_owner(model, geom) for geom in range(model.ngeom)])
    solid = (
        model.geom_type != mujoco.mjtGeom.mjGEOM_PLANE
    )  # the one plane there is, is the ground that positions tell of
    collides = solid & ((model.geom_contype != 0) | (model.geom_conaffinity != 0))
    own = np.flatnonzero((owners == name) & collides)
    best: tuple[float, str | None] = (float("inf"), None)
    for other in dict.fromkeys(owners[(owners != name) & collides].tolist()):
        below = np.flatnonzero((owners == other) & collides).tolist()
        most = min(best[0], FAR_M)
        way = min((gaps.drop(model, data, int(geom), below, most) for geom in own), default=most)
        if way < most:
            best = (way, other)
    return best if best[1] is not None else (FAR_M, None)


def _build(request: dict[str, Any]) -> Any:
    import mujoco

    from worldkit import assets, beside_program, bodies, contacts, models

    from . import grounds

    spec = mujoco.MjSpec()
    spec.option.timestep = request["time_step"]
    spec.option.gravity = request["gravity"]
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    if request["ground"] is not None:
        ground = contacts.surface(**{k: v for k, v in request["ground"].items() if k != "density"})
        plane = mujoco.mjtGeom.mjGEOM_PLANE
        spec.worldbody.add_geom(name="ground", type=plane, size=(0, 0, 1), **ground)
    for row in request["objects"]:
        common: dict[str, Any] = {
            "name": row["name"],
            "pos": row["position"],
            "yaw_deg": row["deg_z"],
            "fixed": row["fixed"],
            "surface": contacts.surface(**row["surface"]) if row["surface"] else None,
            "mass": row["mass"],
        }
        if row["model"]:
            told = dict(row["model"])
            root = told.pop("root", "")
            with beside_program.below(Path(root)) if root else nullcontext():
                models.attach(spec, **told, **{k: v for k, v in common.items() if k != "mass"})
        elif row["asset"]:
            body = assets.add(spec, row["asset"], height=row["size"][2], **common)
            for geom in [geom for geom in body.geoms if geom.contype == 0 and geom.conaffinity == 0]:
                spec.delete(geom)
        elif row["vehicle"]:
            grounds.vehicle(spec, row)
        elif row["road"]:
            grounds.road(spec, row, request["objects"], common["surface"])
        else:
            _primitive(bodies, spec, row, common)
        if row.get("moved"):
            _move(spec.body(row["name"]), *row["moved"])
    if request["cameras"]:
        from . import visibility

        visibility.add_cameras(spec, request["cameras"])
    return spec.compile()


def _move(body: Any, rotation: Any, shift: Any) -> None:
    """Take a body, with all its parts, through x' = R x + t in the world."""
    import numpy as np

    from worldkit.turning import product, quaternion

    body.pos = np.asarray(rotation) @ np.asarray(body.pos, dtype=float) + np.asarray(shift)
    body.quat = product(quaternion(rotation), body.quat)


def _primitive(bodies: Any, spec: Any, row: dict[str, Any], common: dict[str, Any]) -> None:
    x, _, z = row["size"]
    kind = row["primitive"]
    if row["tilt_deg"]:
        common = common | {"tilt_deg": row["tilt_deg"]}
    if kind in ("cylinder", "capsule"):
        getattr(bodies, kind)(spec, diameter=x, height=z, **common)
    elif kind == "sphere":
        bodies.sphere(spec, diameter=x, **common)
    elif kind == "ellipsoid":
        bodies.ellipsoid(spec, size=row["size"], **common)
    elif kind == "compound":
        parts = [_part(values) for values in row["parts"]]
        bodies.compound(spec, parts=parts, **common)
    elif row["form"]:
        from worldkit import forms

        bodies.formed(spec, form=getattr(forms, kind)(**row["form"]), **common)
    elif kind == "box_container":
        bodies.container(spec, size=row["size"], wall=row["wall"], **common)
    else:
        bodies.box(spec, size=row["size"], **common)


def _part(values: dict[str, Any]) -> Any:
    from worldkit import contacts
    from worldkit.parts import Part

    surface = values["surface"]
    return Part(**(values | {"surface": contacts.surface(**surface) if surface else None}))


def _owner(model: Any, geom: int) -> str:
    """The object that a geom belongs to: the body at the root of its tree, for objects stand on their own here."""
    body = int(model.body_rootid[model.geom_bodyid[geom]])
    return "ground" if body == 0 else str(model.body(body).name)


class Progress:
    """Writes where the pre-roll is into a file, at most some times a second."""

    def __init__(self, path: Path) -> None:
        self.path, self.written = path, 0.0

    def __call__(self, where: str) -> None:
        """Say where it is."""
        now = time.monotonic()
        if now - self.written >= EVERY_S:
            self.written = now
            self.path.write_text(where, encoding="utf-8")


def main() -> None:
    """Read the request and answer it; what goes wrong is printed on standard error."""
    request = json.load(sys.stdin)
    try:
        result = answer(request, Progress(Path(request["out"]).with_suffix(".progress")))
    except Exception as error:  # the caller turns it into a finding
        result = {"error": f"{type(error).__name__}: {error}"}
    Path(request["out"]).write_text(json.dumps(result), encoding="utf-8")


if __name__ == "__main__":
    main()
