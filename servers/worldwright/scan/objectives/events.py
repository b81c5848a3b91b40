"""Events: claims of the vocabulary that come true at a moment, as arguments of claims about order.

The moment of an event is the earliest instant up to which the recording already supports it, found by bisection over
beginnings of the recording; an event that holds from the first rows has the first instant as its moment.
"""

from typing import Annotated, Any

from pydantic import AfterValidator

from ...model.recording.trajectory import Trajectory
from ..measuring.measured import UnknowableError

FEWEST_ROWS = 2
MADE_OF_EVENTS = {"event", "events", "first", "then"}
"""Arguments that hold events: such a claim inside another would be measured again for every beginning of the recording."""
EXAMPLE = "{touches: {bodies: [ball, floor]}}"


def known(value: dict[str, Any]) -> dict[str, Any]:
    """The event itself; a ValueError names what is wrong with it."""
    from .claims import EXPECTATIONS
    from .expecting import argument_problem

    if len(value) != 1:
        raise ValueError(f"an event is one name with its arguments, e.g. {EXAMPLE}")
    ((name, arguments),) = value.items()
    events = {entry.name: entry for entry in EXPECTATIONS.values() if entry.EVENT}
    if name not in events:
        raise ValueError(f"`{name}` is no event; events: {', '.join(sorted(events))}")
    if MADE_OF_EVENTS & set(events[name].Given.model_fields):
        raise ValueError(f"`{name}` is made of events itself; name each of them with `happens_in_order`")
    if problem := argument_problem(name, arguments):
        raise ValueError(f"`{name}`: {'; '.join(problem)}")
    return value


Event = Annotated[dict[str, Any], AfterValidator(known)]
"""One event expectation as a mapping with one key."""


def told(event: dict[str, Any]) -> str:
    """Describe an event in a few words: its name and what it speaks of."""
    ((name, arguments),) = event.items()
    if not isinstance(arguments, dict):
        return f"{name} {arguments}"
    shown = [", ".join(v) if isinstance(v, (list, tuple)) else v for v in map(arguments.get, SPEAKS_OF) if v]
    return " ".join([name, *(str(v) for v in shown)])


SPEAKS_OF = ("body", "bodies", "other", "joint", "tendon", "constraint", "parts", "medium")


def moment_s(trajectory: Trajectory, event: dict[str, Any]) -> float | None:
    """When the event comes true, s; None when it does not.

    Raises:
        UnknowableError: the recording cannot answer it.
    """
    from .expecting import measure, named

    ((name, arguments),) = event.items()
    whole = measure(trajectory, name, named(arguments))
    if whole.status == "unknown":
        raise UnknowableError(f"{told(event)}: {whole.message}")
    if whole.status == "fails":
        return None

    def holds(rows: int) -> bool:
        return measure(trajectory.before(rows), name, named(arguments)).status == "holds"

    low, high = 0, len(trajectory.t)
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if middle >= FEWEST_ROWS and holds(middle) else (middle, high)
    return float(trajectory.t[0 if high <= FEWEST_ROWS else high - 1])
