"""Bulbs: glowing balls with a lamp within, which give the lamp's light themselves, since a traced ball lets none of it out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worldkit.lights import LIGHT_GAIN

from ..preview.scenery import own_lights

if TYPE_CHECKING:
    import mujoco


def within(model: mujoco.MjModel, data: mujoco.MjData, glowing: np.ndarray) -> dict[int, list[int]]:
    """By each ball among the `glowing` geoms: the lamps within it that shine all around and go along with it."""
    import mujoco

    lamps = [light for light in own_lights(model) if model.light_type[light] == mujoco.mjtLightType.mjLIGHT_POINT]
    found, rigid = {}, model.body_weldid
    for geom in glowing[model.geom_type[glowing] == int(mujoco.mjtGeom.mjGEOM_SPHERE)]:
        held = [
            light
            for light in lamps
            if np.linalg.norm(data.light_xpos[light] - data.geom_xpos[geom]) < model.geom_size[geom, 0]
            and rigid[model.light_bodyid[light]] == rigid[model.geom_bodyid[geom]]
        ]
        if held:
            found[int(geom)] = held
    return found


def radiance(model: mujoco.MjModel, geom: int, held: list[int]) -> np.ndarray:
    """(3,): what the surface of a ball of radius r gives off as such lamps of intensity I: I / (pi r^2)."""
    light = np.asarray(model.light_diffuse[held], dtype=float).sum(axis=0)
    return np.asarray(light * LIGHT_GAIN / max(float(model.geom_size[geom, 0]), 1e-3) ** 2)
