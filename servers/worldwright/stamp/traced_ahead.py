"""The traced film of a world with glass or a clear liquid, begun by itself once the author's film is drawn and the machine is idle.

Glass is what the preview draws worst. Of a world without any, so short a trace is no better than the preview, and shadows melt in it;
there it is asked for. It is for show, and no evidence: nothing waits for it, and with the lowest priority it takes little from what
something waits for. It is whole whenever its minutes end (`worldengine.film.refining`), ends by itself when the film or the world is changed, and
`worldwright stage start RUN --pass final` goes on with its frames.
"""

import os
import re
from contextlib import suppress

from ..model import work_beside
from ..model.errors import WorldwrightError
from ..model.evidence import pictures_of
from ..model.evidence.run import Run
from ..model.storage import own
from .state import State

MODULE = "worldwright.traced_beside"
"""What the process runs."""
MINUTES = 4.0
"""As long as description, review and acceptance took in walks of fifteen minutes."""
LOWEST = 19
CLEAR = re.compile(r"\bclear #")
"""A look that is clear by its own colour."""


def begin(run: Run) -> str:
    """Begin it, unless it is under way or there already; what there is to say of it, one line, else empty."""
    from ..draft.writing import film_as_drafted
    from ..stage.tools import latest

    state = State(run)
    own_film = (run.folder / pictures_of.FILM).is_file() and not film_as_drafted(run)
    if not work_beside.allowed() or not own_film or state.key is None or not _clear(run):
        return ""
    place = f"{state.place}/evidence/{state.key.key}/final/final.mp4"
    job = latest(run, "final")
    if job is not None and job.state == "succeeded":
        return f"traced, {place}: {job.message}"
    if job is not None and job.ended and job.state != "lost":
        return ""  # it failed, or somebody ended it: not begun again unasked
    with suppress(WorldwrightError, OSError):
        work_beside.begin(MODULE, run.folder, own(run.folder, run.evidence(state.key) / "video"))
        return (
            f"traced beside for {MINUTES:g} minutes, {place}; whole when they end, for show, and waited for by nothing "
            f"(`worldwright stage start {state.place} --pass final` gives it more)"
        )
    return ""


def _clear(run: Run) -> bool:
    """Whether plan, program or film name a look that light goes through."""
    from worldkit import materials

    clear = {name for name in materials.LOOKS if materials.look(name).clear > 0}
    texts = [
        p.read_text(encoding="utf-8", errors="replace") for p in (run.plan, run.program, run.folder / pictures_of.FILM)
    ]
    return any(CLEAR.search(text) or clear & set(re.findall(r"\w+", text)) for text in texts)


def trace(run: Run) -> None:
    """Begin the pass with the lowest priority, which the calling process has from now on."""
    from ..stage.tools import start

    with suppress(OSError):
        os.nice(LOWEST)
    start(str(run.folder), stage="final", minutes=MINUTES)
