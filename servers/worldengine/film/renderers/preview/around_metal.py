"""What bare metal mirrors: the standing world around it as a cube of pictures, and the simple shapes that move beside it.

The picture itself knows nothing of what lies beside, above or before it, and a sky alone makes pearl of polished steel: metal is
known by the crisp, bent image of what is around. The cube is drawn once for each light, from one place: that of the largest piece
of metal that moves, at rest; when that has gone some of its own lengths on, from there. It shows the world as it stands at the
start, without what moves; spheres, boxes and cylinders that move are met by the shader's rays where they are now.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from OpenGL import GL

from . import gl
from .eye import View
from .shader_variants import metal

if TYPE_CHECKING:
    import mujoco

    from .things import Things

SIDE = 128
"""Pixels of a face: as fine as a ball that is 300 pixels wide shows its surroundings."""
FAR_M = 1000.0
"""The distance that the cube tells of the sky."""
STEP = 8.0
"""So many of its radii from where it was drawn the metal gets another cube."""
CROWD = 16.0
"""Pieces of metal so many of its radii from it are seen from one place in their middle."""
MOST_NEAR = 10
"""Moving shapes that rays are tried on."""
UNIT = 18
# Forward, right and up of each face, as OpenGL lays cube maps out.
FACES = (
    ((1, 0, 0), (0, 0, -1), (0, -1, 0)), ((-1, 0, 0), (0, 0, 1), (0, -1, 0)), ((0, 1, 0), (1, 0, 0), (0, 0, 1)),
    ((0, -1, 0), (1, 0, 0), (0, 0, -1)), ((0, 0, 1), (1, 0, 0), (0, -1, 0)), ((0, 0, -1), (-1, 0, 0), (0, -1, 0)),
)  # fmt: skip


class AroundMetal:
    """The surroundings of a model's bare metal. `any` says whether it has some; else nothing here costs anything."""

    def __init__(self, model: mujoco.MjModel, things: Things, rest: mujoco.MjData):
        self._model, self._things = model, things
        geoms = things.geoms
        fixed = model.body_weldid[model.geom_bodyid[geoms]] == 0
        metals = np.zeros(len(geoms), bool)
        for batch in things.batches:
            metals[batch.rows] = metal(batch) and batch.shape[0] != "disc"
        self.any = bool(metals.any())
        if not self.any:
            return
        size = np.maximum(model.geom_rbound[geoms], 1e-3)
        self._chosen = int(np.where(metals, size + 1e3 * ~fixed, -1.0).argmax())
        self._metals = metals
        own = model.geom_bodyid[geoms] == model.geom_bodyid[geoms[self._chosen]]
        self.hidden = np.flatnonzero(~fixed | own)
        """Rows of what moves, and of what the cube is drawn in."""
        self._radius = float(size[self._chosen])
        places = np.array(rest.geom_xpos[geoms])
        home = places[self._chosen]
        beside = (
            metals & (fixed == fixed[self._chosen]) & (np.linalg.norm(places - home, axis=1) < CROWD * self._radius)
        )
        # From a little above them the ground is seen more finely.
        self._home = places[beside].mean(axis=0) + np.array([0.0, 0.0, self._radius if beside.sum() > 1 else 0.0])
        self._offset = self._home - home
        simple = things.rows[:, 39].astype(int)
        moving = ~fixed & (things.rows[:, 19] > 0.9)
        self._shapes = np.flatnonzero(moving & np.isin(simple, (1, 2, 3)))
        others = moving & ~np.isin(simple, (1, 2, 3)) & ~metals
        self.searches = bool(others.any() or model.nskin or model.nflex or model.ntendon)
        """Whether something moves that only the picture itself can tell of."""
        self._rest = rest
        self._key: object = None
        self._target: int = 0
        self.map = 0
        self.place = self._home

    def stale(self, data: mujoco.MjData, light: object) -> bool:
        """Whether another cube is due, in this light and for where the metal is now."""
        grid = STEP * self._radius
        here = np.array(data.geom_xpos[self._things.geoms[self._chosen]]) + self._offset
        self.place = self._home + grid * np.round((here - self._home) / grid)
        key = (light, *np.round(self.place, 6))
        if key == self._key:
            return False
        self._key = key
        return True

    def views(self) -> list[View]:
        """A view for each face."""
        near = 0.2 * self._radius
        return [
            View(self.place, np.array([right, up, [-v for v in forward]], float).T, (1.0, 1.0), near)
            for forward, right, up in FACES
        ]

    def draw(self, face: Callable[[View], None]) -> None:
        """Draw all faces anew; `face` draws a view, its distance as the fourth channel, into what is bound."""
        if not self.map:
            self._make()
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target)
        GL.glViewport(0, 0, SIDE, SIDE)
        for number, view in enumerate(self.views()):
            part = GL.GL_TEXTURE_CUBE_MAP_POSITIVE_X + number
            GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, GL.GL_COLOR_ATTACHMENT0, part, self.map, 0)
            GL.glClearColor(0.0, 0.0, 0.0, FAR_M)
            GL.glClear(GL.GL_COLOR_BUFFER_BIT)
            face(view)
        GL.glActiveTexture(gl.SCRATCH_UNIT)
        GL.glBindTexture(GL.GL_TEXTURE_CUBE_MAP, self.map)
        GL.glGenerateMipmap(GL.GL_TEXTURE_CUBE_MAP)

    def _make(self) -> None:
        self.map = GL.glGenTextures(1)
        GL.glActiveTexture(gl.SCRATCH_UNIT)
        GL.glBindTexture(GL.GL_TEXTURE_CUBE_MAP, self.map)
        GL.glTexStorage2D(GL.GL_TEXTURE_CUBE_MAP, SIDE.bit_length(), GL.GL_RGBA16F, SIDE, SIDE)
        edge = GL.GL_CLAMP_TO_EDGE
        for name, value in (
            (GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR_MIPMAP_LINEAR), (GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR),
            (GL.GL_TEXTURE_WRAP_S, edge), (GL.GL_TEXTURE_WRAP_T, edge), (GL.GL_TEXTURE_WRAP_R, edge),
        ):  # fmt: skip
            GL.glTexParameteri(GL.GL_TEXTURE_CUBE_MAP, name, value)
        GL.glEnable(GL.GL_TEXTURE_CUBE_MAP_SEAMLESS)
        self._target = GL.glGenFramebuffers(1)
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self._target)
        depth = gl.texture(GL.GL_DEPTH_COMPONENT32F, SIDE, SIDE, linear=False)
        GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_TEXTURE_2D, depth, 0)

    def uniforms(self) -> dict[str, object]:
        """For the shader: the place of the cube, and the rows and mean colours of the moving shapes nearest to the metal."""
        if not self.any:
            return {}
        rows, shapes = self._things.rows, self._shapes
        places = rows[:, [3, 7, 11]].astype(float)
        metals = places[self._metals]
        away = np.linalg.norm(places[shapes][:, None] - metals[None, :32], axis=-1).min(axis=1, initial=np.inf)
        near = shapes[np.argsort(away, kind="stable")[:MOST_NEAR]]
        told = np.zeros((MOST_NEAR, 4))
        for number, row in enumerate(near):
            told[number] = *self._things.finish(int(self._things.geoms[row])).mean, row
        return {"cube_place": self.place, "beside": told, "beside_count": len(near), "searches": int(self.searches)}
