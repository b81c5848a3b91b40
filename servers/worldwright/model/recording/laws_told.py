"""The author's laws that a recording tells of, for every reader of `meta`; what makes no sense is a `RecordingError`."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ..errors import RecordingError

if TYPE_CHECKING:
    from worldengine.inputs.declared_media import Medium


def of(meta: Mapping[str, Any], place: str = "meta.json") -> "tuple[Medium, ...]":
    """The laws, in their order; none where it has none.

    Raises:
        RecordingError: what it says of them makes no sense.
    """
    return () if meta.get("laws") is None else _read(meta, place)


def drawn(meta: Mapping[str, Any], place: str = "meta.json") -> frozenset[str]:
    """The names of what only shows the points of a law, or the water of a solver of the suite; errors as of `of`."""
    return frozenset(shown(meta, place))


def shown(meta: Mapping[str, Any], place: str = "meta.json") -> tuple[str, ...]:
    """What shows each medium of a recording, in the order of its points: laws first, then solvers; errors as of `of`."""
    others = () if meta.get("shown") is None else _read({"laws": meta["shown"]}, place)
    return tuple(medium.shown_by for medium in (*of(meta, place), *others))


def _read(meta: Mapping[str, Any], place: str) -> "tuple[Medium, ...]":
    from worldengine.inputs.told_laws import told
    from worldkit import errors

    try:
        return told(meta, place)
    except errors.RecordingError as error:
        raise RecordingError(error.cause, place=error.place, next_move=error.next_move) from error
