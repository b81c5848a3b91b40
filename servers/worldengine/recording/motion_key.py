"""Hash what decides a motion: everything in a compiled world but cameras, lights and looks.

Two worlds of the same hash, in the same environment, move alike bit for bit, so that a repair which changes only what is
seen pays for no physics. What goes in:

- every array, size and option of the compiled model (names of physical things included), except what `LOOKS` lists:
  cameras, lights, materials, textures, colours, skins, texts, and the tables that count or name them;
- the number of steps, which of them are recorded, the seed, and the variant;
- when the program controls the simulation, or laws of its author are stepped: its source and what lies beside it, less what
  only places a camera (`drive_source`).

Where a look may decide the motion, the bytes of the whole world go in too, so that only texts may differ: a sensor that sees
(rays stop at what is drawn, camera sensors), code that might read cameras or colours. There is no hash (an empty text, and
the physics is run) where not all is known that the code could read. What a
hash claims is checked once more at acceptance, which always simulates anew and compares the trajectories.
"""

import hashlib
from typing import TYPE_CHECKING, Any

from worldkit.alike import decides, kind_names

if TYPE_CHECKING:
    import mujoco

    from .drive_source import Beside

CAMERAS = "worldkit.camera"
"""The names under which a world keeps the intent of its cameras begin so."""


def motion_key(
    model: "mujoco.MjModel",
    facts: dict[str, Any],
    control: str = "",
    source: str | None = None,
    *,
    laws: bool = False,
    beside: "Beside | None" = None,
    world: str = "",
) -> str:
    """The hash (SHA-256, hexadecimal), or an empty text where something else may decide the motion.

    Args:
        model: as it will be simulated, before anything has run.
        facts: what else decides: steps, rows, seed, variant, declared inputs; must be JSON.
        control: name of the function that gives inputs; empty when there is none.
        source: text of the program's file; needed only with `control` or `laws`.
        laws: whether laws of the author's are stepped. Which ones, only the code tells, so `beside` must be known.
        beside: what the program runs with besides its file; None: unknown.
        world: hash of the world's file; empty: unknown, and nothing is promised where a look may decide.
    """
    import json

    from .drive_source import drive_source, same_source

    drive, looks = "", _sees(model)
    if control or laws:
        drive = drive_source(source, control, beside) if beside is not None or not laws else ""
        if not drive:
            drive, looks = same_source(source, beside), True
        if not drive:
            return ""
    if looks and not world:
        return ""
    facts = {**facts, "world": world} if looks else facts
    digest = hashlib.sha256()
    digest.update(json.dumps([facts, drive, kind_names(model), _numerics(model)], sort_keys=True).encode())
    for name, value in _fields(model):
        digest.update(f"\n{name} ".encode() + value)
    return digest.hexdigest()


def _fields(model: "mujoco.MjModel") -> "list[tuple[str, bytes]]":
    """(name, bytes) of everything that enters the hash, in the order of the names."""
    import numpy as np

    found: list[tuple[str, bytes]] = []
    for holder, prefix in ((model, ""), (model.opt, "opt.")):
        for name in sorted(dir(holder)):
            if name.startswith("_") or not decides(name):
                continue
            value = getattr(holder, name)
            if isinstance(value, np.ndarray):
                found.append((prefix + name, f"{value.dtype}{value.shape}".encode() + value.tobytes()))
            elif isinstance(value, (bool, int, float, np.generic)):
                found.append((prefix + name, repr(value).encode()))
            elif isinstance(value, bytes):
                found.append((prefix + name, value))
    return found


def _numerics(model: "mujoco.MjModel") -> dict[str, list[float]]:
    """Custom numbers by name, except those that place a camera."""
    import mujoco

    found: dict[str, list[float]] = {}
    for i in range(model.nnumeric):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_NUMERIC, i) or str(i)
        if not name.startswith(CAMERAS):
            at = int(model.numeric_adr[i])
            found[name] = model.numeric_data[at : at + int(model.numeric_size[i])].tolist()
    return found


def _sees(model: "mujoco.MjModel") -> bool:
    """Whether a sensor depends on cameras or on what is drawn; a plugin may do anything, so it counts as one."""
    import mujoco

    seeing = {int(mujoco.mjtSensor.mjSENS_RANGEFINDER), int(mujoco.mjtSensor.mjSENS_CAMPROJECTION)}
    camera = int(mujoco.mjtObj.mjOBJ_CAMERA)
    kinds = {int(kind) for kind in model.sensor_type}
    objects = {int(kind) for kind in (*model.sensor_objtype, *model.sensor_reftype, *model.tuple_objtype)}
    return bool(model.nplugin) or bool(kinds & seeing) or camera in objects
