"""Draw the things of one model on the graphics side, all with one program or each with its own material."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from OpenGL import GL

from worldkit.materials.look import NOTHING

from ...round_things import OF_A_STRING
from . import gl, swarms
from .eye import View
from .far_first import far_first
from .finish import linear
from .lighting import TOLD
from .near_air import Reach
from .shader_variants import Features, Variants, features, glossy, metal
from .shadows import ShadowMap
from .soft import Soft
from .supplies import Supplies
from .things import FLOATS, Batch, Things

if TYPE_CHECKING:
    import mujoco

CLOSED = (*swarms.ROUND, "box")
"""Shapes whose far sides are never seen from outside."""
SHEETS = ("plane", "disc", "hfield")
"""Shapes without a thickness, which keep their tint whatever their look absorbs."""
CUBE, FLAT = GL.GL_TEXTURE_CUBE_MAP, GL.GL_TEXTURE_2D
NESTED = 16
"""Of so many see-through things each is seen through the others."""


def spans(batch: Batch, wanted: np.ndarray, barred: np.ndarray) -> Iterator[tuple[int, int]]:
    """First row and number of the stretches of a batch, few and long, that hold all that are wanted and none that are barred."""
    rows = np.array(batch.rows)
    for stretch in np.split(rows, np.flatnonzero(barred[rows])):
        inner = stretch[wanted[stretch] & ~barred[stretch]]
        if len(inner):
            yield int(inner[0]), int(inner[-1] - inner[0] + 1)


class Painter:
    """Draws the things of a model, the `walls` around them and what is soft.

    `wall_rows` (W, 40) are the rows of the walls' batches, which follow the rows of `things`.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        setting: int,
        things: Things,
        walls: Sequence[Batch],
        wall_rows: np.ndarray,
        height: int,
    ):
        self.setting = setting
        self.things, self.soft, self.supplies = things, Soft(model), Supplies(model, height)
        self._walls, self._wall_rows = walls, wall_rows
        self._rows = things.rows
        self._variants, self._reach = Variants(), Reach(things)
        self._prepared: set[Features] = set()
        self.metal_alone = False
        """Whether metal needs no picture of what is around it beside its cube."""
        self._buffer = GL.glGenBuffers(1)
        self._rows_texture = GL.glGenTextures(1)

    def upload(self, data: mujoco.MjData, hidden: np.ndarray | None = None) -> None:
        """Take over the poses of `data`; the things of the rows `hidden` are not to be drawn."""
        self.things.update(data)
        self.soft.update(data)
        rows = np.concatenate([self.things.rows, self._wall_rows, self.soft.rows])
        if not len(rows):
            rows = np.zeros((1, FLOATS), dtype=np.float32)
        if hidden is not None:
            rows[hidden, 12:16] = 0.0
        self._rows = rows
        GL.glBindBuffer(GL.GL_TEXTURE_BUFFER, self._buffer)
        GL.glBufferData(GL.GL_TEXTURE_BUFFER, rows.nbytes, np.ascontiguousarray(rows), GL.GL_STREAM_DRAW)
        GL.glActiveTexture(GL.GL_TEXTURE2)
        GL.glBindTexture(GL.GL_TEXTURE_BUFFER, self._rows_texture)
        GL.glTexBuffer(GL.GL_TEXTURE_BUFFER, GL.GL_RGBA32F, self._buffer)

    def poses(self) -> np.ndarray:
        """How each thing turns and scales, and where it is, m: (N, 3, 4)."""
        poses = self._rows[:, :12].reshape(-1, 3, 4).astype(float)
        size = np.abs(self._rows[:, 12:15].astype(float))
        size[:, 2] += np.abs(self._rows[:, 15])
        poses[:, :, :3] *= np.where(size > 0, size, 1.0)[:, None]
        return poses

    def rounds(self) -> np.ndarray:
        """How each thing is round, by `round_things` (N,)."""
        own = self.things.rounds
        rounds = np.concatenate([own, np.zeros(max(len(self._rows) - len(own), 0), int)])
        for shape, batch, count in self._soft(None):
            if shape is None:
                rounds[batch.first : batch.first + count] = OF_A_STRING
        return rounds

    def numbers(self) -> np.ndarray:
        """The number of each thing, -1 of what has no shape of its own, and at last -1 of none: int32 (N + 1,)."""
        numbers = np.append(np.arange(len(self._rows), dtype=np.int32), np.int32(-1))
        for shape, batch, count in self._soft(None):
            if shape is not None:
                numbers[batch.first : batch.first + count] = -1
        return numbers

    def batches(self, *, clear: bool | None = False, ground: bool = True, walls: bool = True) -> Iterator[Batch]:
        """Batches to draw: opaque (`clear` False), see-through (True) or all (None)."""
        for batch in self.things.batches:
            if (ground or batch.shape[0] != "disc") and (clear is None or batch.clear == clear):
                yield batch
        if walls and clear is not True:
            yield from self._walls

    def _soft(self, clear: bool | None = False) -> Iterator[tuple[gl.Shape | None, Batch, int]]:
        """Soft things: shape (None: strands), a batch with their place and finish, and their number; `clear` as of `batches`."""
        start = len(self.things.rows) + len(self._wall_rows)
        for shape, first, count, finish in self.soft.draws():
            kind, through = ("capsule", -1) if shape is None else ("mesh", -1), finish.look.clear > 0
            if clear is None or through == clear:
                yield shape, Batch(kind, finish, through, first=start + first), count

    def _fitted(
        self, view: View | None, height: int, clear: bool | None = False
    ) -> Iterator[tuple[gl.Shape, Batch, int]]:
        """As `_soft`, each with a shape, as fine as it is seen."""
        for shape, batch, count in self._soft(clear):
            if shape is None:
                yield from self._stretches(batch, view, height, count)
            else:
                yield shape, batch, count

    def clear(self) -> bool:
        """Whether anything is see-through."""
        return any(batch.clear for batch in self.things.batches) or any(True for _ in self._soft(clear=True))

    def _shape(self, batch: Batch, radius_px: float, many: int = 1) -> gl.Shape:
        """The shape of a batch, as fine as a thing of this radius in the picture, one of so many, needs it."""
        return self.supplies.shape(*batch.shape, radius_px, swarms.least_sectors(many))

    def _stretches(
        self, batch: Batch, view: View | None, height: int, count: int = -1
    ) -> Iterator[tuple[gl.Shape, Batch, int]]:
        """Shape, a batch with the first place, and number of each stretch of things that are drawn alike, as finely as `view` sees
        them in a picture of `height` pixels: all of a batch, but where it holds very many."""
        count = len(batch.rows) if count < 0 else count
        if view is None or not count or batch.shape[0] not in swarms.ROUND:
            unseen = swarms.UNSEEN_SWARM_PX if count >= swarms.MANY else swarms.UNSEEN_PX
            yield self._shape(batch, unseen, count), batch, count
            return
        pixels = swarms.seen_px(self._rows[batch.first : batch.first + count], view, height)
        for first, number, radius_px in swarms.stretches(pixels):
            yield self._shape(batch, radius_px, count), replace(batch, first=batch.first + first), number

    def draw(
        self,
        program: gl.Program,
        view: View | None,
        height: int,
        *,
        flipped: bool = False,
        clear: bool | None = False,
        ground: bool = True,
        walls: bool = True,
        only: tuple[np.ndarray, np.ndarray] | None = None,
    ) -> None:
        """Draw batches with one program into a picture of `height` pixels, seen by `view` (None: by the light).

        `only`, two of (N,) bool: which of the things are to be drawn, others may be, and which must not.
        """
        program.set(things=2)
        with gl.FarSides(flipped) as far_sides:
            for batch in self.batches(clear=clear, ground=ground, walls=walls):
                far_sides.hide(batch.shape[0] in CLOSED)
                if only is None:
                    for shape, part, count in self._stretches(batch, view, height):
                        program.set(first=part.first)
                        shape.draw(count)
                    continue
                for first, count in spans(batch, *only):  # by the light, which needs no finer ones near the eye
                    program.set(first=first)
                    next(self._stretches(batch, None, height))[0].draw(count)
            far_sides.hide(False)
            for shape, part, number in self._fitted(view, height, clear):
                program.set(first=part.first)
                shape.draw(number)

    def prepare(self, uniforms: dict[str, object], textures: dict[str, tuple[int, int]], shadow: ShadowMap) -> None:
        """Set what materials are drawn with from now on: uniforms, textures (unit, handle) by name, and the shadow map."""
        self._prepared.clear()
        self._uniforms, self._textures, self._shadow = uniforms, textures, shadow
        self._hazed = self._reach.hazed(self._rows, self.soft.balls, np.asarray(uniforms["eye"], dtype=float))
        self._hazed &= self.setting == TOLD

    def _shade(
        self,
        batch: Batch,
        shape: gl.Shape,
        count: int,
        *,
        simple: bool = False,
        mirror: bool = False,
        from_metal: bool = False,
    ) -> None:
        """Draw `count` things from the batch's first with its own variant of the surface shader."""
        kind = self.supplies.paint_kind(batch.finish, float(self._rows[batch.first, 26]))
        reflecting, panels = "reflection" in self._textures, bool(self._uniforms["panel_count"])
        wanted = features(
            batch, self.setting, reflecting=reflecting, simple=simple, mirror=mirror, paint=kind, panels=panels,
            lamps=bool(self._uniforms["lamp_count"]), gobo="gobo" in self._textures, coloured=shape.coloured,
            hazed=bool(self._hazed[batch.first : batch.first + count].any()), around_metal="cube" in self._textures,
            from_metal=from_metal,
        )  # fmt: skip
        program = self._variants.get(wanted).use()
        if wanted not in self._prepared:
            self._prepared.add(wanted)
            program.set(**self._uniforms)
            for name, (unit, handle) in self._textures.items():
                program.texture(name, unit, handle, CUBE if name == "cube" else FLAT)
            self._shadow.bind(program)
        if kind:
            wide = batch.shape[0] == "disc" or batch.finish.look.tile_m > 1.0
            target = GL.GL_TEXTURE_CUBE_MAP if kind == 2 else GL.GL_TEXTURE_2D
            program.texture("paint", 1 if kind == 2 else 0, self.supplies.picture(batch.finish, wide), target)
        absorbs = NOTHING if batch.shape[0] in SHEETS else batch.finish.look.absorbs
        program.set(first=batch.first, absorbs=absorbs)
        if wanted.worn:
            beneath = batch.finish.look.beneath
            program.set(worn=(*((-1.0, -1.0, -1.0) if beneath is None else linear(beneath)), batch.finish.look.worn_m))
        shape.draw(count)

    def shade(self, view: View, height: int, *, mirrored: bool = False, from_metal: bool = False) -> None:
        """Draw everything opaque with its own material.

        `mirrored` draws the world's mirror image, in less detail and without the ground. Glossy things are drawn in less
        detail, too: `shade_mirrors` draws them again. `from_metal`: all in less detail, each with its distance.
        """
        with gl.FarSides(mirrored) as far_sides:
            for batch in self.batches(ground=not mirrored):
                far_sides.hide(batch.shape[0] in CLOSED)
                for shape, part, count in self._stretches(batch, view, height):
                    simple = mirrored or from_metal or self._waits(batch)
                    self._shade(part, shape, count, simple=simple, from_metal=from_metal)
            far_sides.hide(False)
            if from_metal:  # what is soft moves
                return
            for shape, part, count in self._fitted(view, height):
                self._shade(part, shape, count, simple=mirrored)

    def mirrors(self) -> list[Batch]:
        """Batches so glossy that neighbours show in them."""
        return [batch for batch in self.batches(walls=False) if self._waits(batch)]

    def _waits(self, batch: Batch) -> bool:
        return glossy(batch) and not (self.metal_alone and metal(batch))

    def shade_mirrors(self, view: View, height: int) -> None:
        """Draw glossy things with the reflection of the picture so far."""
        with gl.FarSides(False) as far_sides:
            for batch in self.mirrors():
                far_sides.hide(batch.shape[0] in CLOSED)
                for shape, part, count in self._stretches(batch, view, height):
                    self._shade(part, shape, count, mirror=True)

    def shade_glass(self, view: View, height: int, copy: Callable[[], None]) -> None:
        """Draw see-through things over the picture so far, the farthest first, and what is inside of another before it.

        Where there are few, the picture is copied before each, so that one is seen through another.
        """
        GL.glEnable(GL.GL_BLEND)
        GL.glBlendFuncSeparate(GL.GL_SRC_ALPHA, GL.GL_ONE_MINUS_SRC_ALPHA, GL.GL_ONE, GL.GL_ONE)
        owners = [(row, batch) for batch in self.things.batches if batch.clear for row in batch.rows]
        model, geoms = self.things.model, self.things.geoms[[row for row, _ in owners]]
        frames = self._rows[[row for row, _ in owners], :12].reshape(-1, 3, 4)
        order = far_first(frames, model.geom_aabb[geoms], model.geom_rbound[geoms], view.eye, view.forward)
        owners = [owners[number] for number in order]
        with gl.FarSides(False) as far_sides:
            far_sides.hide(True)
            for shape, part, count in self._fitted(view, height, clear=True):
                self._shade(part, shape, count)
            if owners and any(True for _ in self._soft(clear=True)):
                copy()
            for number, (row, batch) in enumerate(owners):
                if 0 < number < NESTED and len(owners) <= NESTED:
                    copy()
                for shape, single, count in self._stretches(replace(batch, first=row), view, height, 1):
                    self._shade(single, shape, count)
        GL.glDisable(GL.GL_BLEND)
