"""`Film`: what is shown, from where, how fast, in what light, with what around it. A description, drawn by another process."""

import sys
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..errors import ProgramError
from . import trees, viewpoints
from .drawn_only import SHAPES, Surface, Thing, Vec3, blades, known, look_facts
from .frame_by_frame import grown, sampled
from .ground import Height
from .recorded import Recorded
from .viewpoints import Viewpoint
from .weather import Weather

MOST_FRAMES = 20_000
SLOWEST, FASTEST = 1 / 200, 50.0
PLACES = ("bottom", "top", "title", "left")
Speed = float | tuple[float, float]


class Film(Weather):
    """A film in the making; `recorded` is what happened.

    Shots follow each other; what is not said has good defaults: without any shot the film tells the event by itself, without
    light and sky it has the setting's own.
    """

    def __init__(self, recorded: Recorded) -> None:
        super().__init__()
        self.recorded = recorded
        self.now = 0.0
        """Film time at which the next shot begins, s."""
        self.reached = 0.0
        """Recorded time that the last shot ended at, s."""
        self._shots: list[dict[str, Any]] = []
        self._captions: list[dict[str, Any]] = []
        self._things: list[Thing] = []
        self._grown: list[tuple[Thing, Callable[[np.ndarray], Any]]] = []
        self._looks: dict[str, str | Surface] = {}
        self._shutter, self._samples = 0.0, 1
        self.line = 1
        """Line of film.py that what is being described comes from."""

    # -- shots ---------------------------------------------------------------------------------------------------------

    def shot(self, camera: Viewpoint, *, until: float, speed: Speed = 1.0, start: float | None = None) -> None:
        """Show the recording from where the last shot ended (or from `start`, recorded s) to `until`, through a camera.

        `speed` is recorded seconds in a second of film: 0.25 is slow motion, a pair is a ramp from one to the other. The
        picture says by itself how fast it runs whenever that is not 1.

        Raises:
            ProgramError: the times are not in the recording, or do not run forward; the speed is none that can be shown.
        """
        begin = self.reached if start is None else float(start)
        end = min(float(until), self.recorded.duration)
        if not 0.0 <= begin < end:
            raise ProgramError(
                f"a shot from {begin:.3g} s to {end:.3g} s shows nothing of {self.recorded.duration:.3g} recorded seconds",
                "film.py",
                "give until= a later time, or start= an earlier one",
            )
        first, last = (float(v) for v in (speed if isinstance(speed, (tuple, list)) else (speed, speed)))
        if not (SLOWEST <= first <= FASTEST and SLOWEST <= last <= FASTEST):
            raise ProgramError(
                f"a speed lies between 1/200 and 50, got {speed}", "film.py", "hold a moment with film.hold"
            )
        lasts = (end - begin) / (0.5 * (first + last))
        count = max(2, round(lasts * self.recorded.fps))
        share = np.arange(count + 1) / count
        # The integral of a smooth step from the first speed to the last; whole frames, so it ends within half of one.
        ramp = first * share + (last - first) * (share**3 - 0.5 * share**4)
        times = np.minimum(begin + ramp * count / self.recorded.fps, self.recorded.duration)
        self._take(camera, times[:-1], float(times[-1]))

    def hold(self, camera: Viewpoint, seconds: float, *, at: float | None = None) -> None:
        """Show one recorded moment, the one that was reached or `at`, for some seconds of film, while the camera may move."""
        moment = self.reached if at is None else float(at)
        if not (0.0 <= moment <= self.recorded.duration and 0 < seconds <= 60):
            raise ProgramError(
                f"{moment:.3g} s is no recorded moment, or {seconds} s too long", "film.py", "at most 60 s"
            )
        self._take(camera, np.full(max(2, round(seconds * self.recorded.fps)), moment), moment)

    def _take(self, camera: Viewpoint, times: np.ndarray, reached: float) -> None:
        if not isinstance(camera, Viewpoint):
            raise ProgramError(
                f"a shot needs a camera, not {camera!r}", "film.py", "e.g. film.shot(follow('ball'), until=1)"
            )
        if camera.planned and camera.planned not in self.recorded.cameras:
            known = ", ".join(self.recorded.cameras) or "(none)"
            raise ProgramError(f"the plan has no camera {camera.planned!r}", "film.py", f"name one of: {known}")
        first = sum(len(shot["times"]) for shot in self._shots)
        if first + len(times) > MOST_FRAMES:
            raise ProgramError(f"the film has more than {MOST_FRAMES} frames", "film.py", "show less of it so slowly")
        self._shots.append({"camera": camera, "times": times, "line": _line()})
        self.reached, self.now = reached, (first + len(times)) / self.recorded.fps

    def usual(self) -> None:
        """The shots of a film that nobody has thought about: where we are, what moves, the event slowly, the outcome."""
        recorded, event = self.recorded, self.recorded.event()
        if not recorded.movers:
            self.shot(viewpoints.wide(), until=recorded.duration)
            return
        lead = max(
            recorded.movers,
            key=lambda name: float(np.max(recorded.speed(name, recorded.time[:: 1 + len(recorded.time) // 100]))),
        )
        end, slow = recorded.duration, min(0.5, 0.15 * recorded.duration)
        opening = min(max(event - slow, 0.0), 0.45 * end)
        if opening > 0.2:
            self.shot(viewpoints.wide(), until=opening)
        if event - slow - self.reached > 0.2:
            self.shot(viewpoints.follow(lead, azimuth_deg=(-70, -55)), until=event - slow)
        after = min(end, event + slow)
        if after - self.reached > 0.05:
            self.shot(
                viewpoints.follow(lead, azimuth_deg=(-50, -35), fill=0.26, elevation_deg=14), until=after, speed=0.25
            )
        if end - self.reached > 0.04:
            self.shot(viewpoints.wide(azimuth_deg=(-45, -35)), until=end)

    # -- words ---------------------------------------------------------------------------------------------------------

    def caption(self, text: str, *, seconds: float = 3.0, start: float | None = None, place: str = "bottom") -> None:
        """Words on the picture from where the next shot begins (or film time `start`): `bottom`, `top`, `left` or `title`.

        They come and go softly, in at most a quarter of their time each; spaces and line ends stay as they are written.
        """
        if place not in PLACES or not text.strip() or len(text) > 200 or not seconds > 0:
            raise ProgramError(
                f"a caption has words (at most 200 letters), a time, and a place of {', '.join(PLACES)}", "film.py", ""
            )
        begin = self.now if start is None else float(start)
        self._captions.append({"text": text, "start_s": begin, "end_s": begin + float(seconds), "place": place})

    def shutter(self, share: float = 0.5, *, samples: int = 8) -> None:
        """Motion blur: the shutter is open for `share` of each frame's time, drawn as the mean of so many pictures."""
        if not (0 <= share <= 1 and 1 <= samples <= 32):
            raise ProgramError("a shutter is open for 0 to 1 of a frame, in 1 to 32 samples", "film.py", "shutter(0.5)")
        self._shutter, self._samples = float(share), int(samples)

    # -- what is drawn only --------------------------------------------------------------------------------------------

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
    ) -> None:
        """Draw a mesh that is not simulated: `vertices` (V, 3) in metres, `faces` (F, 3), `uv` (V, 2) for its picture.

        With `instead` it is a skin: drawn in place of the shapes of the body `to`, in the body's frame, and of its size. The
        ground may have one, too: `film.recorded.into("hill", points)` brings points of the world into the hill's frame, and
        the statement says how far the drawn surface is from the simulated one at most.
        """
        points, triangles = np.asarray(vertices, dtype=float), np.asarray(faces, dtype=int)
        good = points.ndim == 2 and points.shape[1] == 3 and triangles.ndim == 2 and triangles.shape[1] == 3
        if not good or not np.isfinite(points).all() or triangles.min() < 0 or triangles.max() >= len(points):
            raise ProgramError(f"the mesh {name!r} is no (V, 3) vertices and (F, 3) faces among them", "film.py", "")
        if uv is not None and np.shape(uv) != (len(points), 2):
            raise ProgramError(f"the uv of {name!r} must be ({len(points)}, 2)", "film.py", "one for each vertex")
        if instead and not to:
            raise ProgramError(f"the skin {name!r} belongs to no body", "film.py", "name it: to='…'")
        self._add(Thing(name, "mesh", (1, 1, 1), look, pos, _yaw(yaw_deg), to, instead, points, triangles, uv))

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
    ) -> None:
        """Blades of grass in an area (x0, y0, x1, y1), m, but for the discs (x, y, radius) of `clear_of`.

        They stand on the ground, or at `z`: a height, m; a body that stands still, such as a hill, on whose height field, mesh
        or box they stand (`film.recorded.surface`); or a function z(x, y) of arrays, NaN where nothing grows. A blade costs
        three triangles: 60000, the most of one call, cost 180000 of the 3 million that a film may draw in one mesh.
        """
        if not 1 <= count <= 60_000:
            raise ProgramError(f"grass has 1 to 60000 blades, got {count}", "film.py", "cover less of the ground")
        points, faces = blades(area, height, count, self._ground(z), clear_of, seed)
        if not len(points):
            raise ProgramError(
                f"no blade of {name!r} stands on the ground that it is given", "film.py", "move its area"
            )
        self._add(Thing(name, "mesh", (1, 1, 1), look, (0, 0, 0), (1, 0, 0, 0), vertices=points, faces=faces))

    def tree(
        self,
        name: str,
        kind: str = "broadleaf",
        *,
        at: Sequence[tuple[float, float]],
        height: float = 8.0,
        z: float | str | Height | None = None,
        leaves: str | Surface = "",
        bark: str | Surface = "#5b4a3a",
        seed: int = 1,
    ) -> None:
        """Trees that are drawn only: a `conifer` or a `broadleaf` at each of some places (x, y), m, about `height` m high.

        They stand on the ground or on `z` as `grass` does; each differs from the others, and is the same at every drawing of
        one `seed`. A tree costs at most 6000 triangles: a wood of 100 far away is 600000, the most of one call.

        Raises:
            ProgramError: there is no such kind, there are none or more than 100 places, or one of them is beside the ground.
        """
        if kind not in trees.KINDS or not 1 <= len(at) <= 100 or not height > 0:
            raise ProgramError(
                f"1 to 100 trees of {' or '.join(trees.KINDS)}, got {len(at)} of {kind!r}",
                "film.py",
                "name one of them",
            )
        places = np.asarray(at, dtype=float).reshape(-1, 2)
        levels = np.asarray(self._ground(z)(places[:, 0], places[:, 1]), dtype=float)
        if not np.isfinite(levels).all():
            where = places[~np.isfinite(levels)][0].tolist()
            raise ProgramError(f"a tree of {name!r} at {where} stands beside its ground", "film.py", "move it")
        random = np.random.default_rng(seed)
        parts: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {"wood": [], "leaves": []}
        for place, level in zip(places, levels, strict=True):
            one = trees.tree(kind, height * random.uniform(0.8, 1.1), int(random.integers(1 << 30)))
            foot = np.array([*place, level - 0.02])
            parts["wood"].append((one.wood + foot, one.wood_faces))
            parts["leaves"].append((one.leaves + foot, one.leaf_faces))
        green = leaves or {"conifer": "#2f4a2c", "broadleaf": "#557a32"}[kind]
        for part, look in (("wood", bark), ("leaves", green)):
            starts = np.cumsum([0, *(len(points) for points, _ in parts[part])])
            faces = np.concatenate([f + s for (_, f), s in zip(parts[part], starts, strict=False)])
            points = np.concatenate([points for points, _ in parts[part]])
            title = name if part == "wood" else f"{name} ({part})"
            self._add(Thing(title, "mesh", (1, 1, 1), look, (0, 0, 0), (1, 0, 0, 0), vertices=points, faces=faces))

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
    ) -> None:
        """Small balls that are not simulated: `at(times)` gives for recorded times (F,) their places (F, P, 3), m.

        It may give a pair: places, and diameters (F, P) in metres, where 0 is not drawn. Asked once, when the film is whole.
        """
        self._add(Thing(name, "sphere", (diameter,) * 3, look, (0, 0, 0), (1, 0, 0, 0)))
        self._grown.append((self._things.pop(), at))

    def look(self, name: str, look: str | Surface) -> None:
        """Another look for a body, or for one geom, through the whole film; it is listed in the report."""
        known(look)
        self._looks[name] = look

    def _add(self, thing: Thing) -> None:
        known(thing.look)
        taken = {other.name for other in (*self._things, *(grown for grown, _ in self._grown))}
        if not thing.name or len(thing.name) > 60 or thing.name in taken:
            raise ProgramError(f"what is drawn needs a name of its own, not {thing.name!r}", "film.py", "name it anew")
        if thing.to:
            self.recorded.index(thing.to)
        self._things.append(thing)

    # -- the description -----------------------------------------------------------------------------------------------

    def description(self) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
        """The whole film as JSON and arrays by name; raises `ProgramError` where a camera or a particle is nowhere."""
        if not self._shots:
            self.usual()
        arrays: dict[str, np.ndarray] = {}
        times = np.concatenate([shot["times"] for shot in self._shots])
        told = []
        for number, shot in enumerate(self._shots):
            self.line = shot["line"]
            told.append(sampled(shot, self.recorded, number))
        for name in ("eye", "target", "roll_deg", "fovy_deg", "focus_m", "aperture"):
            arrays[name] = np.concatenate([one[name] for one in told])
        arrays["time"] = times
        shots, first = [], 0
        for shot in self._shots:
            shots.append({"first": first, "frames": len(shot["times"]), "planned": shot["camera"].planned})
            first += len(shot["times"])
        self.line = 1
        things = [*self._things, *(grown(thing, at, times) for thing, at in self._grown)]
        facts = {
            "schema": 1, "shots": shots, "captions": self._captions, "air": self._air,
            "things": [thing.facts(arrays, number) for number, thing in enumerate(things)],
            "looks": {name: look_facts(look, arrays, f"look_{n}") for n, (name, look) in enumerate(self._looks.items())},
            "shutter": self._shutter, "samples": self._samples,
        }  # fmt: skip
        return facts, arrays


def _line() -> int:
    """The line of film.py that is at work."""
    frame: Any = sys._getframe(1)
    while frame is not None and not frame.f_code.co_filename.endswith("film.py"):
        frame = frame.f_back
    return int(frame.f_lineno) if frame is not None else 1


def _yaw(yaw_deg: float) -> tuple[float, float, float, float]:
    half = np.radians(yaw_deg) / 2
    return (float(np.cos(half)), 0.0, 0.0, float(np.sin(half)))
