"""An author's own law of which all is known: the sums of a mass on a spring, the points of a paint that comes to cover a plate."""

from dataclasses import replace

import numpy as np

from worldkit.turning import matrices

from ...model.recording.law_balances import LawBalance
from ...model.recording.shown_points import Lay, ShownPoints
from ...model.recording.trajectory import Trajectory
from .analytic import clock, motion


def spring(
    kept: float = 1.0,
    made: float = 0.0,
    mass: float = 0.0,
    volume: float = 0.0,
    ballast: float = 0.0,
    lies: float = 1.0,
    rate: float = 3.0,
    felt: float = 1.0,
    weighs: float = 1.0,
) -> LawBalance:
    """The sums of a mass on a spring.

    Args:
        kept: the share of its pull that the body feels.
        made: W that it makes from nothing.
        mass, volume: how fast they grow, as a share of those at the start, 1/s.
        ballast: kg besides, which are let down at once, to nobody's use.
        lies: the share of its weight that what stands fast carries; the rest only falls.
        rate: of its swinging, rad/s.
        felt: the share of the pull that the mass itself feels.
        weighs: kg, of all of it, with springs as much weaker.
    """
    t = np.linspace(0.0, 2.0, 201)
    own = np.outer(np.cos(rate * t), [1.0, 0.0, 0.0])
    gravity = np.array([0.0, 0.0, -9.81]) if ballast else np.zeros(3)
    mass_at = 1.0 + ballast + mass * t
    pulled = np.concatenate([np.zeros((1, 3)), np.cumsum(mass_at[:-1, None] * gravity * np.diff(t)[:, None], axis=0)])
    let_down = -ballast * np.minimum(t, 0.1)
    stored = 2.0 * np.cos(rate * t) ** 2
    return LawBalance(
        name="spring",
        bodies=("body",),
        t=t,
        mass=weighs * mass_at,
        momentum=weighs * (felt * own + (1.0 - lies) * pulled),
        energy=weighs * (stored + made * t + let_down),
        weight=weighs * let_down,
        stored=weighs * stored,
        volume=np.ones_like(t) + volume * t,
        given=weighs * kept * (own[0] - own),
        held=weighs * lies * pulled,
        work=weighs * (2.0 - stored),
        pushed=weighs * kept * float(np.abs(np.diff(own[:, 0])).sum()),
        gravity=gravity,
    )


def pouring(
    share: float = 1.0, begins: float = 0.0, depth: float = 0.002, tilt_deg: float = 0.0, apart: float = 0.0025
) -> Trajectory:
    """A plate `body` of 0.4 by 0.2 by 0.02 m, its upper side 0.05 m high, which `paint` comes to cover from one end within 2 s.

    Args:
        share, begins: what of it is covered in the end, and at the start; what is dry lies 0.3 mm below the surface.
        depth: of the paint, m.
        tilt_deg: by which plate and paint are turned about y.
        apart: how far its points lie from each other, m.
    """
    t = clock(2.0, 0.1)
    half = np.radians(tilt_deg) / 2
    turned = np.tile((np.cos(half), 0.0, np.sin(half), 0.0), (len(t), 1, 1))
    x, y = (np.arange(-side + apart / 2, side, apart) for side in (0.2, 0.1))
    x, y = np.meshgrid(x, y)
    front = -0.2 + 0.4 * (begins + (share - begins) * t / t[-1])
    high = 0.01 + np.where(x.ravel() < front[:, None], depth, -3e-4)
    flat = np.stack([np.tile(x.ravel(), (len(t), 1)), np.tile(y.ravel(), (len(t), 1)), high], axis=2)
    middle = np.array([0.0, 0.0, 0.04])
    places = middle + flat @ matrices(turned[0, 0]).T
    plate = {"body": "body", "type": "box", "pos": [0, 0, 0], "quat": [1, 0, 0, 0], "aabb": [0, 0, 0, 0.2, 0.1, 0.01]}
    pos = np.tile(middle, (len(t), 1))
    media = ShownPoints({"paint": Lay(t, places.reshape(-1, 3))})
    return motion(t, pos, 0 * pos, quat=turned, free=False, meta={"geoms": [plate]}, media=media)


def strewn(per_s: float = 20.0, seconds: float = 2.0, kilograms: float = 0.4) -> Trajectory:
    """`snow`, points of one mass that come down at 1 m/s one after the other, told every 40 ms, and pass z = 0 at (k + 1/2) / per_s;
    what shows them lies still far above.
    """
    t = clock(seconds)
    told = t[::20]
    moments = (np.arange(int(per_s * seconds)) + 0.5) / per_s
    places = np.zeros((len(told), len(moments), 3))
    places[:, :, 2] = moments - told[:, None]
    laws = replace(spring(), name="snowfall", mass=np.full(201, kilograms))
    pos = np.tile((0.0, 0.0, 5.0), (len(t), 1))
    media = ShownPoints({"snow": Lay(told, places.reshape(-1, 3))})
    return motion(t, pos, 0 * pos, names=("snow",), free=False, media=media, balances=(laws,))


def two_paints(share: float = 1.0) -> Trajectory:
    """A yellow and a blue puddle of 0.1 by 0.1 m, 2 mm deep, side by side, which spread; a share of both turns green within 2 s.

    Args:
        share: of the points, from the line between them outwards.
    """
    t = clock(2.0, 0.1)
    side = np.arange(-0.1, 0.1, 0.005) + 0.0025
    x, y = np.array([a.ravel() for a in np.meshgrid(side, side / 2)]) + np.random.default_rng(3).uniform(
        -4e-4, 4e-4, (2, len(side) ** 2)
    )
    spread = 1 + 0.2 * t[:, None]
    places = np.stack([spread * x, spread * y, np.full((len(t), len(x)), 0.002)], axis=2)
    yellow, blue, green = 0xFFC814, 0x1428A0, 0x3C7840
    green_now = np.abs(x) < 0.1 * share * np.minimum(t, 1.0)[:, None]
    hues = np.where(green_now, green, np.where(x < 0, yellow, blue))
    media = ShownPoints({"paint": Lay(t, places.reshape(-1, 3), hues.ravel())})
    return motion(t, np.zeros((len(t), 3)), np.zeros((len(t), 3)), media=media)


def pressed_in(deep: float = 0.01, hollow: float = 0.0) -> Trajectory:
    """`clay`, 0.2 by 0.2 m and 0.05 m thick, of points 4 mm apart, into which a `ball` over its middle makes a dent of 3 cm radius within 1 s.

    Args:
        deep: of the dent, m.
        hollow: how much lower its middle lies from the start, m.
    """
    t = clock(2.0, 0.1)
    side = np.arange(-0.1, 0.1, 0.004) + 0.002
    x, y = (a.ravel() for a in np.meshgrid(side, side))
    far = np.hypot(x, y)
    shape = np.clip(1 - (far / 0.03) ** 4, 0.0, 1.0)
    top = 0.05 - shape * (hollow + deep * np.minimum(t, 1.0)[:, None])
    flat = np.stack(np.broadcast_arrays(x, y, top), axis=2)
    whole = np.concatenate([flat, np.stack(np.broadcast_arrays(x, y, 0 * top), axis=2)], axis=1)
    media = ShownPoints({"clay": Lay(t, whole.reshape(-1, 3))})
    pos = np.tile((0.0, 0.0, 0.06), (len(t), 1))
    return motion(t, pos, 0 * pos, names=("ball",), free=False, media=media)


def whirling(rate: float = 10.0, shakes: bool = False) -> Trajectory:
    """`water`: a grid that only sinks, and 80 points that go round its middle at a `rate`, rad/s, for 2 s; or shake to and fro."""
    t = clock(2.0, 0.04)
    side = np.linspace(-0.05, 0.05, 9)
    x, y = (a.ravel() for a in np.meshgrid(side, side))
    grid = np.stack(np.broadcast_arrays(x, y, -0.01 * t[:, None]), axis=2)
    far, begins = np.linspace(0.005, 0.05, 80), np.arange(80) * 2.4
    angle = begins + (0.3 * np.sin(rate * t) if shakes else rate * t)[:, None]
    round_it = np.stack([far * np.cos(angle), far * np.sin(angle), 0 * angle], axis=2)
    whole = np.concatenate([grid, round_it], axis=1)
    media = ShownPoints({"water": Lay(t, whole.reshape(-1, 3))})
    return motion(t, np.zeros((len(t), 3)), np.zeros((len(t), 3)), media=media)
