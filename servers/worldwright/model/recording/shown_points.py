"""Where the points of a medium lay: what an author's law moves, or a solver of the suite, by the name of what shows it."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from worldengine.recording import point_colours

from ..errors import NotFoundError
from . import laws_told

Array = np.ndarray


@dataclass(frozen=True)
class Lay:
    """The points of one medium at F recorded instants, world frame."""

    t: Array
    """(F,) s."""
    flat: Array
    """(F n, 3) m: instant after instant; memory-mapped where the recording has no other medium."""
    hues: Array | None = None
    """(F n,) colours as one number each (`point_colours`), where its law tells some."""

    def at(self, time_s: float) -> Array:
        """(n, 3) m at the last recorded instant up to a time; at the first where that is earlier."""
        return np.asarray(self.flat[self._instant(time_s)], dtype=float)

    def coloured(self, time_s: float) -> Array | None:
        """(n, 3) sRGB from 0 to 1 at that instant; None where a point has no colour."""
        if self.hues is None:
            return None
        told = np.asarray(self.hues[self._instant(time_s)])
        return None if (told < 0).any() else point_colours.shares(told)

    def _instant(self, time_s: float) -> slice:
        count = len(self.flat) // len(self.t)
        one = max(0, int(np.searchsorted(self.t, time_s + 1e-9, side="right")) - 1)
        return slice(one * count, (one + 1) * count)


@dataclass(frozen=True)
class ShownPoints:
    """The media of one recording, each read when it is asked for."""

    known: Mapping[str, Lay] = field(default_factory=dict)
    """Those that are there already; else they come out of the recording."""
    recording: Any = None
    _read: dict[str, Lay] = field(default_factory=dict, repr=False, compare=False)

    @property
    def names(self) -> tuple[str, ...]:
        """What shows each medium; errors as of `of`."""
        told = () if self.recording is None else laws_told.shown(self.recording.meta, str(self.recording.folder))
        return (*self.known, *told)

    def of(self, name: str) -> Lay:
        """The points that a flex, a body of grains or a skin shows.

        Raises:
            NotFoundError: no medium is shown by this name.
            RecordingError: what the recording says of its media makes no sense.
        """
        if name in self.known:
            return self.known[name]
        if name not in self._read:
            self._read[name] = self._of_recording(name)
        return self._read[name]

    def _of_recording(self, name: str) -> Lay:
        shown = self.names[len(self.known) :]
        if name not in shown:
            known = ", ".join(self.names) or "(none: no law ran)"
            raise NotFoundError(
                f"nothing called '{name}' shows the points of a law", next_move=f"name what shows one: {known}"
            )
        media = self.recording.media
        mine = np.asarray(media.medium) == shown.index(name)
        steps, places = np.asarray(media.step)[mine], media.place if mine.all() else media.place[mine]
        instants, counts = np.unique(steps, return_counts=True)
        whole = int((counts == counts.max(initial=0)).sum())  # a torn recording ends within an instant
        if not whole:
            raise NotFoundError(f"no point of '{name}' was recorded", next_move="run the physics pass again")
        last = whole * int(counts.max())
        hues = np.asarray(media.colour)[mine][:last] if "colour" in media.columns else None
        return Lay(instants[:whole] * float(self.recording.time_step), places[:last], hues)
