"""Media: what an author's laws move beside the engine, as points that are recorded, driven again, and drawn.

A law runs in the author's process (`worldkit.laws`). Its forces are inputs like any other. Its points cross beside the answers a
hundred times a second, or less often where they are many, with their sums, and once more at the
end, so that no push goes uncounted. They are part of what was sent to the world, so a replay hands them on, and asking the law
again must give the same. Nothing of a medium is taken for granted: its bodies, what shows it and its size are checked against the
compiled world, every number when it crosses.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from worldkit.channel import PeerError
from worldkit.errors import ProgramError
from worldkit.laws import EACH, HUGE, PLAIN, TOTALS, WORLD
from worldkit.mirror import words
from worldkit.naming import names

from ..recording import point_colours
from ..recording.stream_files import MOST_BYTES, OF_POINTS

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.record import Recorder

MOST_POINTS = 20_000
"""Points of all media of one world."""
MOST_HZ, LEAST_HZ = 100.0, 25.0
"""Points are recorded so often, 1/s of simulated time."""
POINTS_A_SECOND = 150_000
"""Points recorded a second, about 2 MB packed; above 6,000 points there are more, since `LEAST_HZ` holds: 6 MB for `MOST_POINTS`."""
POINT_BYTES = 28
"""A row of `media`: step, medium, point and colour of four bytes, and a place of twelve."""
PUSHES = ("force", "torque", "solver")


@dataclass(frozen=True)
class Medium:
    """A declared law."""

    name: str
    bodies: tuple[str, ...]
    shown_by: str
    file: str = ""
    """In which the plan says that it stands, beside the program: the author's end refuses a law of another."""
    world: bool = False
    """Whether it pushes on what stands fast too: `world` among its bodies. What goes there is summed, and acts on nothing."""

    @classmethod
    def read(cls, row: Mapping[str, Any]) -> "Medium":
        """Read a row of `inputs.json` or of a recording's `meta.json`; raises KeyError or TypeError when it makes no sense."""
        said = row["law"]
        bodies = tuple(map(str, row["bodies"]))
        own = tuple(body for body in bodies if body != WORLD)
        return cls(str(said["name"]), own, str(said["shown_by"]), str(said.get("file", "")), WORLD in bodies)

    @property
    def named(self) -> tuple[str, ...]:
        """Its bodies, and `world` last where it pushes on that."""
        return (*self.bodies, WORLD) if self.world else self.bodies

    def written(self) -> dict[str, Any]:
        """The row as `inputs.json` and `meta.json` have it."""
        said = {"name": self.name, "shown_by": self.shown_by} | ({"file": self.file} if self.file else {})
        return {"kind": "solver", "bodies": list(self.named), "law": said}


class Media:
    """The media of one world.

    Args:
        model: the world.
        rows: the declared laws, at least one.
        seconds: from one question to the next.
        others: declared (kind, names) of inputs besides; None where everything is open.
        steps: of the run, at whose end the laws tell once more; None where nothing is recorded.
        every: steps from one question to the next.

    Raises:
        ProgramError: a body or what shows a law is not there, is simulated, has too many points, is named twice, or is pushed by
            two; two laws have one name; the laws are asked too seldom, or not at the end;
            their points in all of the run are more than a recording keeps.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        rows: Sequence[Medium],
        seconds: float,
        others: "Sequence[tuple[str, frozenset[str]]] | None" = None,
        steps: int | None = None,
        every: int = 1,
    ) -> None:
        self.rows, self._seconds = tuple(rows), seconds
        bodies = names(model, "body", model.nbody)
        taken = {name: "another input" for kind, found in others or () if kind in PUSHES for name in found}
        for index, row in enumerate(rows):
            if row.name in {other.name for other in rows[:index]}:
                cause = f"two laws are called {row.name}, and the forces of one would be lost"
                raise ProgramError(cause, "interventions", "write one row of each law, with all its bodies")
            for place, body in enumerate(row.bodies):
                if body in row.bodies[:place]:
                    cause = f"the law {row.name} names its body {body!r} twice, and the forces of one would be lost"
                    raise ProgramError(cause, "interventions", "name each body once")
                if body not in bodies[1:]:
                    cause = f"the law {row.name} acts on {body!r}, which is not in the world"
                    raise ProgramError(cause, "interventions", f"name some of: {', '.join(bodies[1:])}")
                if body in taken:
                    cause = f"{body!r} would be pushed by the law {row.name} and by {taken[body]}"
                    move = "let one of them push it: of two forces on one body, nobody could tell whose work is whose"
                    raise ProgramError(cause, "interventions", move)
            taken |= dict.fromkeys(row.bodies, f"the law {row.name}")
        self.places = [Place(model, row) for row in rows]
        self.counts = [place.count for place in self.places]
        if (total := sum(self.counts)) > MOST_POINTS:
            cause = f"the laws move {total} points, more than {MOST_POINTS}"
            raise ProgramError(cause, "interventions", f"make each larger: {MOST_POINTS} points in all")
        rate = min(MOST_HZ, max(LEAST_HZ, POINTS_A_SECOND / max(1, total)))
        self.every = max(1, round(1.0 / (rate * seconds)))
        """So many questions lie between two that take the points."""
        self.end = self._end(steps, every)
        """The number of the question at the end of the run, which only takes the points; None where there is none."""
        if self.end is not None:
            size = total * (-(-self.end // self.every) + 1) * POINT_BYTES
            if size > MOST_BYTES:
                cause = f"{total} points of the laws in {self.end * seconds:g} s are {size >> 20} MiB, more than {MOST_BYTES >> 20} are kept"
                raise ProgramError(cause, "interventions", OF_POINTS)
        self.alone = False
        """Whether the author's process asks its laws and not its `control`, as in a world without that."""

    def _end(self, steps: int | None, every: int) -> int | None:
        if self._seconds > (1.0 + 1e-9) / LEAST_HZ:  # between two questions nobody sees what a law does
            cause = f"the law {self.rows[0].name} is asked every {self._seconds:g} s, and its sums are due {LEAST_HZ:g} times a second"
            raise ProgramError(
                cause, "program.main", f"make control_every times the time step {1 / LEAST_HZ:g} s at most"
            )
        if steps is not None and steps % every:
            cause = f"the run has {steps} steps, and the law {self.rows[0].name} is asked every {every}: its last ends after it"
            raise ProgramError(cause, "program.main", "let control_every divide the number of steps")
        return None if steps is None else steps // every

    def due(self, question: int) -> bool:
        """Whether the points are taken at this question."""
        return question % self.every == 0 or question == self.end

    @property
    def width(self) -> int:
        """How many numbers the laws tell beside an answer."""
        return sum(TOTALS + EACH * count for count in self.counts)

    def as_meta(self) -> dict[str, Any]:
        """The media for the author's process: see `worldkit.laws.Stepped`."""
        rows = [
            {"name": row.name, "bodies": list(row.named), "shown_by": row.shown_by, "file": row.file, "points": count}
            for row, count in zip(self.rows, self.counts, strict=True)
        ]
        told = {"rows": rows, "seconds": self._seconds, "every": self.every, "end": self.end}
        return {**told, "alone": True} if self.alone else told

    def read(self, at: int) -> "np.ndarray":
        """(width,) the numbers at this address, checked.

        Raises:
            PeerError: one is not finite, or too large.
        """
        import numpy as np

        numbers = words(at, self.width).copy()
        for row, (_, points, colours) in zip(self.rows, self.parts(numbers), strict=True):
            if not float(np.abs(points).max(initial=0.0)) < HUGE:
                raise PeerError(f"the law {row.name} sends points that are no places", "control", "send numbers")
            if point_colours.wrong(colours).any():
                raise PeerError(f"the law {row.name} sends colours that are none", "control", "send 24 bits, or -1")
        if not np.isfinite(numbers).all():
            raise PeerError("a law sends sums that are not finite", "control", "send numbers")
        return numbers

    def parts(self, numbers: "np.ndarray") -> "list[tuple[np.ndarray, np.ndarray, np.ndarray]]":
        """((TOTALS,) sums, (n, 3) points, m, (n,) colours, each one number) of each medium."""
        import numpy as np

        found, at = [], 0
        for count in self.counts:
            sums, places, colours = np.split(numbers[at : at + TOTALS + EACH * count], (TOTALS, TOTALS + 3 * count))
            found.append((sums, places.reshape(-1, 3), colours))
            at += TOTALS + EACH * count
        return found

    def keep(self, recorder: "Recorder", step: int, numbers: "np.ndarray") -> None:
        """Record the numbers told at a step."""
        recorder.later("media", lambda: self._points(step, numbers))
        recorder.later("balances", lambda: self._sums(step, numbers))

    def _points(self, step: int, numbers: "np.ndarray") -> dict[str, Any]:
        import numpy as np

        return {
            "step": np.full(sum(self.counts), step, np.int32),
            "medium": np.repeat(np.arange(len(self.counts), dtype=np.int32), self.counts),
            "point": np.concatenate([np.arange(count, dtype=np.int32) for count in self.counts]),
            "place": np.concatenate([points for _, points, _ in self.parts(numbers)]).astype(np.float32),
            "colour": np.concatenate([colours for _, _, colours in self.parts(numbers)]).astype(np.int32),
        }

    def _sums(self, step: int, numbers: "np.ndarray") -> dict[str, Any]:
        import numpy as np

        sums = np.array([totals for totals, _, _ in self.parts(numbers)])
        columns = {"mass": sums[:, 0], "momentum": sums[:, 1:4], "energy": sums[:, 4], "weight": sums[:, 5]}
        columns |= {"stored": sums[:, 6], "volume": sums[:, 7], "held": sums[:, 8:11]}
        count = len(self.counts)
        steps, which = np.full(count, step, np.int32), np.arange(count, dtype=np.int32)
        return {"step": steps, "medium": which, **columns}


class Place:
    """What shows one medium in a world: the points of a flex, or the geoms of a body, in their order.

    Raises:
        ProgramError: there is neither of this name, or the engine simulates it.
    """

    def __init__(self, model: "mujoco.MjModel", row: Medium) -> None:
        import numpy as np

        flexes, bodies = names(model, "flex", model.nflex), names(model, "body", model.nbody)
        self._colours = point_colours.of(model)
        if row.shown_by in flexes:
            flex = flexes.index(row.shown_by)
            first, self.count = int(model.flex_vertadr[flex]), int(model.flex_vertnum[flex])
            self._array, self._tinted, self._at = (
                "flexvert_xpos",
                self._colours.flex,
                np.arange(first, first + self.count),
            )
            owners = model.flex_vertbodyid[first : first + self.count]
            solid = bool(model.flex_contype[flex] or model.flex_conaffinity[flex])
        elif row.shown_by in bodies[1:]:
            body = bodies.index(row.shown_by)
            self._array, self._tinted = "geom_xpos", self._colours.geom
            self._at = np.flatnonzero(model.geom_bodyid == body)
            self.count, owners = len(self._at), np.array([body])
            solid = bool((model.geom_contype[self._at] | model.geom_conaffinity[self._at]).any())
        else:
            known = ", ".join([*flexes, *bodies[1:]]) or "(none)"
            cause = f"the law {row.name} is shown by {row.shown_by!r}, which is no flex and no body of the world"
            raise ProgramError(cause, "interventions", f"name one of: {known}")
        if solid or bool((model.body_weldid[owners] != 0).any()) or not self.count:
            what = "collides" if solid else "moves" if self.count else "has no geoms"
            cause = f"{row.shown_by}, which shows the law {row.name}, {what}"
            raise ProgramError(
                cause, "interventions", "give it contype=0, conaffinity=0, no joints, and a point for each"
            )

    def places(self, data: "mujoco.MjData") -> "np.ndarray":
        """(n, 3) m: where what is drawn lies, in data whose kinematics are done."""
        return getattr(data, self._array)[self._at]

    def show(self, data: "mujoco.MjData", points: "np.ndarray", colours: "np.ndarray | None" = None) -> None:
        """Lay what is drawn at the points (n, 3), m, in data whose kinematics are done; colours (n, 3) sRGB, or None."""
        getattr(data, self._array)[self._at] = points
        self.colour(PLAIN if colours is None else colours)

    def colour(self, colours: "np.ndarray | float") -> None:
        """Give what is drawn colours (n, 3), sRGB, or `PLAIN`."""
        self._tinted[self._at] = colours
