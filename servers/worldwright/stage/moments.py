"""Choose the moments of a world that are worth a look: setup, event, aftermath and one on the way, by motion energy.

The event is where the bodies' velocities change most, weighed by their masses: a blow, a break, a release. (Energy would
not do, as an elastic collision keeps it.) The aftermath is where the kinetic energy, that of a law's points too, has
calmed down for good (or the end, if it never does). A recording tells this exactly; where only a film is left (a fresh clone keeps no recording), the change
of its pictures stands in.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

from ..model import mp4_file

if TYPE_CHECKING:
    import numpy as np

    from worldengine.recording.stored import Recording

CALM = 0.05
"""A world has calmed down when its kinetic energy stays below this share of the highest."""
WINDOW_S = 1 / 24


@dataclass(frozen=True)
class Moments:
    """Times in seconds."""

    setup: float
    event: float
    aftermath: float
    end: float
    source: str
    """`recording` or `film`."""

    def named(self) -> dict[str, float]:
        """The four moments to show, s, in the order of time. `midway` is the middle of the longer of the two stretches
        before and
        after the event; a world that never calms down has an `end` in place of an `aftermath`."""
        midway = max(((self.setup, self.event), (self.event, self.aftermath)), key=lambda span: span[1] - span[0])
        last = "aftermath" if self.aftermath < self.end else "end"
        times = {"setup": self.setup, "midway": sum(midway) / 2, "event": self.event, last: self.aftermath}
        return dict(sorted(times.items(), key=lambda item: item[1]))


OF_THE_EVENT = 3


def storyboard(found: Moments, claimed: Sequence[tuple[float, str]]) -> list[tuple[float, str]]:
    """At most five moments, ascending, each with a word: the setup, three of the event, the aftermath.

    Those of the event are where the motion changes most, and the claimed moments that are farthest from what is shown
    already;
    if too few are claimed, the middle of the way to the event, and of the way from it.

    Args:
        found: the moments by motion energy.
        claimed: (instant in s, name) of the objectives that came true.
    """
    last = "aftermath" if found.aftermath < found.end else "end"
    shown = {found.setup: "setup", found.aftermath: last, found.event: "event"}
    halves = [((found.setup + found.event) / 2, ""), ((found.event + found.aftermath) / 2, "")]
    apart = (found.aftermath - found.setup) / 20
    for moments in (claimed, halves):
        while moments and len(shown) < 2 + OF_THE_EVENT:
            gap, at, word = max((min(abs(at - other) for other in shown), at, word) for at, word in moments)
            if gap <= apart:
                break
            shown[at] = word
    return sorted(shown.items())


def of_recording(folder: Path) -> Moments:
    """Choose moments by the kinetic energy of a recording (`trajectory/`)."""
    import numpy as np

    from worldengine.recording import stored

    recording = stored.open(folder)
    t = recording.time[:]
    mass = np.array([body["mass"] for body in recording.meta["bodies"]])
    raster = _raster(t)
    rows = np.searchsorted(t, raster - 1e-9).clip(max=len(t) - 1)
    blow = np.linalg.norm(np.diff(recording.comvel[rows], axis=0), axis=2) @ mass
    return _choose(raster, recording.energy[rows, 1] + _of_media(recording, raster), blow, "recording")


def _of_media(recording: "Recording", times: "np.ndarray") -> "np.ndarray":
    """(T,) J: the energy of motion of what laws move; a honey that still runs has not calmed down, however still its jar stands."""
    import numpy as np

    sums, found = recording.balances, np.zeros(len(times))
    for medium in np.unique(sums.medium) if len(sums) else ():
        mine = np.asarray(sums.medium) == medium
        moves = np.asarray(sums.energy - sums.weight - sums.stored)[mine]
        found += np.interp(times, np.asarray(sums.step)[mine] * recording.time_step, np.maximum(moves, 0.0))
    return found


def of_film(film: Path) -> Moments:
    """Choose moments by how much the pictures of a film change; thumbnails are enough."""
    import numpy as np

    times, pictures = [], []
    with mp4_file.opened(film) as container:
        for frame in container.decode(video=0):
            times.append(float(frame.time or 0.0))
            pictures.append(frame.reformat(width=96, height=54, format="gray").to_ndarray().astype(np.float32))
    steps = [float(((b - a) ** 2).mean()) for a, b in pairwise(pictures)]
    change = np.array([*steps[:1], *steps])
    return _choose(np.array(times), change, np.abs(np.diff(change)), "film")


def _raster(t: "np.ndarray") -> "np.ndarray":
    """The times of a film's frames, s: a blow shorter than a frame counts whole, one step of a slow change does not."""
    import numpy as np

    return np.arange(t[0], t[-1] + WINDOW_S / 2, WINDOW_S) if len(t) else np.zeros(0)


def _choose(t: "np.ndarray", energy: "np.ndarray", change: "np.ndarray", source: str) -> Moments:
    """Choose moments by times (T,) s, an energy (T,) and the change from each time to the next (T - 1,), in any unit."""
    import numpy as np

    usable = len(t) >= 3 and np.isfinite(energy).all() and np.isfinite(change).all() and change.max() > 0
    if not usable:
        last = float(t[-1]) if len(t) else 0.0
        return Moments(0.0, last / 2, last, last, source)
    event = int(change.argmax()) + 1
    restless = np.flatnonzero(energy > CALM * energy.max())
    aftermath = int(restless[-1]) + 1 if len(restless) else 0
    if aftermath <= event or aftermath >= len(t):
        aftermath = len(t) - 1
    return Moments(float(t[0]), float(t[event]), float(t[aftermath]), float(t[-1]), source)
