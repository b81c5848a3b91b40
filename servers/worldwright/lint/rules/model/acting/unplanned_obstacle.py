"""Something stands, lies or floats in the way that the plan does not have.

What it does: finds geoms and flexes that can touch something, and bodies that can move, and that belong to nothing in the
plan's objects; whether they can be seen or not. A flex is the plan's by the name of a thing that it is all of, not by a
name that begins like a thing beside it.

Why is this bad: what is invisible can hold, stop or steer what the claims are about; what is visible was not placed, weighed
or approved.

Use instead: an object of the plan; what is only drawn gets `contype=0, conaffinity=0, mass=0`.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import GROUND, SOUND, acted_on, changed, holder

CODE = "WM169"
SEVERITY = "error"
SCOPE = "acts"
STOP = "spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, pos=(.25, 0, .1), size=(.02, 1, .1), rgba=(0, 0, 0, 0))"


def _flex(name: str, *also: str) -> tuple[str, dict[str, object]]:
    """A case with a block of flex by the crate, and a plan that has a sheet, too."""
    made = f"f = spec.worldbody.make_flex('{name}', type='grid', dim=3, count=(2, 2, 2), spacing=(.1, .1, .1), mass=9)"
    text, plan = changed(made, "f.radius, f.rgba = 0.02, (0, 0, 0, 0)", *also)
    topology: dict = plan["topology"]  # type: ignore[assignment]
    places = topology["body_positions"] | {"sheet": {"x": 0, "y": 3, "z": 1}}
    row = {"name": "sheet", "primitive": "box", "size": [0.1, 0.1, 0.1], "material": "wood"}
    more = {"scene_objects": [*plan["scene_objects"], row], "topology": topology | {"body_positions": places}}  # type: ignore[misc]
    return text, plan | more


GOOD = (
    *SOUND,
    _flex("sheet"),
    _flex("sheet_left"),
    _flex("crate_drawn", "f.contype = f.conaffinity = 0"),
    changed("spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 1, 1), contype=0, conaffinity=0)"),
)
BAD = (
    changed(STOP),
    _flex("crate_air"),
    _flex("crate"),
    _flex("air", "f.contype = f.conaffinity = 0"),
    changed(
        "b = spec.worldbody.add_body(name='pusher', pos=(0, 0, 3))", "b.add_freejoint(); b.add_geom(size=(.1, 0, 0))"
    ),
    changed("spec.geom('crate').name = 'skin'", STOP.replace("type=", "name='crate', type=", 1)),
    changed("spec.worldbody.add_body(name='block', pos=(0, 0, 3)).add_geom(size=(.1, 0, 0))"),
)
EVIDENCE = Measured(
    "something unseen stops the crate",
    lambda s: float(after(s, 0.5)[1].body("crate").xpos[0]),
    0.01,
    "m",
    bad=changed(STOP)[0],
    good=changed()[0],
)
FIX = "make it an object of the plan (`worldwright plan complete` writes it down), or draw it without contact and mass"


def check(view: ModelView) -> Iterator[Problem]:
    """Check geoms of the world and of unknown bodies; unknown bodies that move; flexes."""
    assert view.planned is not None and view.plan is not None
    named = {*view.plan.object_names(), *acted_on(view.plan, "mocap", "pose")}
    flexed = {int(body) for body in view.flex_vertbodyid}
    there = view.planned.texts["names"]["geom"]
    ground = {name for name, body in zip(there, view.planned.geom_bodyid, strict=True) if body == 0}
    for geom in np.flatnonzero(view.collides):
        body = int(view.geom_bodyid[geom])
        known = holder(view, body) != GROUND or (body == 0 and view.texts["names"]["geom"][geom] in ground)
        if not known and view.texts["names"]["body"][body] not in named:
            kind = view.geom_kind[geom]
            seen = "" if view.visible[geom] else ", which nobody can see,"
            message = f"{view.name('geom', int(geom))} ({kind}){seen} can be touched, and is nothing of the plan's"
            yield view.at("geom", int(geom), message, FIX)
    for body in range(1, len(view.body_mass)):
        loose = view.moving[body] and int(view.body_parentid[body]) == 0 and body not in flexed
        if loose and holder(view, body) == GROUND and view.texts["names"]["body"][body] not in named:
            yield view.at("body", body, f"{view.name('body', body)} can move, and is nothing of the plan's", FIX)
    planned = {*view.planned.texts["names"]["flex"]}
    solid = {holder(view, int(body)) for body in view.geom_bodyid[view.collides]}
    for flex, name in enumerate(view.texts["names"]["flex"]):
        touchable = view.flex_contype[flex] or view.flex_conaffinity[flex]
        things = named - solid if touchable else named
        if name not in planned and not any(name == it or name.startswith((f"{it}_", f"{it}/")) for it in things):
            yield view.at("flex", flex, f"{view.name('flex', flex)} is nothing of the plan's", FIX)
