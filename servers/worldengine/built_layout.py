"""The bundle pass: a world's file, compiled by a process that never saw its program, and where things stand in it.

Leaves `layout.json`: `model_sha256` (of the compiled model, array by array), `bodies` (by name: the `parent`, and `pos`, m, and
`quat`, w x y z, world frame, as `built` and at the `start`), and `contacts` at the start: bodies that are inside each other, the
depth and the radius of the smaller geom, both in m, deepest first.
"""

import argparse
from typing import TYPE_CHECKING, Any

from .given import Given

if TYPE_CHECKING:
    import mujoco

NAME = "layout.json"
MOST_CONTACTS = 1000


def run(given: Given, options: argparse.Namespace) -> None:
    """Compile and describe.

    Raises:
        ProgramError: the file is no world, or the facts beside it are of another one.
    """
    from worldkit import world
    from worldkit.files import write_json

    from .recording.describing import fingerprint

    model = given.model()
    world.check_cast(model, given.movers, given.visual_only)
    steps = world.steps_of(model, given.duration)
    sha256 = fingerprint(model)
    write_json(options.out / NAME, {"model_sha256": sha256, **layout(model)})
    write_json(
        options.out / "result.json",
        {"ok": True, "pass": "bundle", "bodies": model.nbody - 1, "steps": steps, "model_sha256": sha256},
    )


def layout(model: "mujoco.MjModel") -> dict[str, Any]:
    """Where bodies stand as they were built and at keyframe "start", and what touches there."""
    import mujoco

    from worldkit import world
    from worldkit.naming import names

    from .recording import gaps

    built, start = mujoco.MjData(model), world.start(model)
    mujoco.mj_kinematics(model, built)
    mujoco.mj_forward(model, start)
    bodies = names(model, "body", model.nbody)
    deepest: dict[tuple[str, str], tuple[float, float]] = {}
    for geoms, distance in zip(start.contact.geom, start.contact.dist, strict=True):
        if min(geoms) < 0 or distance >= 0:  # a flex has no geom
            continue
        first, second = sorted(bodies[model.geom_bodyid[geom]] for geom in geoms)
        depth = -float(distance)
        if mujoco.mjtGeom.mjGEOM_HFIELD in model.geom_type[geoms]:  # its cells do not tell the whole depth
            depth = max(depth, -gaps.distance(model, start, int(geoms[0]), int(geoms[1]), 0.0))
        radius = min((float(r) for r in model.geom_rbound[geoms] if r > 0), default=0.0)  # a plane has none
        deepest[first, second] = max(deepest.get((first, second), (0.0, 0.0)), (depth, radius))
    contacts = sorted((pair + row for pair, row in deepest.items()), key=lambda row: -row[2])
    found: dict[str, dict[str, Any]] = {}
    for body, name in enumerate(bodies[1:], 1):
        poses = (("built", built), ("start", start))
        found[name] = {when: {"pos": d.xpos[body].tolist(), "quat": d.xquat[body].tolist()} for when, d in poses}
        found[name]["parent"] = bodies[model.body_parentid[body]]
    return {"bodies": found, "contacts": contacts[:MOST_CONTACTS]}
