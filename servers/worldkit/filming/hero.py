"""The shot of a film that nobody has thought about: the whole event in one, from its side, close, level, and behind it all is soft.

Judges who saw our films beside others named, in what they liked less, the wide shot of small things, cuts, and a moment shown again.
"""

from collections import Counter
from dataclasses import replace

import numpy as np

from . import viewpoints
from .recorded import WORLD, Recorded

Told = tuple[viewpoints.Viewpoint, dict[str, float]]
"""A camera, and what `Film.shot` takes besides."""

USUAL_AZIMUTH, USUAL_ELEVATION = -57.0, 13.0
"""From here the lights of all settings fall across what is seen."""
LEAST = 0.1
"""A subject takes at least this share of the picture's height; a camera that held its whole way would show a speck."""
NEAR = 1.8
"""A camera that goes along comes so many times nearer than that."""
LONGEST_S, SHORTEST_S = 14.0, 2.5
"""A longer recording is shown faster and a shorter one slower, as the picture's corner tells."""
AFTER_S = 0.4
LENS_MM = 60.0
SOFT = 0.25
"""Of what is far behind, a point becomes a disc of so many millimetres on the film: 0.7 % of the picture's width."""
REST_S = 0.8
"""What lies still is shown for so long."""
BESIDE = 1.6
"""What stands still belongs into the picture if it is at most so many times as large as the movers' way, and as near to its middle."""
CROWD = 8
"""Of more movers than this the camera follows none."""


def shots(recorded: Recorded) -> list[Told]:
    """The whole recording from one side by a camera that stands still, or that goes along with whom it happens to where that is
    small."""
    azimuth, elevation = view(recorded)
    heroes, end = leads(recorded), settled(recorded)
    speed = np.clip(end / LONGEST_S, 1.0, 50.0) * np.clip(end / SHORTEST_S, 0.2, 1.0)
    speed = 1.0 if abs(speed - 1.0) < 0.2 else speed
    held = recorded.movers + beside(recorded)
    camera = viewpoints.wide(*held, azimuth_deg=azimuth, elevation_deg=elevation, room=1.08, lens_mm=LENS_MM)
    if heroes and len(recorded.movers) <= CROWD:
        away, focus = distance(recorded, camera), None
        if share(recorded, camera, heroes) < LEAST:
            focus, around = heroes[0], (azimuth - 4.0, azimuth + 4.0)
            camera = viewpoints.follow(
                heroes, azimuth_deg=around, elevation_deg=elevation, fill=NEAR * LEAST, lens_mm=LENS_MM, lag_s=0.18
            )
            away = distance(recorded, camera)
        aperture = float(np.clip(LENS_MM**2 / (SOFT * 1000.0 * away), 1.4, 64.0))
        camera = replace(camera, focus=focus or away, aperture=aperture)
    return [(camera, {"until": end, "speed": float(speed)})]


def beside(recorded: Recorded) -> tuple[str, ...]:
    """What stands still among the movers and is about as large as their way: a stand, a ramp, a bowl, which a picture should not cut."""
    names = recorded.movers
    if not names:
        return ()
    times = np.linspace(0.0, recorded.duration, 30)
    ways = np.concatenate([recorded.position(name, times) for name in names[:40]])
    middle, reach = 0.5 * (ways.min(axis=0) + ways.max(axis=0)), float(np.ptp(ways, axis=0).max()) / 2
    reach += recorded.radius(*names)
    others = (name for name in recorded.bodies if name not in names and recorded.radius(name) < BESIDE * reach)
    return tuple(name for name in others if np.linalg.norm(recorded.position(name, 0.0) - middle) < BESIDE * reach)


def settled(recorded: Recorded) -> float:
    """When the first showing ends, s: a moment after all has come to rest, or where the recording ends."""
    times = np.linspace(0.0, recorded.duration, 200)
    if not recorded.movers:
        return recorded.duration
    speeds = np.max([recorded.speed(name, times) for name in recorded.movers[:60]], axis=0)
    moving = np.flatnonzero(speeds > max(0.02 * float(speeds.max()), 1e-3))
    last = float(times[moving[-1]]) if len(moving) else recorded.duration
    return min(recorded.duration, max(last + REST_S, recorded.event() + AFTER_S, 1.0))


def leads(recorded: Recorded) -> tuple[str, ...]:
    """Whom the event happens to: those that meet, at most two, else the fastest."""
    if not recorded.movers:
        return ()
    event = recorded.event()
    near = [touch for touch in recorded.touches() if abs(touch.time_s - event) < 1e-6]
    met = Counter(body for touch in near for body in touch.bodies if body in recorded.movers and body != WORLD)
    if met:
        return tuple(dict(met.most_common(2)))
    return (max(recorded.movers, key=lambda name: float(recorded.speed(name, event))),)


def distance(recorded: Recorded, camera: viewpoints.Viewpoint) -> float:
    """Metres from a camera to what it looks at, as a shot begins."""
    assert camera.eye is not None
    assert camera.target is not None
    course = viewpoints.Course(recorded, np.zeros(1), np.zeros(1))
    return float(np.linalg.norm(camera.eye(course) - camera.target(course)))


def share(recorded: Recorded, camera: viewpoints.Viewpoint, bodies: tuple[str, ...]) -> float:
    """The share of the picture's height that the largest of some bodies takes through a camera, as a shot begins."""
    tangent = float(np.tan(np.radians(viewpoints.fovy_deg(LENS_MM)) / 2))
    return recorded.radius(*bodies) / (distance(recorded, camera) * tangent)


def view(recorded: Recorded) -> tuple[float, float]:
    """Azimuth and elevation, degrees, from which the motion is seen from the side and nothing stands before it."""
    names = recorded.movers or recorded.bodies
    if not names:
        return USUAL_AZIMUTH, USUAL_ELEVATION
    times = np.linspace(0.0, recorded.duration, 24)
    ways = np.stack([recorded.position(name, times) for name in names[:40]])
    steps = np.diff(ways, axis=1).reshape(-1, 3)
    spread = steps[:, :2].T @ steps[:, :2]
    strength, axes = np.linalg.eigh(spread)
    level = strength[1] > 0.02 * float(np.square(steps[:, 2]).sum()) + 1e-12
    along = axes[:, 1] if level else None
    boxes = _obstacles(recorded, names)
    points = ways[:, ::4].reshape(-1, 3)
    far = 4.0 * max(float(np.ptp(points, axis=0).max()), 2 * recorded.radius(*names))
    best, found = np.inf, (USUAL_AZIMUTH, USUAL_ELEVATION)
    for azimuth in np.arange(-177.0, 183.0, 15.0):
        a = np.radians(azimuth)
        away = np.array([np.cos(a), np.sin(a)])
        side = 0.0 if along is None else 0.5 * max(abs(float(away @ along)) - 0.42, 0.0)
        usual = 0.25 * (1.0 - np.cos(a - np.radians(USUAL_AZIMUTH)))
        for elevation in (USUAL_ELEVATION, 28.0, 46.0):
            e = np.radians(elevation)
            eye = points + far * np.array([np.cos(e) * away[0], np.cos(e) * away[1], np.sin(e)])
            cost = side + usual + 0.004 * (elevation - USUAL_ELEVATION) + 3.0 * _hidden(points, eye, boxes)
            if cost < best - 1e-9:
                best, found = cost, (float(azimuth), float(elevation))
    return found


def _obstacles(recorded: Recorded, movers: tuple[str, ...]) -> np.ndarray:
    """Corners (N, 2, 3), m, of the boxes around what does not move."""
    found = []
    for name in recorded.bodies:
        if name in movers:
            continue
        _, half = recorded.box(name)
        centre = recorded.position(name, 0.0)
        reach = np.abs(recorded.orientation(name, 0.0)) @ half
        found.append((centre - reach, centre + reach))
    return np.array(found).reshape(-1, 2, 3)


def _hidden(points: np.ndarray, eyes: np.ndarray, boxes: np.ndarray) -> float:
    """The share of some points (P, 3) that a box between them and the eyes (P, 3) hides; boxes around a point do not."""
    if not len(boxes):
        return 0.0
    way = eyes - points
    safe = np.where(np.abs(way) < 1e-9, 1e-9, way)
    low = (boxes[:, None, 0] - points) / safe
    high = (boxes[:, None, 1] - points) / safe
    enter, leave = np.minimum(low, high).max(axis=-1), np.maximum(low, high).min(axis=-1)
    inside = ((points >= boxes[:, None, 0] - 0.02) & (points <= boxes[:, None, 1] + 0.02)).all(axis=-1)
    return float(((enter < leave) & (leave > 0) & (enter < 1) & ~inside).any(axis=0).mean())
