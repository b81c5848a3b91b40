"""Read what a recording says of the author's laws, in one place: whoever wrote it may have been mistaken, or mean to mislead."""

from collections.abc import Mapping
from typing import Any

from worldkit.errors import RecordingError

from .declared_media import Medium


def told(meta: Mapping[str, Any], place: str, key: str = "laws") -> tuple[Medium, ...]:
    """The laws of a recording's `meta.json`, or what solvers of the suite move (`shown`); none where it has none.

    Raises:
        RecordingError: what stands there is no list of rows with bodies, a name and what shows it.
    """
    rows = meta.get(key)
    if rows is None:
        return ()
    if isinstance(rows, (list, tuple)) and all(map(_whole, rows)):
        return tuple(map(Medium.read, rows))
    cause = f"`{key}` in the recording's meta.json makes no sense: {rows!r:.80}"
    raise RecordingError(cause, place, "run the physics pass again")


def moved(meta: Mapping[str, Any], place: str) -> tuple[Medium, ...]:
    """All media of a recording: its laws, then what solvers of the suite move (`shown`); errors as of `told`."""
    return (*told(meta, place), *told(meta, place, "shown"))


def _whole(row: Any) -> bool:
    said, bodies = (row.get("law"), row.get("bodies")) if isinstance(row, Mapping) else (None, None)
    if not isinstance(said, Mapping) or not isinstance(bodies, (list, tuple)):
        return False
    return all(isinstance(word, str) for word in (said.get("name"), said.get("shown_by"), *bodies))
