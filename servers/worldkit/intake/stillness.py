"""Whether a thing stands still on a floor, and whether what is dropped into its cavity stays there: measured by stepping."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import mujoco

SECONDS, STEP_S = 5.0, 0.002
TILT_DEG, DRIFT, STILL = 3.0, 0.02, 0.002
"""It stands when it leans by less, has moved by less of its size, and in the last second moves by less of its size."""
DEEP, WIDE = 0.2, 0.12
"""A cavity is deeper than this share of the height, and wider at its floor than this share of the width."""
RAYS = 15
BALL = 0.45
"""Diameter of the ball that is dropped, as a share of the cavity's width."""


def stood(key: str, *, moving: bool = False) -> dict[str, Any]:
    """Stand an asset on a floor for five seconds; with `moving`, by its `moving.xml`, whose parts may swing as they stand.

    Returns:
        `stands`, `tilt_deg`, `drift_m` from where it was put, and `moves_m` in the last second.
    """
    import mujoco

    model, data, height = _world(key, moving=moving)
    body = model.body("thing").id
    steps, last = round(SECONDS / STEP_S), round(1.0 / STEP_S)
    began = data.xpos[body].copy()
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for step in range(steps):
        mujoco.mj_step(model, data)
        if step >= steps - last:
            low, high = np.minimum(low, data.xpos[body]), np.maximum(high, data.xpos[body])
    if _diverged(data):
        return {"stands": False, "why": "its motion diverged"}
    own = model.body_rootid[model.geom_bodyid] == body
    size = float(max(height, 2 * model.geom_rbound[own].max()))
    tilt = float(np.degrees(np.arccos(np.clip(data.xmat[body].reshape(3, 3)[2, 2], -1, 1))))
    drift = float(np.linalg.norm(data.xpos[body] - began))
    moves = float(np.linalg.norm(high - low))
    stands = tilt < TILT_DEG and drift < DRIFT * size + 1e-3 and moves < STILL * size + 1e-4
    return {"stands": stands, "tilt_deg": round(tilt, 2), "drift_m": round(drift, 5), "moves_m": round(moves, 6)}


def cavity(key: str) -> dict[str, Any] | None:
    """The cavity that is open above the middle of an asset, as its collision pieces leave it; None without one.

    Returns:
        `z` of its floor above the lowest point, `width` there, and `holds`: whether a ball dropped into it rests within.
    """
    import mujoco

    model, data, height = _world(key)
    body = model.body("thing").id
    half = model.geom_rbound[model.geom_bodyid == body].max()
    group = np.zeros(6, np.uint8)
    group[3] = 1  # collision pieces
    spread = np.linspace(-1, 1, RAYS) * half

    def floor(x: float, y: float) -> float:
        hit = np.zeros(1, np.int32)
        far = mujoco.mj_ray(model, data, np.array([x, y, 2 * height]), np.array([0.0, 0.0, -1.0]), group, 1, -1, hit)
        return 2 * height - far if far >= 0 and model.geom_bodyid[hit[0]] == body else 0.0

    tops = np.array([[floor(x, y) for x in spread] for y in spread])
    near = 0.02 * half  # several, since one may fall between two pieces
    middle = max(floor(x * near, y * near) for x, y in ((0, 0), (1, 0.6), (-0.6, 1), (-1, -0.6), (0.6, -1)))
    rim = float(tops.max())
    if not 0 < middle < rim - DEEP * height:
        return None
    free = []
    for angle in np.arange(12) * np.pi / 6:  # how far one may go on the floor before it rises
        reach = 0.0
        while reach < half and floor(reach * np.cos(angle), reach * np.sin(angle)) < middle + 0.25 * (rim - middle):
            reach += half / 40
        free.append(reach)
    width = 2 * float(min(free))
    if width < WIDE * 2 * half or max(free) >= half:
        return None
    found = {"z": round(middle, 5), "width": round(width, 5)}
    return found | _dropped(key, middle, width, rim)


def _dropped(key: str, floor: float, width: float, rim: float) -> dict[str, Any]:
    """Drop a ball into the cavity and see where it is after three seconds."""
    import mujoco

    diameter = BALL * width
    model, data, _ = _world(key, diameter, rim)
    ball, thing = model.body("ball").id, model.body("thing").id
    for _ in range(round(3.0 / STEP_S)):
        mujoco.mj_step(model, data)
    if _diverged(data):
        return {"holds": False, "ball_m": round(diameter, 5), "why": "its motion diverged"}
    bodies = {frozenset(int(model.geom_bodyid[g]) for g in pair) for pair in data.contact.geom[: data.ncon]}
    where = data.xpos[ball] - data.xpos[thing]
    low = float(where[2]) - diameter / 2 + float(data.xpos[thing][2])
    inside = float(np.linalg.norm(where[:2])) < width / 2 and floor - 0.1 * diameter < low < rim
    touches = frozenset((ball, thing)) in bodies
    return {"holds": bool(inside and touches), "ball_m": round(diameter, 5), "rests_at_m": round(low, 5)}


def _diverged(data: "mujoco.MjData") -> bool:
    """Whether a position, a velocity or an acceleration became no number, or a huge one."""
    import mujoco

    kinds = mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADQVEL, mujoco.mjtWarning.mjWARN_BADQACC
    return any(data.warning[int(kind)].number for kind in kinds) or not np.isfinite(data.qpos).all()


def _world(
    key: str, ball: float = 0.0, above: float = 0.0, *, moving: bool = False
) -> "tuple[mujoco.MjModel, mujoco.MjData, float]":
    """An asset loose on a floor, and a ball of wood over it if one is wanted."""
    import mujoco

    from .. import assets, contacts, models, scene
    from .moving_parts import FILE

    spec = scene.new("stand", time_step=STEP_S)
    asset = assets.find(key)
    height = asset.metric_height
    if moving:
        text = (asset.folder / FILE).read_text(encoding="utf-8")
        models.attach(spec, text, name="thing", pos=(0, 0, height / 2), folder=key)
    else:
        assets.add(spec, key, name="thing", height=height, pos=(0, 0, height / 2))
    if ball:
        body = spec.worldbody.add_body(name="ball", pos=(0, 0, above + 0.6 * ball))
        body.add_freejoint()
        given = contacts.surface(friction=0.5, rolling=0.02 * ball, restitution=0.1, density=700)
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(ball / 2, 0, 0), **given)
    # Else MuJoCo puts what diverged back to where it began, where it would stand.
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data, height


def picture(key: str, out: Path) -> None:
    """Leave a world with the asset and one camera, to be drawn elsewhere: `world.mjz`, `program.json`."""
    from .. import asked, assets, cameras, scene

    spec = scene.new("thumbnail", time_step=STEP_S, setting="studio")
    height = assets.find(key).metric_height
    assets.add(spec, key, name="thing", height=height, pos=(0, 0, height / 2), fixed=True)
    cameras.add(spec, "thumbnail", view="perspective", subjects=("thing",), fovy=28)
    asked.Asked(lambda: spec, None, 0.01, 24, (256, 256), (), 0, (), 1, 0, None).write(out)
