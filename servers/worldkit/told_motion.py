"""What an author's law tells of the speed of its points, held against the way that they go.

Momentum and energy of a law are summed from the velocities that it tells: told ones that its points do not have would balance any
sum. So
the way of its points is held against them: the way of their mean, question by question, to lie between the velocities before and
after, in each direction; and all that is gone, to be neither a twentieth of what is told nor twenty times as much. More cannot be asked of
a law that steps more finely than it is asked: what trembles within a question (a stiff cord) has any velocity at its end.

Of two kinds of points nothing is asked: those whose mass changes are of a grid through which matter flows (paint), and one that has
waited still since the start may begin elsewhere, once (what is poured).
"""

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


class ToldMotion:
    """The points of one law from one question to the next.

    Args:
        name: of the law.
    """

    def __init__(self, name: str) -> None:
        self._name, self._largest = name, 0.0
        self._before: tuple[np.ndarray, ...] | None = None
        self._waits: np.ndarray | bool = True
        self._begin()

    def _begin(self) -> None:
        self._astray: np.ndarray | float = 0.0
        self._way = self._gone = self._said = 0.0
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

    def _judge(self, mass: float, seconds: float, time: float) -> None:
        import numpy as np

        self._largest = max(self._largest, self._way)
        astray, least = float(np.linalg.norm(self._astray)), LEAST * mass
        little, much = sorted((self._gone, self._said))
        lies = astray > max(SHARE * self._largest, least) or much > TIMES * max(little, least)
        if not lies or mass <= 0.0:
            return
        ways = f"they went {self._gone / mass:.3g} m in {seconds:.3g} s, their velocities say {self._said / mass:.3g} m"
        cause = f"the law {self._name} tells velocities that its points do not have: until t = {time:.4f} s {ways}"
        move = "tell those with which the points go, and ask more often what trembles: energy is summed from them"
        raise ProgramError(f"{cause}, each in the mean", self._name, move)
