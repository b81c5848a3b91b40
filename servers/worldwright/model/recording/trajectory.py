"""A recorded motion for analysis: frozen numpy arrays over T recorded rows and B bodies.

Frame: world, z up; metres, seconds, radians, kilograms, newtons. Row n holds the state at `t[n]` and the quantities
derived from that same state (contacts, forces, energy). Bodies are all bodies but the world, in the model's order;
wherever a body is given by index, -1 is the world.

Interchange (`trajectory_files.read_npz`), no pickle: required `t (T,)`, `names (B,)`, `pos (T,B,3)`, `quat (T,B,4)` wxyz,
`linvel (T,B,3)`, `angvel (T,B,3)`; optional `energy (T,2)` potential and kinetic, `ncon (T,)`, `max_penetration (T,)`,
`contact_force_sum (T,B)`; an MJCF file of the same stem beside it tells what poses alone cannot.
"""

import hashlib
import os
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from typing import Any

import numpy as np

from worldengine.inputs.flex_points import own_points
from worldkit.turning import cross, turned

from ..errors import NotFoundError, RecordingError
from . import assemblies
from .coordinates import Coordinates
from .law_balances import LawBalance
from .loads import Loads
from .mechanics import Mechanics
from .records import Contacts, Interventions
from .shown_points import ShownPoints
from .solver_channels import SolverChannels
from .stills import Lens, Stills

Array = np.ndarray
STANDARD_GRAVITY = 9.80665
CUT_OF = "_cut_of"
"""Key under which a motion cut at a row keeps (the whole motion, that row), so that results for the whole can be cut too."""
HASHED = 1 << 20
"""How many numbers are hashed at a time."""
SMALLEST_M = 0.01
"""Radius, m, that a body of unknown size is taken to have at least."""
WORLD_NAMES = ("world", "ground", "floor")
"""Names by which the world itself may be meant where a body is asked for."""
SHAPES = {"pos": (3,), "quat": (4,), "linvel": (3,), "angvel": (3,)}
OPTIONAL_SHAPES = {"energy": "T,2", "ncon": "T", "max_penetration": "T", "contact_force_sum": "T,B"}


@dataclass(frozen=True)
class Trajectory:
    """One recorded motion; channels that were not recorded are None."""

    t: Array
    """(T,) s, strictly increasing."""
    names: tuple[str, ...]
    """(B,) body names."""
    pos: Array
    """(T, B, 3) m, body origins."""
    quat: Array
    """(T, B, 4) wxyz."""
    linvel: Array
    """(T, B, 3) m/s, of the body origins."""
    angvel: Array
    """(T, B, 3) rad/s, world frame."""
    energy: Array | None = None
    """(T, 2) J: potential, kinetic."""
    linmom: Array | None = None
    """(T, 3) kg·m/s of the whole system."""
    angmom: Array | None = None
    """(T, 3) kg·m^2/s of the whole system about its centre of mass."""
    ncon: Array | None = None
    """(T,) number of contacts."""
    max_penetration: Array | None = None
    """(T,) m."""
    contact_force_sum: Array | None = None
    """(T, B) N: sum of the magnitudes of the contact forces on each body."""
    contacts: Contacts | None = None
    interventions: Interventions | None = None
    warnings: tuple[tuple[float, str, int], ...] | None = None
    """Simulator warnings: time in s, name, count."""
    loads: Loads | None = None
    """What constraints, tendons and actuators exert."""
    coordinates: Coordinates | None = None
    """Joint positions, tendon lengths, constraint violations."""
    balances: tuple[LawBalance, ...] = ()
    """What each of the author's own laws gives and takes."""
    media: ShownPoints = field(default_factory=ShownPoints)
    """Where the points of laws lay."""
    beside: SolverChannels = field(default_factory=SolverChannels)
    mechanics: Mechanics = field(default_factory=Mechanics)
    meta: Mapping[str, Any] = field(default_factory=dict)
    model: Any = None
    """The compiled `MjModel` that lies beside foreign data; None for our own recordings, whose ledger says more."""
    stills: "Stills | None" = None
    """What was drawn of it, where it was."""
    cameras: Mapping[str, Lens] | None = None
    """Where each camera stands over the motion; None when nobody looked."""
    time_step: float = 0.0
    """s, of the simulation; 0 when unknown."""
    out_of_order: tuple[float, ...] = ()
    """Times of rows that were not later than the rows before them; they are left out of every array."""
    complete: bool = True
    """False: the recording was cut off by a crash or a limit."""
    recorded_sha256: str = ""

    @classmethod
    def from_arrays(
        cls,
        t: Any,
        names: Sequence[str],
        pos: Any,
        *,
        quat: Any = None,
        linvel: Any = None,
        angvel: Any = None,
        **more: Any,
    ) -> "Trajectory":
        """From arrays; missing rotations are the identity, missing velocities the derivatives of the poses.

        `more` takes the other fields by name, and `gravity`, `mass`, `size_m` (full extents (B,3), or a scalar each).
        """
        t = np.asarray(t, dtype=float)
        pos = np.asarray(pos, dtype=float)
        bodies = len(names)
        if quat is None:
            quat = np.broadcast_to((1.0, 0.0, 0.0, 0.0), (len(t), bodies, 4))
        if linvel is None:
            linvel = np.gradient(pos, t, axis=0) if len(t) > 1 else np.zeros_like(pos)
        if angvel is None:
            angvel = np.zeros((len(t), bodies, 3))
        facts: dict[str, Any] = {}
        for key in ("gravity", "mass"):
            if more.get(key) is not None:
                facts[key] = np.asarray(more.pop(key), dtype=float)
        if more.get("size_m") is not None:
            extents = np.asarray(more.pop("size_m"), dtype=float)
            extents = extents[:, None] if extents.ndim == 1 else extents
            facts["half_extents"] = np.broadcast_to(extents / 2, (bodies, 3))
            facts["center"] = np.zeros((bodies, 3))
        made = cls(
            t=t,
            names=tuple(str(name) for name in names),
            pos=pos,
            quat=np.asarray(quat, dtype=float),
            linvel=np.asarray(linvel, dtype=float),
            angvel=np.asarray(angvel, dtype=float),
            **more,
        )
        made = replace(made, mechanics=replace(made.mechanics, **facts)) if facts else made
        made.verify()
        return made

    def verify(self, place: str = "") -> None:
        """Raise a `RecordingError` naming the first channel whose shape or clock cannot be right."""

        def refuse(cause: str, next_move: str) -> None:
            raise RecordingError(cause, place=place, next_move=next_move)

        rows, bodies = len(self.t) if self.t.ndim == 1 else -1, len(self.names)
        if rows < 1:
            refuse(f"t has shape {self.t.shape}, not (T,) with T > 0", "record at least one row")
        if len(set(self.names)) != bodies:
            refuse("two bodies have the same name", "give every body its own name")
        if not np.all(np.isfinite(self.t)) or np.any(np.diff(self.t) <= 0):
            refuse("t is not strictly increasing and finite", "write one row per instant, in order")
        expected = {name: (rows, bodies, *tail) for name, tail in SHAPES.items()}
        sizes = {"T": rows, "B": bodies, "2": 2}
        for name, text in OPTIONAL_SHAPES.items():
            if getattr(self, name) is not None:
                expected[name] = tuple(sizes[part] for part in text.split(","))
        for name, shape in expected.items():
            if getattr(self, name).shape != shape:
                refuse(f"{name} has shape {getattr(self, name).shape}, not {shape}", "see the interchange's shapes")

    def channel(self, name: str) -> Any:
        """A channel or a fact by dotted name (`contacts`, `mechanics.free`); None when it was not recorded."""
        value: Any = self
        for part in name.split("."):
            value = getattr(value, part, None)
            if value is None:
                return None
        return value

    def index(self, name: str) -> int:
        """The index of a body; -1 for the world (its own names, or a geom of it); unknown names list the known."""
        if name in self.names:
            return self.names.index(name)
        geoms = self.mechanics.geom_names
        if name in geoms and self.mechanics.geom_body is not None:
            return int(self.mechanics.geom_body[geoms.index(name)])
        if name in WORLD_NAMES:
            return -1
        raise NotFoundError(
            f"there is no body '{name}' in this recording",
            next_move=f"name one of: {', '.join(self.names) or '(none)'}, or 'world'",
        )

    def members(self, body: int) -> tuple[int, ...]:
        """A body and all that is welded on below it: one rigid body; itself alone where joints are not known."""
        facts = self.mechanics
        if body < 0 or facts.jointed is None or facts.parent is None:
            return (body,)
        found = assemblies.heads(facts.parent, facts.jointed, (body,))
        return tuple(int(b) for b in np.flatnonzero(found == body))

    @cached_property
    def flex_points(self) -> dict[str, tuple[str, ...]]:
        """The recorded point bodies of each flex, by its name."""
        rows = [row for row in self.meta.get("flexes") or () if isinstance(row, Mapping)]
        told = {str(row.get("name")): own_points(str(row.get("name")), row.get("bodies") or ()) for row in rows}
        return {name: tuple(b for b in bodies if b in self.names) for name, bodies in told.items()}

    def rows(self, start_s: float | None = None, end_s: float | None = None) -> slice:
        """The rows from `start_s` to `end_s` inclusive; at least one row."""
        slack = 1e-9 * max(1.0, abs(float(self.t[-1])))
        first = 0 if start_s is None else int(np.searchsorted(self.t, start_s - slack))
        last = len(self.t) if end_s is None else int(np.searchsorted(self.t, end_s + slack, side="right"))
        first = min(first, len(self.t) - 1)
        return slice(first, max(last, first + 1))

    def before(self, row: int) -> "Trajectory":
        """The motion before `row`."""
        cut: dict[str, Any] = {}
        for f in fields(self):
            value = getattr(self, f.name)
            if isinstance(value, np.ndarray) and len(value) == len(self.t):
                cut[f.name] = value[:row]
        if self.contacts is not None:
            cut["contacts"] = self.contacts.before(row)
        if self.loads is not None:
            cut["loads"] = self.loads.before(row)
        if self.coordinates is not None:
            cut["coordinates"] = self.coordinates.before(row)
        made = replace(self, **cut, beside=self.beside.before(row))
        made.__dict__[CUT_OF] = (self, row)
        if self.__dict__.get("finite"):
            made.__dict__["finite"] = True  # what is true of all rows is true of the first ones
        return made

    @cached_property
    def sha256(self) -> str:
        """Identity of the motion: as recorded, else of the bytes of the clock, the poses and the velocities."""
        if self.recorded_sha256:
            return self.recorded_sha256
        digest = hashlib.sha256("\0".join(self.names).encode())
        parts = []
        for array in (self.t, self.pos, self.quat, self.linvel, self.angvel):
            flat = np.ascontiguousarray(array, dtype="<f8").reshape(-1)
            digest.update(str(array.shape).encode())
            parts += [flat[a : a + HASHED] for a in range(0, len(flat), HASHED)]
        # Each part by itself, since hashing frees the interpreter: on two cores in half the time.
        with ThreadPoolExecutor(min(4, os.cpu_count() or 1)) as pool:
            for part in pool.map(lambda values: hashlib.sha256(values.data).digest(), parts):
                digest.update(part)
        return digest.hexdigest()

    @cached_property
    def interval_s(self) -> float:
        """Median time between recorded rows, s; of a single row the time step, or 1 where that is not known either."""
        return float(np.median(np.diff(self.t))) if len(self.t) > 1 else self.time_step or 1.0

    @property
    def duration_s(self) -> float:
        """From the first to the last row, s."""
        return float(self.t[-1] - self.t[0])

    @cached_property
    def every_step(self) -> bool:
        """Whether every simulation step was recorded."""
        return self.time_step > 0 and abs(self.interval_s / self.time_step - 1) < 0.01

    @cached_property
    def gravity(self) -> Array:
        """(3,) m/s^2; standard gravity downwards when the recording does not tell."""
        known = self.mechanics.gravity
        return np.array([0.0, 0.0, -STANDARD_GRAVITY]) if known is None else known

    @cached_property
    def finite(self) -> bool:
        """No pose and no velocity is nan or infinite (nor so large that their sum is)."""
        # A sum is not finite as soon as one of its terms is not, and costs no array of its own.
        return all(np.isfinite(channel.sum()) for channel in (self.pos, self.quat, self.linvel, self.angvel))

    @cached_property
    def speed(self) -> Array:
        """(T, B) m/s, of the body origins."""
        return np.sqrt(np.einsum("tbi,tbi->tb", self.linvel, self.linvel))

    @cached_property
    def spin(self) -> Array:
        """(T, B) rad/s, magnitude of the angular velocity."""
        return np.sqrt(np.einsum("tbi,tbi->tb", self.angvel, self.angvel))

    @cached_property
    def size_m(self) -> Array:
        """(B,) radius of the sphere around each body; where unknown, a fiftieth of the extent of the scene or 1 cm."""
        known = self.mechanics.half_extents
        size = np.full(len(self.names), np.nan) if known is None else np.sqrt((known**2).sum(axis=1))
        if np.any(np.isnan(size)):
            flat = self.pos[:: max(1, len(self.t) // 500)].reshape(-1, 3)
            flat = flat[np.all(np.isfinite(flat), axis=1)]
            extent = 1.0
            if len(flat):
                low, high = np.percentile(flat, (1, 99), axis=0)
                extent = float(np.sqrt(((high - low) ** 2).sum())) or 1.0
            size = np.where(np.isnan(size), max(0.02 * extent, SMALLEST_M), size)
        return np.maximum(size, 1e-9)

    @cached_property
    def moves_freely(self) -> Array:
        """(B,) bool: not known to be scenery, posed by the program, or only drawn."""
        found = np.ones(len(self.names), dtype=bool)
        facts = self.mechanics
        if facts.dynamic is not None:
            found &= facts.dynamic
        for excluded in (facts.mocap, facts.visual_only):
            if excluded is not None:
                found &= ~excluded
        return found

    @cached_property
    def speed_scale(self) -> Array:
        """(B,) m/s: sqrt(g·size), the speed of falling by half one's own size; without gravity, one size a second."""
        g = float(np.sqrt((self.gravity**2).sum()))
        return np.sqrt(g * self.size_m) if g > 0 else self.size_m / 1.0

    @cached_property
    def touching(self) -> Array | None:
        """(T, B) bool: in contact with something; from the contacts, else the force sums; None when neither is there."""
        if self.contacts is not None:
            return self._mark(self.contacts.take(self.contacts.live))
        return None if self.contact_force_sum is None else self.contact_force_sum > 0

    @cached_property
    def depth_m(self) -> Array | None:
        """(T, B) m: the deepest penetration of each body."""
        if self.contacts is None:
            return None
        deepest = np.zeros((len(self.t), len(self.names)))
        for body in (self.contacts.body1, self.contacts.body2):
            inside = body >= 0
            np.maximum.at(deepest, (self.contacts.row[inside], body[inside]), self.contacts.depth_m[inside])
        return deepest

    def touching_pair(self, one: int, other: int) -> Array | None:
        """(T,) bool: these two bodies touch."""
        if self.contacts is None:
            return None
        found = np.zeros(len(self.t), dtype=bool)
        found[self.contacts.row[self.contacts.live & self.contacts.of_pair(one, other)]] = True
        return found

    @cached_property
    def com(self) -> Array:
        """(T, B, 3) m: centres of mass; body origins when their offset is unknown."""
        if not self._off_centre:
            return self.pos
        found = np.empty_like(self.pos)
        for rows in self._stretches():
            found[rows] = self.pos[rows] + self._com_offset(rows)
        return found

    @cached_property
    def com_velocity(self) -> Array:
        """(T, B, 3) m/s: of the centres of mass."""
        if not self._off_centre:
            return self.linvel
        found = np.empty_like(self.linvel)
        for rows in self._stretches():
            found[rows] = self.linvel[rows] + cross(self.angvel[rows], self._com_offset(rows))
        return found

    @property
    def _off_centre(self) -> bool:
        offset = self.mechanics.com
        return offset is not None and bool(np.any(np.abs(offset) > 1e-12))

    def _com_offset(self, rows: slice) -> Array:
        """(N, B, 3) m: from the body origins to the centres of mass, world frame."""
        return turned(self.quat[rows], np.asarray(self.mechanics.com))

    def _stretches(self, cells: int = 16384) -> Iterator[slice]:
        """Successive rows, few enough at a time that what is made of them stays small."""
        rows = max(1, cells // max(1, len(self.names)))
        return (slice(a, a + rows) for a in range(0, len(self.t), rows))

    def _mark(self, contacts: Contacts) -> Array:
        found = np.zeros((len(self.t), len(self.names)), dtype=bool)
        for body in (contacts.body1, contacts.body2):
            inside = body >= 0
            found[contacts.row[inside], body[inside]] = True
        return found
