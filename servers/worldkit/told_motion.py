"""What an author's law tells of the speed of its points, held against the way that they go.

Momentum and energy of a law are summed from the velocities that it tells: told ones that its points do not have would balance any
sum. So
the way of its points is held against them: the way of their mean, question by question, to lie between the velocities before and
after, in each direction; and all that is gone, to be neither a twentieth of what is told nor twenty times as much. More cannot be asked of
a law that steps more finely than it is asked: what trembles within a question (a stiff cord) has any velocity at its end.

Points whose mass changes are of a grid through which matter flows (paint): of those the way of their centre of mass, across the
weight, is held against the momentum that is told, as long as nothing flows in or out, and they go no further than twice what is told
of them. Of one that has waited still since the start nothing is asked: it may begin elsewhere, once (what is poured).
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .errors import ProgramError

if TYPE_CHECKING:
    import numpy as np

WINDOW = 10
"""Questions over which ways are summed."""
SHARE, TIMES = 0.5, 20.0
"""The mean astray, of the way that is gone, or told where that is more, in the largest window until then; and told, of that gone."""
LEAST = 1e-5
"""m, the mean of all points in a window: less is no motion."""
LEAKS = 1e-3
"""The share of what flows through a grid that may come or go in a window; where more does, its centre of mass tells nothing."""


class ToldMotion:
    """The points of one law from one question to the next.

    Args:
        name: of the law.
        gravity: (3,) m/s^2, of the world.
    """

    def __init__(self, name: str, gravity: Sequence[float] = (0.0, 0.0, 0.0)) -> None:
        size = sum(g * g for g in gravity) ** 0.5
        self._down = [g / size if size else 0.0 for g in gravity]
        self._name, self._largest, self._largest_flow = name, 0.0, 0.0
        self._before: tuple[np.ndarray, ...] | None = None
        self._waits: np.ndarray | bool = True
        self._begin()

    def _begin(self) -> None:
        self._astray: np.ndarray | float = 0.0
        self._way = self._gone = self._said = 0.0
        self._flown_astray: np.ndarray | float = 0.0
        self._flow = self._flowed = self._flow_said = self._leaked = 0.0
        self._questions = 0

    def look(self, law: Any, seconds: float, time: float) -> None:
        """Take the points as they are after a question of so many `seconds`, at the `time` of the world, s; the first time only
        remember them.

        Raises:
            ProgramError: their velocities are not those with which they go.
        """
        import numpy as np

        try:
            now = tuple(np.array(value, float) for value in (law.points, law.velocities, law.mass))
        except (TypeError, ValueError):
            return  # no numbers: refused where they are told
        before, self._before = self._before, now
        if before is None or any(a.shape != b.shape for a, b in zip(before, now, strict=True)):
            return  # of a wrong shape: refused where it is told
        went = now[0] - before[0]
        waited = self._waits & ~before[1].any(axis=1)
        self._waits = waited & ~went.any(axis=1)
        weight = np.where((before[2] == now[2]) & (self._waits | ~waited), now[2], 0.0)
        self._sum(weight, went, seconds * before[1], seconds * now[1])
        if (grid := (before[2] != now[2]) & (self._waits | ~waited)).any():
            self._sum_flow(tuple(part[grid] for part in before), tuple(part[grid] for part in now), seconds)
        self._questions += 1
        if self._questions == WINDOW:
            self._judge(float(np.abs(now[2]).sum()), WINDOW * seconds, time)
            self._begin()

    def _sum(self, mass: "np.ndarray", went: "np.ndarray", old: "np.ndarray", new: "np.ndarray") -> None:
        import numpy as np

        low, high = np.minimum(old, new), np.maximum(old, new)
        gone, first, last = (np.sqrt((way**2).sum(axis=1)) for way in (went, old, new))
        self._astray = self._astray + mass @ (went - np.clip(went, low, high))
        self._way += float(mass @ np.maximum(gone, np.maximum(first, last)))
        self._gone += float(mass @ gone)
        self._said += float(mass @ (first + last)) / 2

    def _sum_flow(self, before: "tuple[np.ndarray, ...]", now: "tuple[np.ndarray, ...]", seconds: float) -> None:
        import numpy as np

        (was, old, some), (place, new, mass) = before, now
        middle = (some @ was) / max(float(some.sum()), 1e-300)
        went, ends = mass @ (place - middle), (seconds * (some @ old), seconds * (mass @ new))
        astray = went - np.clip(went, np.minimum(*ends), np.maximum(*ends))
        self._flown_astray = self._flown_astray + astray - (astray @ self._down) * np.array(self._down)
        self._flow += float(max(np.linalg.norm(way) for way in (went, *ends)))
        self._flowed += float(mass @ np.linalg.norm(place - was, axis=1))
        self._flow_said += seconds * float(some @ np.linalg.norm(old, axis=1) + mass @ np.linalg.norm(new, axis=1)) / 2
        self._leaked += abs(float(mass.sum() - some.sum())) / max(float(mass.sum()), 1e-300)

    def _judge(self, mass: float, seconds: float, time: float) -> None:
        import numpy as np

        self._largest = max(self._largest, self._way)
        astray, least = float(np.linalg.norm(self._astray)), LEAST * mass
        little, much = sorted((self._gone, self._said))
        lies = astray > max(SHARE * self._largest, least) or much > TIMES * max(little, least)
        self._largest_flow = max(self._largest_flow, self._flow)
        flown = float(np.linalg.norm(self._flown_astray)) if self._leaked <= LEAKS else 0.0
        flows = flown > max(SHARE * self._largest_flow, least) or self._flowed > 2 * self._flow_said + least
        if not (lies or flows) or mass <= 0.0:
            return
        gone, said = (self._gone, self._said) if lies else (self._flowed, self._flow_said)
        ways = f"they went {gone / mass:.3g} m in {seconds:.3g} s, their velocities say {said / mass:.3g} m"
        cause = f"the law {self._name} tells velocities that its points do not have: until t = {time:.4f} s {ways}"
        move = "tell those with which the points go, and ask more often what trembles: energy is summed from them"
        raise ProgramError(f"{cause}, each in the mean", self._name, move)
