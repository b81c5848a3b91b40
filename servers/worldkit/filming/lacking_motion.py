"""What a film's failure on a world that stands still says of the film: nothing, where another motion might not have it."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from ..errors import ProgramError, WorldkitError
from .plain_refusals import NoTimeError

AUTHORS = (NameError, AttributeError, TypeError, ImportError, SyntaxError)
"""No motion mends these."""
DRIFT_M, TOUCH_N = 0.3, 10.0


class NeedsRecordingError(WorldkitError):
    """A film failed on a world that stands still, and may do without fault on a recording."""

    code = "needs_recording"


def may_hold(error: BaseException, told: Callable[[Any], Any] | None, arrays: Mapping[str, np.ndarray]) -> bool:
    """Whether a film that failed with `error`, after it asked how things move, may be told of what really moves.

    What worldkit refuses (a name, a limit, a number that is none) is asked again of a world where everything moves and touches:
    refused there in the same words, it is refused of any. A moment that is looked for and never comes, in a film that reckons until
    when it lasts, is found in no made-up world.
    """
    from .director import Film
    from .recorded import Recorded

    if isinstance(error, AUTHORS) or not isinstance(error, Exception) or told is None:
        return False
    if isinstance(error, NoTimeError) or not isinstance(error, ProgramError):
        return True
    try:
        film = Film(Recorded(stirred(arrays)))
        film.recorded.unmoved = True
        told(film)
        film.description()
    except Exception as again:  # author code may raise anything
        return str(again) != str(error)
    return True


def stirred(arrays: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The same recording with each body on a way of its own, and each touching the next and the world half-way through."""
    found = dict(arrays)
    time, bodies = np.asarray(arrays["time"]), len(arrays["bodies"])
    share = time / max(float(time[-1]), 1e-9)
    number = np.arange(bodies)
    ways = DRIFT_M * np.stack([np.cos(number), np.sin(number), 0.3 + 0 * number], axis=-1)
    found["pos"] = np.asarray(arrays["pos"]) + (share**2)[:, None, None] * ways
    for name in [name for name in arrays if name.startswith("law") and not name.startswith("law_")]:
        if name.endswith("_points"):
            drift = np.linspace(0.0, DRIFT_M, len(arrays[name]))[:, None, None]
            found[name] = arrays[name] + drift
        elif not name.endswith(("_time", "_at")):
            found[name] = np.linspace(1.0, 2.0, len(arrays[name]))
    pairs = np.array([*((n, n + 1) for n in range(bodies - 1)), *((n, -1) for n in range(bodies))], int).reshape(-1, 2)
    found["touch_time"] = np.full(len(pairs), float(time[len(time) // 2]))
    found["touch_a"], found["touch_b"] = pairs.T
    found["touch_force"] = np.full(len(pairs), TOUCH_N)
    return found
