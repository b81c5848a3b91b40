"""What decides a motion: one hash over everything in a compiled world that is not a camera, a light or a look.

Two worlds of the same hash, in the same environment, move alike bit for bit, so that a repair which changes only what is
seen pays for no physics. What goes in:

- every array, size and option of the compiled model (names of physical things included), except what `LOOKS` lists:
  cameras, lights, materials, textures, colours, skins, texts, and the tables that count or name them;
- the number of steps, which of them are recorded, the seed, and the variant;
- when the program controls the simulation: its source, less what only places a camera (`drive_source`).

There is no hash (an empty text, and the physics is run) where a look may decide the motion: a sensor that sees (rays
stop at what is drawn, camera sensors), an engine callback, or control code that might read cameras or colours. What a
hash claims is checked once more at acceptance, which always simulates anew and compares the trajectories.
"""

import hashlib
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .interventions import NO_CALLBACKS, installed_callbacks

if TYPE_CHECKING:
    import mujoco

LOOKS = ("cam_", "light_", "mat_", "tex_", "skin_", "text_", "name_", "numeric_", "nskin", "ntex", "nnames", "nnumeric")
"""Beginnings of the model's fields that no force depends on."""
LOOKS_TOO = {
    "ncam", "nlight", "nmat", "nuser_cam", "npaths", "nbuffer", "names", "names_map", "paths", "signature",
    "vis", "stat", "geom_castshadow",
}  # fmt: skip
ENDINGS = ("_matid", "_rgba", "_pathadr")
CAMERAS = "worldkit.camera"
"""Beginning of the names under which a world keeps how its cameras are meant."""
NAMED = (
    "body", "jnt", "geom", "site", "flex", "mesh", "hfield", "pair", "exclude", "eq", "tendon", "actuator", "sensor",
    "tuple", "key", "plugin",
)  # fmt: skip
"""Kinds of things whose names count: control code and recordings speak of them."""


def motion_key(
    model: "mujoco.MjModel", control: Callable[..., Any] | None, facts: dict[str, Any], source: str | None
) -> str:
    """The hash (SHA-256, hexadecimal), or an empty text where looks may decide the motion.

    Args:
        model: as it will be simulated, before anything has run.
        control: the program's, if it has one.
        facts: what else decides: steps, rows, seed, variant; must be JSON.
        source: text of the program's file; needed only with `control`.
    """
    import json

    from .drive_source import drive_source

    if _sees(model) or installed_callbacks() != NO_CALLBACKS:
        return ""
    drive = ""
    if control is not None:
        drive = drive_source(source, control)
        if not drive:
            return ""
    digest = hashlib.sha256()
    digest.update(json.dumps([facts, drive, _names(model), _numerics(model)], sort_keys=True).encode())
    for name, value in _fields(model):
        digest.update(f"\n{name} ".encode() + value)
    return digest.hexdigest()


def decides(field: str) -> bool:
    """Whether a field of the model counts."""
    return not (field.startswith(LOOKS) or field.endswith(ENDINGS) or field in LOOKS_TOO)


def compared(one: "mujoco.MjModel", other: "mujoco.MjModel") -> tuple[float, str]:
    """(largest relative difference, name) over the fields that decide the motion; infinite where they cannot be compared.

    Each array is measured by its own largest number, and not below one.
    """
    import numpy as np

    worst, where = 0.0, ""
    if _names(one) != _names(other):
        return float("inf"), "the names"
    for holder, twin, prefix in ((one, other, ""), (one.opt, other.opt, "opt.")):
        for name in filter(decides, sorted(n for n in dir(holder) if not n.startswith("_"))):
            a, b = getattr(holder, name), getattr(twin, name)
            if not isinstance(a, (np.ndarray, bool, int, float, np.generic)) or name == "narena":
                continue
            a, b = np.asarray(a, float), np.asarray(b, float)
            if a.shape != b.shape:
                return float("inf"), prefix + name
            apart = float(np.max(np.abs(a - b), initial=0.0)) / max(1.0, float(np.max(np.abs(a), initial=0.0)))
            if not apart <= worst:
                worst, where = apart, prefix + name
    return worst, where


def _fields(model: "mujoco.MjModel") -> "list[tuple[str, bytes]]":
    """(name, bytes) of everything that counts, in the order of the names."""
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


def _names(model: "mujoco.MjModel") -> dict[str, list[str]]:
    """Names by kind, in the order of the ids."""
    table = bytes(model.names)
    return {
        kind: [table[at : table.index(b"\0", at)].decode(errors="replace") for at in getattr(model, f"name_{kind}adr")]
        for kind in NAMED
    }


def _numerics(model: "mujoco.MjModel") -> dict[str, list[float]]:
    """Custom numbers, by name, except those that say how a camera is placed."""
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
