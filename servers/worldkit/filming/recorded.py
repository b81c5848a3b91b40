"""What a film's author knows: where the bodies were, how large they are, and when they touched."""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from difflib import get_close_matches
from itertools import product
from typing import Any

import numpy as np

from ..errors import ProgramError
from ..turning import matrices
from . import ground
from .laws_shown import Laws

WORLD = "world"
LEAST_M = 0.02
"""Points that wait in one place, as all do in a world that stands still, are looked at as if they were so large."""
GROUND = ("vertices", "faces", "owner", "names")
"""Arrays of the triangles of what stands still."""


@dataclass(frozen=True)
class Touch:
    """The beginning of a contact between two bodies that did not touch before."""

    time_s: float
    bodies: tuple[str, str]
    """Names; `world` is the ground and whatever is fixed to it."""
    force_n: float
    """The largest normal force until they part, N."""


class Recorded:
    """A recording as the film's author sees it; nothing can be changed.

    `duration` is in seconds, `bodies` are the names of all bodies but the world, `movers` of those that the plan expects to
    move (all that move where it names none). `arrays` come from the engine (`worldengine.film.motion_facts`).
    """

    def __init__(self, arrays: Mapping[str, np.ndarray]) -> None:
        self.asked_of_motion = False
        """Whether somebody asked how anything moves: what then goes wrong on a made-up recording may be that one's fault."""
        self.unmoved = False
        """Whether nothing was recorded yet, and nothing moves or happens in it."""
        self.time = np.asarray(arrays["time"], dtype=float)
        """(T,) s, from 0."""
        self._pos, self._quat = np.asarray(arrays["pos"]), np.asarray(arrays["quat"])
        self._middle, self._half = np.asarray(arrays["middle"]), np.asarray(arrays["half"])
        self.bodies: tuple[str, ...] = tuple(str(name) for name in arrays["bodies"])
        self.sized = bool(arrays.get("sized", True))
        """Whether the sizes of the bodies are those recorded, and not a rehearsal's."""
        self.duration = float(self.time[-1])
        self.fps = int(arrays["fps"])
        self.size = tuple(int(side) for side in arrays["size"])
        """Width and height of the picture, pixels."""
        self.cameras: tuple[str, ...] = tuple(str(name) for name in arrays["cameras"])
        """The cameras that the plan names."""
        self.floor_z = float(arrays["floor_z"])
        """Height of the ground, m (of the lowest thing where there is none)."""
        self.setting = str(arrays["setting"]) if "setting" in arrays else ""
        """`studio`, `room`, `outdoor` or `dark`, as the plan says; empty where nothing does."""
        self.floor = str(arrays["floor"]) if "floor" in arrays else ""
        """The look of the ground that the plan names; empty for the setting's own."""
        self.words: tuple[str, ...] = tuple(str(word) for word in arrays["words"]) if "words" in arrays else ()
        """The plan's title, thrice, its first paragraph and the names of its things, word by word, in small letters."""
        self.light: dict[str, Any] = json.loads(str(arrays["light"])) if "light" in arrays else {}
        """The light and sky that the plan states, by the words of `worldkit.lights.treated`; empty where it states none."""
        self.wind: tuple[float, ...] = (0.0, 0.0, 0.0)
        """What the plan's medium blows with, m/s; gusts that a program makes are not in it."""
        if "wind" in arrays:
            self.wind = tuple(float(part) for part in arrays["wind"])
        self.looks: dict[str, str] = {}
        """The looks that the plan gives its things, by name."""
        if "looks" in arrays:
            self.looks = {str(name): str(look) for name, look in np.asarray(arrays["looks"]).reshape(-1, 2)}
        self._laws = Laws(arrays)
        self._ground = {name: np.asarray(arrays[f"ground_{name}"]) for name in GROUND if f"ground_{name}" in arrays}
        self._heights: dict[str, ground.Height] = {}
        moving = np.ptp(self._pos, axis=0).max(axis=-1) > 1e-3 if len(self.bodies) else np.zeros(0, bool)
        named = tuple(str(name) for name in arrays["movers"])
        self._named = bool(named)
        self._movers = named or tuple(name for name, moves in zip(self.bodies, moving, strict=True) if moves)
        names = (*self.bodies, WORLD)
        self._touches = [
            Touch(float(t), (names[a], names[b]), float(force))
            for t, a, b, force in zip(
                arrays["touch_time"], arrays["touch_a"], arrays["touch_b"], arrays["touch_force"], strict=True
            )
        ]

    @classmethod
    def rehearsal(
        cls,
        ways: Mapping[str, np.ndarray],
        duration: float,
        radius: float = 0.1,
        *,
        ground: Mapping[str, tuple[np.ndarray, np.ndarray]] | None = None,
    ) -> "Recorded":
        """A made-up recording to try a film on: bodies of one size that go through points (T, 3), m, and do not turn.

        `ground` are surfaces by the name of a body that stands still: vertices (V, 3) in the world, m, and faces (F, 3).
        """
        rows = {len(way) for way in ways.values()}
        if len(rows) != 1 or not duration > 0:
            raise ProgramError(
                "the ways of a rehearsal have equally many points", "Recorded.rehearsal", "give (T, 3) each"
            )
        count, bodies = rows.pop(), len(ways)
        nothing = np.zeros(0)
        still = {
            name: (np.asarray(points, float), np.asarray(faces, int))
            for name, (points, faces) in (ground or {}).items()
        }
        starts = np.cumsum([0, *(len(points) for points, _ in still.values())])
        faces = [part + start for (_, part), start in zip(still.values(), starts, strict=False)]
        return cls(
            {
                "time": np.linspace(0.0, duration, count), "pos": np.stack([np.asarray(way) for way in ways.values()], axis=1),
                "quat": np.tile([1.0, 0.0, 0.0, 0.0], (count, bodies, 1)), "middle": np.zeros((bodies, 3)),
                "half": np.full((bodies, 3), radius / np.sqrt(3.0)), "sized": np.array(False), "bodies": np.array(list(ways)),
                "cameras": np.array([], dtype=str), "movers": np.array([], dtype=str), "fps": np.array(24),
                "size": np.array([1280, 720]), "floor_z": np.array(0.0), "touch_time": nothing, "touch_a": nothing,
                "touch_b": nothing, "touch_force": nothing, "ground_names": np.array(list(still), dtype=str),
                "ground_vertices": np.concatenate([np.zeros((0, 3)), *(points for points, _ in still.values())]),
                "ground_faces": np.concatenate([np.zeros((0, 3), int), *faces]),
                "ground_owner": np.repeat(np.arange(len(faces)), [len(part) for part in faces]) if faces else nothing,
            }
        )  # fmt: skip

    @property
    def movers(self) -> tuple[str, ...]:
        """The bodies that the plan expects to move; all that move where it names none."""
        self.asked_of_motion |= not self._named
        return self._movers

    def index(self, body: str) -> int:
        """Number of a body; a `ProgramError` names the nearest where there is none."""
        if body in self.bodies:
            return self.bodies.index(body)
        if body in self._laws:
            cause = f"{body!r} is no body: it shows the points of a law, which have a middle and neither frame nor box"
            raise ProgramError(cause, "film.py", f"film.recorded.points({body!r}, times)")
        known = (*self.bodies, *self._laws.names, *self._laws.shown_by)
        near = get_close_matches(str(body), known, n=3) or list(known[:6])
        raise ProgramError(f"no body is called {body!r}", "film.py", f"name one of: {', '.join(near) or '(none)'}")

    def position(self, body: str, at: float | np.ndarray) -> np.ndarray:
        """Centre of what is seen of a body (the box around its shapes) at some recorded times: (3,), or (N, 3), m.

        Of a law, and of what shows one and is no body, it is the middle of its points.
        """
        self.asked_of_motion = True
        if body not in self.bodies and body in self._laws:
            return self._laws.middle(body, at)
        times, number = np.atleast_1d(np.asarray(at, dtype=float)), self.index(body)
        turn = matrices(self._quat[:, number])
        centre = self._pos[:, number] + turn @ self._middle[number]
        found = np.stack([np.interp(times, self.time, centre[:, axis]) for axis in range(3)], axis=-1)
        return found if np.ndim(at) else found[0]

    def middle(self, name: str, at: float | np.ndarray) -> np.ndarray:
        """What a camera looks at of a body, a law, or what shows one: its `position`, of a law's the middle of its points."""
        self.asked_of_motion = True
        return self._laws.middle(name, at) if name in self._laws else self.position(name, at)

    def origin(self, body: str, at: float | np.ndarray) -> np.ndarray:
        """Where the frame of a body lies at some recorded times: (3,), or (N, 3), m."""
        self.asked_of_motion = True
        times, way = np.atleast_1d(np.asarray(at, dtype=float)), self._pos[:, self.index(body)]
        found = np.stack([np.interp(times, self.time, way[:, axis]) for axis in range(3)], axis=-1)
        return found if np.ndim(at) else found[0]

    def orientation(self, body: str, at: float | np.ndarray) -> np.ndarray:
        """Rotation matrices of a body at the recorded rows nearest to some times: (3, 3), or (N, 3, 3)."""
        self.asked_of_motion = True
        rows = self.rows(np.atleast_1d(np.asarray(at, dtype=float)))
        found = matrices(self._quat[rows, self.index(body)])
        return found if np.ndim(at) else found[0]

    def speed(self, body: str, at: float | np.ndarray) -> np.ndarray:
        """Speed of the centre of a body, m/s: a number, or (N,)."""
        step = 0.01
        times = np.atleast_1d(np.asarray(at, dtype=float))
        low, high = np.clip(times - step, 0, self.duration), np.clip(times + step, 0, self.duration)
        way = self.position(body, high) - self.position(body, low)
        found = np.linalg.norm(way, axis=-1) / np.maximum(high - low, 1e-9)
        return found if np.ndim(at) else found[0]

    def radius(self, *bodies: str) -> float:
        """Half the diagonal of the box around the largest of some bodies, m."""
        return max((float(np.linalg.norm(self._half[self.index(body)])) for body in bodies), default=0.5)

    def reach(self, *names: str) -> float:
        """The `radius` of the largest of what a camera looks at, m; of a law's points, where they lie furthest apart."""
        found = (max(self._laws.radius(name), LEAST_M) if name in self._laws else self.radius(name) for name in names)
        return max(found, default=0.5)

    def box(self, body: str) -> tuple[np.ndarray, np.ndarray]:
        """The box around a body's shapes, in the body's own frame, m: its middle (3,) and its half extents (3,), in this order.

        A skin of the size of a mesh that spans -1 to 1 is `middle + half * vertices`; full extents are `2 * half`.
        """
        number = self.index(body)
        return self._middle[number].copy(), self._half[number].copy()

    def surface(self, body: str) -> ground.Height:
        """The upper side of a body that stands still, from its own height fields, meshes and boxes: a function of x and y.

        It takes arrays of one shape, m, in the world's frame, and gives heights of that shape, m, NaN beside the body. Where
        one such body has nothing to stand on, a `ProgramError` names those that have. `world` is what has no body.
        """
        if body not in self._heights:
            names = [str(name) for name in self._ground.get("names", ())]
            if body not in names:
                raise ProgramError(
                    f"{body!r} is nothing that stands still and has a height field, a mesh or a box",
                    "film.py",
                    f"name one of: {', '.join(names)}" if names else "give z as a number or a function of x and y",
                )
            mine = self._ground["owner"] == names.index(body)
            self._heights[body] = ground.over(self._ground["vertices"], self._ground["faces"][mine])
        return self._heights[body]

    @property
    def still(self) -> tuple[str, ...]:
        """Bodies that stand still and have an upper side (`surface`); `world` among them where it has shapes of its own."""
        return tuple(str(name) for name in self._ground.get("names", ()))

    def extent(self, body: str) -> tuple[np.ndarray, np.ndarray]:
        """The two corners (3,), m, of what a body of `still` takes up in the world."""
        self.surface(body)
        points = self._of_still(body)
        return points.min(axis=0), points.max(axis=0)

    def _of_still(self, body: str) -> np.ndarray:
        mine = self._ground["owner"] == self.still.index(body)
        return np.asarray(self._ground["vertices"][np.unique(self._ground["faces"][mine])])

    def outline(self, body: str) -> np.ndarray:
        """Points (P, 3), m, of the world that a body lies between at first: its own of one of `still`, else the corners around it."""
        if body in self.still:
            return self._of_still(body)
        half, turn = self.box(body)[1], self.orientation(body, 0.0)
        return np.asarray(self.position(body, 0.0) + (half * list(product((-1, 1), repeat=3))) @ turn.T)

    def into(self, body: str, points: np.ndarray, at: float = 0.0) -> np.ndarray:
        """Points (N, 3) of the world, m, in a body's own frame at a recorded time: what `to=` and skins are drawn in."""
        self.asked_of_motion = True
        row = int(self.rows(np.array([at]))[0])
        turn = matrices(self._quat[row : row + 1, self.index(body)])[0]
        return np.asarray((np.asarray(points, dtype=float) - self._pos[row, self.index(body)]) @ turn)

    @property
    def laws(self) -> tuple[str, ...]:
        """The author's laws, and other media that move points."""
        return self._laws.names

    @property
    def grains(self) -> tuple[str, ...]:
        """The bodies of many balls that show the points of a law."""
        return self._laws.grains

    @property
    def shows(self) -> dict[str, str]:
        """What shows the points of each law, a body or a surface, by the law's name."""
        return dict(zip(self._laws.names, self._laws.shown_by, strict=False))

    def points(self, law: str, at: float | np.ndarray) -> np.ndarray:
        """Where the points of a law are at some recorded times: (P, 3), or (N, P, 3), m; in the order of `law.points`.

        `law` is its name, or that of what shows it, as of `told`.
        So `points("balloon", t)[:, 12]` is the way of one of them. Where there is no such law, a `ProgramError` names those there are.
        """
        self.asked_of_motion = True
        return self._laws.points(law, at)

    def told(self, law: str, what: str, at: float | np.ndarray) -> np.ndarray:
        """What a law tells of itself at some recorded times, a number or (N,): its `mass`, kg, `energy` and `stored`, J, `volume`, m^3."""
        self.asked_of_motion = True
        return self._laws.told(law, what, at)

    def touches(self, one: str = "", other: str = "") -> list[Touch]:
        """Beginnings of contacts, in the order of time, of all bodies or of those named (`world` is a name, too)."""
        for name in (one, other):
            if name and name != WORLD:
                self.index(name)
        self.asked_of_motion = True
        wanted = {name for name in (one, other) if name}
        return [touch for touch in self._touches if wanted <= set(touch.bodies)]

    def event(self) -> float:
        """The moment to slow down for, s: the strongest blow, else the greatest speed of a mover, else the middle.

        What touches again and again about as strongly, as something that rolls or rests does, gives no blow; speed that hardly
        changes is no event.
        """
        self.asked_of_motion = True
        later = [touch for touch in self._touches if touch.time_s > max(0.05, 0.05 * self.duration)]
        for blows in ([touch for touch in later if WORLD not in touch.bodies], later):
            forces = [touch.force_n for touch in blows]
            if forces and (len(forces) <= 3 or max(forces) > 3 * float(np.median(forces))):
                return max(blows, key=lambda touch: touch.force_n).time_s
        times = np.linspace(0, self.duration, 200)
        speeds = np.max([self.speed(body, times) for body in self.movers], axis=0) if self.movers else np.zeros(200)
        return float(times[int(speeds.argmax())]) if speeds.max() > 1.3 * speeds.mean() else self.duration / 2

    def rows(self, at: np.ndarray) -> np.ndarray:
        """The recorded rows nearest to some times, (N,)."""
        after = np.clip(np.searchsorted(self.time, at), 1, max(len(self.time) - 1, 1))
        before = after - 1
        after = np.minimum(after, len(self.time) - 1)
        return np.where(np.abs(self.time[before] - at) <= np.abs(self.time[after] - at), before, after)
