"""Make a picture of scene light: air, the ground's melting into the backdrop, bloom, exposure, film curve, grading."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from worldkit.settings import Setting

from ...film_curve import BRIGHTEST, film_curve, gains
from ...treatment import Treatment
from ..preview.finish import linear

STEPS = 4096
HAZE = np.array([0.46, 0.57, 0.56], np.float32)
_CURVE = film_curve(BRIGHTEST * np.linspace(0.0, 1.0, STEPS) ** 4).astype(np.float32)


@dataclass(frozen=True)
class Scene:
    """What the air and the backdrop depend on besides the picture."""

    setting: Setting
    centre: np.ndarray
    radius: float
    floor_z: float
    span: float
    """The larger of the scene's radius and about half the camera's distance, m."""
    horizon: np.ndarray
    """Radiance of the surroundings at the horizon (N, 3), from +y over +x around."""


def _smooth(low: float, high: float, x: np.ndarray) -> np.ndarray:
    t = np.clip((x - low) / max(high - low, 1e-9), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def air(
    light: np.ndarray,
    places: np.ndarray,
    seen: np.ndarray,
    eye: np.ndarray,
    ways: np.ndarray,
    scene: Scene,
    told: Treatment,
) -> np.ndarray:
    """Scene light (H, W, 3) with what lies between the eye and things.

    Args:
        light: scene light.
        places: what is seen behind each pixel, world frame, m (H, W, 3).
        seen: the share of each pixel that shows a thing (H, W).
        eye: of the camera, (3,).
        ways: unit viewing directions (H, W, 3).
        scene: what surrounds it.
        told: what the film asks for.
    """
    setting, out = scene.setting, light
    foggy = told.fog_rgb is not None and told.fog_density > 0
    if setting.name == "room" and told.sky_zenith is None and not foggy:
        return light
    reach = np.linalg.norm(places - eye.astype(np.float32), axis=-1)

    def mixed(colour: np.ndarray, share: np.ndarray) -> None:
        nonlocal out
        out = out + (share * seen)[..., None].astype(np.float32) * (colour - out)

    def backdrop() -> np.ndarray:
        turn = np.arctan2(ways[..., 0], ways[..., 1]) / (2 * np.pi) % 1.0
        return scene.horizon[(turn * len(scene.horizon)).astype(int) % len(scene.horizon)]

    if setting.name == "outdoor" and told.sky_zenith is None:
        mixed(HAZE, 0.9 * (1.0 - np.exp(-np.maximum(reach - 4.0, 0.0) / setting.haze_m)))
    elif told.sky_zenith is not None:
        mixed(backdrop(), 0.95 * (1.0 - np.exp(-np.maximum(reach - 12.0, 0.0) / setting.haze_m)))
    elif setting.name in ("studio", "dark"):
        ground = np.abs(places[..., 2] - scene.floor_z) < 1e-3 + 2e-4 * reach
        away = np.linalg.norm(places[..., :2] - scene.centre[:2], axis=-1)
        mixed(
            np.zeros(3, np.float32),
            0.45 * ground * _smooth(setting.pool[0] * scene.radius, setting.pool[1] * scene.radius, away),
        )
        mixed(backdrop(), ground * _smooth(setting.fade[0] * scene.span, setting.fade[1] * scene.span, away))
    if foggy:
        out = _fogged(out, reach, ways, seen, eye, scene, told)
    return out


def _fogged(
    light: np.ndarray,
    reach: np.ndarray,
    ways: np.ndarray,
    seen: np.ndarray,
    eye: np.ndarray,
    scene: Scene,
    told: Treatment,
) -> np.ndarray:
    """Fog that thins with height, and glows around the light."""
    key = scene.setting.key
    toward = np.maximum(ways @ np.array(key.direction), 0.0) ** 10
    fog = (linear(told.fog_rgb or (0, 0, 0)) + 0.10 * toward[..., None] * np.array(key.colour)).astype(np.float32)
    height = told.fog_height_m
    x = ways[..., 2] * reach / height
    safe = np.where(np.abs(x) < 1e-3, 1.0, x)
    mean = np.where(np.abs(x) < 1e-3, 1.0, -np.expm1(-np.clip(safe, -50, 50)) / safe)
    over = max(float(eye[2]) - scene.floor_z, 0.0)
    thing = 1.0 - np.exp(-told.fog_density * reach * np.exp(-over / height) * mean)
    high = min(height, 120.0)
    sky = 1.0 - np.exp(-told.fog_density * np.exp(-over / high) * high / np.maximum(ways[..., 2], 0.002))
    share = (seen * thing + (1 - seen) * sky)[..., None].astype(np.float32)
    return light + share * (fog - light)


@lru_cache(maxsize=2)
def _vignette(width: int, height: int, strength: float) -> np.ndarray:
    """The share of light (H, W) that a lens leaves to each pixel."""
    x = ((np.arange(width) + 0.5) / width - 0.5) ** 2
    y = (((np.arange(height) + 0.5) / height - 0.5) * 0.85) ** 2
    return (1.0 - strength * _smooth(0.05, 0.62, (x[None] + y[:, None]) * 1.9)).astype(np.float32)


def develop(light: np.ndarray, setting: Setting, told: Treatment) -> np.ndarray:
    """The picture, uint8 (H, W, 3), of scene light (H, W, 3), as the preview renderer develops it."""
    import cv2

    height, width, _ = light.shape
    small = cv2.resize(light, (max(width // 16, 1), max(height // 16, 1)), interpolation=cv2.INTER_AREA)
    glow = cv2.resize(cv2.GaussianBlur(small, (0, 0), 1.2), (width, height), interpolation=cv2.INTER_LINEAR)
    share = 0.045 if told.grade_glow is None else told.grade_glow
    c = (light + np.float32(share) * (glow - light)) * gains(told.grade_temperature, told.grade_tint).astype(np.float32)
    vignette = setting.vignette if told.grade_vignette is None else told.grade_vignette
    shade = _vignette(width, height, vignette)
    c *= np.float32(setting.exposure * 2.0**told.grade_exposure_stops) * shade[..., None]
    grey = (c @ np.array([0.25, 0.6, 0.15], np.float32))[..., None]
    strong = np.maximum(np.maximum(c[..., 0], c[..., 1]), c[..., 2])
    if strong.max() > 1.0:
        c += (np.float32(0.35) * _smooth(1.0, 9.0, strong))[..., None] * (grey - c)
    c = np.maximum(grey + np.float32(1.07) * (c - grey), np.float32(0.0))
    root = np.sqrt(np.sqrt(c * np.float32(1 / BRIGHTEST)))
    index = np.minimum(root * np.float32(STEPS - 1) + np.float32(0.5), np.float32(STEPS - 1)).astype(np.int32)
    c = _CURVE[index]
    if (told.grade_contrast, told.grade_saturation, told.grade_fade) != (1.0, 1.0, 0.0):
        c = np.clip((c - 0.42) * told.grade_contrast + 0.42, 0.0, 1.0)
        grey = (c @ np.array([0.2126, 0.7152, 0.0722]))[..., None]
        c = np.clip(grey + (c - grey) * told.grade_saturation, 0.0, 1.0) * (1.0 - told.grade_fade)
    return (c * 255.0 + 0.5).astype(np.uint8)
