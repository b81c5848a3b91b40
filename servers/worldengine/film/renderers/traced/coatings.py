"""What surfaces are made of, as Mitsuba's materials: one class for all that is opaque, which keeps rays together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.materials import paint
from worldkit.materials.look import NOTHING

from ..preview.finish import Finish, model_pixels
from . import rubbed, variant

if TYPE_CHECKING:
    import mujoco

PIXELS, WIDE_PIXELS, CUBE_PIXELS, BALL_PIXELS = 512, 1024, 256, 512
CORNERS = "vertex_color"
"""The attribute of a mesh whose corners have colours of their own."""
CLEAR = 0.6
"""What is more transparent than this by its colour alone is glass; the rest is partly there."""


def encoded(linear: np.ndarray) -> np.ndarray:
    """Scene-linear colours as half floats, as they lie in textures."""
    return np.ascontiguousarray(np.clip(linear, 0.0, 0.97), dtype=np.float32)


def texture(pixels: np.ndarray) -> dict[str, Any]:
    """A texture of scene-linear pixels (H, W, 3)."""
    import mitsuba as mi

    return {"type": "bitmap", "bitmap": mi.Bitmap(encoded(pixels)), "raw": True, "format": "fp16"}


def round_picture(faces: np.ndarray, height: int = BALL_PIXELS) -> np.ndarray:
    """Six faces (6, N, N, 3) of a cube map, in OpenGL's layout, as one picture (height, 2 height, 3) over all directions."""
    import cv2

    phi = (np.arange(2 * height) + 0.5) / height * np.pi
    theta = (np.arange(height) + 0.5) / height * np.pi
    p, t = np.meshgrid(phi, theta)
    x, y, z = np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)
    most = np.argmax(np.abs(np.stack([x, y, z])), axis=0)
    out = np.zeros((height, 2 * height, 3), np.float32)
    layout = ((0, x, -z, -y), (0, -x, z, -y), (1, y, x, z), (1, -y, x, -z), (2, z, x, -y), (2, -z, -x, -y))
    for face, (axis, toward, right, down) in zip(faces, layout, strict=True):
        here = (most == axis) & (toward > 0)
        size = len(face)
        scale = np.maximum(np.abs(toward), 1e-6)
        columns = ((right / scale + 1) / 2 * size - 0.5).astype(np.float32)
        rows = ((down / scale + 1) / 2 * size - 0.5).astype(np.float32)
        found = cv2.remap(
            np.ascontiguousarray(face, np.float32), columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
        )
        out[here] = found[here]
    return out


def marked(albedo: np.ndarray, height: int = 256) -> np.ndarray:
    """A plain ball's band and two dots (height, 2 height, 3), by which its spin is seen."""
    z = np.cos((np.arange(height) + 0.5) / height * np.pi)[:, None, None]
    on = ((np.abs(z) < 0.075) | (np.abs(z) > 0.975)).astype(float)
    bright = albedo @ np.array([0.3, 0.6, 0.1])
    other = albedo * 0.30 if bright > 0.22 else albedo * 0.28 + 0.85 * 0.72
    return np.broadcast_to(albedo * (1 - on) + other * on, (height, 2 * height, 3))


class Coatings:
    """The materials of one model, made when they are first needed."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self.fades = variant.choose() != variant.PLAIN
        """Light fades in what absorbs it by the way that it goes there; computed plainly, it is tinted where it enters."""
        self._made: dict[Any, Any] = {}
        self._pictures: dict[Any, np.ndarray] = {}

    def picture(self, finish: Finish, wide: bool) -> np.ndarray | None:
        """Scene-linear pixels (H, W, 3) of what a finish shows, before its tint; None for a plain colour."""
        entry = finish.look
        if finish.texture < 0 and entry.paint is None:
            return None
        key = (entry if finish.texture < 0 else None, finish.texture, wide)
        if key not in self._pictures:
            if finish.texture >= 0:
                pixels = model_pixels(self.model, finish.texture)[..., :3]
                if entry.around:
                    side = pixels.shape[1]
                    faces = pixels.reshape(-1, side, side, 3)
                    pixels = round_picture(faces if len(faces) == 6 else np.repeat(faces[:1], 6, axis=0))
            elif entry.around:
                pixels = round_picture(paint.cube(entry, CUBE_PIXELS)[..., :3])
            else:
                pixels = paint.tile(entry, WIDE_PIXELS if wide or entry.tile_m > 1.0 else PIXELS)[..., :3]
            self._pictures[key] = ((pixels / np.float32(255.0)) ** np.float32(2.2)).astype(np.float32)
        return self._pictures[key]

    def of(
        self,
        finish: Finish,
        rgb: np.ndarray,
        alpha: float,
        *,
        ball: bool = False,
        wide: bool = False,
        sheet: bool = False,
        strip: bool = False,
        corners: bool = False,
    ) -> Any:
        """The material of a thing.

        Args:
            finish: its look, and the picture that it carries.
            rgb: its scene-linear tint, (3,).
            alpha: its opacity by its colour alone.
            ball: it is a sphere, which may carry a mark.
            wide: it is large, so its paint is finer.
            sheet: it has no thickness.
            strip: it is the worn strip along its edges.
            corners: its mesh has colours at its corners, in place of all tints and pictures.
        """
        mark = ball and finish.look.mark and finish.texture < 0 and finish.look.paint is None
        key = (finish.look, finish.texture, tuple(np.round(rgb, 4)), round(alpha, 3), mark, wide, sheet, strip, corners)
        if key not in self._made:
            import mitsuba as mi

            told = self._told(finish, np.asarray(rgb, dtype=float), alpha, mark, wide, sheet, strip, corners)
            self._made[key] = mi.load_dict(told)
        return self._made[key]

    def _told(
        self,
        finish: Finish,
        rgb: np.ndarray,
        alpha: float,
        mark: bool,
        wide: bool,
        sheet: bool,
        strip: bool,
        corners: bool,
    ) -> dict[str, Any]:
        entry = finish.look
        if entry.clear > 0 or alpha < CLEAR:
            tint: dict[str, Any] = {"type": "rgb", "value": [float(x) for x in np.clip(rgb, 0.0, 1.0) ** 0.5]}
            if corners:
                tint = {"type": "mesh_attribute", "name": CORNERS}
            if sheet:
                return {"type": "thindielectric", "int_ior": entry.index, "specular_transmittance": tint}
            faded = self.fades and entry.absorbs != NOTHING
            return {"type": "dielectric", "int_ior": entry.index} | ({} if faded else {"specular_transmittance": tint})
        pixels = None if corners else marked(rgb) if mark else self.picture(finish, wide)
        colour: dict[str, Any]
        if corners:
            colour = {"type": "mesh_attribute", "name": CORNERS}
        elif pixels is None:
            colour = {"type": "rgb", "value": [float(x) for x in np.clip(rgb, 0.0, 0.97)]}
        else:
            tinted = pixels if mark else pixels * rgb.astype(np.float32)
            colour = texture(rubbed.flaked(tinted, finish.look) if strip else tinted)
        opaque = told(colour, entry)
        if alpha < 0.997:
            return {"type": "mask", "opacity": float(alpha), "nested": opaque}
        return opaque


def told(colour: dict[str, Any], entry: Any) -> dict[str, Any]:
    """An opaque material of this colour with the other traits of a look."""
    return {
        "type": "principled", "base_color": colour, "roughness": float(np.clip(entry.roughness, 0.06, 1.0)),
        "metallic": float(entry.metallic), "clearcoat": float(min(entry.coat, 1.0)), "clearcoat_gloss": 0.92,
        "sheen": float(entry.sheen), "specular": 0.5,
    }  # fmt: skip
