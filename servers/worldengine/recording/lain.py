"""Lay what shows an author's laws where its points lay: between two recorded instants on the straight way from one to the next."""

from typing import TYPE_CHECKING

from worldkit.errors import ProgramError, RecordingError
from worldkit.laws import PLAIN

from . import point_colours
from .long_table import OneMedium

if TYPE_CHECKING:
    from collections.abc import Callable

    import mujoco
    import numpy as np

    from .stored import Recording


class Lain:
    """The media of a recording, ready to be drawn in a world.

    Args:
        model: the world, dressed or not.
        recording: with an author's law.

    Raises:
        RecordingError: the world has nothing that shows a law, or the recording not the points that it shows.
    """

    def __init__(self, model: "mujoco.MjModel", recording: "Recording") -> None:
        from ..inputs.declared_media import Place
        from ..inputs.told_laws import moved

        rows = moved(recording.meta, str(recording.folder))
        try:
            self._places = [Place(model, row) for row in rows]
        except ProgramError as error:
            raise RecordingError(error.cause, str(recording.folder), "draw it with the world that it is of") from error
        self.times: list[np.ndarray] = []
        """Of each medium (F,) s: when its points lay there; what a solver moves has instants of its own."""
        self.media: list[OneMedium] = []
        """Where they lay then; what is not shown stays packed in its file."""
        for number, (row, place) in enumerate(zip(rows, self._places, strict=True)):
            lay = OneMedium(recording.folder / "media.arrows", number, place.count)
            steps = lay.steps  # a torn recording ends within an instant
            if not len(lay) or (lay.rows != place.count * len(steps) and recording.complete):
                cause = f"the recording has {lay.rows} places of the law {row.name}, {place.count} points at {len(steps)} instants"
                raise RecordingError(cause, str(recording.folder), "run the physics pass again")
            self.times.append(steps[: len(lay)] * recording.time_step)
            self.media.append(lay)
            # Who draws it asks first whether there are some.
            place.colour(point_colours.shares(lay.colours(0)) if lay.coloured else PLAIN)

    def show(self, data: "mujoco.MjData") -> None:
        """Lay them as they were at the data's time."""
        at = float(data.time)
        for place, times, lay in zip(self._places, self.times, self.media, strict=True):
            place.show(data, between(times, lay.places, at), mixed(times, lay.colours, at) if lay.coloured else None)


def between(times: "np.ndarray", points: "Callable[[int], np.ndarray]", at: float) -> "np.ndarray":
    """(n, 3) m: the points at an instant, s, from those (n, 3) at each of the times (F,); the first before, the last after."""
    import numpy as np

    before, after, share = _around(times, at)
    return np.asarray(points(before) * (1.0 - share) + points(after) * share)


def mixed(times: "np.ndarray", colours: "Callable[[int], np.ndarray]", at: float) -> "np.ndarray":
    """(n, 3) sRGB at an instant, s, from the numbers (n,) at each of the times (F,): where one of the two around it is none, the earlier."""
    import numpy as np

    before, after, share = _around(times, at)
    first, second = (point_colours.shares(colours(n)) for n in (before, after))
    whole = (first >= 0) & (second >= 0)
    return np.where(whole, first * (1.0 - share) + second * share, second if share == 1.0 else first)


def _around(times: "np.ndarray", at: float) -> tuple[int, int, float]:
    """The instants before and after one, and how far it is on the way."""
    import numpy as np

    if len(times) == 1:
        return 0, 0, 0.0
    after = int(np.clip(np.searchsorted(times, at), 1, len(times) - 1))
    return after - 1, after, float(np.clip((at - times[after - 1]) / (times[after] - times[after - 1]), 0.0, 1.0))
