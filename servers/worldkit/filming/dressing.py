"""`Dressing`: what a film draws and nobody simulated, and the looks it gives."""

from collections.abc import Callable, Sequence
from fnmatch import fnmatchcase
from typing import Any

import numpy as np

from ..errors import ProgramError
from . import groves, sward, swaying_weights
from .drawn_only import SHAPES, Surface, Thing, Vec3, known, matt, opaque, rgb
from .film_bounds import FAR_M, MOST_LAMPS, MOST_PANELS, PANEL_M, SMOOTHEST, STORM_M_S
from .ground import Height
from .law_clouds import Clouds
from .own_names import OwnNames
from .plain_refusals import line, whole
from .recorded import Recorded


class Dressing(Clouds):
    """The things and looks of a film; `recorded` is what happened."""

    def __init__(self, recorded: Recorded) -> None:
        super().__init__(recorded)
        self._names = OwnNames()
        self._things: list[Thing] = []
        self._grown: list[tuple[Thing, Callable[[np.ndarray], Any], int]] = []
        self._surfaces: list[dict[str, Any]] = []
        self._labels: list[str] = []
        self._lamps: list[dict[str, Any]] = []
        self._panels: list[dict[str, Any]] = []
        self._looks: dict[str, str | Surface] = {}
        self._ground_look: str | Surface | None = None
        self._breeze: tuple[float, float] | None = None

    def as_planned(self) -> None:
        """Light and sky as the plan states them, whatever was said of them before; nothing where it states none."""
        if told := self._stated():
            self._told(None, **told)

    def _stated(self) -> dict[str, Any]:
        from ..lights import treated

        return treated(**self.recorded.light)

    def draw(
        self,
        name: str,
        shape: str,
        size: Vec3 | float,
        *,
        pos: Vec3 = (0.0, 0.0, 0.0),
        yaw_deg: float = 0.0,
        quat: tuple[float, float, float, float] | None = None,
        look: str | Surface = "plastic_grey",
        to: str = "",
    ) -> None:
        """Draw a thing that is not simulated: a box, sphere, cylinder, capsule or ellipsoid of full extents `size` (m).

        It stands in the world, or is fixed `to` a body, in whose frame `pos` (m) and the turn are then. `look` is a name of
        `worldkit.materials`, `#rrggbb`, or a `Surface`.
        """
        if shape not in SHAPES or shape == "mesh":
            raise ProgramError(f"there is no shape {shape!r}", "film.py", f"use one of: {', '.join(SHAPES[:-1])}")
        extents = tuple(float(v) for v in (size if isinstance(size, (tuple, list)) else (size,) * 3))
        self._add(Thing(name, shape, extents, look, pos, quat or _yaw(yaw_deg), to))  # type: ignore[arg-type]

    def mesh(
        self,
        name: str,
        vertices: np.ndarray,
        faces: np.ndarray,
        *,
        uv: np.ndarray | None = None,
        pos: Vec3 = (0.0, 0.0, 0.0),
        yaw_deg: float = 0.0,
        look: str | Surface = "plastic_grey",
        to: str = "",
        instead: bool = False,
        sways: np.ndarray | None = None,
    ) -> None:
        """Draw a mesh that is not simulated: `vertices` (V, 3) in metres, `faces` (F, 3), `uv` (V, 2) for its picture.

        With `instead` it is a skin: drawn in place of the shapes of the body `to`, in the body's frame, and of its size. The
        ground may have one, too: `film.recorded.into("hill", points)` brings points of the world into the hill's frame, and
        the statement says how far the drawn surface is from the simulated one at most.

        `sways` (V,) is how far a fresh breeze carries each vertex, m (cloth on a line: 0 where it hangs); see `breeze`.
        """
        points, triangles = np.asarray(vertices, dtype=float), np.asarray(faces, dtype=int)
        good = points.ndim == 2 and points.shape[1] == 3 and triangles.ndim == 2 and triangles.shape[1] == 3
        if not good or not np.isfinite(points).all() or triangles.min() < 0 or triangles.max() >= len(points):
            raise ProgramError(f"the mesh {name!r} is no (V, 3) vertices and (F, 3) faces among them", "film.py", "")
        if uv is not None and (np.shape(uv) != (len(points), 2) or not np.isfinite(uv).all()):
            raise ProgramError(
                f"the uv of {name!r} must be ({len(points)}, 2) numbers", "film.py", "one for each vertex"
            )
        if instead and not to:
            raise ProgramError(f"the skin {name!r} belongs to no body", "film.py", "name it: to='…'")
        told = None
        if sways is not None:
            weight = np.asarray(sways, dtype=float)
            pictured = uv is not None or (isinstance(look, Surface) and look.picture is not None)
            if weight.shape != (len(points),) or not ((weight >= 0) & (weight < 10)).all() or instead or pictured:
                cause = f"the sways of {name!r} must be ({len(points)},) metres from 0 to 10, of a mesh without picture that is no skin"
                raise ProgramError(cause, "film.py", "0 where it is held")
            told = np.stack([weight, 0.8 * points @ np.array([1.0, 0.7, 1.3])], axis=1)
        one = Thing(name, "mesh", (1, 1, 1), look, pos, _yaw(yaw_deg), to, instead, points, triangles, uv, sways=told)
        self._add(one)

    def grass(
        self,
        name: str = "grass",
        *,
        area: tuple[float, float, float, float],
        height: float = 0.12,
        count: int = 6000,
        look: str | Surface = "#5f7a35",
        clear_of: Sequence[tuple[float, float, float]] = (),
        z: float | str | Height | None = None,
        seed: int = 1,
        densest: tuple[float, float] | None = None,
    ) -> None:
        """Blades of grass in an area (x0, y0, x1, y1), m, but for the discs (x, y, radius) of `clear_of`.

        They stand in clumps, spread evenly, or most of them around `densest` (x, y), m, as where a camera is near.

        They stand on the ground, or at `z`: a height, m; a body that stands still, such as a hill, on whose height field, mesh
        or box they stand (`film.recorded.surface`); or a function z(x, y) of arrays, NaN where nothing grows. A blade costs
        three triangles: 60000, the most of one call, cost 180000 of the 3 million that a film may draw in one mesh.
        """
        if not 1 <= count <= 60_000:
            raise ProgramError(f"grass has 1 to 60000 blades, got {count}", "film.py", "cover less of the ground")
        points, faces = sward.blades(area, height, count, self._ground(z), clear_of, whole(seed), densest)
        if not len(points):
            raise ProgramError(
                f"no blade of {name!r} stands on the ground that it is given", "film.py", "move its area"
            )
        sways = swaying_weights.of_grass(points)
        still = (0, 0, 0), (1, 0, 0, 0)
        self._add(
            Thing(name, "mesh", (1, 1, 1), matt(look), *still, vertices=points, faces=faces, sways=sways, grows=True)
        )

    def tree(
        self,
        name: str,
        kind: str = "broadleaf",
        *,
        at: Sequence[tuple[float, float]],
        height: float = 8.0,
        z: float | str | Height | None = None,
        season: str = "summer",
        leaves: str | Surface = "",
        bark: str | Surface = "",
        seed: int = 1,
    ) -> None:
        """Trees that are drawn only: one of a kind at each of some places (x, y), m, about `height` m high.

        A kind is `oak`, `birch`, `pine`, `willow`, `palm`, `bush` or `hedge` (a piece twice as long as high, along x), in `spring`,
        `summer`, `autumn` or `winter`; or, for woods far away, `conifer` or `broadleaf`. They stand on the ground or on `z` as
        `grass` does; each differs from the others, and is the same at every drawing of one `seed`. The fewer, the finer: a tree has
        at most 24,000 triangles, one of 100 has 6000; more than 100 need another call.

        Raises:
            ProgramError: there is no such kind or season, there are none or more than 100 places, or one is beside the ground.
        """
        for thing in groves.planted(name, kind, at, self._ground(z), height, season, leaves, bark, whole(seed)):
            self._add(thing)

    def breeze(self, speed: float | None = None, *, towards_deg: float | None = None) -> None:
        """Let a wind move the grass, the leaves and branches of trees, and every mesh with `sways`; drawn only.

        It blows with `speed`, m/s, towards an azimuth; what is left out is the wind that the plan's medium states, of which no
        more than 40 m/s are drawn. Gusts travel with it. In the final pass a shot with it is drawn whole, frame by frame.

        Raises:
            ProgramError: the plan states no wind, and none is given; or it is none of 0 to 40 m/s.
        """
        x, y = self.recorded.wind[:2]
        planned = float(np.hypot(x, y))
        strong = min(planned, STORM_M_S) if speed is None else float(speed)
        if not 0 < strong <= STORM_M_S or not np.isfinite(towards_deg or 0.0):
            raise ProgramError(
                f"a breeze of {strong:g} m/s towards {towards_deg}: a wind blows with more than 0 and at most 40 m/s",
                "film.py",
                "film.breeze(3.0, towards_deg=90)" + ("" if planned else ", as the plan's medium states no wind"),
            )
        way = np.arctan2(y, x) if towards_deg is None else np.radians(float(towards_deg))
        self._breeze = (strong * float(np.cos(way)), strong * float(np.sin(way)))

    def _ground(self, z: float | str | Height | None) -> Height:
        """What things stand on, as a height over x and y."""
        if isinstance(z, str):
            return self.recorded.surface(z)
        if callable(z):
            return z
        level = self.recorded.floor_z if z is None else float(z)
        return lambda x, _y: np.full(np.shape(x), level)

    def particles(
        self,
        name: str,
        at: Callable[[np.ndarray], Any],
        *,
        look: str | Surface = "#ffffff",
        diameter: float = 0.02,
        shape: str = "ball",
    ) -> None:
        """Small balls that are not simulated: `at(times)` gives for recorded times (F,) their places (F, P, 3), m.

        It may give a pair: places, and diameters (F, P) in metres, where 0 is not drawn. Asked once, when the film is whole.
        With `shape="leaf"` they are leaves as long as `diameter`, which rock and spin as they go and lie level at rest.

        Raises:
            ProgramError: there is no such shape, or no diameter above 0.
        """
        if shape not in ("ball", "leaf") or not 0 < diameter < np.inf or not callable(at):
            raise ProgramError(
                f"{name!r} is of balls or leaves with a diameter above 0, at a function's places, not {diameter} of {shape!r} at {at!r}",
                "film.py",
                "shape='leaf', and a function of times (F,) that gives places (F, P, 3)",
            )
        size, place, turn = (diameter,) * 3, (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)
        if shape == "leaf":
            from ..sculpt.foliage import leaf

            one = leaf(1.0, 0.6, veins=0)
            self._add(Thing(name, "mesh", size, look, place, turn, vertices=one.vertices, faces=one.faces, uv=one.uv))
        else:
            self._add(Thing(name, "sphere", size, look, place, turn))
        self._grown.append((self._things.pop(), at, line()))

    def surface(
        self,
        name: str,
        *,
        of: str | Sequence[str],
        look: str | Surface = "wax",
        blended: bool = False,
        smooth: float = 1.0,
    ) -> None:
        """Bodies or particles of one substance as one smooth surface, made for each picture from where they are then.

        `of` names bodies, a law that one shows, or particles that were drawn before, `*` standing for any letters: `film.surface("honey",
        of="drop_*", look="honey")`. Their own shapes are left out. `blended`: their colours, mixed where they meet; those of a law too.
        `smooth`, 1 to 3: over how much more than its near neighbours' places a particle's place is evened out: 2 for what lies smooth,
        such as snow, cream, or a mound of honey; fine threads and splashes grow thinner with it.

        Raises:
            ProgramError: it names nothing, or what is another surface's already.
        """
        known(look)
        if not isinstance(smooth, (int, float)) or not 1.0 <= smooth <= SMOOTHEST:
            raise ProgramError(f"a surface is 1 to {SMOOTHEST:g} smooth, not {smooth!r}", "film.py", "try smooth=2")
        laws = self.recorded.shows
        wanted = [laws.get(one, one) for one in ([of] if isinstance(of, str) else of)]
        names = [*self.recorded.bodies, *(thing.name for thing, *_ in self._grown if thing.shape == "sphere")]
        found = [each for each in names if any(fnmatchcase(each, pattern) for pattern in wanted)]
        taken = {each for one in self._surfaces for each in one["of"]}
        if not found or taken & set(found):
            raise ProgramError(
                f"the surface {name!r} is of {', '.join(wanted) or 'nothing'}, which names no body and no particles, or another's",
                "film.py",
                f"name some of: {', '.join(names[:6]) or '(none)'}",
            )
        self._named(name)
        more = {} if smooth == 1.0 else {"smooth": float(smooth)}
        self._surfaces.append({"name": name, "of": found, "look": look, "blended": blended, **more})

    def lamp(
        self,
        name: str,
        pos: Vec3,
        *,
        strength: float = 1.0,
        colour: str = "#ffd9a8",
        aim: Vec3 | None = None,
        cone_deg: float = 40.0,
        radius: float = 0.0,
        seen: bool = True,
        to: str = "",
    ) -> None:
        """A lamp at `pos` (m), in the world or fixed `to` a body: it shines around, or with `aim` in a cone towards a point.

        A white surface that faces it at one metre has radiance `strength` (the key light gives about 2). With a `radius`, m,
        a glowing ball is drawn around it, unless `seen` is False. At most 64; the preview draws the eight strongest, and shadows of four.

        Raises:
            ProgramError: there are too many, or a number is none that a lamp may have.
        """
        numbers = [*pos, strength, cone_deg, radius, *(aim or ())]
        if len(self._lamps) >= MOST_LAMPS:
            raise ProgramError(f"a film has at most {MOST_LAMPS} lamps", "film.py", "let one stand for many")
        good = (np.abs(numbers) <= FAR_M).all() and 0 < strength <= 1000 and 1 <= cone_deg <= 89 and 0 <= radius <= 10
        if not good or len(pos) != 3 or (aim is not None and len(aim) != 3):
            raise ProgramError(
                f"the lamp {name!r} needs a place, a strength up to 1000, a cone of 1 to 89 degrees",
                "film.py",
                "check its numbers",
            )
        self._carrier(to)
        if radius > 0 and seen:
            self.draw(
                name, "sphere", 2 * radius, pos=pos, look=Surface(colour=colour, glow=min(6.0, 2 + strength)), to=to
            )
        else:
            self._named(name)
        self._lamps.append(
            {
                "name": name, "pos": list(map(float, pos)), "aim": None if aim is None else list(map(float, aim)),
                "strength": float(strength), "rgb": list(rgb(colour)), "cone_deg": float(cone_deg), "to": to,
            }
        )  # fmt: skip

    def panel(
        self,
        name: str,
        pos: Vec3,
        size: tuple[float, float],
        *,
        towards: Vec3,
        strength: float = 1.0,
        colour: str = "#fff6e8",
        seen: bool = True,
        to: str = "",
    ) -> None:
        """A shining rectangle, such as a window or a softbox: its middle at `pos` (m), facing the point `towards`.

        `size` is its width, which lies level, and its height (m). It shines from its front, with soft shadows in the final
        pass and without in the preview; from afar as a lamp of that `strength`. It is seen itself, and dark from behind,
        unless `seen` is False. It stands in the world, or is fixed `to` a body in whose frame its points are. At most 16.

        Raises:
            ProgramError: there are too many, or a number is none that a panel may have.
        """
        if len(self._panels) >= MOST_PANELS:
            raise ProgramError(f"a film has at most {MOST_PANELS} panels", "film.py", "let one stand for many")
        place, point, extent = (np.asarray(value, dtype=float) for value in (pos, towards, size))
        good = place.shape == point.shape == (3,) and extent.shape == (2,) and 0 < strength <= 1000
        if not good or not (np.abs([*place, *point]) <= FAR_M).all() or not np.linalg.norm(point - place) > 1e-6:
            raise ProgramError(
                f"the panel {name!r} needs a place, another point that it faces, and a strength up to 1000",
                "film.py",
                "film.panel('window', (0, 2, 1.5), (1.2, 1.5), towards=(0, 0, 0.5))",
            )
        if not (extent.min() >= PANEL_M[0] and extent.max() <= PANEL_M[1]):
            raise ProgramError(
                f"the panel {name!r} is {size} m",
                "film.py",
                f"give it a width and height of {PANEL_M[0]} to {PANEL_M[1]} m",
            )
        self._carrier(to)
        self._named(name)
        self._panels.append(
            {
                "name": name, "pos": place.tolist(), "towards": point.tolist(), "size": extent.tolist(),
                "strength": float(strength), "rgb": list(rgb(colour)), "seen": bool(seen), "to": to,
            }
        )  # fmt: skip

    def look(self, name: str, look: str | Surface) -> None:
        """Another look for a body, one geom, or a law or what shows it, through the whole film; the report lists it.

        None makes a mover unseen.
        """
        known(look)
        if not isinstance(name, str):
            raise ProgramError(f"a look is given to a body or a geom by its name, not to {name!r}", "film.py", "")
        name = self.recorded.shows.get(name, name)
        self._looks[name] = opaque(look, name, self.recorded.movers)

    def ground(self, look: str | Surface) -> None:
        """Another look for the ground, where the world has one (the geom `ground`)."""
        known(look)
        self._ground_look = look

    def _add(self, thing: Thing) -> None:
        known(thing.look)
        self._named(thing.name)
        self._carrier(thing.to)
        self._things.append(thing)

    def _carrier(self, to: str) -> None:
        """Refuse to fix anything to what is no body; empty is the world."""
        if to != "":
            self.recorded.index(to)

    def _named(self, name: str) -> None:
        """Refuse a name that something else has, or none."""
        self._names.take(name)


def _yaw(yaw_deg: float) -> tuple[float, float, float, float]:
    half = np.radians(yaw_deg) / 2
    return (float(np.cos(half)), 0.0, 0.0, float(np.sin(half)))
