"""Everything of a model that is drawn, as meshes grouped by body and material, which move with the recorded poses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.materials.look import NOTHING

from ... import swaying
from ...panel_lights import of_model
from ..preview import unit_shapes
from ..preview.things import EXACT_UV, FLAT_UV, Things
from . import bulbs, rounded, rubbed
from .absorbed import lets_through
from .coatings import CLEAR, CORNERS, Coatings
from .ground_rings import rings
from .inside_out import outward
from .leaning import facing, upright
from .relief import displaced
from .rounded import Mesh
from .two_sides import Sides, two_sided
from .unwrapped import along_sides, around_centre

if TYPE_CHECKING:
    import mujoco

MANY = 60
"""Of more spheres than this, each is drawn coarser."""
TREMBLE = 1e-7
"""Geoms that rest move by so much at times, m; a centimetre from the camera that is a hundredth of a pixel."""


@dataclass
class Figure:
    """Geoms of one material that move together; `shape` is Mitsuba's mesh of them."""

    coating: Any
    glow: np.ndarray
    """Radiance that it gives off, (3,)."""
    geoms: list[int] = field(default_factory=list)
    meshes: list[Mesh] = field(default_factory=list)
    shape: Any = None
    params: Any = None
    meshed: list[bool] = field(default_factory=list)
    """Which of them are meshes of any shape, through which light does not go."""
    absorbs: tuple[float, float, float] = NOTHING
    """What light loses of itself in it, 1/m."""
    _placed: tuple[np.ndarray, np.ndarray] | None = None
    _faces: bytes = b""
    _turned: bool = False
    _blown: tuple[float, float, float] | None = None
    strip: bool = False
    """It is the worn strips along the edges of geoms that others hold."""
    sways: list[np.ndarray] = field(default_factory=list)
    """Of each mesh that a breeze moves its corners' weights, m, and phases, (V, 2)."""
    poses: np.ndarray | None = None
    """Of each geom the rotation, place and size that it was given last, (G, 13)."""

    def finish(self) -> None:
        """Join its meshes, and hand the mesh over to Mitsuba."""
        counts = [len(mesh.points) for mesh in self.meshes]
        self.owner = np.repeat(np.arange(len(counts)), counts)
        self._ends = np.cumsum([0, *counts])
        self._any_shape = np.repeat(self.meshed, counts)
        self.points = np.concatenate([mesh.points for mesh in self.meshes])
        self.normals = np.concatenate([mesh.normals for mesh in self.meshes])
        uv = np.concatenate([np.zeros((len(m.points), 2)) if m.uv is None else m.uv for m in self.meshes])
        faces = np.concatenate([mesh.faces + start for mesh, start in zip(self.meshes, self._ends[:-1], strict=True)])
        self.shape, self.params = mesh_of(len(self.points), faces, uv, self.coating, self.glow)

    def place(self, data: mujoco.MjData, sizes: np.ndarray, breeze: tuple[float, float, float] | None = None) -> bool:
        """Move it to the poses in `data`, with the geoms' present sizes over those drawn; returns whether anything changed."""
        poses = np.column_stack([data.geom_xmat[self.geoms], data.geom_xpos[self.geoms], sizes[self.geoms]])
        blown = breeze if self.sways else None
        if self.poses is not None and np.array_equal(poses, self.poses) and blown == self._blown:
            return False
        self._blown = blown
        self.poses = poses
        rotation = poses[:, :9].reshape(-1, 3, 3)
        normals = np.einsum("vij,vj->vi", rotation[self.owner], self.normals)
        points = self._stands(poses)
        if blown is not None:
            weight, phase = np.concatenate(self.sways).T
            points = points + swaying.swayed(points, weight, phase, blown)
        fill(self.params, points, normals)
        self._placed = (points, normals) if any(self.meshed) else None
        self._faces, self._turned = b"", False
        return True

    def face(self, eye: np.ndarray) -> None:
        """Let all that an eye (3,) sees of its meshes face it."""
        if self._placed is None or self._faces == eye.tobytes():
            return
        self._faces = eye.tobytes()
        (points, normals), chosen = self._placed, self._any_shape
        theirs = normals[chosen]
        turned = facing(points[chosen], theirs, eye)
        turns = turned is not theirs
        if turns:
            normals = normals.copy()
            normals[chosen] = turned
        if turns or self._turned:
            self.params["vertex_normals"] = np.ascontiguousarray(normals, dtype=np.float32).ravel()
            self.params.update()
        self._turned = turns

    def _stands(self, poses: np.ndarray, chosen: Any = slice(None)) -> np.ndarray:
        """Where its points are, or those chosen, at these poses, (V, 3) m."""
        owner = self.owner[chosen]
        scaled = self.points[chosen] * poses[owner, 12:]
        return np.einsum("vij,vj->vi", poses[:, :9].reshape(-1, 3, 3)[owner], scaled) + poses[owner, 9:12]

    def moved(self, before: np.ndarray, now: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """The points (V, 3), m, of each geom that stands otherwise, at both poses."""
        for geom in np.flatnonzero(elsewhere(before, now)):
            chosen = slice(self._ends[geom], self._ends[geom + 1])
            yield self._stands(before, chosen), self._stands(now, chosen)


def elsewhere(before: np.ndarray, now: np.ndarray) -> np.ndarray:
    """Which geoms stand otherwise in one of two sets of poses (G, 13): bool (G,)."""
    return np.abs(before - now).max(axis=1) > TREMBLE


def mesh_of(
    vertices: int, faces: np.ndarray, uv: np.ndarray, coating: Any, glow: np.ndarray, coloured: bool = False
) -> tuple[Any, Any]:
    """An empty mesh of Mitsuba with these triangles, and its parameters; its corners may have colours of their own."""
    import mitsuba as mi

    props = mi.Properties()
    props["mesh_bsdf"] = coating
    if glow.max() > 0:
        light = {"type": "area", "radiance": {"type": "rgb", "value": glow.tolist()}, "sampling_weight": 0.0}
        props["mesh_emitter"] = mi.load_dict(light)
    shape = mi.Mesh("figure", vertices, len(faces), props=props, has_vertex_normals=True, has_vertex_texcoords=True)
    params = mi.traverse(shape)
    params["faces"] = np.ascontiguousarray(faces, dtype=np.uint32).ravel()
    params["vertex_texcoords"] = np.ascontiguousarray(uv, dtype=np.float32).ravel()
    if coloured:
        shape.add_attribute(CORNERS, 3, [0.5] * (3 * vertices))
        params = mi.traverse(shape)
    return shape, params


def fill(params: Any, points: np.ndarray, normals: np.ndarray, colours: np.ndarray | None = None) -> None:
    """Give a mesh its vertices and normals (V, 3), and colours of its own, scene-linear (V, 3), if it was made for them."""
    if colours is not None:
        params[CORNERS] = np.ascontiguousarray(np.clip(colours, 0.0, 0.97), dtype=np.float32).ravel()
    params["vertex_positions"] = np.ascontiguousarray(points, dtype=np.float32).ravel()
    params["vertex_normals"] = np.ascontiguousarray(normals, dtype=np.float32).ravel()
    params.update()


def shape_of(model: mujoco.MjModel, batch: Any, numbers: np.ndarray, geom: int, line_m: float = 0.0) -> Mesh:
    """The mesh of a geom in its own frame, with texture coordinates; with a line of corners so far from its edges, m."""
    kind, finish = batch.shape[0], batch.finish
    entry, size, half = finish.look, numbers[12:15].astype(float), float(numbers[15])
    many = len(batch.rows) > MANY
    mesh: Mesh
    if kind == "sphere":
        mesh = displaced(size, entry, geom, many) or rounded.sphere(size, 20 if many else 64)
    elif kind == "capsule":
        mesh = rounded.capsule(size[0], half, 16 if many else 32)
    elif kind == "cylinder":
        mesh = rounded.cylinder(size[0], size[2], 24 if many else 72, line_m)
    elif kind == "box":
        mesh = rounded.box(size, line_m)
    elif kind == "plane":
        mesh = rounded.sheet(size[0], size[1])
    else:
        made = unit_shapes.mesh if kind == "mesh" else unit_shapes.height_field
        rows, faces = made(model, batch.shape[1])
        v = np.column_stack([rows[:, 7], 1.0 - rows[:, 8]])
        mesh = Mesh(rows[:, :3].astype(float), rows[:, 4:7].astype(float), np.asarray(faces), v)
        mesh = upright(outward(mesh) if kind == "mesh" else mesh)
    if finish.texture < 0 and entry.paint is None:
        return mesh
    per_metre, other, mode, seed = (float(x) for x in numbers[24:28])
    if entry.around:
        return around_centre(mesh) if kind != "sphere" or mesh.uv is None else mesh
    if mode == EXACT_UV and mesh.uv is not None:
        return mesh._replace(uv=mesh.uv * per_metre)
    if mode == FLAT_UV:
        flat = mesh.points[:, :2] * (per_metre, other) + 0.5
        return mesh._replace(uv=np.column_stack([flat[:, 0], 1.0 - flat[:, 1]]))
    return along_sides(mesh, int(mode + 0.5), per_metre, seed)


def found_again(points: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Weights, m, and phases (V, 2) of corners at `points` (V, 3), which paint may have split, of a mesh that tells them."""
    known = {place.tobytes(): number for number, place in enumerate(rows[:, :3].astype(np.float32))}
    chosen = [known[place.tobytes()] for place in points.astype(np.float32)]
    return np.column_stack([rows[chosen, 7], 1.0 - rows[chosen, 8]]).astype(float)


class Figures:
    """The figures of one model."""

    def __init__(self, model: mujoco.MjModel, rest: mujoco.MjData) -> None:
        self.model = model
        self.things = Things(model)
        self.things.update(rest)
        self.coatings = Coatings(model)
        self._sizes = np.array(model.geom_size[:, 0])
        self.all: list[Figure] = []
        self._swaying = swaying.geoms(model)
        self.clear = any(batch.clear for batch in self.things.batches)
        """Glass or water is in the world, which takes longer paths."""
        groups: dict[Any, Figure] = {}
        rows = self.things.rows
        glowing = self.things.geoms[(rows[:, 29] > 0) & (rows[:, 37] == 0) & (rows[:, 19] >= CLEAR)]
        self.bulbs = bulbs.within(model, rest, glowing)
        panels = {panel.geom for panel in of_model(model)}  # emitters of their own
        for batch in self.things.batches:
            if batch.shape[0] == "disc":
                continue
            for row in batch.rows:
                if int(self.things.geoms[row]) not in panels:
                    self._add(groups, batch, row)
        for figure in groups.values():
            figure.finish()
        self.all = list(groups.values())

    def _add(self, groups: dict[Any, Figure], batch: Any, row: int) -> None:
        numbers, kind = self.things.rows[row], batch.shape[0]
        geom = int(self.things.geoms[row])
        entry = batch.finish.look
        rgb, alpha = numbers[16:19].astype(float), float(numbers[19])
        body = int(self.model.geom_bodyid[geom])
        fixed = self.model.body_weldid[body] == 0
        sheet = kind == "plane"
        extent = float(self.model.geom_rbound[geom])
        coating = self.coatings.of(batch.finish, rgb, alpha, ball=kind == "sphere", wide=extent > 0.8, sheet=sheet)
        half = numbers[12:15].astype(float)
        worn = rubbed.width(entry, kind, half) if batch.finish.texture < 0 else 0.0
        glow = rgb * float(numbers[29]) if entry.emission > 0 and entry.clear == 0 and alpha >= CLEAR else np.zeros(3)
        if batch.finish.texture >= 0 or entry.paint:  # what glows by a picture glows in its mean colour
            glow = np.asarray(batch.finish.mean) * float(numbers[29]) if glow.any() else glow
        if glow.any() and geom in self.bulbs:
            glow = np.maximum(glow, bulbs.radiance(self.model, geom, self.bulbs[geom]))
        see_through = batch.clear and not sheet
        alone = see_through or geom in self._swaying
        key = (-1 if fixed else body, id(coating), tuple(glow), geom if alone else -1)
        figure = groups.setdefault(key, Figure(coating, glow, absorbs=entry.absorbs if see_through else NOTHING))
        figure.geoms.append(geom)
        figure.meshed.append(kind == "mesh" and not see_through)
        mesh = shape_of(self.model, batch, numbers, geom, worn)
        if worn > 0:
            mesh, strips = rubbed.parted(mesh, kind, half, worn)
            edge = self.coatings.of(batch.finish, rgb, alpha, wide=extent > 0.8, strip=True)
            along = groups.setdefault((key[0], id(edge), "strip"), Figure(edge, np.zeros(3), strip=True))
            along.geoms.append(geom)
            along.meshed.append(False)
            along.meshes.append(strips)
        sides = two_sided(mesh) if figure.meshed[-1] else Sides(mesh, np.arange(len(mesh.points)))
        figure.meshes.append(sides.mesh)
        if geom in self._swaying:
            rows, _ = unit_shapes.mesh(self.model, batch.shape[1])
            figure.sways.append(found_again(mesh.points, rows)[sides.origin])

    def ground(self, centre: np.ndarray, radius: float) -> Iterator[Any]:
        """Meshes of the endless planes, none of which moves."""
        import mitsuba as mi

        from .coatings import texture, told

        for batch in (batch for batch in self.things.batches if batch.shape[0] == "disc"):
            for row in batch.rows:
                numbers, look = self.things.rows[row], batch.finish.look
                frame = numbers[:12].reshape(3, 4).astype(float)
                own = (frame[:, :3].T @ (np.append(centre, 0.0) - frame[:, 3]))[:2]
                tile = self.coatings.picture(batch.finish, True)
                for ring in rings(tile, numbers[16:19], look, float(numbers[24]), own, radius):
                    coating = mi.load_dict(told(texture(ring.pixels), look))
                    shape, params = mesh_of(len(ring.mesh.points), ring.mesh.faces, ring.mesh.uv, coating, np.zeros(3))
                    fill(params, ring.mesh.points @ frame[:, :3].T + frame[:, 3], ring.mesh.normals @ frame[:, :3].T)
                    yield shape

    def place(self, data: mujoco.MjData, breeze: tuple[float, float, float] | None = None) -> bool:
        """Move all figures to the poses in `data`, and what sways by a breeze; returns whether anything changed."""
        sizes = np.ones(self.model.ngeom)
        balls = self.things.geoms[self.things._balls]
        sizes[balls] = self.model.geom_size[balls, 0] / np.maximum(self._sizes[balls], 1e-12)
        return bool(sum([figure.place(data, sizes, breeze) for figure in self.all]))

    def passing(self) -> list[tuple[Any, tuple[float, float, float]]]:
        """The shapes that light goes through, with what it loses there, 1/m."""
        return [(figure.shape, figure.absorbs) for figure in self.all if lets_through(figure.coating)]

    def poses(self) -> tuple[np.ndarray, ...]:
        """Where all figures stand."""
        return tuple(figure.poses for figure in self.all if figure.poses is not None)

    def how_many_moved(self, before: tuple[np.ndarray, ...], now: tuple[np.ndarray, ...]) -> int:
        """How many geoms stand otherwise; loose ones are a figure each."""
        whole = zip(self.all, before, now, strict=True)
        return sum(int(elsewhere(mine, theirs).sum()) for figure, mine, theirs in whole if not figure.strip)

    def moved(
        self, before: tuple[np.ndarray, ...], now: tuple[np.ndarray, ...]
    ) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """The points (V, 3), m, of each geom that stands otherwise, at both of two sets of poses."""
        for figure, mine, theirs in zip(self.all, before, now, strict=True):
            if not figure.strip:
                yield from figure.moved(mine, theirs)
