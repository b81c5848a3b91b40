"""Survey a whole recording once: for each stretch of time and body, the extremes that tell a check where to look closely.

Most checks ask something of every row that hardly any row answers. Asking each in turn reads hundreds of megabytes a
dozen times; here the recording is read once, in stretches that fit a processor's cache, and what comes out is small.
Every figure is a bound: where it rules something out, no row of the stretch could have shown it.
"""

from dataclasses import dataclass

import numpy as np

from ...model.recording.trajectory import Trajectory

Array = np.ndarray
CELLS = 16384
"""Rows times bodies of one stretch: thirteen channels of doubles, under two megabytes."""
LONGEST_S, BEAT_S = 2.0, 0.25
_KEY = "_survey"
STEPWISE = (
    "excess", "lone", "overturn", "still", "unturned", "takeoffs", "halts", "weightless", "off_gravity", "odd_fall",
    "kicked",
)  # fmt: skip
LOOSE_FALL = 0.025
"""A fall is looked at when it differs by this share of gravity; half of what `free_fall` reports."""


@dataclass(frozen=True)
class Survey:
    """K stretches of B bodies; a step belongs to the stretch of its first row."""

    rows: int
    """Rows of a stretch; the last one may be shorter."""
    low: Array
    """(K, B, 3) m: the least coordinates of the body origins."""
    high: Array
    """(K, B, 3) m: the greatest coordinates."""
    speed: Array
    """(K, B) m/s: the greatest speed."""
    spin: Array
    """(K, B) rad/s: the greatest spin."""
    stretched: Array
    """(K, B) the largest | |q|^2 - 1 |."""
    excess: Array
    """(K, B) m: how much further one step goes than the larger of its two speeds takes it."""
    lone: Array
    """(K, B) m: the largest step that is more than eight times its two neighbours together."""
    overturn: Array
    """(K, B) rad: an upper bound of how far a step turns beyond 1.2 times what the larger of its two spins gives."""
    astray: Array
    """(A, B) m: sum over `beat` steps of |displacement - mean velocity x dt|, in the 1-norm."""
    beat: int
    """Steps of one row of `astray`: a quarter of a second."""
    still: Array
    """(K, B) steps whose positions are equal bit for bit."""
    unturned: Array
    """(K, B) steps whose orientations are equal bit for bit."""
    touches: Array
    """(K, B) rows in contact; 0 when contacts are not known."""
    takeoffs: Array
    """(K, B) steps that end a contact."""
    halts: Array
    """(K, B) steps that leave less than a hundredth of a speed which gravity gives only in three steps."""
    weightless: Array
    """(K, B) steps apart from everything whose velocity changes by less than a twentieth of gravity's."""
    off_gravity: Array
    """(K, B) steps apart from everything whose velocity does not change as gravity's does, within a tenth."""
    odd_fall: Array
    """(K, B) steps of falling along gravity, but not as fast as gravity."""
    kicked: Array
    """(K, B) steps apart from everything that gain more energy than gravity gives, at once."""

    def anywhere(self, mask: Array) -> Array:
        """(B,) bool: bodies for which `mask` (K, B) holds in some stretch."""
        return np.asarray(mask.any(axis=0))

    def astray_over(self, steps: int) -> Array:
        """(B,) m: a bound of how far any `steps` successive steps go astray."""
        wide = min(len(self.astray), -(-max(steps, 1) // self.beat) + 1)
        total = np.cumsum(np.concatenate((np.zeros((1, self.astray.shape[1])), self.astray)), axis=0)
        return np.asarray((total[wide:] - total[:-wide]).max(axis=0))


def survey(trajectory: Trajectory) -> Survey:
    """The survey of a recording, made once; fills the recording's speeds and spins on the way."""
    known: Survey | None = trajectory.__dict__.get(_KEY)
    if known is None:
        known = trajectory.__dict__[_KEY] = _make(trajectory)
    return known


def _make(trajectory: Trajectory) -> Survey:
    count, bodies = len(trajectory.t), max(1, len(trajectory.names))
    beat = max(1, round(BEAT_S / max(trajectory.interval_s, 1e-9)))
    rows = beat * max(1, min(CELLS // bodies, round(LONGEST_S / BEAT_S) * beat) // beat)
    starts = range(0, count, rows)
    speed, spin = np.empty((count, len(trajectory.names))), np.empty((count, len(trajectory.names)))
    touching = trajectory.touching
    if touching is None and trajectory.ncon is not None:
        apart_all: Array | None = np.broadcast_to((trajectory.ncon == 0)[:, None], speed.shape)
    else:
        apart_all = None if touching is None else ~touching
    with np.errstate(all="ignore"):
        stretches = [
            _stretch(trajectory, a, min(count, a + rows), beat, touching, apart_all, speed, spin) for a in starts
        ]
    # Both equal what the cached properties would compute, and are found there from now on.
    trajectory.__dict__.setdefault("speed", speed)
    trajectory.__dict__.setdefault("spin", spin)
    found = {name: np.array([one[name] for one in stretches]) for name in stretches[0] if name != "astray"}
    return Survey(rows=rows, beat=beat, astray=np.concatenate([one["astray"] for one in stretches]), **found)


def _squared(vectors: Array) -> Array:
    """(…,) squared norms of (…, 3) or (…, 4), by planes: several times faster than a sum over the last axis."""
    squares = vectors * vectors
    total = squares[..., 0] + squares[..., 1]
    for k in range(2, vectors.shape[-1]):
        total += squares[..., k]
    return np.asarray(total)


def _count(mask: Array) -> Array:
    """(B,) how often each column of (N, B) is true; most never are, which is quicker to see than to count."""
    return mask.sum(axis=0, dtype=float) if mask.any() else np.zeros(mask.shape[1])


def _stretch(
    trajectory: Trajectory,
    a: int,
    z: int,
    beat: int,
    touching: Array | None,
    apart_all: Array | None,
    speeds: Array,
    spins: Array,
) -> dict[str, Array]:
    found: dict[str, Array] = {}
    count = len(trajectory.t)
    end = min(count, z + 1)  # one row more, for the stretch's last step
    pos, quat = trajectory.pos[a:end], trajectory.quat[a:end]
    lin, ang = trajectory.linvel[a:end], trajectory.angvel[a:end]
    own = slice(0, z - a)
    squared = _squared(lin)
    speed, spin = np.sqrt(squared), np.sqrt(_squared(ang))
    speeds[a:end], spins[a:end] = speed, spin
    found["low"] = pos[own].min(axis=0)
    found["high"] = pos[own].max(axis=0)
    found["speed"] = speed[own].max(axis=0)
    found["spin"] = spin[own].max(axis=0)
    found["stretched"] = np.abs(_squared(quat[own]) - 1.0).max(axis=0)
    none = np.zeros(pos.shape[1])
    found["touches"] = none if touching is None else _count(touching[a:z])
    if end - a < 2:
        for name in STEPWISE:
            found[name] = none
        found["astray"] = none[None]
        return found
    dt = np.diff(trajectory.t[a:end])[:, None]
    step = pos[1:] - pos[:-1]
    moved = np.sqrt(_squared(step))
    faster = np.maximum(speed[1:], speed[:-1])
    found["excess"] = (moved - faster * dt).max(axis=0)
    slowing = 3 * float(np.sqrt((trajectory.gravity**2).sum())) * dt
    found["halts"] = _count((speed[1:] < 0.01 * speed[:-1]) & (speed[:-1] > slowing))
    found["still"] = _count(moved == 0)
    found["lone"] = _lone(trajectory, a, end, moved)
    step_back = (lin[1:] + lin[:-1]) * (0.5 * dt[..., None])
    np.subtract(step, step_back, out=step_back)
    found["astray"] = np.add.reduceat(np.abs(step_back, out=step_back), range(0, len(step_back), beat), axis=0).sum(
        axis=2
    )
    equal = quat[1:] == quat[:-1]
    found["unturned"] = _count(equal.view(np.uint32)[..., 0] == 0x01010101)
    found["overturn"] = _overturn(quat, spin, dt)
    lifted = None if touching is None else touching[a : end - 1] & ~touching[a + 1 : end]
    found["takeoffs"] = none if lifted is None else _count(lifted)
    if apart_all is None:
        for name in ("weightless", "off_gravity", "odd_fall", "kicked"):
            found[name] = none
        return found
    apart = apart_all[a + 1 : end] & apart_all[a : end - 1]
    _flight(trajectory, slice(a, end), lin, squared, speed, step, dt, apart, found)
    return found


def _lone(trajectory: Trajectory, a: int, end: int, moved: Array) -> Array:
    """(B,) m: the largest step that is far longer than those around it; the recording's first and last never count."""

    def before(row: int) -> Array:
        return np.sqrt(_squared(trajectory.pos[row + 1] - trajectory.pos[row]))

    near = np.empty_like(moved)
    near[1:] = moved[:-1]
    near[0] = before(a - 1) if a > 0 else np.inf
    near[:-1] += moved[1:]
    near[-1] += before(end - 1) if end < len(trajectory.t) else np.inf
    near *= 8.0
    return np.where(moved > near, moved, 0.0).max(axis=0) if (moved > near).any() else np.zeros(moved.shape[1])


def _overturn(quat: Array, spin: Array, dt: Array) -> Array:
    product = quat[1:] * quat[:-1]
    cosine = product[..., 0] + product[..., 1]
    cosine += product[..., 2]
    cosine += product[..., 3]
    short = 1.0 - np.abs(cosine)
    if short.max() < 0.005:  # no step turns by 0.2 rad
        return np.zeros(quat.shape[1])
    # arccos(c) <= pi/2 sqrt(1 - c) for 0 <= c <= 1: a bound without the cosine's rounding.
    angle = np.pi * np.sqrt(np.clip(short, 0.0, 1.0))
    return np.asarray((angle - 1.2 * np.maximum(spin[1:], spin[:-1]) * dt).max(axis=0))


def _flight(
    trajectory: Trajectory,
    rows: slice,
    lin: Array,
    squared: Array,
    speed: Array,
    step: Array,
    dt: Array,
    apart: Array,
    found: dict[str, Array],
) -> None:
    gravity = trajectory.gravity
    g2 = float((gravity**2).sum())
    g = float(np.sqrt(g2))
    known = trajectory.com_velocity
    centres = lin if known is trajectory.linvel else known[rows]
    change = centres[1:] - centres[:-1]
    size = _squared(change)
    along = (change.reshape(-1, 3) @ gravity).reshape(size.shape)
    squared_dt = dt**2
    # |dv - g dt|^2 = |dv|^2 - 2 dv.g dt + g^2 dt^2
    extra = size - 2 * along * dt + g2 * squared_dt
    found["weightless"] = _count(apart & (size < 1.01 * (0.05 * g) ** 2 * squared_dt))
    tolerance = 0.099 * max(g, 1.0)
    found["off_gravity"] = _count(apart & (extra > tolerance**2 * squared_dt))
    if g2 > 0:
        share = along / (g2 * dt)
        across = size / (g2 * squared_dt) - share**2
        odd = apart & (across < 0.011) & (np.abs(share - 1.0) > LOOSE_FALL)
        found["odd_fall"] = _count(odd)
    else:
        found["odd_fall"] = np.zeros(size.shape[1])
    limit = (0.099 * trajectory.speed_scale + 0.0199 * speed[:-1]) ** 2
    if centres is lin:
        fall, jump = (step.reshape(-1, 3) @ gravity).reshape(size.shape), extra
    else:
        fall = (step.reshape(-1, 3) @ gravity).reshape(size.shape)
        jump = _squared(lin[1:] - lin[:-1] - gravity * dt[..., None])
    gain = squared[1:] - squared[:-1] - 2 * fall
    found["kicked"] = _count(apart & (gain > limit) & (jump > limit))
