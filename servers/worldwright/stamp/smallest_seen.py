"""What of a run is smallest in its pictures, read of each recording once."""

from pathlib import Path

from ..model.evidence.run import Run
from .state import State

_SMALLEST: dict[tuple[Path, str, str], str] = {}
"""Of the last recording, by its run, key and hash: it is read for this once, however often a walk is taken up again."""


def smallest_seen(run: Run) -> str:
    """See `scan.tools.smallest`."""
    from ..scan.tools import smallest

    state = State(run)
    about = (run.folder, state.key.key if state.key else "", state.trajectory_sha256)
    said = _SMALLEST.get(about)
    if said is None:
        said = smallest(run)
        _SMALLEST.clear()  # which another walk beside may do at any moment, too
        _SMALLEST[about] = said
    return said
