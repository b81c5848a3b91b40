"""`PatternedLight`: a pattern of shadow that a film holds before its key light."""

from typing import Any

import numpy as np

from ..errors import ProgramError
from .drawn_only import Vec3
from .film_bounds import FAR_M, GOBO_M, GOBOS
from .plain_refusals import whole
from .recorded import Recorded
from .weather import Weather

_OF_ACTION = {"leaves": 0.4, "branches": 0.6}
"""The size of a pattern as a share of that of the action, where it is not all of it."""


class PatternedLight(Weather):
    """The light of a film of `recorded`, with what is held before it."""

    def __init__(self, recorded: Recorded) -> None:
        super().__init__()
        self.recorded = recorded
        self._gobo: dict[str, Any] | None = None

    def gobo(
        self,
        kind: str = "window",
        *,
        size: float | None = None,
        at: Vec3 | None = None,
        turn_deg: float = 0.0,
        softness_deg: float = 1.2,
        seed: int = 1,
    ) -> None:
        """Hold a pattern before the key light, whose shadow falls on everything: `window`, `blinds`, `leaves`, `branches`, `bars`.

        With `none` it is taken away, as from a set in whose window the sun stands.

        The pattern is drawn only and never seen itself. Its middle, a pane's, lies on the light's way to `at` (m), and `size` is
        about a pane's width, m: without them the action fills it. It is turned by `turn_deg`, and `softness_deg` is the light's
        from now on, as hard light shows it best. A light from the side, 25 to 45 degrees high, throws it far over a wall.

        Raises:
            ProgramError: there is no such pattern, or a number is none that it may have.
        """
        if kind == "none":
            self._gobo = None
            return
        if kind not in GOBOS:
            raise ProgramError(f"there is no gobo {kind!r}", "film.py", f"use one of: {', '.join(GOBOS)}")
        low, high = self._action()
        middle = tuple((0.5 * (low + high)).tolist()) if at is None else tuple(map(float, at))
        fills = _OF_ACTION.get(kind, 1.0) * max(float(np.hypot(*(high - low)[:2])), float(high[2] - low[2]))
        wide = float(np.clip(fills, *GOBO_M)) if size is None else float(size)
        turn, number = float(turn_deg), whole(seed)
        if not (GOBO_M[0] <= wide <= GOBO_M[1] and len(middle) == 3 and (np.abs([turn, *middle]) <= FAR_M).all()):
            raise ProgramError(
                f"a gobo has a size of {GOBO_M[0]:g} to {GOBO_M[1]:g} m, a point (x, y, z) that its light falls on, and a turn, "
                f"not {wide:g} m, {middle} and {turn:g} degrees",
                "film.py",
                "film.gobo('window', size=0.6)",
            )
        if number >= 1 << 32:
            raise ProgramError(f"the seed of a gobo lies below {1 << 32}, got {number}", "film.py", "seed=1")
        self.light(softness_deg=softness_deg)
        self._gobo = {
            "kind": kind, "size_m": wide, "at": list(middle), "turn_deg": turn, "seed": number
        }  # fmt: skip

    def _action(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (3,), m, of the space that the movers cross, from the ground up."""
        names = self.recorded.movers or self.recorded.bodies
        times, own = np.linspace(0.0, self.recorded.duration, 60), self.recorded.radius(*names)
        every = np.concatenate([self.recorded.position(name, times) for name in names] or [np.zeros((1, 3))])
        low, high = every.min(axis=0) - own, every.max(axis=0) + own
        low[2] = min(low[2], self.recorded.floor_z)
        return low, high
