"""Draw one model by tracing paths: its figures in their light, each frame at the poses of its moment."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.materials import look
from worldkit.settings import STUDIO, Light

from ...panel_lights import of_model
from ...treatment import PLAIN, Treatment
from ..classic import Classic
from ..preview.eye import View, of_camera
from ..preview.finish import Finish, linear
from ..preview.lighting import relight
from ..preview.scenery import own_lights, setting_of, space_of
from . import daylight, panel_emitters, patches, plates, rounded, variant, walked
from .darkroom import Scene, air, develop
from .denoised import Denoiser
from .figures import Figures, fill, mesh_of
from .glimpses import Around, Glimpse, Outlook, glimpses_apart
from .half_room import Face, Walls
from .plates import Plate, Sight
from .shutter import FINEST, Lens, Shutter, sensor
from .strand_meshes import Strands
from .unwrapped import along_sides
from .walked import Rays

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    import mujoco

    from .. import Before, Moment, Quality

DEPTH, CLEAR_DEPTH = 4, 12
"""The longest paths, and those where light goes through glass."""
SEEDS_APART = 1 << 16
"""Moments have chances of their own."""
LEAST_ALBEDO = 0.2
"""Darker surfaces show light as it comes: of what they hardly reflect no draft can tell what fell on them."""
BRIGHTEST = 12.0
"""Of few samples, a pixel of more scene light would be a speck that the denoiser cannot take out; of many, it is a caustic."""


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
        held = {light for lamps in self.figures.bulbs.values() for light in lamps}
        self._lights = [light for light in self._lights if light not in held]
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
        self._depth = CLEAR_DEPTH if self.figures.clear or self._strands.clear else DEPTH
        self._clear = [*self.figures.passing(), *self._strands.passing]
        self._plates = plates.Shelf()
        self._plain: Classic | None = None
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
        disk = daylight.key_disk(self.setting, self._centre, max(self._radius, 1.0))
        self._around = Around(self.setting, self._treatment, self.width, self.height, disk)
        self._scenes.clear()

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
                "type": "scene", "around": daylight.environment(self._around.lighting),
                **daylight.key_lights(self.setting, self._centre, reach, self._treatment.light_gobo),
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
        """The camera, with the lens that the film asks for."""
        return sensor(view, self._treatment, self.width // coarser, self.height // coarser, channels)

    def _placed(self, data: mujoco.MjData, view: View, faces: frozenset[Face]) -> Any:
        """The scene with these walls at the poses of `data`, as it is seen from here."""
        if self.figures.place(data, self._treatment.breeze) | self._strands.place(data):
            self._stale.update(self._scenes)
        for figure in self.figures.all:
            figure.face(view.eye)
        return self._scene(faces, data)

    def trace(
        self,
        data: mujoco.MjData,
        view: View,
        faces: frozenset[Face],
        samples: int,
        seed: int,
        coarser: int = 1,
        guides: int = 4,
        where: np.ndarray | None = None,
    ) -> Rays:
        """Trace the picture of `data`, with these walls, or some of it; its light `coarser` times smaller each way."""
        scene, eye = self._placed(data, view, faces), self._sensor(view, "rgb", coarser)
        light = walked.light(scene, eye, self._depth, samples, seed, where, self._clear)
        rays = walked.ordered(light, walked.guides(scene, self._sensor(view, "rgba"), guides, where, self._clear))

        def again() -> tuple[np.ndarray, np.ndarray]:
            covered = walked.covered(scene, self._sensor(view, "rgba", coarser), samples, seed, where)
            return covered, walked.light(self._around.alone(), eye, 1, samples, seed, where)

        return self._around.uncovered(rays, view, again, where)

    def image(self, data: mujoco.MjData, camera: int, quality: Quality) -> np.ndarray:
        """The picture: uint8 (height, width, 3)."""
        return self.blurred([data], 1, camera, quality)

    def blurred(self, moments: Iterable[mujoco.MjData], count: int, camera: int, quality: Quality) -> np.ndarray:
        """The picture of a shutter that is open for `count` moments, their light added up and then developed once.

        `quality` is that of the whole: its samples a pixel, less than one for a draft, are shared out among the moments.
        """
        shutter = Shutter.of(quality, count)
        rays, glimpses = self._exposed(moments, shutter, camera)
        return self._developed(self._cleaned(rays, shutter), glimpses)

    def _exposed(
        self, moments: Iterable[mujoco.MjData], shutter: Shutter, camera: int, where: np.ndarray | None = None
    ) -> tuple[Rays, list[Glimpse]]:
        """The mean of what is traced of some moments, in all pixels or in some, and what is around it."""
        mean: Rays | None = None
        apart = glimpses_apart(shutter.moments, self.width * self.height)
        glimpses: list[Glimpse] = []
        for number, data in enumerate(moments):
            view, outlook, drawn, painted = self._seen(data, camera)
            seed = number * SEEDS_APART
            rays = self.trace(data, view, drawn, shutter.each, seed, shutter.coarser, shutter.guides, where)
            if shutter.samples < FINEST or self.figures.bulbs:  # a bulb seen outright would glow over all
                np.minimum(rays.light, BRIGHTEST, out=rays.light)
            mean = rays if mean is None else mean.joined(rays, number)
            if number % apart == 0:
                glimpses.append(Glimpse(view, outlook, painted, rays.places, rays.seen))
        assert mean is not None
        if all(one.outlook is glimpses[0].outlook for one in glimpses):  # the camera stood still
            glimpses = [glimpses[-1]._replace(places=mean.places, seen=mean.seen)]
        return mean, glimpses

    def _seen(self, data: mujoco.MjData, camera: int) -> tuple[View, Outlook, frozenset[Face], frozenset[Face]]:
        """What a camera looks at, with the walls that are drawn and those that are painted in."""
        view = of_camera(self.model, data, camera, self.width, self.height)
        outlook = self._around.outlook(view)
        if self._walls is None:
            return view, outlook, frozenset(), frozenset()
        some = outlook.ways[:: max(self.height // 24, 1), :: max(self.width // 40, 1)].reshape(-1, 3)
        return view, outlook, *self._walls.seen(view.eye, some)

    def _developed(self, clean: np.ndarray, glimpses: list[Glimpse]) -> np.ndarray:
        """The picture of light without noise, and of what is around it."""
        if len(glimpses) == 1:
            clean = glimpses[0].cleared(clean)
        light = sum((self._around_it(clean, one) for one in glimpses), np.float32(0)) / np.float32(len(glimpses))
        return develop(light, self.setting, self._treatment)

    def over(self, before: Sequence[Before], moments: Sequence[Moment], camera: int, quality: Quality) -> np.ndarray:
        """As `blurred`, but where nothing differs from the pictures `before` of the same still camera and light, these stand.

        They are traced more finely, and so is what differs where that is little.
        """
        shutter = Shutter.of(quality, len(moments))
        finer = Shutter.of(plates.samples(shutter.samples), len(moments))
        first = moments[0]()  # which stands only until another moment is asked for
        view, outlook, drawn, painted = self._seen(first, camera)
        self._placed(first, view, drawn)
        now, moved = self.figures.poses(), self.figures.how_many_moved
        before = before[: self.beside(len(moments), quality)[0]]
        self._plates.keep({(one.name, finer) for one in before})
        found = [self._plate(one, finer, camera) for one in before]
        known = [plate for plate in found if plate.key == self._key(view, drawn)]
        known = [plate for plate in known if moved(plate.sights[0].poses, now) <= plates.MOST_MOVED]
        sights = self._sights(moments, view, drawn) if known else ()
        look = plates.Look.of(self.setting, self._treatment, self._floor_z, view)
        kept = plates.kept(sights, known, self.figures, self._strands, view, look) if known else None
        if kept is None:
            return self.blurred((moment() for moment in moments), len(moments), camera, quality)
        rays, clean = kept.rays, kept.clean
        if kept.left.any():
            some = shutter.finer(float(kept.left.mean()), finer.samples)
            anew, _ = self._exposed((moment() for moment in moments), some, camera, kept.left)
            rays = anew.over(rays, kept.left)
        if kept.other.any():
            clean = patches.mended(clean, rays, kept.other, self._denoised)
        return self._developed(clean, [Glimpse(view, outlook, painted, rays.places, rays.seen)])

    def beside(self, moments: int, quality: Quality) -> tuple[int, float]:
        """How many pictures of its shot at most `over` draws with one of so many moments: those that have room; and how many times
        the samples each of them takes."""
        shutter, pixels = Shutter.of(quality, moments), self.width * self.height
        # A breeze moves all that grows; computed plainly, paths are not walked side by side; a draft gains nothing.
        still = self._treatment.breeze is None and variant.choose() != variant.PLAIN and shutter.coarser == 1
        held = (*self.figures.poses(), *self._strands.points.values())
        sight = sum(part.nbytes for part in held) + 12 * pixels // plates.SIDE**2
        fitting = plates.fitting(pixels, sight, shutter.moments) if still else 0
        return fitting, plates.samples(shutter.samples) / shutter.samples

    def _key(self, view: View, drawn: frozenset[Face]) -> Any:
        """What has to be equal in two pictures for the light of the one to be that of the other."""
        lens = Lens.of(view, self._treatment)
        return view.eye.tobytes(), view.axes.tobytes(), view.tangents, lens, drawn, self._treatment.lit

    def _plate(self, one: Before, shutter: Shutter, camera: int) -> Plate:
        """The picture of these moments, with what it takes to see what differs from it."""
        name = (one.name, shutter)
        plate = self._plates.find(name)
        if plate is None:
            view, _, drawn, _ = self._seen(one.moments[0](), camera)
            key = self._key(view, drawn)
            seen = (self._seen(moment(), camera) for moment in one.moments[1:])
            moving = any(self._key(later, walls) != key for later, _, walls, _ in seen)
            sights = () if moving else self._sights(one.moments, view, drawn)
            rays, _ = self._exposed((moment() for moment in one.moments), shutter, camera)
            plate = self._plates.put(name, Plate(None if moving else key, sights, rays, self._cleaned(rays, shutter)))
        return plate

    def _sights(self, moments: Sequence[Moment], view: View, drawn: frozenset[Face]) -> tuple[Sight, ...]:
        """What is seen coarsely of each moment."""
        sights = []
        for moment in moments:
            scene = self._placed(moment(), view, drawn)
            eye = self._sensor(view, "rgb", plates.SIDE)
            light = walked.light(scene, eye, self._depth, plates.SAMPLES, 0, clear=self._clear)
            sights.append(Sight(light, self.figures.poses(), dict(self._strands.points)))
        return tuple(sights)

    def _around_it(self, light: np.ndarray, one: Glimpse) -> np.ndarray:
        """Light (H, W, 3) with the surroundings, the painted walls and the air of one glimpse."""
        view, outlook = one.view, one.outlook
        if one.painted:
            assert self._walls is not None
            away = np.linalg.norm(one.places - view.eye, axis=-1)
            reach = np.where(one.seen > 0.5, away, np.inf)
            light = self._walls.paint_in(light, one.painted, view.eye, outlook.ways, reach, self._around.lighting)
        span = max(self._radius, 0.55 * float(np.linalg.norm(view.eye - self._centre)))
        horizon = self._around.shown[len(self._around.shown) // 2 - 2]
        scene = Scene(self.setting, self._centre, self._radius, self._floor_z, span, horizon)
        return air(light, outlook.sky, one.places, one.seen, view.eye, outlook.ways, scene, self._treatment)

    def _cleaned(self, rays: Rays, shutter: Shutter) -> np.ndarray:
        """Light without noise (H, W, 3); that of a draft is spread over the colours of the surfaces, which are as fine as ever."""
        coarser, fine = shutter.coarser, shutter.fine
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

        albedo = np.maximum(rays.albedo, LEAST_ALBEDO).astype(np.float32)
        clean = denoiser.clean(rays.light, smaller(rays.albedo), smaller(rays.normals))
        fallen = clean / smaller(albedo)
        return cv2.resize(fallen, (self.width, self.height), interpolation=cv2.INTER_LINEAR) * albedo

    def _denoised(self, rays: Rays, scale: float, fine: bool) -> np.ndarray:
        """Light without noise of a patch (h, w, 3) of a picture, brightened by `scale` meanwhile."""
        height, width = rays.seen.shape
        denoiser = Denoiser(width, height, variant.choose() == variant.GPU, fine, scale)
        try:
            return denoiser.clean(rays.light, rays.albedo, rays.normals)
        finally:
            denoiser.close()

    def segmentation(self, data: mujoco.MjData, camera: int) -> np.ndarray:
        """Geom number of each pixel, or -1: int32 (height, width), by MuJoCo's own renderer."""
        return self._by_numbers.segmentation(data, camera)

    def seen_through(self, data: mujoco.MjData, camera: int) -> np.ndarray | None:
        """The same without all that is see-through; None where nothing is."""
        return self._by_numbers.seen_through(data, camera)

    @property
    def _by_numbers(self) -> Classic:
        """MuJoCo's own renderer."""
        if self._plain is None:
            self._plain = Classic(self.model, self.width, self.height)
        return self._plain

    def close(self) -> None:
        """Free what it holds."""
        self._scenes.clear()
        self._plates.keep(())
        self._put_away()
        if self._plain is not None:
            self._plain.close()
            self._plain = None

    def _put_away(self) -> None:
        """Close the denoiser."""
        if self._denoiser is not None:
            self._denoiser[1].close()
            self._denoiser = None
