"""Which moments of a world are worth a look: its setup, its event, its aftermath and one on the way, by motion energy.

The event is where the bodies' velocities change most, weighed by their masses: a blow, a break, a let-go. (Their energy
would not do: an elastic collision keeps it.) The aftermath is where the kinetic energy has calmed down for good (or the
end, when it never does). A recording says so exactly; where only a film is left (a fresh clone
keeps no recording), the change of its pictures stands in.
"""

from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

CALM = 0.05
"""Of the highest kinetic energy: below it, for good, things have calmed down."""
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
        """The four to show, in the order of their times: with `midway`, the middle of the longer of the two stretches before
        and after the event; what never calms down has an `end` instead of an `aftermath`."""
        midway = max(((self.setup, self.event), (self.event, self.aftermath)), key=lambda span: span[1] - span[0])
        last = "aftermath" if self.aftermath < self.end else "end"
        times = {"setup": self.setup, "midway": sum(midway) / 2, "event": self.event, last: self.aftermath}
        return dict(sorted(times.items(), key=lambda item: item[1]))


def of_recording(folder: Path) -> Moments:
    """From the kinetic energy of a recording (`trajectory/`)."""
    import numpy as np

    from worldkit import trajectory

    recording = trajectory.open(folder)
    t = recording.time[:]
    mass = np.array([body["mass"] for body in recording.meta["bodies"]])
    raster = _raster(t)
    rows = np.searchsorted(t, raster - 1e-9).clip(max=len(t) - 1)
    blow = np.linalg.norm(np.diff(recording.comvel[rows], axis=0), axis=2) @ mass
    return _choose(raster, recording.energy[rows, 1], blow, "recording")


def of_film(film: Path) -> Moments:
    """From how much the pictures of a film change; thumbnails are enough."""
    import av
    import numpy as np

    times, pictures = [], []
    with av.open(str(film)) as container:
        for frame in container.decode(video=0):
            times.append(float(frame.time or 0.0))
            pictures.append(frame.reformat(width=96, height=54, format="gray").to_ndarray().astype(np.float32))
    steps = [float(((b - a) ** 2).mean()) for a, b in pairwise(pictures)]
    change = np.array([*steps[:1], *steps])
    return _choose(np.array(times), change, np.abs(np.diff(change)), "film")


def _raster(t: "np.ndarray") -> "np.ndarray":
    """The film's own times, s: a blow shorter than a frame counts whole, a slow change in one step of many does not."""
    import numpy as np

    return np.arange(t[0], t[-1] + WINDOW_S / 2, WINDOW_S) if len(t) else np.zeros(0)


def _choose(t: "np.ndarray", energy: "np.ndarray", change: "np.ndarray", source: str) -> Moments:
    """From times (T,) s, an energy (T,) and how much changed between them (T - 1,), of any unit."""
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
