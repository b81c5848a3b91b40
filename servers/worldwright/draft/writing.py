"""Write a run's `simulation.py` from its approved plan, and a first `film.py`, never over what an author wrote."""

from dataclasses import dataclass

from worldkit.files import write_atomic

from ..model.evidence import approval, pictures_of
from ..model.evidence.run import Run, sha256_file
from ..model.plan.layout import Scene

FILMED = "draft_film"
"""The journal's word for a film that was drafted."""


@dataclass(frozen=True)
class Written:
    """The outcome of a draft."""

    outcome: str
    """It is `written`, `unchanged`, or `kept` when an author's program exists."""
    lines: int
    open_places: tuple[str, ...] = ()
    """The places that the draft leaves to its author."""
    unread: tuple[str, ...] = ()
    """Constants of the plan that the draft reads nowhere."""


def write_program(run: Run, actor: str = "build") -> Written:
    """Draft the program of the run's present plan.

    Raises:
        GateError: the plan is not approved as it stands, or a model file that it names changed since.
    """
    from ..model.plan.plan_text import read_plan
    from ..place.tools import resolve
    from . import draft

    approval.require(run, "no code may be written for this plan")
    layout = Scene(objects=resolve(run.plan, write=False).objects)
    drafted = draft(read_plan(run.plan).plan, layout)
    lines = len(drafted.source.splitlines())
    if run.program.is_file():
        present = sha256_file(run.program)
        if not any(e.get("action") == "draft" and e.get("program_sha256") == present for e in run.entries()):
            return Written("kept", len(run.program.read_text(encoding="utf-8", errors="replace").splitlines()))
        if run.program.read_text(encoding="utf-8") == drafted.source:
            return Written("unchanged", lines, drafted.open_places, drafted.unread)
    write_atomic(run.program, drafted.source)
    run.log(actor, "draft", program_sha256=sha256_file(run.program), open_places=list(drafted.open_places))
    return Written("written", lines, drafted.open_places, drafted.unread)


def write_film(run: Run, actor: str = "build") -> bool:
    """Draft a first `film.py` of the run's plan, unless there is one, or was, or it was filmed or accepted without; whether it was written.

    Raises:
        PlanError: the plan cannot be read.
    """
    from ..model.plan.plan_text import read_plan
    from .film_text import film_text

    path = run.folder / pictures_of.FILM
    done = any(e.get("action") == FILMED or e.get("stage") == "video" for e in run.entries())
    if path.exists() or run.accepted.exists() or done:  # whoever took it away wants the house's own film
        return False
    write_atomic(path, film_text(read_plan(run.plan).plan))
    run.log(actor, FILMED, film_sha256=sha256_file(path))
    return True


def film_as_drafted(run: Run) -> bool:
    """Whether the run's `film.py` is the one that was drafted, which its author has not touched."""
    path = run.folder / pictures_of.FILM
    drafted = {e.get("film_sha256") for e in run.entries() if e.get("action") == FILMED}
    return path.is_file() and sha256_file(path) in drafted
