"""A drive driven again by its own stream, confined as every pass is, and held against the rows that were recorded live."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..model import json_object
from ..model.errors import JobError
from .drive_folder import LIVE, STREAM, TRAJECTORY, refuse

if TYPE_CHECKING:
    from worldengine.recording.stored import Recording

SAME = ("time", "qpos", "qvel", "act")
"""Columns of the rows recorded live that the replay must repeat."""
STILL_S, MEMORY_MB, FILE_MB = 120.0, 8192, 8192
"""Of the replay: seconds of its own in which no step is taken, MiB of memory, MiB of one file. Its length is that of the drive."""


@contextmanager
def sound(place: Path) -> Iterator[None]:
    """Turn what reading a damaged recording raises into a `GateError`."""
    from pyarrow.lib import ArrowException

    from worldkit.errors import WorldkitError

    try:
        yield
    except (WorldkitError, ArrowException, OSError, LookupError, TypeError, ValueError, OverflowError) as cause:
        refuse(place, f"what was recorded makes no sense: {type(cause).__name__}: {str(cause)[:300]}")


def recorded(folder: Path) -> "Recording":
    """The rows recorded live; a `GateError` where there is none, or they make no sense."""
    from worldengine.recording import stored

    live = folder / LIVE / TRAJECTORY
    if not (live / "meta.json").is_file():
        refuse(folder, "nothing was recorded live, so nothing can be compared with a replay")
    with sound(live):
        found = stored.open(live)
        if not (found.time_step > 0 and int(found.meta["record_every"]) > 0 and len(found)):
            raise ValueError("no row, or no step")
        return found


def steps_of(live: "Recording") -> int:
    """Steps from the first row to the last, which is the end also where a kill came before it could be said."""
    with sound(live.folder):
        steps = round(float(live.time[-1] - live.time[0]) / live.time_step)
    if steps < 1:
        refuse(live.folder, "nothing was driven: not one step was recorded")
    return steps


def again(folder: Path, given: Path, room: Path, every: int) -> "Recording":
    """Drive the world again by the stream, confined, in a clean process, into a folder of its own.

    Args:
        folder: of the drive.
        given: where the copies lie that are driven: world, facts, inputs, stream.
        room: a new folder to record in.
        every: steps between two rows recorded live, as many as possible of which must be rows of the replay.

    Raises:
        JobError: it failed, or was stopped.
    """
    from worldengine.recording import stored

    from ..stage import confined

    parts = {"world": "world.mjz", "program": "program.json", "inputs": "inputs.json", "replay": STREAM}
    words = [word for name, file in parts.items() for word in (f"--{name}", str(given / file))]
    call = [sys.executable, "-s", "-P", "-m", "worldengine", "physics", *words, "--meets", str(every), "--out", "{out}"]
    ended = confined.run(
        call, reads=[given / file for file in parts.values()], wanted=("error.json",), wall_s=STILL_S,
        memory_mb=MEMORY_MB, file_mb=FILE_MB, kept=room, advances=True,
    )  # fmt: skip
    if ended.status != "ended" or ended.exit_code:
        said = (json_object.told(ended.files.get("error.json", b"")) or {}).get("message")
        last = next((line for line in reversed(ended.log.splitlines()) if line.strip()), "")
        raise JobError(
            f"the drive cannot be driven again: {said or last or ended.status}",
            code=ended.status,
            place=str(folder),
            next_move="worldwright doctor, if the sandbox refuses; else the world or its stream is damaged",
        )
    with sound(folder):
        return stored.open(room / TRAJECTORY)


def compared(live: "Recording", whole: "Recording", steps: int) -> int:
    """How many rows recorded live the replay has, too, bit for bit; the others lie between two rows of a long replay.

    Raises:
        GateError: one of them is another.
    """
    import numpy as np

    with sound(live.folder):
        every = int(whole.meta["record_every"])
        at = np.rint((np.asarray(live.time) - live.time[0]) / live.time_step).astype(int)
        told = ((at % every == 0) & (at >= 0) & (at <= steps)) | (at == steps)
        in_whole = np.where(at[told] == steps, len(whole) - 1, at[told] // every)
        for name in SAME:
            one, other = np.asarray(getattr(live, name))[told], np.asarray(getattr(whole, name))[in_whole]
            same = (one == other).reshape(len(one), -1).all(axis=1)
            if not same.all():
                when = float(live.time[told][int(same.argmin())])
                refuse(
                    live.folder, f"the replay passes through other states than the drive, from {when:.3f} s on ({name})"
                )
        return int(told.sum())
