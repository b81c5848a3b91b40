"""Where the light comes from: the surroundings as a picture around everything, the key light as a disk, lamps of the world."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.lights import LIGHT_GAIN
from worldkit.settings import Setting

from ...gobos import REACH, Gobo, slide
from ...treatment import Treatment
from ..preview import sky_maps

if TYPE_CHECKING:
    import mujoco

SEEN_WIDTH, SOFT_WIDTH = 2048, 256
"""Pixels around: of surroundings that are seen, and of those that only light a room."""
BRIGHTEST = 1.3
"""The lamps that glossy things mirror already light everything as key and fills."""
LOBE = 8.0
"""A fill is so broad: its radiance falls with this power of the cosine."""
SHARE = {"studio": 1.0, "room": 0.97, "outdoor": 1.0, "dark": 1.0}
"""What is left to the surroundings where light that comes back from floor and walls is traced."""
AWAY = 60.0
"""The key light is so many radii of the scene away."""
POINTS, GOLDEN_ANGLE = 12, 2.3999632
"""Through a slide the key light shines from so many points of its disk, each turned by this angle from the one before."""
GROUND_M, STEEP = 1000.0, 3.0
"""Beside a slide light shines on all of the scene and so far over endless ground, from so many times as far away at least."""
RING, BESIDE = 256, (0.25, 0.1)
"""It is thrown by rings with a hole, each so many times as wide as that at most; the first and those around it are looked at so often,
where the slide is looked at once."""


def directions(width: int) -> np.ndarray:
    """Unit directions (width / 2, width, 3) of the pixels of a picture around everything, as `sky_maps` has them."""
    turn = (np.arange(width) + 0.5) / width * 2 * np.pi
    down = (np.arange(width // 2) + 0.5) / (width // 2) * np.pi
    p, t = np.meshgrid(turn, down)
    return np.stack([np.sin(t) * np.sin(p), np.sin(t) * np.cos(p), np.cos(t)], -1)


def seen(setting: Setting, told: Treatment) -> np.ndarray:
    """Radiance (N, 2 N, 3) of the surroundings as a camera sees them."""
    return sky_maps.draw(setting, told, SEEN_WIDTH, lamps=False)


def lighting(setting: Setting, told: Treatment, shown: np.ndarray) -> np.ndarray:
    """Radiance of the surroundings as they light things, with the fill lights of the setting as broad glows."""
    if setting.name == "outdoor" or told.sky_zenith is not None:
        return np.minimum(shown, BRIGHTEST)
    picture = SHARE[setting.name] * np.minimum(sky_maps.draw(setting, told, SOFT_WIDTH, lamps=True), BRIGHTEST)
    around = directions(picture.shape[1])
    for fill in setting.fills:
        toward = np.maximum(around @ np.array(fill.direction), 0.0) ** LOBE
        picture += (toward[..., None] * np.array(fill.colour) * (LOBE + 2) / 2).astype(np.float32)
    return picture


def looked_up(picture: np.ndarray, ways: np.ndarray) -> np.ndarray:
    """The radiance (H, W, 3) of surroundings (N, 2 N, 3) along unit directions (H, W, 3), between pixels as Mitsuba has it."""
    import cv2

    height, width, _ = picture.shape
    turn = np.arctan2(ways[..., 0], ways[..., 1]) / (2 * np.pi) % 1.0
    down = np.arccos(np.clip(ways[..., 2], -1.0, 1.0)) / np.pi
    wide = np.concatenate([picture[:, -1:], picture, picture[:, :1]], axis=1)
    # Mitsuba lays the middles of columns between the degrees, and the first and the last row on the poles.
    at = (turn * width + 0.5).astype(np.float32), (down * (height - 1)).astype(np.float32)
    return np.asarray(cv2.remap(np.ascontiguousarray(wide, np.float32), *at, cv2.INTER_LINEAR))


def environment(picture: np.ndarray) -> dict[str, Any]:
    """The surroundings as a light."""
    import mitsuba as mi

    turn = mi.ScalarTransform4f().rotate([1, 0, 0], 90)
    return {"type": "envmap", "bitmap": mi.Bitmap(np.ascontiguousarray(picture, np.float32)), "to_world": turn}


def key_disk(setting: Setting, centre: np.ndarray, radius: float) -> tuple[np.ndarray, float]:
    """The middle (3,) and the radius of the disk that the key light of a scene of this centre and radius is, m."""
    return centre + AWAY * radius * np.array(setting.key.direction), AWAY * radius * max(setting.key_spread, 0.008)


def key_light(setting: Setting, centre: np.ndarray, radius: float) -> dict[str, Any]:
    """The key light: a disk of its spread, by which a white surface that faces it has the radiance of its colour."""
    import mitsuba as mi

    way = np.array(setting.key.direction)
    spread = max(setting.key_spread, 0.008)
    place, wide = key_disk(setting, centre, radius)
    up = [0, 0, 1] if abs(way[2]) < 0.99 else [0, 1, 0]
    move = mi.ScalarTransform4f().look_at(origin=place.tolist(), target=centre.tolist(), up=up)
    radiance = (np.array(setting.key.colour) / spread**2).tolist()
    return {
        "type": "disk", "to_world": move @ mi.ScalarTransform4f().scale(wide),
        "emitter": {"type": "area", "radiance": {"type": "rgb", "value": radiance}},
    }  # fmt: skip


def key_lights(setting: Setting, centre: np.ndarray, radius: float, gobo: Gobo | None) -> dict[str, dict[str, Any]]:
    """The key light, or what shines in its stead through a slide: points all over its disk, each of which throws the slide
    onto the scene, and what goes by beside it."""
    if gobo is None:
        return {"key": key_light(setting, centre, radius)}
    import mitsuba as mi

    spread, across = max(setting.key_spread, 0.008), gobo.across(np.array(setting.key.direction))
    half = REACH * gobo.size_m
    turn = across[:, :3] * np.array([[half], [half], [1.0]])
    middle = np.array(gobo.at)
    far = max(float(np.linalg.norm(centre - middle)) + radius, GROUND_M)
    away = max(AWAY * max(radius, half), STEEP * far)
    colour = np.array(setting.key.colour)
    share = slide(gobo.kind, gobo.seed, setting.key_spread)
    through = mi.load_dict(_thrown(share[..., None] * colour, "bilinear"))
    thrown = [("key", through, half, 1.0)]
    for ring, times in enumerate(rings(half, far)):
        around = np.ones((2 * times, 2 * times, 1))
        around[times - 1 : times + 1, times - 1 : times + 1] = 0.0
        beside = mi.load_dict(_thrown(around * colour, "nearest"))
        thrown.append((f"beside{ring}_", beside, times * thrown[-1][2], BESIDE[min(ring, 1)]))
    found: dict[str, dict[str, Any]] = {}
    for number in range(POINTS):
        out, angle = np.sqrt((number + 0.5) / POINTS) * spread * away, number * GOLDEN_ANGLE
        place = middle - away * turn[2] + out * (np.cos(angle) * turn[0] + np.sin(angle) * turn[1])
        move = mi.ScalarTransform4f().look_at(origin=place.tolist(), target=middle.tolist(), up=turn[1].tolist())
        for name, image, wide, often in thrown:
            found[f"{name}{number}"] = {
                "type": "projector", "to_world": move, "irradiance": image, "scale": float(away**2 / POINTS),
                "fov": float(2 * np.degrees(np.arctan(wide / away))), "sampling_weight": often / POINTS,
            }  # fmt: skip
    return found


def rings(half: float, far: float) -> list[int]:
    """How many times as wide as what is within it each ring of light around a slide of half width `half` is, so that they reach `far`, m."""
    found = []
    while half < far:
        found.append(min(RING, int(np.ceil(far / half))))
        half *= found[-1]
    return found


def _thrown(picture: np.ndarray, filtering: str) -> dict[str, Any]:
    import mitsuba as mi

    bitmap = mi.Bitmap(np.ascontiguousarray(picture, np.float32))
    return {"type": "bitmap", "bitmap": bitmap, "raw": True, "filter_type": filtering, "wrap_mode": "clamp"}


def lamps(model: mujoco.MjModel, data: mujoco.MjData, chosen: list[int]) -> dict[str, dict[str, Any]]:
    """The world's own lights where they stand now, by name."""
    import mujoco

    found: dict[str, dict[str, Any]] = {}
    for light in chosen:
        colour = np.asarray(model.light_diffuse[light], dtype=float) * LIGHT_GAIN * np.pi
        value, kind = {"type": "rgb", "value": colour.tolist()}, model.light_type[light]
        told: dict[str, Any] = {"type": "point", "intensity": value}
        if kind == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL:
            told = {"type": "directional", "irradiance": value}
        elif kind == mujoco.mjtLightType.mjLIGHT_SPOT:
            cutoff = float(np.clip(model.light_cutoff[light], 1.0, 89.0))
            told = {"type": "spot", "intensity": value, "cutoff_angle": cutoff}
        found[f"lamp{light}"] = told | _stands(model, data, light)
    return found


def _stands(model: mujoco.MjModel, data: mujoco.MjData, light: int) -> dict[str, Any]:
    """Where a light stands: its `position`, or `to_world` where it has a direction."""
    import mitsuba as mi
    import mujoco

    kinds, place, way = mujoco.mjtLightType, data.light_xpos[light], data.light_xdir[light]
    if not any(model.light_type[light] == kind for kind in (kinds.mjLIGHT_DIRECTIONAL, kinds.mjLIGHT_SPOT)):
        return {"position": place.tolist()}
    up = [0, 0, 1] if abs(way[2]) < 0.99 else [0, 1, 0]
    return {"to_world": mi.ScalarTransform4f().look_at(origin=place.tolist(), target=(place + way).tolist(), up=up)}


def move(scene: Any, model: mujoco.MjModel, data: mujoco.MjData, chosen: list[int]) -> None:
    """Put the world's own lights of a scene where they stand now."""
    import mitsuba as mi

    knobs = mi.traverse(scene)
    for light in chosen:
        for name, value in _stands(model, data, light).items():
            knobs[f"lamp{light}.{name}"] = mi.Point3f(value) if name == "position" else mi.Transform4f(value)
    knobs.update()
