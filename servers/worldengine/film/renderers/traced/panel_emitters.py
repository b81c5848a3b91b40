"""Panels of light as emitters: a rectangle where it is seen, else spots spread over it, since cameras see no spots."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...panel_lights import Panel

if TYPE_CHECKING:
    import mujoco

SIDE = 4
"""A panel that is not seen is so many spots wide and high."""
OFF_M = 0.001


def emitters(panels: list[Panel], data: mujoco.MjData) -> dict[str, dict[str, Any]]:
    """Parts of a scene, by name."""
    parts: dict[str, dict[str, Any]] = {}
    for number, panel in enumerate(panels):
        value = list(panel.radiance)
        told: dict[str, Any]
        if panel.seen:
            told = {"type": "rectangle", "emitter": {"type": "area", "radiance": {"type": "rgb", "value": value}}}
        else:
            area = 4 * panel.half[0] * panel.half[1]
            each = [channel * area / SIDE**2 for channel in value]
            told = {
                "type": "spot", "intensity": {"type": "rgb", "value": each}, "cutoff_angle": 89.0, "beam_width": 10.0,
                "sampling_weight": 1 / SIDE**2,  # together they are looked at as often as any one lamp
            }  # fmt: skip
        for name, move in _stand(number, panel, data).items():
            parts[name] = told | {"to_world": move}
    return parts


def move(scene: Any, panels: list[Panel], data: mujoco.MjData) -> None:
    """Put the panels of a scene where they are now."""
    import mitsuba as mi

    if not panels:
        return
    knobs = mi.traverse(scene)
    for number, panel in enumerate(panels):
        for name, place in _stand(number, panel, data).items():
            knobs[f"{name}.to_world"] = mi.Transform4f(place)
    knobs.update()


def _stand(number: int, panel: Panel, data: mujoco.MjData) -> dict[str, Any]:
    """Where the emitters of a panel stand, by their names."""
    import mitsuba as mi

    middle, across, up, way = panel.corner(data)
    middle = middle + OFF_M * way
    if panel.seen:
        columns = np.stack([across, up, way, middle], axis=-1)
        return {f"panel{number}": mi.ScalarTransform4f(np.vstack([columns, [0, 0, 0, 1]]))}
    steps = (np.arange(SIDE) + 0.5) / SIDE * 2 - 1
    places = [middle + x * across + y * up for x in steps for y in steps]
    head = (up / np.linalg.norm(up)).tolist()
    return {
        f"panel{number}_{k}": mi.ScalarTransform4f().look_at(
            origin=place.tolist(), target=(place + way).tolist(), up=head
        )
        for k, place in enumerate(places)
    }
