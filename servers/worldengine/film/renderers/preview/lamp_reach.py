"""Choose the lamps of a model whose shadows are worth drawing, by their light on what is seen, and what casts them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

    from .things import Things

MOST_LAMPS = 4
"""Lamps with shadows; `lamps.glsl` has room for as many, with all six faces of the cube around each."""
BESIDE_M = 0.06
"""Lamps this close stand for one, and share their shadows."""
FAINT = 0.004
"""Scene light below which no shadow of a lamp would show."""
LARGEST_M = 0.3
WEIGHTS = np.array([0.2126, 0.7152, 0.0722])
AXES = ((1, 2, 0), (2, 0, 1), (0, 1, 2))
"""By the axis of a face: the coordinates that run along u, v and away from the lamp."""


@dataclass
class Lamp:
    """A lamp with shadows, or several that stand together."""

    lights: list[int]
    """Numbers among the chosen lights."""
    place: np.ndarray
    axes: np.ndarray
    """(3, 3): rows are the axes of the cube around it; of a spot, the last points against its aim."""
    light: np.ndarray
    """(N,): its scene light on each seen point, were nothing between."""
    radius: float = 0.0
    """Of what shines, m."""
    share: float = 1.0
    """How much of its shadow is drawn: less, the less it differs from the strongest lamp that has none."""

    def facing(self, points: np.ndarray) -> np.ndarray:
        """The face of the cube that each point (N, 3) is seen through: 0 to 5, for +x -x +y -y +z -z."""
        d = (points - self.place) @ self.axes.T
        axis = np.abs(d).argmax(axis=1)
        return 2 * axis + (d[np.arange(len(d)), axis] < 0)

    def clip(self, face: int, tangent: float, near: float) -> np.ndarray:
        """(4, 4) from world to the clip space of a face: depth is 1 - near / distance along its axis."""
        u, v, w = AXES[face // 2]
        side = -1.0 if face % 2 else 1.0
        rows = np.stack([side * self.axes[u], self.axes[v], side * self.axes[w]])
        view, lens = np.eye(4), np.zeros((4, 4))
        view[:3, :3], view[:3, 3] = rows, -rows @ self.place
        lens[0, 0] = lens[1, 1] = 1.0 / tangent
        lens[2, 2], lens[2, 3], lens[3, 2] = 1.0, -near, 1.0
        return lens @ view


def gather(
    model: mujoco.MjModel, rows: np.ndarray, aims: np.ndarray, chosen: list[int], seen: np.ndarray
) -> list[Lamp]:
    """The lamps that light what is seen, the strongest first, at most `MOST_LAMPS`.

    Args:
        rows: of the chosen lights for the shader (2 N, 4), see `scenery.light_rows`.
        aims: of the same (N, 3).
        chosen: the lights themselves.
        seen: points and normals of surfaces in the picture, world, m: (M, 6).
    """
    found: list[Lamp] = []
    for number, light in enumerate(chosen[: len(rows) // 2]):
        (*place, near), (*colour, cutoff) = rows[2 * number], rows[2 * number + 1]
        if near < 0.5:
            continue
        way = np.array(place) - seen[:, :3]
        d2 = (way**2).sum(axis=1)
        way /= np.sqrt(np.maximum(d2, 1e-12))[:, None]
        cone = np.clip((-way @ aims[number] - cutoff) / max(0.35 * (1.0 - cutoff), 1e-6), 0.0, 1.0)
        given = float(WEIGHTS @ colour) * cone / (0.08 + d2) * np.maximum((way * seen[:, 3:]).sum(axis=1), 0.0)
        for other in found:
            if cutoff <= -1.0 and np.linalg.norm(other.place - place) < BESIDE_M:
                other.lights.append(number)
                other.light += given
                break
        else:
            axes = np.eye(3) if cutoff <= -1.0 else _around(-aims[number])
            found.append(Lamp([number], np.array(place), axes, given, float(model.light_bulbradius[light])))
    found = [lamp for lamp in found if lamp.light.max(initial=0.0) > FAINT]
    found.sort(key=lambda lamp: -float(lamp.light.mean()))
    if len(found) > MOST_LAMPS:
        left = float(found[MOST_LAMPS].light.mean())
        for lamp in found[:MOST_LAMPS]:
            lamp.share = min(4.0 * (1.0 - left / float(lamp.light.mean())), 1.0)
    return found[:MOST_LAMPS]


def _around(back: np.ndarray) -> np.ndarray:
    """(3, 3) rows: two axes across, and `back`."""
    across = np.cross([0.0, 1.0, 0.0] if abs(back[1]) < 0.9 else [1.0, 0.0, 0.0], back)
    across /= np.linalg.norm(across)
    return np.stack([across, np.cross(back, across), back])


class Casters:
    """What may stand between a lamp and what it lights: the things of a model."""

    def __init__(self, things: Things):
        import mujoco

        self._things, kinds = things, mujoco.mjtGeom
        model, geoms = things.model, things.geoms
        self._box = model.geom_aabb[geoms]
        self._reach = np.linalg.norm(self._box[:, 3:], axis=1)
        self._reach[(model.geom_type[geoms] == int(kinds.mjGEOM_PLANE)) | (self._reach <= 0)] = np.inf
        self._glows = things.rows[:, 29] > 0
        self._kind = {kind: model.geom_type[geoms] == int(kind) for kind in (
            kinds.mjGEOM_SPHERE, kinds.mjGEOM_ELLIPSOID, kinds.mjGEOM_CAPSULE, kinds.mjGEOM_CYLINDER, kinds.mjGEOM_BOX,
        )}  # fmt: skip

    def move(self) -> None:
        """Take over where the things are now."""
        self._frames = self._things.rows[:, :12].reshape(-1, 3, 4).astype(float)
        self._middles = self._frames[:, :, 3] + np.einsum("nij,nj->ni", self._frames[:, :, :3], self._box[:, :3])
        swaying = self._things.rows[:, 39] >= 100.0
        self._spans = self._reach * np.where(swaying, 1.5, 1.0)

    def holders(self, lamp: Lamp) -> np.ndarray:
        """(N,) bool: what holds a lamp within it, and so casts no shadow: its bulb or globe, a shade that glows, its solid case.

        The lamp shines from as wide as the smallest of these glows.
        """
        import mujoco

        kinds, size = mujoco.mjtGeom, np.maximum(np.abs(self._things.rows[:, 12:16].astype(float)), 1e-9)
        near = np.linalg.norm(lamp.place - self._middles, axis=1) < self._spans + 0.02
        q = np.abs(np.einsum("nji,nj->ni", self._frames[:, :, :3], lamp.place - self._frames[:, :, 3]))
        ball = np.linalg.norm(q / size[:, :3], axis=1) < 1
        wide = np.hypot(q[:, 0], q[:, 1])
        pill = np.hypot(wide, np.maximum(q[:, 2] - size[:, 3], 0.0)) < size[:, 0]
        inside = {
            kinds.mjGEOM_SPHERE: ball, kinds.mjGEOM_ELLIPSOID: ball, kinds.mjGEOM_CAPSULE: pill,
            kinds.mjGEOM_CYLINDER: (wide < size[:, 0]) & (q[:, 2] < size[:, 2]),
            kinds.mjGEOM_BOX: (q < size[:, :3]).all(axis=1),
        }  # fmt: skip
        glowing = near & self._glows & np.isfinite(self._reach)
        if glowing.any():
            least = self._box[glowing, 3:].min(axis=1).min()
            lamp.radius = min(max(lamp.radius, float(least)), LARGEST_M)
        return glowing | np.any([self._kind[kind] & held for kind, held in inside.items()], axis=0)

    def seen_through(self, lamp: Lamp, face: int, tangent: float) -> np.ndarray:
        """(N,) bool: what lies, or may lie, within what a face shows."""
        u, v, w = AXES[face // 2]
        side = -1.0 if face % 2 else 1.0
        d = (self._middles - lamp.place) @ lamp.axes.T
        long, slant = side * d[:, w], np.hypot(1.0, tangent)
        out = np.maximum(np.abs(d[:, u]), np.abs(d[:, v])) - tangent * long  # how far it is past the face's own planes
        return (out < self._spans * slant) & (long > -self._spans)
