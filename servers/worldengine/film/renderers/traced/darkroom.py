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
SPREAD_PX = 2.5
FAR_M = 60.0
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
    sky: np.ndarray,
    places: np.ndarray,
    seen: np.ndarray,
    eye: np.ndarray,
    ways: np.ndarray,
    scene: Scene,
    told: Treatment,
) -> np.ndarray:
    """Scene light (H, W, 3) with what lies between the eye and things.

    Where a thing covers only some of a pixel, the air before it changes its share of the light, and leaves that of the sky.

    Args:
        light: scene light.
        sky: that of the surroundings (H, W, 3), which is in it where no thing is seen.
        places: what is seen behind each pixel, world frame, m (H, W, 3).
        seen: the share of each pixel that shows a thing (H, W).
        eye: of the camera, (3,).
        ways: unit viewing directions (H, W, 3).
        scene: what surrounds it.
        told: what the film asks for.
    """
    setting, light = scene.setting, np.maximum(light, 0.0)
    foggy = told.fog_rgb is not None and told.fog_density > 0
    if setting.name == "room" and told.sky_zenith is None and not foggy:
        return light
    reach = np.linalg.norm(places - eye.astype(np.float32), axis=-1)
    there, reach, places = _spread(seen > 0, reach, places)
    ground = there & (np.abs(places[..., 2] - scene.floor_z) < 1e-3 + 2e-4 * reach)
    things = light - (1.0 - seen)[..., None] * sky
    seen = _to_horizon(seen, ground & (reach > FAR_M), ways)
    open_sky = (1.0 - seen)[..., None] * sky

    def mixed(colour: np.ndarray, share: np.ndarray) -> None:
        nonlocal things
        things = things + (share * there)[..., None].astype(np.float32) * (seen[..., None] * colour - things)

    def backdrop() -> np.ndarray:
        turn = np.arctan2(ways[..., 0], ways[..., 1]) / (2 * np.pi) % 1.0
        return scene.horizon[(turn * len(scene.horizon)).astype(int) % len(scene.horizon)]

    if setting.name == "outdoor" and told.sky_zenith is None:
        mixed(HAZE, 0.9 * (1.0 - np.exp(-np.maximum(reach - 4.0, 0.0) / setting.haze_m)))
    elif told.sky_zenith is not None:
        mixed(backdrop(), 0.95 * (1.0 - np.exp(-np.maximum(reach - 12.0, 0.0) / setting.haze_m)))
    elif setting.name in ("studio", "dark"):
        away = np.linalg.norm(places[..., :2] - scene.centre[:2], axis=-1)
        mixed(
            np.zeros(3, np.float32),
            0.45 * ground * _smooth(setting.pool[0] * scene.radius, setting.pool[1] * scene.radius, away),
        )
        mixed(backdrop(), ground * _smooth(setting.fade[0] * scene.span, setting.fade[1] * scene.span, away))
    if foggy:
        fog, before_things, before_sky = _fogged(reach, ways, eye, scene, told)
        mixed(fog, before_things)
        share = before_sky[..., None].astype(np.float32)
        open_sky = open_sky + share * ((1.0 - seen)[..., None] * fog - open_sky)
        things = np.where(there[..., None], things, (1.0 - share) * things)
    return np.maximum(things + open_sky, 0.0)


def _spread(there: np.ndarray, reach: np.ndarray, places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Where things are (H, W), how far, m, and their places, spread by `SPREAD_PX` into what shows none: the samples that tell of
    places may have missed what those of light met, at the horizon above all, and the denoiser smears it by a pixel."""
    if there.all() or not there.any():
        return there, reach, places
    import cv2

    away, nearest = cv2.distanceTransformWithLabels(
        (~there).astype(np.uint8), cv2.DIST_L2, 5, labelType=cv2.DIST_LABEL_PIXEL
    )
    taken = ~there & (away < SPREAD_PX)
    owner = np.zeros(int(nearest.max()) + 1, dtype=np.int64)
    owner[nearest[there]] = np.flatnonzero(there)
    chosen = owner[nearest[taken]]
    reach, places = reach.copy(), places.copy()
    reach[taken], places[taken] = reach.ravel()[chosen], places.reshape(-1, 3)[chosen]
    return there | taken, reach, places


def _to_horizon(seen: np.ndarray, far: np.ndarray, ways: np.ndarray) -> np.ndarray:
    """The share of things (H, W), by the level line of the horizon where endless ground is `far` (H, W): a few samples are dots."""
    rows = np.flatnonzero(far.any(axis=1))
    if not len(rows) or min(far.shape) < 2:
        return seen
    some = slice(max(rows[0] - 1, 0), rows[-1] + 2)
    up = ways[some, :, 2]
    if len(up) < 2:
        return seen
    high = np.abs(np.gradient(up, axis=0)) + np.abs(np.gradient(up, axis=1))
    out = seen.copy()
    below = np.clip(0.5 - up / np.maximum(high, 1e-9), 0.0, 1.0)
    out[some] = np.where(far[some] & (np.abs(up) < high), below, seen[some])
    return out


def _fogged(
    reach: np.ndarray, ways: np.ndarray, eye: np.ndarray, scene: Scene, told: Treatment
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fog that thins with height, and glows around the light: its light (H, W, 3), how much it hides of things and of the sky."""
    key = scene.setting.key
    toward = np.maximum(ways @ np.array(key.direction), 0.0) ** 10
    fog = (linear(told.fog_rgb or (0, 0, 0)) + 0.10 * toward[..., None] * np.array(key.colour)).astype(np.float32)
    height = told.fog_height_m
    x = ways[..., 2] * reach / height
    safe = np.where(np.abs(x) < 1e-3, 1.0, x)
    mean = np.where(np.abs(x) < 1e-3, 1.0, -np.expm1(-np.clip(safe, -50, 50)) / safe)
    over = max(float(eye[2]) - scene.floor_z, 0.0)
    thing = 1.0 - np.exp(-told.fog_density * reach * np.exp(-over / height) * mean)
    high = told.fog_over_m
    sky = 1.0 - np.exp(-told.fog_density * np.exp(-over / high) * high / np.maximum(ways[..., 2], 0.002))
    return fog, thing, sky


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
