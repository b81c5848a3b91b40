"""The shot of a film that nobody has thought about: the whole event in one, from its side, close, level, and behind it all is soft.

Judges who saw our films beside others named, in what they liked less, the wide shot of small things, cuts, and a moment shown again.
"""

from collections import Counter
from dataclasses import replace
from itertools import product

import numpy as np

from . import viewpoints
from .recorded import WORLD, Recorded

Told = tuple[viewpoints.Viewpoint, dict[str, float]]
"""A camera, and what `Film.shot` takes besides."""

USUAL_AZIMUTH, USUAL_ELEVATION = -57.0, 13.0
"""From here the lights of all settings fall across what is seen."""
LEVEL_DEG = 6.5
"""So low goes a camera that goes along: through its lens the horizon is then in the upper third, else it sees the ground alone."""
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
ROOM = 1.2
"""So many times as wide and as high as what happens is the picture at least."""
BESIDE = 1.6
"""What stands still belongs into the picture if it is at most so many times as large as the movers' way, and as near to its middle."""
CROWD = 8
"""Of more movers than this the camera follows none."""


def shots(recorded: Recorded) -> list[Told]:
    """The whole recording from one side by a camera that stands still, or that goes along with whom it happens to where that is
    small."""
    return [(composed(recorded), {"until": settled(recorded), "speed": pace(recorded)})]


def pace(recorded: Recorded) -> float:
    """Recorded seconds in a second of film, with which the first showing is neither long nor over at once."""
    end = settled(recorded)
    speed = float(np.clip(end / LONGEST_S, 1.0, 50.0) * np.clip(end / SHORTEST_S, 0.2, 1.0))
    return 1.0 if abs(speed - 1.0) < 0.2 else speed


def composed(
    recorded: Recorded, seen_from: tuple[float, float] | None = None, lens_mm: float = LENS_MM
) -> viewpoints.Viewpoint:
    """One shot that holds the whole event from its side (`view`), or from an azimuth and elevation, degrees: as near as its way allows.

    What is far behind is soft. Where whom it happens to would be small in it, the camera goes along with them, near and level.
    """
    heroes = leads(recorded)
    camera, away = whole(recorded, *(seen_from or view(recorded)), lens_mm)
    if not heroes or len(recorded.movers) > CROWD:
        return camera
    tangent = float(np.tan(np.radians(viewpoints.fovy_deg(lens_mm)) / 2))
    if recorded.radius(*heroes) >= LEAST * away * tangent:
        return replace(camera, focus=away, aperture=_soft(lens_mm, away))
    return _near(recorded, heroes, seen_from, NEAR * LEAST, lens_mm)


def close(
    recorded: Recorded, seen_from: tuple[float, float] | None = None, large: float = 0.3, lens_mm: float = 85.0
) -> viewpoints.Viewpoint:
    """A shot of whom the event happens to, who take the share `large` of the picture's height where they are together."""
    heroes = leads(recorded)
    if not heroes:
        return composed(recorded, seen_from, lens_mm)
    return _near(recorded, heroes, seen_from, large, lens_mm)


def _near(
    recorded: Recorded, heroes: tuple[str, ...], seen_from: tuple[float, float] | None, large: float, lens_mm: float
) -> viewpoints.Viewpoint:
    """A camera that goes along with some, near, from their side and level, or as it is told."""
    away = recorded.radius(*heroes) / (large * float(np.tan(np.radians(viewpoints.fovy_deg(lens_mm)) / 2)))
    azimuth, elevation = seen_from or view(recorded, away, LEVEL_DEG)
    return viewpoints.follow(
        heroes, azimuth_deg=(azimuth - 4.0, azimuth + 4.0), elevation_deg=elevation,
        fill=large, lens_mm=lens_mm, lag_s=0.18, focus=heroes[0], aperture=_soft(lens_mm, away),
    )  # fmt: skip


def _soft(lens_mm: float, away: float) -> float:
    """The aperture with which what is far behind a thing so far away, m, is soft."""
    return float(np.clip(lens_mm**2 / (SOFT * 1000.0 * away), 1.4, 64.0))


def whole(
    recorded: Recorded, azimuth_deg: float, elevation_deg: float, lens_mm: float = LENS_MM
) -> tuple[viewpoints.Viewpoint, float]:
    """A camera that stands still, as near as the whole way of all that moves allows with what stands among it; and how far it is, m."""
    times = np.linspace(0.0, recorded.duration, 60)
    names = recorded.movers or recorded.bodies
    corners = [np.zeros((0, 3))]
    signs = np.array(list(product((-1.0, 1.0), repeat=3)))
    for name in names:
        corners.append(
            (recorded.position(name, times)[:, None] + recorded.radius(name) * signs / 3**0.5).reshape(-1, 3)
        )
    corners += [recorded.outline(name) for name in beside(recorded)]
    points = np.concatenate(corners)
    points[:, 2] = np.maximum(points[:, 2], recorded.floor_z)  # a box around a slanted thing reaches into the ground
    a, e = np.radians((azimuth_deg, elevation_deg))
    way = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    across = np.array([-np.sin(a), np.cos(a), 0.0])
    axes = np.stack([across, np.cross(way, across), way])
    seen = points @ axes.T
    middle = 0.5 * (seen.min(axis=0) + seen.max(axis=0)) if len(seen) else np.zeros(3)
    tangent = float(np.tan(np.radians(viewpoints.fovy_deg(lens_mm)) / 2))
    halves = np.array([tangent * recorded.size[0] / recorded.size[1], tangent])
    needed = (seen[:, 2] - middle[2])[:, None] + ROOM * np.abs(seen - middle)[:, :2] / halves
    away = max(float(needed.max(initial=0.0)), 0.05)
    target = middle @ axes
    return viewpoints.still(tuple(target + away * way), tuple(target), lens_mm=lens_mm), away


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


def view(recorded: Recorded, away: float = 0.0, lowest_deg: float = USUAL_ELEVATION) -> tuple[float, float]:
    """Azimuth and elevation, degrees, from which the motion is seen from the side and nothing stands before it, from so far away, m;
    without it from where the whole way is seen. It is as low as `lowest_deg` where nothing is hidden then."""
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
    still = tuple(name for name in recorded.bodies if name not in names)
    points = ways[:, ::4].reshape(-1, 3)
    far = away or 4.0 * max(float(np.ptp(points, axis=0).max()), 2 * recorded.radius(*names))
    best, found = np.inf, (USUAL_AZIMUTH, USUAL_ELEVATION)
    for azimuth in np.arange(-177.0, 183.0, 15.0):
        a = np.radians(azimuth)
        level_way = np.array([np.cos(a), np.sin(a)])
        side = 0.0 if along is None else 0.5 * max(abs(float(level_way @ along)) - 0.42, 0.0)
        usual = 0.25 * (1.0 - np.cos(a - np.radians(USUAL_AZIMUTH)))
        for elevation in (lowest_deg, 28.0, 46.0):
            e = np.radians(elevation)
            eye = points + far * np.array([np.cos(e) * level_way[0], np.cos(e) * level_way[1], np.sin(e)])
            cost = side + usual + 0.004 * (elevation - lowest_deg) + 3.0 * _hidden(recorded, points, eye, still)
            if cost < best - 1e-9:
                best, found = cost, (float(azimuth), float(elevation))
    return found


def _hidden(recorded: Recorded, points: np.ndarray, eyes: np.ndarray, still: tuple[str, ...]) -> float:
    """The share of some points (P, 3) that the box of something between them and the eyes (P, 3) hides; boxes around a point do not."""
    hidden = np.zeros(len(points), bool)
    for name in still:
        middle, half = recorded.box(name)
        turn = recorded.orientation(name, 0.0)
        local = (points - recorded.position(name, 0.0)) @ turn - middle
        way = (eyes - points) @ turn
        safe = np.where(np.abs(way) < 1e-9, 1e-9, way)
        low, high = (-half - local) / safe, (half - local) / safe
        enter, leave = np.minimum(low, high).max(axis=-1), np.maximum(low, high).min(axis=-1)
        inside = (np.abs(local) <= half + 0.02).all(axis=-1)
        hidden |= (enter < leave) & (leave > 0) & (enter < 1) & ~inside
    return float(hidden.mean())
