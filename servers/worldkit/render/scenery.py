"""Facts about a model that only pictures need: its setting, the space its subjects cross, its own lights."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from ..settings import SETTINGS, STUDIO, Setting

if TYPE_CHECKING:
    import mujoco

SETTING_TEXT = "worldkit.setting"
SPACE_NUMERIC = "worldkit.space"
LIGHT_PREFIX = "worldkit."
LIGHT_GAIN = 1.5
"""MuJoCo's lights are sized for displays that clip at 1; ours for a film curve."""


def text(model: mujoco.MjModel, name: str) -> dict[str, Any] | None:
    """The JSON object stored in the model's text `name`, or None."""
    import mujoco

    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, name)
    if index < 0:
        return None
    start = int(model.text_adr[index])
    raw = bytes(model.text_data[start : start + int(model.text_size[index])]) if not isinstance(
        model.text_data, bytes
    ) else model.text_data[start : start + int(model.text_size[index])]  # fmt: skip
    try:
        value = json.loads(raw.rstrip(b"\0").decode())
    except (ValueError, UnicodeDecodeError):
        return None
    return value if isinstance(value, dict) else None


def setting_of(model: mujoco.MjModel) -> Setting | None:
    """The setting that `worldkit.scene` wrote into the model, or None for a model from elsewhere."""
    value = text(model, SETTING_TEXT)
    return SETTINGS.get(str(value.get("setting")), STUDIO) if value else None


def space_slot(model: mujoco.MjModel) -> slice | None:
    """Where the model keeps the corners of the space its subjects cross (6 numbers of `numeric_data`), or None."""
    import mujoco

    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, SPACE_NUMERIC)
    if index < 0 or int(model.numeric_size[index]) != 6:
        return None
    start = int(model.numeric_adr[index])
    return slice(start, start + 6)


def own_lights(model: mujoco.MjModel) -> list[int]:
    """Lights of the model other than those that `worldkit.scene` added for MuJoCo's own viewers, at most four."""
    import mujoco

    names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_LIGHT, i) or "" for i in range(model.nlight)]
    return [i for i, name in enumerate(names) if not name.startswith(LIGHT_PREFIX) and model.light_active[i]]


def light_rows(
    model: mujoco.MjModel, data: mujoco.MjData, setting: Setting, chosen: list[int]
) -> tuple[np.ndarray, np.ndarray, int]:
    """Fill lights and the model's own for the shader: pairs of rows (8, 4), aims (4, 3), and how many of four."""
    import mujoco

    rows, aims, count = np.zeros((8, 4)), np.tile([0.0, 0.0, -1.0], (4, 1)), 0
    for fill in setting.fills[:4]:
        rows[2 * count] = *fill.direction, 0.0
        rows[2 * count + 1] = *fill.colour, -1.0
        count += 1
    for light in chosen:
        if count == 4:
            break
        colour = model.light_diffuse[light] * LIGHT_GAIN
        if model.light_type[light] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL:
            rows[2 * count] = *(-data.light_xdir[light]), 0.0
            rows[2 * count + 1] = *colour, -1.0
        else:
            spot = model.light_type[light] == mujoco.mjtLightType.mjLIGHT_SPOT
            rows[2 * count] = *data.light_xpos[light], 1.0
            rows[2 * count + 1] = *colour, np.cos(np.radians(model.light_cutoff[light])) if spot else -1.0
            aims[count] = data.light_xdir[light]
        count += 1
    return rows, aims, count
