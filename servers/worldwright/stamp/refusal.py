"""What a gate answers when it does not open."""

from collections.abc import Iterable

from ..model.errors import GateError
from ..model.frozen import Frozen


class Refusal(Frozen):
    """One thing a gate needs and does not have."""

    cause: str
    next_move: str = ""


def raise_if(gate: str, refusals: Iterable[Refusal], place: str = "") -> None:
    """Raise one `GateError` that names every refusal, and the first one's next move."""
    found = list(refusals)
    if found:
        listed = "".join(f"\n  - {r.cause}" for r in found) if len(found) > 1 else f" {found[0].cause}"
        moves = list(dict.fromkeys(r.next_move for r in found if r.next_move))
        raise GateError(f"the {gate} gate refuses:{listed}", place=place, next_move="; then ".join(moves[:3]))
