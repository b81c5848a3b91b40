"""Bake the light of the surroundings over all directions, smoothed for rough mirrors and summed for matt ones."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from OpenGL import GL

from worldkit.materials.paint import noise
from worldkit.settings import Setting

from . import gl

SIZE, LEVELS = 256, 7


@lru_cache(maxsize=1)
def noise_field() -> np.ndarray:
    """Smooth noise, uint8 (512, 512), that goes on at its other side, mean one half."""
    field = noise.spectral(512, 1.35, "surroundings", low=1.0)
    return (noise.unit(field, 2.6) * 255).astype(np.uint8)


def noise_map() -> int:
    """A tileable map of smooth noise, mean one half."""
    field = noise_field()
    handle = gl.texture(GL.GL_R8, 512, 512, repeat=True, levels=1)
    GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
    GL.glTexSubImage2D(GL.GL_TEXTURE_2D, 0, 0, 0, 512, 512, GL.GL_RED, GL.GL_UNSIGNED_BYTE, field)
    return handle


def slide_map(share: np.ndarray) -> int:
    """A slide before the key light: float (N, N), row 0 the top, clear at its edges."""
    size = len(share)
    handle = gl.texture(GL.GL_R16F, size, size, levels=6)
    GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
    GL.glTexSubImage2D(
        GL.GL_TEXTURE_2D, 0, 0, 0, size, size, GL.GL_RED, GL.GL_FLOAT, np.ascontiguousarray(share[::-1], np.float32)
    )
    GL.glGenerateMipmap(GL.GL_TEXTURE_2D)
    return handle


def _directions(size: int) -> tuple[np.ndarray, np.ndarray]:
    """Unit directions (size, size, 3) of the folded-out upper hemisphere, and the solid angle of each texel, sr."""
    axis = (np.arange(size) + 0.5) / size * 2.0 - 1.0
    qx, qy = np.meshgrid(axis, axis)
    px, py = (qx + qy) / 2.0, (qx - qy) / 2.0
    point = np.stack([px, py, 1.0 - np.abs(px) - np.abs(py)], -1)
    length = np.linalg.norm(point, axis=-1)
    # Equal areas of a face of the octahedron seen from its centre at a distance and a slant: cosine / distance^2.
    weight = length**-3.0
    return point / length[..., None], weight * (2.0 * np.pi / weight.sum())


def harmonics(radiance: np.ndarray) -> np.ndarray:
    """Nine coefficients (9, 3) of the irradiance over pi from `radiance` (N, N, 3) of the folded-out upper hemisphere.

    After Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001).
    """
    direction, weight = _directions(len(radiance))
    x, y, z = np.moveaxis(direction, -1, 0)
    basis = np.stack(
        [np.full_like(x, 0.282095), 0.488603 * y, 0.488603 * z, 0.488603 * x, 1.092548 * x * y, 1.092548 * y * z,
         0.315392 * (3 * z * z - 1), 1.092548 * x * z, 0.546274 * (x * x - y * y)]
    )  # fmt: skip
    constants = np.array([0.282095, 0.488603, 0.488603, 0.488603, 1.092548, 1.092548, 0.315392, 1.092548, 0.546274])
    share = np.array([1.0, 2 / 3, 2 / 3, 2 / 3, 0.25, 0.25, 0.25, 0.25, 0.25])
    coefficients = np.einsum("khw,hwc,hw->kc", basis, radiance, weight)
    return coefficients * (constants * share)[:, None]


def irradiance(coefficients: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Irradiance over pi on a surface facing `normal`, (3,)."""
    x, y, z = normal
    basis = np.array([1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y])
    return np.maximum(basis @ coefficients, 0.0)


def _smoothed(picture: np.ndarray) -> np.ndarray:
    """Halve, then blur a little."""
    half = picture.reshape(picture.shape[0] // 2, 2, picture.shape[1] // 2, 2, 3).mean(axis=(1, 3))
    for axis in (0, 1):
        wide = np.concatenate([half.take([0], axis), half, half.take([-1], axis)], axis=axis)
        count = half.shape[axis]
        half = 0.25 * wide.take(range(count), axis) + 0.5 * half + 0.25 * wide.take(range(2, count + 2), axis)
    return half


class Surroundings:
    """The baked surroundings of one setting.

    `map` is a texture with coarser levels for rougher surfaces, `harmonics` (9, 3) the diffuse light.
    """

    def __init__(self, setting: Setting, noise_handle: int, uniforms: dict[str, object]):
        self._noise = noise_handle
        self._target = gl.Target(SIZE, SIZE, GL.GL_RGBA32F)
        self._programs: dict[int, gl.Program] = {}
        self.map = gl.texture(GL.GL_RGB16F, SIZE, SIZE, levels=LEVELS)
        self.bake(setting, uniforms)

    def bake(self, setting: Setting, uniforms: dict[str, object]) -> None:
        """Take over the light of a setting."""
        self._target.bind()
        if setting.index not in self._programs:
            self._programs[setting.index] = gl.Program("screen.vert", "sky.frag", BAKE=1, SETTING=setting.index)
        program = self._programs[setting.index].use().set(depth=0.0, **uniforms)
        program.texture("noise_map", 3, self._noise)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        raw = GL.glReadPixels(0, 0, SIZE, SIZE, GL.GL_RGB, GL.GL_FLOAT)
        radiance = np.frombuffer(raw, dtype=np.float32).reshape(SIZE, SIZE, 3) * setting.sky
        # The lamps that glossy things mirror already light matt things as key and fills.
        self.harmonics = harmonics(np.minimum(radiance, 1.3))
        GL.glActiveTexture(gl.SCRATCH_UNIT)
        GL.glBindTexture(GL.GL_TEXTURE_2D, self.map)
        level = np.ascontiguousarray(radiance)
        for i in range(LEVELS):
            GL.glTexSubImage2D(
                GL.GL_TEXTURE_2D, i, 0, 0, level.shape[1], level.shape[0], GL.GL_RGB, GL.GL_FLOAT,
                np.ascontiguousarray(level, dtype=np.float32),
            )  # fmt: skip
            if i + 1 < LEVELS:
                level = _smoothed(level)
