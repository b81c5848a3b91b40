"""A run's film, drawn roughly as soon as its claims hold, before anything dear: whether it is believed is seen where it moves."""

from collections.abc import Callable

from ..model.errors import CallOverError, WorldwrightError
from ..model.evidence import pictures_of
from ..model.evidence.run import Run
from .state import State
from .steps import one


def drawn(run: Run, say: Callable[[str, str, str], None]) -> str:
    """Draw it; the folder where it lies. Empty, which is told, where it cannot be drawn: a faulty film holds up only itself.

    Empty also of a run without a `film.py`, and of one that is filmed.

    Raises:
        CallOverError: the client's call ended first.
    """
    from ..stage.tools import frames

    if not (run.folder / pictures_of.FILM).is_file() or one(State(run), "video").status != "missing":
        return ""
    try:
        shown = frames(str(run.folder), show="moving")
    except CallOverError:
        raise
    except WorldwrightError as refused:
        say("moving", "stopped", str(refused))
        return ""
    say("moving", "done", shown.data.text())
    return str(shown.folder or "")
