"""Draw MuJoCo's scene with our own shaders on MuJoCo's own OpenGL context (hardware or software).

Passes: shadow map; guide and ambient occlusion; the ground's mirror image where it is polished; depth alone, so that
each pixel is shaded once; the picture itself; glass over a copy of it; development. Nothing depends on earlier frames:
the same state gives the same picture in whatever order frames are drawn.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from OpenGL import GL

from worldkit.settings import STUDIO, Light

from ...carrying import Surfaces
from ...gobos import slide
from ...panel_lights import of_model
from ...treatment import PLAIN, Treatment
from . import gl, room
from .around_metal import SIDE, UNIT, AroundMetal
from .eye import View, of_camera
from .finish import linear
from .first_seen import FirstSeen
from .focus import Focus
from .lamp_maps import LampLight
from .lighting import relight, sky_uniforms
from .painter import Painter
from .scenery import light_rows, own_lights, panel_rows, setting_of, space_of
from .shadows import covered
from .stages import QUALITIES, Stage
from .surroundings import Surroundings, irradiance, noise_map, slide_map
from .things import FLOATS, Batch, Things

if TYPE_CHECKING:
    import mujoco

RANK_STEP = 2e-4
"""The last of all geoms is drawn nearer by this share of its distance, so that coplanar faces never flicker."""


class Pipeline:
    """Draws one model. Needs a current OpenGL context for every call; raises RuntimeError if the driver lacks something."""

    def __init__(self, model: mujoco.MjModel, width: int, height: int):
        import mujoco

        self.model, self.width, self.height = model, width, height
        chosen = setting_of(model)
        self.setting = chosen or STUDIO
        self.lights, self.panels = own_lights(model), of_model(model)
        rest = mujoco.MjData(model)
        mujoco.mj_forward(model, rest)
        if chosen is None:
            self._adopt_key(rest)
        self.things = Things(model)
        self.things.update(rest)
        low, high = self.things.bounds(rest)
        space = space_of(model)
        if space is not None:
            low, high = np.minimum(low, space[0]), np.maximum(high, space[1])
        self.low, self.high = low, high
        self.centre = 0.5 * (low + high)
        self.radius = max(float(np.linalg.norm(high - low)) / 2.0, 1e-3)
        self.floor_z = float(self.things.rows[self.things.ground, 11]) if self.things.ground >= 0 else float(low[2])

        gl.prepare_depth()
        self._own, self._treatment = self.setting, PLAIN
        self._stages: dict[str, Stage] = {}
        self._noise = noise_map()
        self._sky_uniforms = sky_uniforms(self.setting, PLAIN)
        self._slides: dict[tuple[str, int, float], int] = {}
        """Textures of the slides that were before the key light, by kind, seed and its spread."""
        self._around = Surroundings(self.setting, self._noise, self._sky_uniforms)
        self._weigh()
        self.room_extent: tuple[np.ndarray, np.ndarray] | None = None
        walls, wall_rows = self._build_room(rest) if self.setting.name == "room" else ([], np.zeros((0, FLOATS)))
        self.painter = Painter(model, self.setting.index, self.things, walls, wall_rows.astype(np.float32), height)
        self._skies: dict[tuple[int, int], gl.Program] = {}
        self._depth_program = gl.Program("thing.vert", "shadow.frag", FULL=0)
        self.lamps = LampLight(model, self.things, self.lights)
        self._metal, self._rest = AroundMetal(model, self.things, rest), rest
        self.painter.metal_alone = self._metal.any and not self._metal.searches
        self._first_seen = FirstSeen(model, self.painter, width, height, RANK_STEP)

    def _weigh(self) -> None:
        """Compute the direction of the key light, and the light on level ground."""
        self._key = np.array(self.setting.key.direction)
        key = np.array(self.setting.key.colour) * max(self._key[2], 0.0)
        self._ground_light = irradiance(self._around.harmonics, np.array([0.0, 0.0, 1.0])) + key

    def treat(self, treatment: Treatment) -> None:
        """Apply this light, haze, focus and grading from now on."""
        relit = treatment.lit != self._treatment.lit
        self._treatment = treatment
        self.things.breeze = treatment.breeze
        if relit:
            self.setting = relight(self._own, treatment)
            self._sky_uniforms = sky_uniforms(self.setting, treatment)
            self._around.bake(self.setting, self._sky_uniforms)
            self._weigh()
            self.painter.setting = self.setting.index

    def _adopt_key(self, rest: mujoco.MjData) -> None:
        """Let a foreign model's own directional light be the key light."""
        import mujoco

        for light in self.lights:
            if (
                self.model.light_type[light] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
                and rest.light_xdir[light][2] < -0.2
            ):
                x, y, z = -rest.light_xdir[light]
                elevation = float(np.degrees(np.arcsin(np.clip(z, -1, 1))))
                key = Light(float(np.degrees(np.arctan2(y, x))), min(elevation, 75.0), self.setting.key.colour)
                self.setting = replace(self.setting, key=key)
                self.lights.remove(light)
                return

    def _build_room(self, rest: mujoco.MjData) -> tuple[list[Batch], np.ndarray]:
        self.room_extent = room.extent(self.low, self.high, np.array(rest.cam_xpos).reshape(-1, 3))
        low, high = self.room_extent
        panels = room.panels(low, high, self.floor_z, self.setting.key.azimuth_deg)
        return room.batches(panels, len(self.things.rows), self.ground_mean(), self.floor_z)

    def ground_mean(self) -> tuple[float, float, float]:
        """Scene-linear mean colour of the ground."""
        if self.things.ground < 0:
            return (0.18, 0.18, 0.18)
        return self.things.finish(int(self.things.geoms[self.things.ground])).mean

    def _uniforms(self, stage: Stage, view: View, data: mujoco.MjData, size: tuple[int, int]) -> dict[str, object]:
        setting = self.setting
        rows, aims, count = light_rows(self.model, data, setting, self.lights)
        span = max(self.radius, 0.55 * float(np.linalg.norm(view.eye - self.centre)))
        return {
            **self._sky_uniforms, **self._air(), **self.lamps.uniforms, "view_projection": view.matrix(), "to_clip": view.matrix(), "eye": view.eye,
            "forward": view.forward, "pixels": (float(size[0]), float(size[1])), "harmonics": self._around.harmonics,
            "ground_light": self._ground_light, "ground_mean": self.ground_mean(), "key_sharp": 0.0 if setting.key_in_sky else 1.0,
            "key_spread": setting.key_spread, "lights": rows, "light_aims": aims, "light_count": count,
            "panels": panel_rows(self.panels, data), "panel_count": len(self.panels),
            "haze_m": setting.haze_m, "mirror_z": self.floor_z, "rank_step": RANK_STEP, "mirrored": 0, "things": 2,
            "fade": (self.centre[0], self.centre[1], setting.fade[0] * span, setting.fade[1] * span),
            "pool": (self.centre[0], self.centre[1], setting.pool[0] * self.radius, setting.pool[1] * self.radius),
            "near_m": view.near_m, "march": stage.quality.march, "stride": 1.0 + 4.4 / stage.quality.march,
            "blockers": stage.quality.blockers, "filters": stage.quality.filters, "to_gobo": self._to_slide(), **self._metal.uniforms(),
        }  # fmt: skip

    def _to_slide(self) -> np.ndarray:
        """(4, 4): of a point of the world, where it lies on the slide."""
        gobo, found = self._treatment.light_gobo, np.eye(4)
        if gobo is not None:
            found[:3] = gobo.across(self._key)
        return found

    def _slide(self) -> dict[str, tuple[int, int]]:
        """Unit and texture of the slide, if there is one."""
        gobo = self._treatment.light_gobo
        if gobo is None:
            return {}
        key = (gobo.kind, gobo.seed, self.setting.key_spread)
        if key not in self._slides:
            while len(self._slides) > 3:  # a light that softens slowly has one for each frame
                GL.glDeleteTextures(1, [self._slides.pop(next(iter(self._slides)))])
            self._slides[key] = slide_map(slide(*key))
        return {"gobo": (13, self._slides[key])}

    def _air(self) -> dict[str, object]:
        """Uniforms of the fog."""
        told = self._treatment
        colour = (0.0, 0.0, 0.0) if told.fog_rgb is None else tuple(linear(told.fog_rgb))
        density = 0.0 if told.fog_rgb is None else told.fog_density
        return {
            "fog": (*colour, density),
            "fog_height": told.fog_height_m,
            "fog_over": told.fog_over_m,
            "fog_floor": self.floor_z,
        }

    def _sky(self, rays: np.ndarray, eye: np.ndarray, bake: int = 0) -> None:
        key = self.setting.index, bake
        if key not in self._skies:
            self._skies[key] = gl.Program("screen.vert", "sky.frag", BAKE=bake, SETTING=key[0])
        air = self._air() | {"eye": eye}
        program = self._skies[key].use().set(depth=0.0, rays=rays, **self._sky_uniforms, **air)
        program.texture("noise_map", 3, self._noise)
        GL.glDrawArrays(GL.GL_TRIANGLES, 0, 3)

    def _open(self, view: View, height: int, *, mirrored: bool = False) -> None:
        """Clear the bound target and draw depth alone, so that only visible surfaces get shaded."""
        GL.glEnable(GL.GL_DEPTH_TEST)
        GL.glDepthMask(GL.GL_TRUE)
        GL.glDepthFunc(GL.GL_GEQUAL)
        GL.glDisable(GL.GL_BLEND)
        GL.glClearDepth(0.0)
        GL.glClear(GL.GL_DEPTH_BUFFER_BIT)
        GL.glColorMask(False, False, False, False)
        self._depth_program.use().set(
            view_projection=view.matrix(),
            eye=view.eye,
            rank_step=RANK_STEP,
            mirrored=int(mirrored),
            mirror_z=self.floor_z,
        )
        self.painter.draw(self._depth_program, view, height, flipped=mirrored, ground=not mirrored)
        GL.glColorMask(True, True, True, True)

    def _polished(self, view: View) -> bool:
        if self.things.ground < 0 or view.eye[2] <= self.floor_z:
            return False
        entry = self.things.finish(int(self.things.geoms[self.things.ground])).look
        return entry.coat >= 0.09 or entry.roughness < 0.3

    def image(self, data: mujoco.MjData, camera: int, quality: str) -> np.ndarray:
        """The picture of `data` through a camera: uint8 (H, W, 3); stills come at twice the size, to be averaged."""
        if quality not in self._stages:
            self._stages[quality] = Stage(self.width, self.height, QUALITIES[quality])
        stage = self._stages[quality]
        painter, height = self.painter, stage.height
        view = of_camera(self.model, data, camera, self.width, self.height)
        if self._metal.any and self._metal.stale(data, (self._treatment.lit, self._air()["fog"])):
            self._look_around_metal(stage)
        painter.upload(data)
        low, high = self.things.bounds(data)
        everything = np.minimum(low, self.low), np.maximum(high, self.high)
        whole = self.centre, float(np.linalg.norm(np.maximum(everything[1] - self.centre, self.centre - everything[0])))
        stage.shadow.draw(
            self._key, self.setting.key_spread, *covered(view, whole, self._treatment.focus_m), whole,
            lambda program: painter.draw(program, None, height, flipped=True, ground=False, walls=False),
        )  # fmt: skip
        small = stage.occlusion.height
        stage.occlusion.draw(view, lambda program: painter.draw(program, view, small))
        reflecting = self._polished(view)
        level = np.array(self.setting.key.colour) * max(self._key[2], 0.0)
        self.lamps.draw(
            data, view, max(stage.width, stage.height), stage.occlusion,
            light_rows(self.model, data, self.setting, self.lights), level, self._ground_light - level,
            lambda program, only: painter.draw(program, None, height, flipped=True, ground=False, walls=False, only=only),
            everywhere=reflecting,
        )  # fmt: skip
        if reflecting:
            self._reflect(stage, view, data)
        mirrors, clear = painter.mirrors(), painter.clear()
        if (mirrors or clear) and stage.behind is None:
            stage.behind = gl.Target(stage.width, stage.height, GL.GL_RGBA16F, depth=True)
        drawn = stage.drawn(self._treatment.grade_outlines > 0.5)
        drawn.bind()
        self._open(view, height)
        uniforms = self._uniforms(stage, view, data, (stage.width, stage.height))
        painter.prepare(uniforms, self._textures(stage, reflecting), stage.shadow)
        painter.shade(view, height)
        self._sky(view.rays(), view.eye)
        if mirrors:
            self._copy(stage, drawn)
            painter.shade_mirrors(view, height)
        scene, told = stage.picture.colour, self._treatment
        if drawn is not stage.picture:
            stage.mean(self.setting.exposure * 2.0**told.grade_exposure_stops)
        if clear:  # over the mean: each copy of several places in a pixel would cost as much as a picture
            self._copy(stage, stage.picture)
            painter.shade_glass(view, height, lambda: self._copy(stage, stage.picture))
        if told.aperture > 0:
            if stage.focus is None:
                stage.focus = Focus(stage.width, stage.height)
            scene = stage.focus.draw(stage.picture, view, told.focus_m, told.aperture)
        traits = self.setting.exposure, self.setting.vignette, told
        return stage.developer.draw(scene, *traits, rounded=self.lamps.any)

    def _textures(self, stage: Stage, reflecting: bool) -> dict[str, tuple[int, int]]:
        """Unit and texture of everything that materials read."""
        behind, black = stage.behind, self.painter.supplies.black
        out = {
            "noise_map": (3, self._noise),
            "around": (4, self._around.map),
            "shade": (8, stage.occlusion.result.colour),
            "behind": (9, behind.colour if behind else black),
            "guide": (11, stage.occlusion.guide.colour),
            "behind_depth": (12, behind.depth if behind else black),
        }
        out |= self._slide() | self.lamps.textures
        out |= {"cube": (UNIT, self._metal.map)} if self._metal.any and self._metal.map else {}
        return out | {"reflection": (10, stage.mirror.colour)} if reflecting and stage.mirror else out

    def _look_around_metal(self, stage: Stage) -> None:
        """Draw the standing world from where the metal is."""
        painter, place = self.painter, self._metal.place
        painter.upload(self._rest, self._metal.hidden)
        far = float(np.linalg.norm(np.maximum(self.high - place, place - self.low)))
        stage.shadow.draw(
            self._key, self.setting.key_spread, place, min(far, 3.0 * self.radius), (place, far),
            lambda program: painter.draw(program, None, SIDE, flipped=True, ground=False, walls=False),
        )  # fmt: skip

        def face(view: View) -> None:
            self._open(view, SIDE)
            uniforms = self._uniforms(stage, view, self._rest, (SIDE, SIDE)) | {
                "blockers": 4,
                "filters": 6,
                "lamp_count": 0,
            }
            textures = {n: t for n, t in self._textures(stage, False).items() if n != "cube"}
            painter.prepare(uniforms, textures, stage.shadow)
            painter.shade(view, SIDE, from_metal=True)
            GL.glColorMask(True, True, True, False)
            self._sky(view.rays(), view.eye, 3)
            GL.glColorMask(True, True, True, True)

        self._metal.draw(face)

    def _reflect(self, stage: Stage, view: View, data: mujoco.MjData) -> None:
        """Draw the world mirrored at the ground, with coarser copies for duller floors."""
        if stage.mirror is None:
            w, h = stage.width // 3, stage.height // 3
            stage.mirror = gl.Target(max(w, 1), max(h, 1), GL.GL_RGBA16F, depth=True, levels=6)
        mirror = stage.mirror
        mirror.bind()
        GL.glEnable(GL.GL_CLIP_DISTANCE0)
        self._open(view, mirror.height, mirrored=True)
        flip = np.array([1.0, 1.0, -1.0])
        uniforms = self._uniforms(stage, view, data, (mirror.width, mirror.height)) | {
            "mirrored": 1,
            "eye": view.eye * flip + np.array([0.0, 0.0, 2.0 * self.floor_z]),
            "forward": view.forward * flip,
            "blockers": 4,
            "filters": 6,
        }
        self.painter.prepare(uniforms, self._textures(stage, False), stage.shadow)
        self.painter.shade(view, mirror.height, mirrored=True)
        GL.glDisable(GL.GL_CLIP_DISTANCE0)
        rays = view.rays()
        rays[2, :] *= -1.0
        self._sky(rays, view.eye)
        GL.glActiveTexture(GL.GL_TEXTURE10)
        GL.glBindTexture(GL.GL_TEXTURE_2D, mirror.colour)
        GL.glGenerateMipmap(GL.GL_TEXTURE_2D)

    @staticmethod
    def _copy(stage: Stage, drawn: gl.Target) -> None:
        """Copy the picture so far for mirrors and glass to read."""
        assert stage.behind is not None
        drawn.blit_to(stage.behind, depth=True)
        drawn.bind()

    def segmentation(self, data: mujoco.MjData, camera: int) -> np.ndarray:
        """Geom number of each pixel, -1 for none, flexes from -2 down: int32 (H, W), row 0 the top."""
        return self._first_seen.numbers(data, camera)

    def seen_through(self, data: mujoco.MjData, camera: int) -> np.ndarray | None:
        """The same without all that is see-through; None where nothing is."""
        return self._first_seen.numbers(data, camera, clear=False) if self.painter.clear() else None

    def surfaces(self, data: mujoco.MjData, camera: int, coarser: int = 1) -> Surfaces:
        """What each pixel shows first, be it glass, and how far away; `coarser` times smaller each way, and then also behind it."""
        return self._first_seen.surfaces(data, camera, coarser)
