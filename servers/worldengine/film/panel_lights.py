"""Panels of light in a dressed world: thin boxes before a dark back, and what they give, kept beside the model."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING, Any, NamedTuple
from weakref import WeakKeyDictionary

import numpy as np

from worldkit.cameras.views import axes
from worldkit.turning import quaternion

if TYPE_CHECKING:
    import mujoco

THICK_M, DEEP_M = 0.001, 0.008
"""What shines of a panel is so thick, from its front, the side of its own z axis, back; and so is the dark back behind it."""


class Panel(NamedTuple):
    """One panel of a model."""

    geom: int
    half: tuple[float, float]
    """Half its width and height, along the geom's x and y axes, m."""
    radiance: tuple[float, float, float]
    """Scene-linear light that its front gives off."""
    seen: bool

    def corner(self, data: mujoco.MjData) -> np.ndarray:
        """(4, 3): the middle of its front, half its width and half its height as vectors, and the way it faces; world, m."""
        axes = data.geom_xmat[self.geom].reshape(3, 3).T
        front = data.geom_xpos[self.geom] + axes[2] * THICK_M / 2
        return np.stack([front, axes[0] * self.half[0], axes[1] * self.half[1], axes[2]])


_KEPT: WeakKeyDictionary[mujoco.MjModel, list[Panel]] = WeakKeyDictionary()
"""By dressed world. It is kept here and not in the model, since a world could write there what no film has declared."""


def of_model(model: mujoco.MjModel) -> list[Panel]:
    """The panels of a dressed world, none in any other."""
    return list(_KEPT.get(model, ()))


def keep(model: mujoco.MjModel, panels: tuple[dict[str, Any], ...]) -> None:
    """Note what the panels give that were hung up in a world which is now compiled."""
    _KEPT[model] = [
        Panel(
            model.geom(f"drawn.{panel['name']}").id, (panel["size"][0] / 2, panel["size"][1] / 2),
            tuple((np.array(panel["rgb"]) ** 2.2 * _bright(panel)).tolist()), bool(panel["seen"]),
        )
        for panel in panels
    ]  # fmt: skip


def _bright(panel: dict[str, Any]) -> float:
    """From afar each lights as a lamp of its strength: its radiance is strength x pi / area."""
    return float(panel["strength"] * pi / (panel["size"][0] * panel["size"][1]))


def hang(spec: mujoco.MjSpec, panels: tuple[dict[str, Any], ...], hidden_group: int, **common: Any) -> None:
    """Add the panels of a film's description to a world; `keep` follows.

    One that is not seen lies in the hidden group. `common` are properties of all geoms that are drawn only.
    """
    import mujoco

    for panel in panels:
        name, place = f"drawn.{panel['name']}", np.array(panel["pos"])
        width, height = panel["size"]
        way = np.array(panel["towards"]) - place
        turn = axes(way / np.linalg.norm(way))
        quat = quaternion(turn)
        bright = _bright(panel)
        parts = {"": (bright, THICK_M), "/back": (0.0, DEEP_M)} if panel["seen"] else {"": (bright, THICK_M)}
        body, front = spec.body(panel["to"]) if panel["to"] else spec.worldbody, 0.0
        for part, (glow, deep) in parts.items():
            rgba = (*panel["rgb"], 1.0) if glow else (0.05, 0.05, 0.05, 1.0)
            spec.add_material(name=name + part, rgba=rgba, roughness=1.0, metallic=0.0, emission=glow, specular=0.0)
            body.add_geom(
                **common | ({} if panel["seen"] else {"group": hidden_group}), name=name + part,
                type=mujoco.mjtGeom.mjGEOM_BOX, size=(width / 2, height / 2, deep / 2), quat=quat,
                pos=place - turn[:, 2] * (front + deep / 2), material=name + part,
            )  # fmt: skip
            front += deep
