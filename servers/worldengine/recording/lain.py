"""Lay what shows an author's laws where its points lay: between two recorded instants on the straight way from one to the next."""

from collections.abc import Callable
from typing import TYPE_CHECKING

from worldkit.errors import ProgramError, RecordingError

from . import point_colours

if TYPE_CHECKING:
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
        import numpy as np

        from ..inputs.declared_media import Place
        from ..inputs.told_laws import moved

        rows, media = moved(recording.meta, str(recording.folder)), recording.media
        try:
            self._places = [Place(model, row) for row in rows]
        except ProgramError as error:
            raise RecordingError(error.cause, str(recording.folder), "draw it with the world that it is of") from error
        step, medium = np.asarray(media.step), np.asarray(media.medium)
        steps = np.unique(step)
        self.times = steps * recording.time_step
        """(F,) s: when they lay there."""
        self.points: list[np.ndarray] = []
        """Of each medium (F, n, 3) m."""
        self.colours: list[np.ndarray | None] = []
        """Of each medium (F, n), each as one number; None where it has none."""
        for number, (row, place) in enumerate(zip(rows, self._places, strict=True)):
            mine = np.asarray(media.place)[medium == number]
            whole = len(mine) // max(1, place.count)  # a torn recording ends within an instant
            if not whole or (len(mine) != place.count * len(steps) and recording.complete):
                cause = f"the recording has {len(mine)} places of the law {row.name}, {place.count} points at {len(steps)} instants"
                raise RecordingError(cause, str(recording.folder), "run the physics pass again")
            self.points.append(mine[: whole * place.count].reshape(whole, place.count, 3))
            told = np.asarray(media.colour)[medium == number] if "colour" in media.columns else np.empty(0)
            own = told[: whole * place.count]
            self.colours.append(own.reshape(whole, -1) if len(own) and own.max() >= 0 else None)
            if len(own):
                place.colour(point_colours.shares(own[: place.count]))  # who draws it asks first whether there are some

    def show(self, data: "mujoco.MjData") -> None:
        """Lay them as they were at the data's time."""
        for place, points, colours in zip(self._places, self.points, self.colours, strict=True):
            times, at = self.times[: len(points)], float(data.time)
            shown = None if colours is None else between(times, colours, at, point_colours.shares)
            place.show(data, between(times, points, at), shown)


def between(
    times: "np.ndarray", points: "np.ndarray", at: float, read: "Callable[[np.ndarray], np.ndarray]" = lambda one: one
) -> "np.ndarray":
    """(n, 3) m: the points at an instant, s, from those (F, n, 3) at the times (F,), as they are read; the first before, the last
    after.
    """
    import numpy as np

    after = int(np.clip(np.searchsorted(times, at), 1, max(1, len(times) - 1)))
    if len(times) == 1:
        return np.asarray(read(points[0]))
    share = float(np.clip((at - times[after - 1]) / (times[after] - times[after - 1]), 0.0, 1.0))
    return np.asarray(read(points[after - 1]) * (1.0 - share) + read(points[after]) * share)
