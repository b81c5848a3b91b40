"""An author's own law: matter that the engine does not know (rubber, drops, paint), stepped beside it in the program's process.

A law is an object in a file beside the program (`laws/rubber.py`). It keeps points with masses, exchanges forces with bodies, and
advances itself by the time from one question to the next. Its forces cross to the engine as inputs of the bodies it names; its
points and sums cross with them, are recorded as a medium of its name, and move what it is shown by: the points of a flex, or
the geoms of one body, in their order.

Of the sums, momentum, energy of motion and energy by weight are computed here, from masses, points and velocities as the law tells
them; what is stored, its volume, and what it gives to the world are the law's word. Velocities are held to the way that the points go
(`told_motion`). It runs in the author's process: the sums catch a mistake, and a cheat only where it does not make up points to match.
What bodies were given is the engine's own record.
"""

import inspect
import sys
import traceback
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from .errors import ProgramError, WorldkitError
from .mirror import words
from .naming import names
from .told_motion import ToldMotion

if TYPE_CHECKING:
    import mujoco
    import numpy as np

_T = TypeVar("_T")

WORLD = "world"
"""As a body of a law, which the plan's row names too: what stands fast. What pushes it is summed, and goes nowhere."""
TOTALS = 11
"""Numbers before the points: mass, momentum (3), energy, of that by weight and stored, volume, impulse taken by the world (3)."""
EACH = 4
"""Numbers of a point, after them: all places (3), and then all colours, each as one number (`one_number`)."""
HUGE = 1e6
"""A point or force beyond it, m or N, is a blow-up."""


PLAIN = -1.0
"""In place of a colour: that of what shows the law is drawn."""


class Law(Protocol):
    """The protocol of a law; n points, k bodies, everything in the world frame.

    It may have `volume() -> float`, m^3, too, where its matter keeps one, and `colours`, (n, 3) sRGB from 0 to 1, which are drawn in
    place of the colour of what shows it. Where it steps more finely than it is asked, the force
    that it returns is the mean one.
    """

    name: str
    """Of the medium, which is the name of its file: `rubber` of `laws/rubber.py`."""
    bodies: Sequence[str]
    """Those that it pushes and is pushed by; `world` for what is fixed to nothing."""
    shown_by: str
    """The flex, or the body with geoms, whose points it moves: n of them. Nothing of it is simulated by the engine."""
    mass: "np.ndarray"
    """(n,) kg, of the points."""
    points: "np.ndarray"
    """(n, 3) m."""
    velocities: "np.ndarray"
    """(n, 3) m/s, with which the points go."""

    def start(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Take the initial state of the world and make that of the points."""

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData", seconds: float) -> "np.ndarray":
        """Advance the points by `seconds`, with the bodies as `data` shows them.

        Returns:
            (k, 3) force, N, or (k, 6) force and torque, N m, on each body at its centre of mass, held for `seconds`. What pushes
            a body pushes the points back.
        """

    def energy(self) -> float:
        """What is stored in the points besides their motion and weight, J: stretch, surface."""


def one_number(colours: "np.ndarray") -> "np.ndarray":
    """(n,) colours (n, 3), sRGB from 0 to 1, as whole numbers of 24 bits, red first."""
    import numpy as np

    return np.asarray(np.rint(np.clip(colours, 0.0, 1.0) * 255.0) @ (65536.0, 256.0, 1.0))


def check(laws: Any) -> tuple[Law, ...]:
    """The laws of a program, each with what the protocol names, and each name once.

    Raises:
        ProgramError: one lacks something, or two have one name.
    """
    found = tuple(laws) if isinstance(laws, list | tuple) else (laws,)
    for law in found:
        lacking = [word for word in ("name", "bodies", "shown_by", "start", "step", "energy") if not hasattr(law, word)]
        if lacking or isinstance(law, type):
            what = "is a class: give an object of it" if isinstance(law, type) else f"has no {', no '.join(lacking)}"
            raise ProgramError(
                f"the law {law!r:.60} {what}", "program.main", "see worldkit.laws.Law for what a law has"
            )
        if isinstance(law.bodies, str):
            raise ProgramError(
                f"the bodies of the law {law.name} are a text", "program.main", f'write bodies = ("{law.bodies}",)'
            )
        if twice := [body for body in law.bodies if [*law.bodies].count(body) > 1]:
            cause = f"the law {law.name} names its body {twice[0]} twice"
            raise ProgramError(cause, "program.main", "name it once, and sum what pushes it")
    if twice := [law.name for law in found if sum(other.name == law.name for other in found) > 1]:
        raise ProgramError(f"two laws are called {twice[0]}", "program.main", "give each a name of its own")
    return found


def rows(laws: Sequence[Law]) -> list[dict[str, Any]]:
    """The laws as `program.json` lists them: name, bodies, and what shows it."""
    return [
        {"name": str(law.name), "bodies": [str(body) for body in law.bodies], "shown_by": str(law.shown_by)}
        for law in laws
    ]  # fmt: skip


def _stands_in(law: Law, declared: str) -> None:
    """Refuse a law whose class stands in another file than the one beside the program that the plan declares; an empty one
    declares none.
    """
    if not declared:
        return
    folder = Path(getattr(sys.modules["__main__"], "__file__", None) or "program").resolve().parent
    try:
        found = Path(inspect.getfile(type(law))).resolve()
    except (TypeError, OSError):
        found = Path()
    if found != (folder / declared).resolve():
        where = found.relative_to(folder) if found.is_relative_to(folder) else found.name or "no file"
        cause = f"the law {law.name} stands in {where}, and the plan declares {declared}"
        raise ProgramError(cause, "program.main", "move its class into that file, and import it from there")


class Stepped:
    """The laws of a program at work, at the author's end.

    Args:
        laws: the program's.
        model: the author's own.
        declared: `media` of the engine's greeting: `rows` with the number of `points` of each, `seconds` from one question to the
            next, `every`: so many questions lie between two that take the points, and `end`: the number of that which only takes
            them, after the last step; None where there is none.
        at: address of the numbers for the engine: `TOTALS` and the points of each, one after another.

    Raises:
        ProgramError: the laws are not those that the plan declares.
    """

    def __init__(self, laws: Sequence[Law], model: "mujoco.MjModel", declared: Mapping[str, Any], at: int) -> None:
        import numpy as np

        known = {row["name"]: row for row in declared.get("rows", ())}
        if odd := sorted({law.name for law in laws} ^ set(known)):
            ours = odd[0] in {law.name for law in laws}
            cause = (
                "is not declared in the plan"
                if ours
                else "is declared in the plan, and the program has none of this name"
            )
            move = "write a row of `interventions` of the kind `solver`, with its `file` (skill media)"
            raise ProgramError(f"the law {odd[0]} {cause}", "program.main", move if ours else "give it in `laws=`")
        self._seconds, self._every = float(declared.get("seconds", 0.0)), int(declared.get("every", 1))
        self._asked, self._end, self._laws, pushed = 0, declared.get("end"), [], []
        bodies = names(model, "body", model.nbody)
        for law in sorted(laws, key=lambda law: list(known).index(law.name)):
            row = known[law.name]
            if {*law.bodies} != {*row["bodies"]} or law.shown_by != row["shown_by"]:
                says = f"{', '.join(law.bodies)}, shown by {law.shown_by}"
                plan = f"{', '.join(row['bodies'])}, shown by {row['shown_by']}"
                cause = f"the law {law.name} acts on {says}; the plan declares {plan}"
                move = "say the same in both, `world` too where the law pushes on it"
                raise ProgramError(cause, "program.main", move)
            _stands_in(law, row.get("file", ""))
            numbers = words(at, TOTALS + EACH * row["points"])
            at += 8 * len(numbers)
            told = numbers[TOTALS : TOTALS + 3 * row["points"]].reshape(-1, 3), numbers[TOTALS + 3 * row["points"] :]
            of = np.array([bodies.index(body) for body in law.bodies], np.intp)
            self._laws.append(
                (law, of, numbers[:TOTALS], told, np.zeros(3), ToldMotion(law.name, model.opt.gravity.tolist()))
            )
            pushed.append(of[of > 0])
        self._gravity = model.opt.gravity.copy()  # which nobody can write afterwards
        self._pushed = np.concatenate([np.zeros(0, np.intp), *pushed])
        self._wrench = np.zeros((len(self._pushed), 6))

    @property
    def ended(self) -> bool:
        """Whether the question that came last was that at the end, to which no answer acts."""
        return self._end is not None and self._asked > self._end

    def step(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Tell the points as they are, and advance each law; its forces wait for `push`. At the end only tell.

        Raises:
            ProgramError: a law raises, or returns what cannot be.
        """
        first = 0
        for law, bodies, totals, (points, colours), held, motion in self._laws:
            if not self._asked:
                self._of(law, data, "start", partial(law.start, model, data))
                self._looked(law, data, motion)
            if self._asked % self._every == 0 or self._asked == self._end:
                points[:], velocities, mass = self._told(law, len(points))
                colours[:] = self._coloured(law, data, len(points))
                self._sane(law, data)
                totals[:] = self._totals(law, data, points, velocities, mass, held)
            if self._asked == self._end:
                continue
            forces = self._of(law, data, "step", partial(law.step, model, data, self._seconds))
            wrench = self._checked(law, forces, len(bodies), data)
            held += self._seconds * wrench[bodies == 0, :3].sum(axis=0)
            loose = wrench[bodies > 0]
            self._wrench[first : first + len(loose)] = loose
            first += len(loose)
            self._sane(law, data)
            self._looked(law, data, motion)
        self._asked += 1

    def push(self, data: "mujoco.MjData") -> bool:
        """Write the forces of the last step into `data`; says whether others stood there."""
        other = bool((data.xfrc_applied[self._pushed] != self._wrench).any())
        data.xfrc_applied[self._pushed] = self._wrench
        return other

    def _of(self, law: Law, data: "mujoco.MjData", what: str, call: Callable[[], _T]) -> _T:
        """What a law's own code gives; what it raises names its file and line."""
        try:
            return call()
        except WorldkitError:
            raise
        except Exception as error:  # author code may raise anything
            frames = [f for f in traceback.extract_tb(error.__traceback__) if f.filename != __file__]
            own = [f for f in frames if Path(f.filename).stem == law.name] or frames
            place = f"{Path(own[-1].filename).name}:{own[-1].lineno}" if own else law.name
            said = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
            cause = f"{what} of the law {law.name} failed at t = {data.time:.4f} s: {said}"
            raise ProgramError(cause, place, "correct it there; what was recorded until then is kept") from error

    def _told(self, law: Law, count: int) -> "list[np.ndarray]":
        """Its points (n, 3), m, velocities (n, 3), m/s, and masses (n,), kg, as it has them now."""
        import numpy as np

        told = []
        for name, shape in (("points", (count, 3)), ("velocities", (count, 3)), ("mass", (count,))):
            try:
                found = np.asarray(getattr(law, name, ()), float)
            except (TypeError, ValueError) as error:
                cause = f"the law {law.name} has {name} that are no numbers: {error}"
                raise ProgramError(cause, law.name, f"make it an array of the shape {shape}") from error
            if found.shape != shape:
                cause = (
                    f"the law {law.name} has {name} of the shape {found.shape}, and {law.shown_by} shows {count} points"
                )
                raise ProgramError(cause, law.name, f"make it {shape}, or give {law.shown_by} as many points")
            told.append(found)
        return told

    def _coloured(self, law: Law, data: "mujoco.MjData", count: int) -> "np.ndarray | float":
        """(n,) its colours, each as one number; `PLAIN` where it has none."""
        import numpy as np

        given = getattr(law, "colours", None)
        if given is None:
            return PLAIN
        found = self._of(law, data, "colours", partial(np.asarray, given, float))
        if found.shape != (count, 3) or not float(np.abs(found - 0.5).max(initial=0.0)) <= 0.5 + 1e-6:
            cause = (
                f"the law {law.name} has colours of the shape {found.shape}, or beyond 0 to 1, at t = {data.time:.4f} s"
            )
            raise ProgramError(cause, law.name, f"give {law.shown_by} ({count}, 3) of sRGB from 0 to 1, or none")
        return one_number(found)

    def _sane(self, law: Law, data: "mujoco.MjData") -> None:
        """Refuse points that are no numbers, or far away; a sum finds them without looking at each."""
        import numpy as np

        def far() -> float:
            return float(np.abs(law.points).max(initial=0.0) + np.abs(law.velocities).max(initial=0.0))

        if not self._of(law, data, "points", far) < HUGE:
            cause = f"the points of the law {law.name} blew up at t = {data.time:.4f} s"
            raise ProgramError(cause, law.name, "step it more finely (several steps within one), soften it, or damp it")

    def _looked(self, law: Law, data: "mujoco.MjData", motion: ToldMotion) -> None:
        self._of(law, data, "points", partial(motion.look, law, self._seconds, data.time))

    def _checked(self, law: Law, forces: Any, count: int, data: "mujoco.MjData") -> "np.ndarray":
        """(k, 6) force and torque."""
        import numpy as np

        given = np.zeros(0) if forces is None else forces
        found = self._of(law, data, "step", partial(np.asarray, given, float))
        if found.shape not in ((count, 3), (count, 6)):
            cause = f"step of the law {law.name} returned forces of the shape {found.shape}"
            raise ProgramError(
                cause, law.name, f"return ({count}, 3), or ({count}, 6) with torques: one row for each body"
            )
        if not float(np.abs(found).max(initial=0.0)) < HUGE:
            cause = f"the law {law.name} pushes with what is no number, or beyond {HUGE:g} N, at t = {data.time:.4f} s"
            raise ProgramError(cause, law.name, "step it more finely (several steps within one), soften it, or damp it")
        return np.pad(found, ((0, 0), (0, 6 - found.shape[1])))

    def _totals(
        self,
        law: Law,
        data: "mujoco.MjData",
        points: "np.ndarray",
        velocities: "np.ndarray",
        mass: "np.ndarray",
        held: "np.ndarray",
    ) -> "list[float]":
        motion = 0.5 * float((mass[:, None] * velocities**2).sum())
        weight = -float((mass[:, None] * points).sum(axis=0) @ self._gravity)
        stored = float(self._of(law, data, "energy", law.energy))
        volume = float(self._of(law, data, "volume", getattr(law, "volume", float)))
        momentum = (mass[:, None] * velocities).sum(axis=0)
        return [float(mass.sum()), *momentum, motion + weight + stored, weight, stored, volume, *held]
