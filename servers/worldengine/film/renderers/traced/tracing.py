"""Draw one model by tracing paths: its figures in their light, each frame at the poses of its moment."""

from __future__ import annotations

from dataclasses import replace
from math import atan, degrees
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from worldkit.materials import look
from worldkit.settings import STUDIO, Light

from ...panel_lights import of_model
from ...treatment import PLAIN, Treatment
from ..preview.eye import View, of_camera
from ..preview.finish import Finish, linear
from ..preview.focus import FRAME_M
from ..preview.lighting import relight
from ..preview.scenery import own_lights, setting_of, space_of
from . import daylight, panel_emitters, rounded, variant
from .darkroom import Scene, air, develop
from .denoised import Denoiser
from .figures import Figures, fill, mesh_of
from .half_room import Face, Walls
from .strand_meshes import Strands
from .unwrapped import along_sides

if TYPE_CHECKING:
    from collections.abc import Iterable

    import mujoco

    from .. import Drawing, Quality

SAMPLES: dict[str, float] = {"still": 32, "video": 3}
DEPTH, CLEAR_DEPTH = 4, 8
"""The longest paths, and those where light goes through glass."""
GUIDE_SAMPLES, FINE_GUIDE_SAMPLES = 4, 16
FINE, FINEST = 18, 54
"""From so many samples a pixel on the denoiser is guided better and takes its time; and from so many, no light is cut off."""
AT_ONCE, SEEDS_APART = 64, 1 << 16
"""Samples a pixel that are traced in one go, since the memory they take grows with them; and moments have chances of their own."""
GLIMPSES_BYTES = 1 << 30
"""Of the room that the moments of one picture may take: places, directions, what is seen and what lies behind, 44 bytes a pixel."""
DRAFT_SIDE = 2
"""Of a draft, light is traced for every second pixel of every second row."""
LEAST_ALBEDO = 0.2
"""Darker surfaces show light as it comes: of what they hardly reflect no draft can tell what fell on them."""
BRIGHTEST = 12.0
"""Of few samples, a pixel of more scene light would be a speck that the denoiser cannot take out; of many, it is a caustic."""


class Rays(NamedTuple):
    """One picture as it was traced: scene light, surface colours, normals, places (H, W, 3), and the share of things (H, W)."""

    light: np.ndarray
    albedo: np.ndarray
    normals: np.ndarray
    places: np.ndarray
    seen: np.ndarray

    def joined(self, other: Rays, before: int) -> Rays:
        """The mean of these, which are that of so many moments, and those of one more; a place counts as far as it is seen."""
        light, albedo, normals, seen = (
            (before * getattr(self, name) + getattr(other, name)) / np.float32(before + 1)
            for name in ("light", "albedo", "normals", "seen")
        )
        mine, theirs = before * self.seen[..., None], other.seen[..., None]
        places = (mine * self.places + theirs * other.places) / np.maximum(mine + theirs, 1e-6)
        return Rays(light, albedo, normals, places, seen)


class Outlook(NamedTuple):
    """Unit viewing directions (H, W, 3), and by how much the surroundings look otherwise than they light things."""

    ways: np.ndarray
    behind: np.ndarray | None


class Glimpse(NamedTuple):
    """What is seen from one place besides the light on things: where they are, as in `Rays`, and what is around them."""

    view: View
    outlook: Outlook
    painted: frozenset[Face]
    """Walls that are painted in, since they stand between the eye and the room."""
    places: np.ndarray
    seen: np.ndarray


class Tracing:
    """Draws one model at one size."""

    def __init__(self, model: mujoco.MjModel, width: int, height: int) -> None:
        import mujoco

        self.model, self.width, self.height = model, width, height
        rest = mujoco.MjData(model)
        mujoco.mj_forward(model, rest)
        self._rest = rest
        chosen = setting_of(model)
        self._own = chosen or STUDIO
        self._lights, self._lit = own_lights(model), of_model(model)
        if chosen is None:
            self._adopt_key(rest)
        self.setting, self._treatment = self._own, PLAIN
        self.figures = Figures(model, rest)
        self._strands = Strands(model, rest, self.figures.coatings)
        low, high = self.figures.things.bounds(rest)
        space = space_of(model)
        if space is not None:
            low, high = np.minimum(low, space[0]), np.maximum(high, space[1])
        self._centre, self._radius = 0.5 * (low + high), max(float(np.linalg.norm(high - low)) / 2.0, 1e-3)
        ground = self.figures.things.ground
        self._floor_z = float(self.figures.things.rows[ground, 11]) if ground >= 0 else float(low[2])
        self._ground = list(self.figures.ground(self._centre[:2], self._radius))
        eyes = np.array(rest.cam_xpos).reshape(-1, 3)
        inside = self._own.name == "room"
        self._walls = Walls(self._own, low, high, eyes, self._floor_z) if inside else None
        self._panels: dict[Face, list[Any]] = {}
        self._scenes: dict[Any, Any] = {}
        self._lamps: dict[Any, bytes] = {}
        """Where the lamps of a scene stand."""
        self._stale: set[Any] = set()
        """Scenes that do not know yet that something has moved."""
        self._denoiser: tuple[Any, Denoiser] | None = None
        self._plain: Drawing | None = None
        self.figures.place(rest)
        self._strands.place(rest)
        self._relight()

    def _adopt_key(self, rest: mujoco.MjData) -> None:
        """Let a foreign model's own directional light be the key light."""
        import mujoco

        for light in self._lights:
            way = -rest.light_xdir[light]
            if self.model.light_type[light] == mujoco.mjtLightType.mjLIGHT_DIRECTIONAL and way[2] > 0.2:
                elevation = min(float(np.degrees(np.arcsin(np.clip(way[2], -1, 1)))), 75.0)
                key = Light(float(np.degrees(np.arctan2(way[1], way[0]))), elevation, self._own.key.colour)
                self._own = replace(self._own, key=key)
                self._lights.remove(light)
                return

    def _relight(self) -> None:
        """Take over the light of the setting."""
        self._shown = daylight.seen(self.setting, self._treatment)
        self._around = daylight.lighting(self.setting, self._treatment, self._shown)
        self._scenes.clear()
        self._looked: Any = None

    def treat(self, treatment: Treatment) -> bool:
        """Apply this light, haze, focus and grading from now on."""
        relit = treatment.lit != self._treatment.lit
        self._treatment = treatment
        if relit:
            self.setting = relight(self._own, treatment)
            self._relight()
        return True

    def _scene(self, walls: frozenset[Face], data: mujoco.MjData) -> Any:
        """The scene with these walls; its meshes are those of all others."""
        lamps = np.concatenate([data.light_xpos[self._lights], data.light_xdir[self._lights]]).tobytes()
        lamps += b"".join(panel.corner(data).tobytes() for panel in self._lit)
        if walls not in self._scenes:
            import mitsuba as mi

            reach = max(self._radius, 1.0)
            parts: dict[str, Any] = {
                "type": "scene", "around": daylight.environment(self._around),
                "key": daylight.key_light(self.setting, self._centre, reach),
                **daylight.lamps(self.model, data, self._lights), **panel_emitters.emitters(self._lit, data),
            }  # fmt: skip
            shapes = [figure.shape for figure in self.figures.all] + self._strands.shapes + self._ground
            for face in sorted(walls):
                shapes += self._wall(face)
            for number, shape in enumerate(shapes):
                parts[f"shape{number}"] = shape
            self._scenes[walls] = mi.load_dict(parts, optimize=False)
        else:
            if lamps != self._lamps[walls]:
                daylight.move(self._scenes[walls], self.model, data, self._lights)
                panel_emitters.move(self._scenes[walls], self._lit, data)
            if walls in self._stale:  # it searches its meshes by where they were, until it is told
                self._scenes[walls].parameters_changed()
        self._lamps[walls] = lamps
        self._stale.discard(walls)
        return self._scenes[walls]

    def _wall(self, face: Face) -> list[Any]:
        """Meshes of the panels of a wall."""
        if face not in self._panels:
            self._panels[face] = []
            assert self._walls is not None
            for panel in self._walls.panels[face]:
                shining = panel.look == "window_light"
                entry = look("plastic_white" if shining else panel.look)
                mesh = rounded.box(np.array(panel.half))
                if entry.paint is not None:
                    mesh = along_sides(mesh, 2, 1.0 / entry.tile_m, 0.0)
                tint = linear(panel.rgba[:3])
                coating = self.figures.coatings.of(Finish(entry), tint, 1.0, wide=True)
                uv = np.zeros((len(mesh.points), 2)) if mesh.uv is None else mesh.uv
                glow = 4.5 * tint if shining else np.zeros(3)
                shape, params = mesh_of(len(mesh.points), mesh.faces, uv, coating, glow)
                fill(params, mesh.points + np.array(panel.centre), mesh.normals)
                self._panels[face].append(shape)
        return self._panels[face]

    def _sensor(self, view: View, channels: str, coarser: int = 1) -> Any:
        """The camera; one with a lens where the film focuses."""
        import mitsuba as mi

        told, tangent = self._treatment, view.tangents[1]
        place = (view.eye - view.axes[:, 2]).tolist()
        move = mi.ScalarTransform4f().look_at(origin=view.eye.tolist(), target=place, up=view.axes[:, 1].tolist())
        film = {
            "type": "hdrfilm", "width": self.width // coarser, "height": self.height // coarser, "rfilter": {"type": "box"},
            "pixel_format": channels, "component_format": "float32",
        }  # fmt: skip
        lens: dict[str, Any] = {"type": "perspective"}
        if told.aperture > 0:
            radius = FRAME_M / (2.0 * tangent) / told.aperture / 2.0
            lens = {"type": "thinlens", "aperture_radius": radius, "focus_distance": max(told.focus_m, 0.02)}
        return mi.load_dict(
            {**lens, "fov": 2 * degrees(atan(tangent)), "fov_axis": "y", "near_clip": 0.01, "far_clip": 1e5,
             "to_world": move, "film": film}
        )  # fmt: skip

    def _outlook(self, view: View) -> Outlook:
        """What a view needs of the surroundings; that of the last one is kept, as most cameras stand still."""
        key = (view.eye.tobytes(), view.axes.tobytes(), view.tangents)
        if key != self._looked:
            x = ((np.arange(self.width) + 0.5) / self.width * 2 - 1) * view.tangents[0]
            y = (1 - (np.arange(self.height) + 0.5) / self.height * 2) * view.tangents[1]
            ways = x[None, :, None] * view.axes[:, 0] + y[:, None, None] * view.axes[:, 1] - view.axes[:, 2]
            ways = (ways / np.linalg.norm(ways, axis=-1, keepdims=True)).astype(np.float32)
            behind = None
            if self._around is not self._shown:
                behind = daylight.looked_up(self._shown, ways) - daylight.looked_up(self._around, ways)
            self._last, self._looked = Outlook(ways, behind), key
        return self._last

    def trace(
        self,
        data: mujoco.MjData,
        view: View,
        faces: frozenset[Face],
        samples: int,
        seed: int,
        coarser: int = 1,
        guides: int = GUIDE_SAMPLES,
    ) -> Rays:
        """Trace the picture of `data`, with these walls; its light `coarser` times smaller each way."""
        import mitsuba as mi

        if self.figures.place(data) | self._strands.place(data):
            self._stale.update(self._scenes)
        scene, sensor = self._scene(faces, data), self._sensor(view, "rgb", coarser)
        depth = CLEAR_DEPTH if self.figures.clear or self._strands.clear else DEPTH
        path = mi.load_dict({"type": "path", "max_depth": depth, "rr_depth": 16})
        light: Any = np.float32(0)
        for first in range(0, samples, AT_ONCE):
            some = min(AT_ONCE, samples - first)
            drawn = mi.render(scene, sensor=sensor, integrator=path, spp=some, seed=seed + first)
            light = light + np.array(drawn) * np.float32(some / samples)
        # A second walk for the guides: around the path tracer itself they would double its time.
        guide = mi.load_dict({"type": "aov", "aovs": "a:albedo,n:sh_normal,p:position", "any": {"type": "depth"}})
        said = mi.render(scene, sensor=self._sensor(view, "rgba"), integrator=guide, spp=guides, seed=0)
        return _rays(np.array(light), np.array(said))

    def image(self, data: mujoco.MjData, camera: int, quality: Quality) -> np.ndarray:
        """The picture: uint8 (height, width, 3)."""
        return self.blurred([data], 1, camera, quality)

    def blurred(self, moments: Iterable[mujoco.MjData], count: int, camera: int, quality: Quality) -> np.ndarray:
        """The picture of a shutter that is open for `count` moments, their light added up and then developed once.

        `quality` is that of the whole: its samples a pixel, less than one for a draft, are shared out among the moments.
        """
        samples = SAMPLES[quality] if isinstance(quality, str) else quality
        coarser = DRAFT_SIDE if samples < 1 else 1
        each = max(1, round(samples * coarser**2 / count))
        guides = -(-(FINE_GUIDE_SAMPLES if samples >= FINE else GUIDE_SAMPLES) // count)
        mean: Rays | None = None
        apart = glimpses_apart(count, self.width * self.height)
        glimpses: list[Glimpse] = []
        for number, data in enumerate(moments):
            view = of_camera(self.model, data, camera, self.width, self.height)
            outlook = self._outlook(view)
            drawn: frozenset[Face] = frozenset()
            painted: frozenset[Face] = frozenset()
            if self._walls is not None:
                some = outlook.ways[:: max(self.height // 24, 1), :: max(self.width // 40, 1)].reshape(-1, 3)
                drawn, painted = self._walls.seen(view.eye, some)
            rays = self.trace(data, view, drawn, each, number * SEEDS_APART, coarser, guides)
            if samples < FINEST:
                np.minimum(rays.light, BRIGHTEST, out=rays.light)
            mean = rays if mean is None else mean.joined(rays, number)
            if number % apart == 0:
                glimpses.append(Glimpse(view, outlook, painted, rays.places, rays.seen))
        assert mean is not None
        if all(one.outlook is glimpses[0].outlook for one in glimpses):  # the camera stood still
            glimpses = [glimpses[-1]._replace(places=mean.places, seen=mean.seen)]
        clean = self._cleaned(mean, coarser, samples >= FINE)
        light = sum((self._around_it(clean, one) for one in glimpses), np.float32(0)) / np.float32(len(glimpses))
        return develop(light, self.setting, self._treatment)

    def _around_it(self, light: np.ndarray, one: Glimpse) -> np.ndarray:
        """Light (H, W, 3) with the surroundings, the painted walls and the air of one glimpse."""
        view, outlook = one.view, one.outlook
        if outlook.behind is not None and one.seen.min() < 1:
            light = light + (1.0 - one.seen)[..., None] * outlook.behind
        if one.painted:
            assert self._walls is not None
            away = np.linalg.norm(one.places - view.eye, axis=-1)
            reach = np.where(one.seen > 0.5, away, np.inf)
            light = self._walls.paint_in(light, one.painted, view.eye, outlook.ways, reach, self._around)
        span = max(self._radius, 0.55 * float(np.linalg.norm(view.eye - self._centre)))
        horizon = self._shown[self._shown.shape[0] // 2 - 2]
        scene = Scene(self.setting, self._centre, self._radius, self._floor_z, span, horizon)
        return air(np.maximum(light, 0.0), one.places, one.seen, view.eye, outlook.ways, scene, self._treatment)

    def _cleaned(self, rays: Rays, coarser: int, fine: bool) -> np.ndarray:
        """Light without noise (H, W, 3); that of a draft is spread over the colours of the surfaces, which are as fine as ever."""
        height, width = rays.light.shape[:2]
        if self._denoiser is None or self._denoiser[0] != (coarser, fine):
            self._put_away()
            self._denoiser = (coarser, fine), Denoiser(width, height, variant.choose() == variant.GPU, fine)
        denoiser = self._denoiser[1]
        if coarser == 1:
            return denoiser.clean(rays.light, rays.albedo, rays.normals)
        import cv2

        def smaller(picture: np.ndarray) -> np.ndarray:
            return cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)

        albedo = np.maximum(np.where(rays.seen[..., None] > 0.01, rays.albedo, 1.0), LEAST_ALBEDO).astype(np.float32)
        clean = denoiser.clean(rays.light, smaller(rays.albedo), smaller(rays.normals))
        fallen = clean / smaller(albedo)
        return cv2.resize(fallen, (self.width, self.height), interpolation=cv2.INTER_LINEAR) * albedo

    def segmentation(self, data: mujoco.MjData, camera: int) -> np.ndarray:
        """Geom number of each pixel, or -1: int32 (height, width), by MuJoCo's own renderer."""
        if self._plain is None:
            from .. import classic

            self._plain = classic.take(self.model, self.width, self.height)
        return self._plain.segmentation(data, camera)

    def close(self) -> None:
        """Free what it holds."""
        self._scenes.clear()
        self._put_away()
        if self._plain is not None:
            self._plain.close()
            self._plain = None

    def _put_away(self) -> None:
        """Close the denoiser."""
        if self._denoiser is not None:
            self._denoiser[1].close()
            self._denoiser = None


def glimpses_apart(count: int, pixels: int) -> int:
    """Of so many moments of a moving camera every how many-th is kept for what lies around things, so that they fit into memory."""
    return -(-count // max(1, GLIMPSES_BYTES // (44 * pixels)))


def _rays(light: np.ndarray, said: np.ndarray) -> Rays:
    """Bring what was traced into order; where there is only sky, nothing has a place."""
    for traced in (light, said):
        if not np.isfinite(traced).all():
            np.nan_to_num(traced, copy=False, nan=0.0, posinf=0.0, neginf=0.0)
    seen = np.clip(said[..., 3], 0.0, 1.0)
    places = said[..., 10:13] / np.maximum(seen, 1e-6)[..., None]
    return Rays(np.maximum(light, 0.0), np.clip(said[..., 4:7], 0, 1), said[..., 7:10], places, seen)
