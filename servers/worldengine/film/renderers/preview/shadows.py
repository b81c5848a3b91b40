"""The shadow map of the key light, and the bounds of its blocks that let most pixels skip the soft filter."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from OpenGL import GL

from . import gl
from .eye import View

BLOCK = 16
WIDEST = 6.0 * 16 / 2048
"""The radius of the widest penumbra, as a share of the map."""


def frame_of(direction: np.ndarray) -> np.ndarray:
    """(3, 3) rows: two axes across the light, and the axis along it, away from the light."""
    along = -np.asarray(direction, dtype=float)
    side = np.cross(along, [0.0, 0.0, 1.0] if abs(along[2]) < 0.95 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    return np.stack([side, np.cross(along, side), along])


def steady(radius: float) -> float:
    """The next larger power of the square root of two, so that the map's scale does not creep from frame to frame."""
    return float(2.0 ** (np.ceil(2.0 * np.log2(max(radius, 1e-4))) / 2.0))


def covered(view: View, whole: tuple[np.ndarray, float], focus_m: float = 0.0) -> tuple[np.ndarray, float]:
    """The disc, its middle and radius, m, that the map should cover: the whole scene, or the part that the camera sees.

    Around what it focuses on, if anything: hills on the horizon must not make the map so wide that a pole near by is thinner
    than one of its pixels, and throws no shadow.
    """
    centre, radius = whole
    along = focus_m or float(np.clip((centre - view.eye) @ view.forward, 0.05 * radius, 4.0 * radius))
    around = 0.15 * radius
    if focus_m:
        around = min(around, 2.0 * along)
    seen = 1.7 * along * float(np.hypot(*view.tangents)) + around
    if seen >= radius:
        return centre, radius
    pull = view.eye + along * view.forward - centre
    reach = max(radius - 0.5 * seen, 0.0)
    return centre + pull * min(1.0, reach / max(float(np.linalg.norm(pull)), 1e-9)), seen


class ShadowMap:
    """Depth seen from the key light over a disc of the scene."""

    def __init__(self, size: int):
        # The widest penumbra is the same share of the scene at every size of map.
        self.size, self.reach = size, max(1, round(WIDEST * size / BLOCK))
        self.map = gl.Target(size, size, None, depth=True)
        self._blocks = gl.Target(size // BLOCK, size // BLOCK, GL.GL_RG32F, linear=False)
        self.bounds = gl.Target(size // BLOCK, size // BLOCK, GL.GL_RG32F, linear=False)
        self._depth = gl.Program("thing.vert", "shadow.frag", FULL=0)
        self._tiles = gl.Program("screen.vert", "tiles.frag")
        self._spread = gl.Program("screen.vert", "spread.frag")
        self._raw, self._compare = GL.glGenSamplers(2)
        for sampler, filtering in ((self._raw, GL.GL_NEAREST), (self._compare, GL.GL_LINEAR)):
            for name in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
                GL.glSamplerParameteri(sampler, name, filtering)
            for name in (GL.GL_TEXTURE_WRAP_S, GL.GL_TEXTURE_WRAP_T):
                GL.glSamplerParameteri(sampler, name, GL.GL_CLAMP_TO_EDGE)
        GL.glSamplerParameteri(self._compare, GL.GL_TEXTURE_COMPARE_MODE, GL.GL_COMPARE_REF_TO_TEXTURE)
        GL.glSamplerParameteri(self._compare, GL.GL_TEXTURE_COMPARE_FUNC, GL.GL_LEQUAL)
        self._uniforms: dict[str, object] = {}

    def draw(
        self,
        direction: np.ndarray,
        spread: float,
        centre: np.ndarray,
        radius: float,
        whole: tuple[np.ndarray, float],
        draw_things: Callable[[gl.Program], None],
    ) -> None:
        """Render the map for the disc (`centre`, `radius`); `whole` is the sphere around everything that casts shadows."""
        axes = frame_of(direction)
        radius = steady(radius)
        middle = axes @ centre
        texel = 2.0 * radius / self.size
        middle[:2] = np.round(middle[:2] / texel) * texel
        # Whole pixels of the light keep edges from crawling as the box moves.
        depth_middle, depth_radius = axes[2] @ whole[0], steady(whole[1] * 1.02)
        depth_middle = np.round(depth_middle / (0.05 * depth_radius)) * 0.05 * depth_radius
        low = depth_middle - 1.1 * depth_radius
        depth_range = 2.2 * depth_radius
        clip = np.eye(4)
        clip[0, :3], clip[0, 3] = axes[0] / radius, -middle[0] / radius
        clip[1, :3], clip[1, 3] = axes[1] / radius, -middle[1] / radius
        clip[2, :3], clip[2, 3] = axes[2] / depth_range, -low / depth_range
        self.map.bind()
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glClearDepth(1.0)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        self._depth.use().set(view_projection=clip, rank_step=0.0, mirrored=0)
        draw_things(self._depth)
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glBindSampler(0, 0)
        self._blocks.bind()
        self._tiles.use().set(depth=0.0, block=BLOCK).texture("shadow_depth", 0, self.map.depth)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        self.bounds.bind()
        self._spread.use().set(depth=0.0, reach=self.reach).texture("blocks", 0, self._blocks.colour)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        to_unit = np.eye(4)
        to_unit[0, 0] = to_unit[1, 1] = to_unit[0, 3] = to_unit[1, 3] = 0.5
        widest = (self.reach - 0.5) * BLOCK / self.size
        self._uniforms = {
            "to_shadow": to_unit @ clip,
            "shadow_scale": (2.0 * radius, depth_range, spread, widest),
        }

    def bind(self, program: gl.Program) -> None:
        """Give the map to a program (units 5, 6 and 7)."""
        program.set(**self._uniforms)
        program.texture("shadow_depth", 5, self.map.depth)
        program.texture("shadow_compare", 6, self.map.depth)
        program.texture("shadow_blocks", 7, self.bounds.colour)
        GL.glBindSampler(5, self._raw)
        GL.glBindSampler(6, self._compare)
