"""Write a run's `simulation.py` from its approved plan, never over an author's program."""

from dataclasses import dataclass

from worldkit.files import write_atomic

from ..model.evidence import approval
from ..model.evidence.run import Run, sha256_file
from ..model.plan.layout import Scene


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
