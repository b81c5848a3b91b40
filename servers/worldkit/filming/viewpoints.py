"""Where the camera is and what it looks at, over one shot.

Each maker returns a `Viewpoint`. All take the lens: `lens_mm`, the focal length as on a full-frame camera (24 wide, 50 as the
eye sees, 85 narrow), a number or a pair that it goes through; `focus`, a body's name, a point (x, y, z) or a distance in metres, and
`aperture`, the f-number (1.4 blurs much, 16 nearly nothing), without which everything is sharp; `shake`, how unsteady the
hand is (0 to 1); `roll_deg`. Where a body's name goes, that of a law does, or of what shows one: its points have a middle.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..errors import ProgramError
from .recorded import Recorded

Vec3 = tuple[float, float, float]
Range = float | tuple[float, float]
Target = str | Sequence[str] | Vec3


class Course(NamedTuple):
    """One shot, frame by frame."""

    recorded: Recorded
    share: np.ndarray
    """How much of the shot is over, (N,), from 0 to 1."""
    times: np.ndarray
    """Recorded times, (N,), s."""


Path = Callable[[Course], np.ndarray]
"""Points (N, 3) over a shot, m."""
EASE_S = 0.5
"""A camera that draws back to keep bodies in the picture begins so long before it must."""
FRAME_MM = 20.25
"""Height of the picture on a full-frame camera that films in 16:9."""


SHAPES = {"lens_mm": ((), (2,)), "roll_deg": ((), (2,)), "focus": ((), (3,)), "aperture": ((),), "shake": ((),)}
"""The shapes of what a lens is told."""
KINDS = {(): "a number", (2,): "a pair of numbers", (3,): "a point (x, y, z) in metres"}


@dataclass(frozen=True)
class Viewpoint:
    """One camera over one shot."""

    eye: Path | None
    target: Path | None
    lens_mm: Range = 35.0
    roll_deg: Range = 0.0
    focus: str | float | Vec3 | None = None
    aperture: float | None = None
    shake: float = 0.0
    planned: str = ""
    """The plan's camera that is meant instead of all the above."""

    def __post_init__(self) -> None:
        for name, shapes in SHAPES.items():
            told = getattr(self, name)
            if told is not None and not isinstance(told, str if name == "focus" else ()):
                _require_numbers(name, told, shapes)
        lenses = np.atleast_1d(self.lens_mm)
        if len(lenses) > 2 or not ((lenses >= 6) & (lenses <= 600)).all():
            raise ProgramError(
                f"lens_mm must lie between 6 and 600, got {self.lens_mm}", "film.py", "50 sees as eyes do"
            )
        if self.aperture is not None and not 0.5 <= self.aperture <= 64:
            raise ProgramError(f"aperture must lie between 0.5 and 64, got {self.aperture}", "film.py", "try 2.8")


def _require_numbers(name: str, told: Any, shapes: tuple[tuple[int, ...], ...]) -> None:
    """Refuse what is no number of one of these shapes; a distance lies above 0."""
    try:
        numbers = np.asarray(told)
        good = numbers.shape in shapes and numbers.dtype.kind in "iuf" and bool(np.isfinite(numbers).all())
    except ValueError:
        good = False
    if not good or (name == "focus" and not np.ndim(told) and not told > 0):
        kinds = [KINDS[shape] for shape in shapes]
        kinds = ["a body's name", "a distance above 0 m", *kinds[1:]] if name == "focus" else kinds
        raise ProgramError(f"{name} is {' or '.join(kinds)}, not {told!r}", "film.py", f"follow('ball', {name}=…)")


def eased(share: np.ndarray) -> np.ndarray:
    """A gentle start and end: 0..1 to 0..1 with no speed and no jerk at either."""
    x = np.clip(share, 0.0, 1.0)
    return np.asarray(x * x * x * (x * (6 * x - 15) + 10))


def between(value: Range, share: np.ndarray) -> np.ndarray:
    """A number as it is, or a pair gone through gently: (N,)."""
    low, high = (float(v) for v in (value if isinstance(value, (tuple, list)) else (value, value)))
    return low + (high - low) * eased(share)


def fovy_deg(lens_mm: float | np.ndarray) -> Any:
    """Vertical field of view of a lens."""
    return np.degrees(2 * np.arctan(FRAME_MM / 2 / np.asarray(lens_mm, dtype=float)))


def smoothed(recorded: Recorded, bodies: Sequence[str], times: np.ndarray, lag_s: float) -> np.ndarray:
    """Middle of some bodies, without what is quicker than `lag_s`: (N, 3)."""
    offsets = np.linspace(-2.0, 2.0, 17)
    weights = np.exp(-0.5 * offsets**2)
    total = np.zeros((len(times), 3))
    for offset, weight in zip(offsets * lag_s, weights / weights.sum(), strict=True):
        at = np.clip(times + offset, 0.0, recorded.duration)
        total += weight * np.mean([recorded.middle(body, at) for body in bodies], axis=0)
    return total


def _names(target: Target) -> tuple[str, ...]:
    """The bodies that a target names; none when it is a point."""
    if isinstance(target, str):
        return (target,)
    return tuple(target) if all(isinstance(part, str) for part in target) else ()  # type: ignore[arg-type]


def _at(target: Target, lag_s: float) -> Path:
    names = _names(target)
    if names:
        return lambda course: smoothed(course.recorded, names, course.times, lag_s)
    point = np.asarray(target, dtype=float)
    if point.shape != (3,):
        raise ProgramError(f"a target is a body's name, names, or x, y, z in metres; got {target!r}", "film.py", "")
    return lambda course: np.tile(point, (len(course.times), 1))


def _direction(azimuth_deg: np.ndarray, elevation_deg: np.ndarray) -> np.ndarray:
    a, e = np.radians(azimuth_deg), np.radians(elevation_deg)
    return np.stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)], axis=-1)


def _distance(course: Course, names: tuple[str, ...], distance: Range | None, fill: float, lens: Range) -> np.ndarray:
    """Metres from the target: as given, or so that the largest subject takes `fill` of the picture's height."""
    if distance is not None:
        return between(distance, course.share)
    tangent = np.tan(np.radians(fovy_deg(between(lens, course.share))) / 2)
    return course.recorded.reach(*names) / (fill * tangent)


def _holding(
    course: Course, names: tuple[str, ...], way: np.ndarray, lens: Range, room: float, lag_s: float
) -> np.ndarray:
    """Metres from the middle of some bodies, (N,), from which all of them are in the picture with room, changing gently.

    The mean, over a second, of what the second around each moment needs at most: never less than the moment itself needs.
    """
    recorded = course.recorded
    across = np.stack([-way[:, 1], way[:, 0], np.zeros(len(way))], axis=-1)
    across /= np.maximum(np.linalg.norm(across, axis=-1, keepdims=True), 1e-9)
    up = np.cross(way, across)
    tangent = np.tan(np.radians(fovy_deg(between(lens, course.share))) / 2)
    sides = ((across, tangent * recorded.size[0] / recorded.size[1]), (up, tangent))

    def needed(times: np.ndarray) -> np.ndarray:
        middle, most = smoothed(recorded, names, times, lag_s), np.zeros(len(times))
        for name in names:
            apart, radius = recorded.middle(name, times) - middle, recorded.reach(name)
            nearer = np.einsum("ni,ni->n", apart, way)
            for axis, half in sides:
                reach = np.abs(np.einsum("ni,ni->n", apart, axis)) + radius
                most = np.maximum(most, nearer + room * reach / half)
        return most

    offsets = np.linspace(-2 * EASE_S, 2 * EASE_S, 17)
    found = np.array([needed(np.clip(course.times + offset, 0.0, recorded.duration)) for offset in offsets])
    return np.asarray(np.mean([found[k : k + 9].max(axis=0) for k in range(9)], axis=0))


def still(eye: Vec3, look_at: Target, *, lag_s: float = 0.2, **lens: Any) -> Viewpoint:
    """A camera on a tripod at `eye` that looks at a point, or turns with what it looks at."""
    return Viewpoint(_at(eye, 0.0), _at(look_at, lag_s), **lens)


def follow(
    body: str | Sequence[str],
    *,
    azimuth_deg: Range = -60.0,
    elevation_deg: Range = 16.0,
    distance: Range | None = None,
    fill: float = 0.22,
    room: float = 1.25,
    lag_s: float = 0.12,
    **lens: Any,
) -> Viewpoint:
    """A camera that goes along with a body, or with several (`follow(["a", "b"])`), seen from a direction.

    The direction is counter-clockwise from +x and above the horizon. `distance` is in metres; without it the largest body
    takes the share `fill` of the picture's height, and several are all kept in the picture: as they part the camera draws
    back, gently, so that `room` times what they take fits in. Numbers given as pairs are gone through over the shot. What is
    quicker than `lag_s` the camera does not follow.
    """
    names = _names(body)

    def eye(course: Course) -> np.ndarray:
        away = _distance(course, names, distance, fill, lens.get("lens_mm", 35.0))
        way = _direction(between(azimuth_deg, course.share), between(elevation_deg, course.share))
        if distance is None and len(names) > 1:
            away = np.maximum(away, _holding(course, names, way, lens.get("lens_mm", 35.0), room, lag_s))
        return smoothed(course.recorded, names, course.times, lag_s) + away[:, None] * way

    return Viewpoint(eye, _at(body, lag_s), **lens)


def orbit(
    about: Target,
    *,
    azimuth_deg: Range = (-70.0, -40.0),
    elevation_deg: Range = 20.0,
    distance: Range | None = None,
    fill: float = 0.3,
    **lens: Any,
) -> Viewpoint:
    """A camera that goes around where a body stands when the shot begins (or a point), at the distance of `follow`."""
    names = _names(about)
    if not names and distance is None:
        raise ProgramError("an orbit about a point needs a distance", "film.py", "give distance=…, in metres")

    def middle(course: Course) -> np.ndarray:
        return _at(about, 0.0)(course._replace(times=np.full(len(course.times), course.times[0])))

    def eye(course: Course) -> np.ndarray:
        away = _distance(course, names, distance, fill, lens.get("lens_mm", 35.0))
        way = _direction(between(azimuth_deg, course.share), between(elevation_deg, course.share))
        return middle(course) + away[:, None] * way

    return Viewpoint(eye, middle, **lens)


def along(points: Sequence[Vec3], look_at: Target, *, lag_s: float = 0.2, **lens: Any) -> Viewpoint:
    """A camera that glides through some points (at least two) and looks at a point or a body."""
    way = np.asarray(points, dtype=float)
    if way.ndim != 2 or way.shape[1] != 3 or len(way) < 2:
        raise ProgramError(
            "a way needs at least two points of x, y, z in metres", "film.py", "along([(…), (…)], 'ball')"
        )

    def eye(course: Course) -> np.ndarray:
        place = eased(course.share) * (len(way) - 1)
        first = np.minimum(place.astype(int), len(way) - 2)
        u = (place - first)[:, None]
        # Catmull-Rom, its ends prolonged.
        padded = np.vstack([2 * way[0] - way[1], way, 2 * way[-1] - way[-2]])
        a, b, c, d = (padded[first + k] for k in range(4))
        return 0.5 * (2 * b + (c - a) * u + (2 * a - 5 * b + 4 * c - d) * u**2 + (3 * b - a - 3 * c + d) * u**3)

    return Viewpoint(eye, _at(look_at, lag_s), **lens)


def ride(
    body: str,
    *,
    seat: Vec3 = (0.0, 0.0, 0.3),
    look: Vec3 = (1.0, 0.0, 0.0),
    level: bool = True,
    lag_s: float = 0.1,
    **lens: Any,
) -> Viewpoint:
    """A camera on a body: `seat` from its centre, looking along `look`.

    `level` means both along the way that the body goes (x forward, z up), so that a rolling ball can be ridden; without it
    they are in the body's own frame.
    """

    def carried(vector: Vec3, course: Course) -> np.ndarray:
        recorded, times = course.recorded, course.times
        turn = recorded.orientation(body, times)
        if level:
            ahead = np.clip(times + 0.1, 0, recorded.duration)
            way = smoothed(recorded, (body,), ahead, 0.15) - smoothed(recorded, (body,), ahead - 0.2, 0.15)
            goes = np.linalg.norm(way[:, :2], axis=1) > 1e-3
            yaw = np.where(goes, np.arctan2(way[:, 1], way[:, 0]), np.arctan2(turn[:, 1, 0], turn[:, 0, 0]))
            flat = np.zeros_like(turn)
            flat[:, 0, 0], flat[:, 0, 1] = np.cos(yaw), -np.sin(yaw)
            flat[:, 1, 0], flat[:, 1, 1], flat[:, 2, 2] = np.sin(yaw), np.cos(yaw), 1.0
            turn = flat
        return smoothed(recorded, (body,), times, lag_s) + turn @ np.asarray(vector, dtype=float)

    def eye(course: Course) -> np.ndarray:
        return carried(seat, course)

    def target(course: Course) -> np.ndarray:
        return carried((seat[0] + look[0], seat[1] + look[1], seat[2] + look[2]), course)

    return Viewpoint(eye, target, **lens)


def wide(
    *bodies: str, azimuth_deg: Range = (-65.0, -50.0), elevation_deg: Range = 22.0, room: float = 1.25, **lens: Any
) -> Viewpoint:
    """A camera that holds the whole way of some bodies (of all that move, when none is named) in the picture."""

    def space(recorded: Recorded) -> tuple[np.ndarray, float, np.ndarray]:
        names = bodies or recorded.movers or recorded.bodies
        times = np.linspace(0.0, recorded.duration, 60)
        where, large = (recorded.middle, recorded.reach) if bodies else (recorded.position, recorded.radius)
        points = np.concatenate([where(name, times) for name in names])
        low, high = points.min(axis=0), points.max(axis=0)
        return 0.5 * (low + high), large(*names), high - low

    def eye(course: Course) -> np.ndarray:
        middle, radius, extent = space(course.recorded)
        tangent = np.tan(np.radians(fovy_deg(between(lens.get("lens_mm", 35.0), course.share))) / 2)
        way = _direction(between(azimuth_deg, course.share), between(elevation_deg, course.share))
        aspect = course.recorded.size[0] / course.recorded.size[1]
        across = np.stack([-way[:, 1], way[:, 0], np.zeros(len(way))], axis=-1)
        across /= np.maximum(np.linalg.norm(across, axis=-1, keepdims=True), 1e-9)
        breadth = np.abs(across) @ (extent / 2) + radius
        height = extent[2] / 2 + radius + 0.35 * np.abs(way) @ (extent / 2)
        away = room * np.maximum(breadth / (tangent * aspect), height / tangent) + np.abs(way) @ (extent / 2)
        return middle + away[:, None] * way

    return Viewpoint(eye, lambda course: np.tile(space(course.recorded)[0], (len(course.times), 1)), **lens)


def planned(camera: str) -> Viewpoint:
    """The camera of this name in the plan, as the still and video pass place it."""
    return Viewpoint(None, None, planned=camera)


def axes(eye: np.ndarray, target: np.ndarray, roll_deg: float | np.ndarray) -> np.ndarray:
    """(..., 3, 3) columns right, up and back of cameras at `eye` (..., 3) that look at `target`, upright but for their roll (...)."""
    back = np.asarray(eye, dtype=float) - np.asarray(target, dtype=float)
    back /= np.maximum(np.linalg.norm(back, axis=-1, keepdims=True), 1e-12)
    right = np.cross(np.where(np.abs(back[..., 2:]) < 0.9999, [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]), back)
    right /= np.linalg.norm(right, axis=-1, keepdims=True)
    up, roll = np.cross(back, right), np.radians(np.asarray(roll_deg, dtype=float))[..., None]
    c, s = np.cos(roll), np.sin(roll)
    return np.stack([c * right + s * up, c * up - s * right, back], axis=-1)
