"""Find the finish of each material of a model: a look of the library, or a translation of MuJoCo's own numbers."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from worldkit.materials import look
from worldkit.materials.look import Look

if TYPE_CHECKING:
    import mujoco


def linear(rgb: np.ndarray | tuple[float, ...]) -> np.ndarray:
    """Convert sRGB to scene-linear colour, by the same power as the shaders."""
    return np.clip(np.asarray(rgb, dtype=float), 0.0, None) ** 2.2


@dataclass(frozen=True)
class Finish:
    """A look, the picture it carries, and its mean colour."""

    look: Look
    texture: int = -1
    """The texture of the model to show, or -1 for the look's own paint, if any."""
    repeat: tuple[float, float] = (1.0, 1.0)
    uniform: bool = False
    mean: tuple[float, float, float] = (0.5, 0.5, 0.5)
    """Scene-linear colour over the whole surface."""


def _known(name: str) -> Look | None:
    try:
        return look(name.rsplit("/", 1)[-1])
    except ValueError:
        return None


def model_pixels(model: mujoco.MjModel, texture: int) -> np.ndarray:
    """A texture of the model as uint8 (H, W, 4), with a full last channel."""
    width, height, channels = (int(a[texture]) for a in (model.tex_width, model.tex_height, model.tex_nchannel))
    start = int(model.tex_adr[texture])
    data = model.tex_data[start : start + width * height * channels].reshape(height, width, channels)
    rgb = np.repeat(data[..., :1], 3, axis=2) if channels < 3 else data[..., :3]
    return np.concatenate([rgb, np.full((height, width, 1), 255, dtype=np.uint8)], axis=-1)


def _mean(entry: Look) -> np.ndarray:
    tint = linear(entry.rgba[:3])
    if entry.paint is None:
        return tint
    from worldkit.materials import paint

    pixels = paint.cube(entry, 32) if entry.around else paint.tile(entry, 64)
    return tint * linear(pixels[..., :3].reshape(-1, 3) / 255.0).mean(axis=0)


def plain(rgba: np.ndarray | tuple[float, ...]) -> Finish:
    """The finish of a geom without a material: satin plastic of its colour."""
    r, g, b, a = (float(x) for x in rgba)
    entry = Look("", rgba=(r, g, b, a), roughness=0.42, coat=0.06, mark=True)
    return Finish(entry, mean=tuple(linear((r, g, b))))


def of_material(model: mujoco.MjModel, material: int) -> Finish:
    """The finish of a material of the model."""
    import mujoco

    name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_MATERIAL, material) or ""
    entry = _known(name)
    if entry is not None:
        return Finish(entry, mean=tuple(_mean(entry)))
    rgba = tuple(float(x) for x in model.mat_rgba[material])
    shininess = float(model.mat_shininess[material])
    rough, metal = float(model.mat_roughness[material]), float(model.mat_metallic[material])
    entry = Look(
        "",
        rgba=rgba,
        roughness=rough if rough >= 0 else float(np.clip(0.85 - 0.7 * shininess, 0.06, 1.0)),
        metallic=max(metal, 0.0),
        coat=float(np.clip(0.5 * model.mat_specular[material] * shininess + model.mat_reflectance[material], 0.0, 1.0)),
        emission=float(model.mat_emission[material]),
    )
    texture = int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGB])
    if texture < 0:
        texture = int(model.mat_texid[material, mujoco.mjtTextureRole.mjTEXROLE_RGBA])
    mean = linear(rgba[:3])
    if texture >= 0:
        pixels = model_pixels(model, texture)
        step = max(1, pixels.shape[0] // 64)
        mean = mean * linear(pixels[::step, ::step, :3].reshape(-1, 3) / 255.0).mean(axis=0)
        entry = replace(entry, around=bool(model.tex_type[texture] == mujoco.mjtTexture.mjTEXTURE_CUBE))
    repeat = model.mat_texrepeat[material]
    return Finish(
        entry, texture, (float(repeat[0]), float(repeat[1])), bool(model.mat_texuniform[material]), tuple(mean)
    )
