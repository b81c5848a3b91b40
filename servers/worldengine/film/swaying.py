"""Grass, leaves and cloth that are drawn only, moved by a breeze: where their corners are at a time; the same in both renderers.

A corner of weight w, m, is carried so far in a fresh breeze of 8 m/s: along the wind by gusts that travel with it, across it
by flutter, and down as it bends. The shader `swaying.glsl` says the same.
"""

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco
    import numpy as np

TEXT = "worldkit.sways"
FRESH_M_S, MOST = 8.0, 2.0
"""The speed at which weights are told, and how many times as far the strongest wind carries."""
FLAG = 100.0
"""A thing whose kind is so large sways: its kind is then the time, s, above this."""


def told(film: dict[str, Any]) -> tuple[float, float] | None:
    """The breeze of a film's description, read with distrust; a ValueError for none that may be."""
    import numpy as np

    from worldkit.filming.film_bounds import STORM_M_S

    if film.get("breeze") is None:
        return None
    wind = np.asarray(film["breeze"], dtype=float)
    if wind.shape != (2,) or not np.isfinite(wind).all() or not 0 < np.hypot(*wind) <= STORM_M_S * (1 + 1e-6):
        raise ValueError(f"a breeze is a wind of at most {STORM_M_S:g} m/s")
    return float(wind[0]), float(wind[1])


def add(spec: "mujoco.MjSpec", names: list[str]) -> None:
    """Keep in a model which geoms sway; the texture coordinates of their meshes are weight and phase."""
    if names:
        spec.add_text(name=TEXT, data=json.dumps({"geoms": names}))


def geoms(model: "mujoco.MjModel") -> set[int]:
    """The geoms that sway."""
    from worldkit.model_text import read

    told = read(model, TEXT) or {}
    return {int(model.geom(name).id) for name in told.get("geoms", ())}


def swayed(
    points: "np.ndarray", weight: "np.ndarray", phase: "np.ndarray", breeze: tuple[float, float, float]
) -> "np.ndarray":
    """How far corners at `points` (V, 3), m, are from where they stand in calm air, (V, 3) m.

    Args:
        points: in the world.
        weight: (V,) m.
        phase: (V,) radians: neighbours do not nod together.
        breeze: the wind towards x and y, m/s, and the time, s.
    """
    import numpy as np

    x, y, t = breeze
    speed = max(float(np.hypot(x, y)), 1e-9)
    along, across = np.array([x, y]) / speed, np.array([-y, x]) / speed
    u, v = points[:, :2] @ along, points[:, :2] @ across
    far = weight * min(speed / FRESH_M_S, MOST)
    gust = (
        0.55
        + 0.30 * np.sin(1.9 * t - 0.9 * u + 0.4 * v + phase)
        + 0.15 * np.sin(4.7 * t - 2.3 * u + 1.3 * v + 2 * phase)
    )
    flutter = 0.22 * np.sin(9.0 * t - 3.0 * u + 4 * phase)
    moved = np.zeros_like(points)
    moved[:, :2] = far[:, None] * (gust[:, None] * along + flutter[:, None] * across)
    moved[:, 2] = -0.4 * far * gust * gust
    return moved
