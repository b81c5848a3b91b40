"""Build the walls of the `room` setting, which are drawn around the scene and its cameras and never simulated.

They are scenery like the sky: they belong to the picture, not to the model, cannot be touched, and cast no shadow.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from worldkit.materials import look

from .finish import Finish, linear
from .things import FLOATS, SIDE_MODE, Batch

Vector = tuple[float, float, float]
Rgba = tuple[float, float, float, float]


class Panel(NamedTuple):
    """An axis-aligned box of scenery."""

    centre: Vector
    half: Vector
    look: str
    rgba: Rgba


WALL = (0.835, 0.815, 0.775, 1.0)
DADO = (0.46, 0.535, 0.525, 1.0)
TRIM = (0.90, 0.89, 0.865, 1.0)
CEILING = (0.90, 0.895, 0.88, 1.0)


def extent(low: np.ndarray, high: np.ndarray, eyes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Corners (3,) of a room that holds the box (`low`, `high`) and the cameras `eyes` (N, 3), with space to spare, m."""
    low, high = low.copy(), high.copy()
    size = float(np.max(high - low))
    margin = np.array([max(1.1, 0.45 * size)] * 2 + [max(0.7, 0.3 * size)])
    low[:2] -= margin[:2]
    high += margin
    if len(eyes):
        low[:2] = np.minimum(low[:2], eyes[:, :2].min(axis=0) - 0.5)
        high = np.maximum(high, eyes.max(axis=0) + np.array([0.5, 0.5, 0.4]))
    least = np.array([2.0, 2.0])
    middle = 0.5 * (low[:2] + high[:2])
    low[:2] = np.minimum(low[:2], middle - least)
    high[:2] = np.maximum(high[:2], middle + least)
    low[2] = 0.0
    high[2] = max(high[2], 2.6)
    return low, high


def panels(low: np.ndarray, high: np.ndarray, floor_z: float, window_azimuth_deg: float) -> list[Panel]:
    """Make walls with dado and skirting, a ceiling, and a window toward the key light."""
    x0, y0, _ = (float(v) for v in low)
    x1, y1, z1 = (float(v) for v in high)
    z0 = floor_z
    mx, my = (x0 + x1) / 2, (y0 + y1) / 2
    hx, hy, hz = (x1 - x0) / 2, (y1 - y0) / 2, (z1 - z0) / 2
    t = 0.05
    out: list[Panel] = [Panel((mx, my, z1 + t), (hx + t, hy + t, t), "plaster", CEILING)]
    dado = min(0.95, 0.38 * (z1 - z0))
    for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
        edge = (x1 if sign > 0 else x0) if axis == 0 else (y1 if sign > 0 else y0)

        def slab(
            out_m: float, low_z: float, high_z: float, axis: int = axis, sign: int = sign, edge: float = edge
        ) -> tuple[Vector, Vector]:
            # A box whose inner face stands `out_m` in front of the wall.
            place = edge + sign * (t - out_m)
            centre = (place, my, (low_z + high_z) / 2) if axis == 0 else (mx, place, (low_z + high_z) / 2)
            half = (t, hy + t, (high_z - low_z) / 2) if axis == 0 else (hx + t, t, (high_z - low_z) / 2)
            return centre, half

        for out_m, low_z, high_z, name, colour in (
            (0.0, z0, z1, "plaster", WALL),
            (0.008, z0, z0 + dado, "plaster", DADO),
            (0.026, z0 + dado, z0 + dado + 0.045, "plastic_white", TRIM),
            (0.020, z0, z0 + 0.13, "plastic_white", TRIM),
            (0.045, z1 - 0.09, z1, "plastic_white", TRIM),
        ):
            centre, half = slab(out_m, low_z, high_z)
            out.append(Panel(centre, half, name, colour))
    angle = np.radians(window_azimuth_deg)
    axis = 0 if abs(np.cos(angle)) > abs(np.sin(angle)) else 1
    sign = 1.0 if (np.cos(angle), np.sin(angle))[axis] > 0 else -1.0
    edge = ((x1 if sign > 0 else x0), (y1 if sign > 0 else y0))[axis]
    wide, tall = min(0.75, 0.5 * (hy, hx)[axis]), min(0.62, 0.3 * hz * 2)
    middle_z = z0 + dado + 0.12 + tall

    def pane(along: float, up: float, half_along: float, half_up: float, depth: float, look: str, rgba: Rgba) -> Panel:
        place = edge - sign * depth / 2
        if axis == 0:
            return Panel((place, my + along, middle_z + up), (depth / 2, half_along, half_up), look, rgba)
        return Panel((mx + along, place, middle_z + up), (half_along, depth / 2, half_up), look, rgba)

    out.append(pane(0, 0, wide, tall, 0.012, "window_light", (0.86, 0.93, 1.0, 1.0)))
    for along in (-wide, 0.0, wide):
        out.append(pane(along, 0, 0.03, tall + 0.03, 0.06, "plastic_white", TRIM))
    for up in (-tall, 0.18 * tall, tall):
        out.append(pane(0, up, wide + 0.03, 0.03, 0.06, "plastic_white", TRIM))
    out.append(pane(0, -tall - 0.05, wide + 0.10, 0.02, 0.16, "plastic_white", TRIM))
    return out


def batches(
    panels: list[Panel], start: int, ground: tuple[float, float, float], floor_z: float
) -> tuple[list[Batch], np.ndarray]:
    """Batches of the panels by look, and their rows (N, 40) from row `start` on; `ground` is the mean colour of what they stand on."""
    rows: list[np.ndarray] = []
    walls = []
    for name in sorted({panel.look for panel in panels}):
        entry = look("plastic_white" if name == "window_light" else name)
        batch = Batch(("box", -1), Finish(entry), False, first=start + len(rows))
        for panel in (p for p in panels if p.look == name):
            row = np.zeros(FLOATS, dtype=np.float32)
            row[[0, 5, 10]] = 1.0
            row[[3, 7, 11]] = panel.centre
            row[12:15] = panel.half
            row[16:20] = *linear(panel.rgba[:3]), 1.0
            row[20:24] = entry.roughness, 0.0, entry.coat, 0.0
            row[24:28] = 1.0 / entry.tile_m, entry.relief_m, SIDE_MODE, 0.0
            row[28:32] = -1.0, 4.5 if name == "window_light" else 0.0, 0.0, 0.004
            row[32:36] = *ground, floor_z
            row[36:40] = 0.0, 0.0, 1e3, 0.0
            rows.append(row)
            batch.rows.append(batch.first + len(batch.rows))
        walls.append(batch)
    return walls, np.array(rows)
