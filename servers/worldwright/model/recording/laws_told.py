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
    if meta.get("laws") is None:
        return ()
    from worldengine.inputs.told_laws import told
    from worldkit import errors

    try:
        return told(meta, place)
    except errors.RecordingError as error:
        raise RecordingError(error.cause, place=error.place, next_move=error.next_move) from error
