"""Read facts of a model that only pictures need: its setting, the space its subjects cross, its own lights."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worldkit.filming.film_bounds import MOST_PANELS
from worldkit.lights import LIGHT_GAIN
from worldkit.model_text import numbers, read
from worldkit.settings import SETTINGS, STUDIO, Setting

from ...panel_lights import Panel

if TYPE_CHECKING:
    import mujoco

SETTING_TEXT = "worldkit.setting"
SPACE_NUMERIC = "worldkit.space"
LIGHT_PREFIX = "worldkit."
MOST, MOST_FILLS = 8, 4
"""Lights of the model, and fill lights of its setting, that the shader takes; `surface.frag` has room for as many together."""


def setting_of(model: mujoco.MjModel) -> Setting | None:
    """The setting that `worldkit.scene` wrote into the model, or None for a model from elsewhere."""
    value = read(model, SETTING_TEXT)
    return SETTINGS.get(str(value.get("setting")), STUDIO) if value else None


def space_of(model: mujoco.MjModel) -> tuple[np.ndarray, np.ndarray] | None:
    """Corners (3,), m, of the space that the model's subjects cross, as `worldkit.cameras.aim` found it, or None."""
    space = numbers(model, SPACE_NUMERIC)
    if space is None or len(space) != 6 or not np.any(space):
        return None
    return np.array(space[:3]), np.array(space[3:])


def own_lights(model: mujoco.MjModel) -> list[int]:
    """Lights of the model other than those that `worldkit.scene` added for MuJoCo's own viewers, the strongest first."""
    import mujoco

    names = [mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_LIGHT, i) or "" for i in range(model.nlight)]
    found = [i for i, name in enumerate(names) if not name.startswith(LIGHT_PREFIX) and model.light_active[i]]
    return sorted(found, key=lambda i: -float(model.light_diffuse[i].sum()))


def light_rows(
    model: mujoco.MjModel, data: mujoco.MjData, setting: Setting, chosen: list[int]
) -> tuple[np.ndarray, np.ndarray, int]:
    """Fill lights and the model's own for the shader: pairs of rows (2 N, 4), aims (N, 3), and their number."""
    import mujoco

    room = MOST_FILLS + MOST
    rows, aims, count = np.zeros((2 * room, 4)), np.tile([0.0, 0.0, -1.0], (room, 1)), 0
    for fill in setting.fills[:MOST_FILLS]:
        rows[2 * count] = *fill.direction, 0.0
        rows[2 * count + 1] = *fill.colour, -1.0
        count += 1
    for light in chosen[:MOST]:
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


def panel_rows(panels: list[Panel], data: mujoco.MjData) -> np.ndarray:
    """The panels of light for the shader, (4 MOST_PANELS, 4): by fours the middle, half the width and the height, the radiance."""
    rows = np.zeros((MOST_PANELS, 4, 4))
    for number, panel in enumerate(panels[:MOST_PANELS]):
        rows[number, :, :3] = [*panel.corner(data)[:3], panel.radiance]
    return rows.reshape(-1, 4)
