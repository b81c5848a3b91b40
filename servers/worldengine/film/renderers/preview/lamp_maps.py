"""The shadow maps of the lamps that light what is seen: faces of a cube around each, side by side in one map."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from OpenGL import GL

from . import gl
from .lamp_reach import MOST_LAMPS, WEIGHTS, Casters, Lamp, gather
from .scenery import MOST, MOST_FILLS
from .shadows import BLOCK

if TYPE_CHECKING:
    import mujoco

    from .eye import View
    from .occlusion import Occlusion
    from .things import Things

TANGENT = 1.3
"""Of half of what a tile shows, as `lamps.glsl` has it."""
FARTHEST, SPREADS = 0.4, 3
"""In a tile's tangents, so far away is the last that the widest penumbra depends on; the bounds reach there by so many steps."""
NEAR_M = 0.02
"""What is nearer to the middle of a lamp casts no shadow."""
SMALLEST, LARGEST = 256, 1024
"""Bounds of the side of a tile, which is about as wide as the picture."""
STEP = 2
"""Of the picture's guide, every so-manieth pixel is looked at."""
NIGHT, DAY = 0.03, 0.12
"""Light of the sky on level ground below which lamps outdo the key light's shadow, and above which they leave it alone."""
BESIDE = 0.3
"""Where lamps give this much of the key light, its shadows by night are at their faintest."""
FAINTEST = 0.2
DEPTH, COMPARE, BLOCKS = 14, 16, 17
"""The units of the textures."""
Draw = Callable[[gl.Program, "tuple[np.ndarray, np.ndarray]"], None]


def seen_points(guide: gl.Target, view: View) -> np.ndarray:
    """Points and normals of what is in the picture, world, m: (N, 6)."""
    GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, guide.handle)
    raw = GL.glReadPixels(0, 0, guide.width, guide.height, GL.GL_RGBA, GL.GL_FLOAT)
    pixels = np.frombuffer(raw, dtype=np.float32).reshape(guide.height, guide.width, 4)[::STEP, ::STEP].astype(float)
    y, x = np.mgrid[0 : guide.height : STEP, 0 : guide.width : STEP]
    across = (2 * (x + 0.5) / guide.width - 1) * view.tangents[0], (2 * (y + 0.5) / guide.height - 1) * view.tangents[1]
    rays = view.forward + across[0][..., None] * view.axes[:, 0] + across[1][..., None] * view.axes[:, 1]
    points = np.concatenate([view.eye + pixels[..., 3:] * rays, pixels[..., :3]], axis=-1)
    return np.asarray(points[pixels[..., 3] > 0])


class LampMaps:
    """Depth seen from lamps, for pictures so many pixels wide."""

    def __init__(self, pixels: int):
        self.side = min(max(SMALLEST, 1 << (pixels - 1).bit_length()), LARGEST)
        self.reach = int(np.ceil(FARTHEST / (2.0 * TANGENT) * self.side / BLOCK / SPREADS))
        self._maps: dict[int, tuple[gl.Target, gl.Target, gl.Target]] = {}
        self._depth = gl.Program("thing.vert", "shadow.frag", FULL=0)
        self._tiles = gl.Program("screen.vert", "tiles.frag")
        self._spread = gl.Program("screen.vert", "spread.frag")
        self._samplers = GL.glGenSamplers(2)
        for sampler, filtering in zip(self._samplers, (GL.GL_NEAREST, GL.GL_LINEAR), strict=True):
            for name in (GL.GL_TEXTURE_MIN_FILTER, GL.GL_TEXTURE_MAG_FILTER):
                GL.glSamplerParameteri(sampler, name, filtering)
        GL.glSamplerParameteri(self._samplers[1], GL.GL_TEXTURE_COMPARE_MODE, GL.GL_COMPARE_REF_TO_TEXTURE)
        GL.glSamplerParameteri(self._samplers[1], GL.GL_TEXTURE_COMPARE_FUNC, GL.GL_LEQUAL)

    def _of(self, across: int) -> tuple[gl.Target, gl.Target, gl.Target]:
        """The map of so many tiles each way, and the bounds of its blocks, of each alone and of what is around each."""
        if across not in self._maps:
            side, blocks = across * self.side, across * self.side // BLOCK
            self._maps[across] = (
                gl.Target(side, side, None, depth=True),
                gl.Target(blocks, blocks, GL.GL_RG32F, linear=False),
                gl.Target(blocks, blocks, GL.GL_RG32F, linear=False),
            )
        return self._maps[across]

    def draw(
        self, lamps: list[Lamp], casters: Casters, points: np.ndarray | None, draw_things: Draw
    ) -> tuple[dict[str, object], dict[str, tuple[int, int]]]:
        """Render the faces through which lamps see a point (N, 3) that they light, or any: the shader's uniforms and textures."""
        casters.move()
        wanted: list[tuple[int, int, np.ndarray, np.ndarray]] = []
        for number, lamp in enumerate(lamps):
            held = casters.holders(lamp)
            faces = range(6) if points is None else np.unique(lamp.facing(points[lamp.light > 0]))
            for face in faces:
                through = casters.seen_through(lamp, int(face), TANGENT)
                wanted.append((number, int(face), through, held))
        across = int(np.ceil(np.sqrt(max(len(wanted), 1))))
        depth, blocks, bounds = self._of(across)
        found, used = np.zeros((6 * MOST_LAMPS, 4)), -(-len(wanted) // across)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, depth.handle)
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthFunc(GL.GL_LEQUAL)
        GL.glClearDepth(1.0)
        GL.glEnable(GL.GL_SCISSOR_TEST)
        GL.glScissor(0, 0, depth.width, used * self.side)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        GL.glDisable(GL.GL_SCISSOR_TEST)
        self._depth.use().set(rank_step=0.0, mirrored=0)
        for tile, (number, face, through, held) in enumerate(wanted):
            column, row = tile % across, tile // across
            found[6 * number + face] = (column + 0.5) / across, (row + 0.5) / across, 1.0, 0.0
            GL.glViewport(column * self.side, row * self.side, self.side, self.side)
            self._depth.use().set(view_projection=lamps[number].clip(face, TANGENT, NEAR_M))
            draw_things(self._depth, (through, held))
        GL.glDisable(GL.GL_DEPTH_TEST)
        GL.glBindSampler(0, 0)
        GL.glClearColor(1.0, 0.0, 0.0, 0.0)  # the bounds of nothing, beyond the rows in use
        steps = [(blocks, self._tiles, "shadow_depth", depth.depth)]
        steps += [(bounds, self._spread, "blocks", blocks.colour), (blocks, self._spread, "blocks", bounds.colour)] * 2
        for target, program, name, source in steps[: 1 + SPREADS]:
            target.bind()
            GL.glClear(GL.GL_COLOR_BUFFER_BIT)
            GL.glViewport(0, 0, target.width, used * self.side // BLOCK)
            program.use().set(depth=0.0, block=BLOCK, reach=self.reach).texture(name, 0, source)
            GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)
        for unit, sampler in zip((DEPTH, COMPARE), self._samplers, strict=True):
            GL.glBindSampler(unit, sampler)
        uniforms = {"lamp_faces": found, "lamp_scale": (0.5 / across, NEAR_M)}
        textures = {"lamp_depth": (DEPTH, depth.depth), "lamp_compare": (COMPARE, depth.depth)}
        return uniforms, textures | {"lamp_blocks": (BLOCKS, bounds.colour)}


class LampLight:
    """The lamps of one model, and their shadows in one picture after the other; `uniforms` and `textures` are of the last."""

    def __init__(self, model: mujoco.MjModel, things: Things, lights: list[int]):
        import mujoco

        self.model, self.lights = model, lights
        directional = int(mujoco.mjtLightType.mjLIGHT_DIRECTIONAL)
        self.any = any(model.light_type[light] != directional for light in lights[:MOST])
        self._casters = Casters(things)
        self._maps: dict[int, LampMaps] = {}
        self.uniforms: dict[str, object] = {"lamp_count": 0}
        self.textures: dict[str, tuple[int, int]] = {}

    def draw(
        self,
        data: mujoco.MjData,
        view: View,
        pixels: int,
        occlusion: Occlusion,
        rows: tuple[np.ndarray, np.ndarray, int],
        key: np.ndarray,
        sky: np.ndarray,
        draw_things: Draw,
        *,
        everywhere: bool,
    ) -> None:
        """Find the lamps of this picture and render their maps.

        Args:
            rows: of all lights for the shader, see `scenery.light_rows`.
            key: the key light on level ground, scene-linear; `sky`: that of the surroundings.
            everywhere: what lies outside of the picture is seen as well, in a floor that mirrors it.
        """
        if not self.any:
            return
        seen = seen_points(occlusion.guide, view)
        table, aims, count = rows
        first = count - len(self.lights[:MOST])
        lamps = gather(self.model, table[2 * first : 2 * count], aims[first:count], self.lights, seen)
        self.uniforms, self.textures = {"lamp_count": len(lamps)}, {}
        if not lamps:
            return
        if pixels not in self._maps:
            self._maps[pixels] = LampMaps(pixels)
        points = None if everywhere else seen[:, :3]
        told, self.textures = self._maps[pixels].draw(lamps, self._casters, points, draw_things)
        places, axes, radii = np.zeros((MOST_LAMPS, 3)), np.zeros((3 * MOST_LAMPS, 3)), np.zeros(MOST_LAMPS)
        masks = np.zeros((MOST_FILLS + MOST, 4))
        for number, lamp in enumerate(lamps):
            places[number], axes[3 * number : 3 * number + 3], radii[number] = lamp.place, lamp.axes, lamp.radius
            masks[[first + light for light in lamp.lights], number] = lamp.share
        light = float(np.mean(sum(lamp.light for lamp in lamps)))
        outdone = min(light / max(BESIDE * float(WEIGHTS @ key), 1e-9), 1.0)
        outdone *= float(np.clip((DAY - WEIGHTS @ sky) / (DAY - NIGHT), 0.0, 1.0))
        shade = 1.0 - (1.0 - FAINTEST) * outdone
        self.uniforms |= told | {"lamp_places": places, "lamp_axes": axes, "lamp_radii": radii}
        self.uniforms |= {"lamp_masks": masks, "key_shade": shade}
