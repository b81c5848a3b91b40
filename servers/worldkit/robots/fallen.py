"""Who has fallen, and what its servos hold from then on: its home pose, in place of a policy that was never shown such a state.

FALLS = fallen.Falls(("t1_1", "t1_2"), GAITS["t1"])
able, held = FALLS(data)  # (N,), (N, J): not a number where the policy acts
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from .gaits import Gait

if TYPE_CHECKING:
    import mujoco
    import numpy as np

FALLEN_DEG = 45.0
"""Of tilt: beyond it no walking policy here has come back; one that walks leans by less than 15."""


class Falls:
    """Robots of one kind, and which of them have fallen; it starts anew where time goes back, as walkers do.

    `at` says since when each lies, s; not a number of those on their feet.
    """

    def __init__(self, names: Sequence[str], gait: Gait) -> None:
        import numpy as np

        self.names, self.gait = tuple(names), gait
        self.at = np.full(len(self.names), np.nan)
        self._time = float("inf")

    @property
    def count(self) -> int:
        """How many lie."""
        import numpy as np

        return int(np.isfinite(self.at).sum())

    def __call__(self, data: "mujoco.MjData") -> "tuple[np.ndarray, np.ndarray]":
        """(N,) who is on its feet, and (N, J) rad, what the servos of the others hold; not a number where the policy acts.

        Args:
            data: the state, up to date.

        Raises:
            KeyError: there is no body of a name.
        """
        import numpy as np

        if data.time < self._time:
            self.at[:] = np.nan
        self._time = float(data.time)
        lies = np.array([upright(data, name) < np.cos(np.radians(FALLEN_DEG)) for name in self.names])
        self.at = np.where(np.isnan(self.at) & lies, self._time, self.at)
        able = np.isnan(self.at)
        return able, np.where(able[:, None], np.nan, np.asarray(self.gait.home))


def upright(data: "mujoco.MjData", name: str) -> float:
    """The cosine of the tilt of a robot's root body, whose own Z axis points up where it stands."""
    return float(data.body(name).xmat[8])
