"""A rehearsal: the walk of `go` in a copy of a run whose plan nobody has approved, as far as a storyboard, and no further.

The copy (`model.evidence.rehearsed`) holds the plan, what it names and an author's program; where there is none, or only the
draft of an earlier plan, the walk drafts one there. Unlike `go` it tells check, place and lint together, and a place left to the
program's author is a remark. What they find wrong in plan or model is mended before anybody pays for the physics of it, unless the
caller asks to go on: then it is told beside what was measured.
"""

import difflib
import re
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from ..model import processor_time
from ..model.errors import GateError, NotFoundError, WorldwrightError
from ..model.evidence import approval, rehearsed
from ..model.evidence.build_steps import STEPS, StepName
from ..model.evidence.run import Run, sha256_file
from ..model.progress import Progress
from ..model.storage import writing
from .going import Going
from .gone import Wrong
from .halts import WrongError
from .rehearsal_copy import lay_out, names, require_place, stands
from .rehearsed_answer import Mend, Rehearsed, Whose
from .state import State

MOST_REMARKS = 12
"""So many remarks of one step are told, and the number of the others."""
OF_PLAN = re.compile(r"error WP\d+ .*", re.DOTALL)
"""How a fault of the plan itself reads, which lint repeats."""
OF_WORLD = re.compile(r"error (WP\d+|WM(?!101\b)\d+) ")
"""How a fault of plan or model reads, which makes another world of it; without `NO_WORLD`, which the machine can cause."""
NO_WORLD = "WM101"
"""Lint's word for a program of which no world came."""
OWN_LOG = "stage log"
"""A next move that reads a log speaks of the rehearsal's own folder."""


def rehearse(run: Run, timeout_s: float, progress: Progress, go_on: bool = False) -> Rehearsed:
    """Rehearse a run as it stands; while another call does, that is what is answered. With `go_on` also what lint refuses.

    Raises:
        GateError: its plan is approved, so that `go` may do all this; or it is a rehearsal itself; or what lies where its
            rehearsal belongs is none.
        NotFoundError: it has no plan.
        StorageError: the rehearsal cannot be written.
    """
    deadline = time.monotonic() + timeout_s
    if not run.plan.is_file():
        raise NotFoundError("there is no plan to rehearse", place=str(run.plan), next_move="write plan.md first")
    entries = list(run.entries())
    if rehearsed.is_one(entries):
        raise GateError(
            "this is a rehearsal already",
            place=str(run.folder),
            next_move=f"worldwright stage rehearse {run.folder.parent}",
        )
    if approval.standing(entries, sha256_file(run.plan), approval.model_hashes(run)) is not None:
        raise GateError(
            "the plan is approved as it stands: nothing is left to rehearse",
            place=str(run.plan),
            next_move=f"worldwright go {run.folder}",
        )
    require_place(run)
    with _alone(run, deadline) as nobody_else:
        if nobody_else:
            copy, left_s = lay_out(run), max(deadline - time.monotonic(), 0.0)
            return Rehearsal(run, copy, timeout_s=left_s, progress=progress, go_on=go_on).rehearsed()
    return Rehearsed(
        run=run.name,
        state="running",
        under_way=("another call rehearses this run",),
        next_move=f"worldwright stage rehearse {State(run).place}",
    )


@contextmanager
def _alone(run: Run, deadline: float) -> Iterator[bool]:
    """Hold the rehearsal of a run; a folder that cannot be made is for its owner to mend."""
    with ExitStack() as held:
        with writing("the rehearsal", run.folder):
            got = held.enter_context(rehearsed.alone(rehearsed.folder(run.folder), deadline))
        yield got


class Rehearsal(Going):
    """One walk along a rehearsal.

    Args:
        original: the run that is rehearsed.
        copy: its rehearsal.
        timeout_s: return after about this long, s; what is under way goes on by itself.
        progress: told how far a long step is.
        go_on: simulate also what check or lint found wrong.
    """

    def __init__(self, original: Run, copy: Run, *, timeout_s: float, progress: Progress, go_on: bool = False) -> None:
        super().__init__(copy, timeout_s=timeout_s, progress=progress)
        self.original, self.go_on = original, go_on
        self.remarks: list[Mend] = []
        self.began_s = processor_time.spent_s()

    def actions(self) -> Iterator[tuple[StepName, Callable[[], str]]]:
        """The steps in order, as long as there is something for the next one to look at."""
        yield "check", self.check
        if State(self.run).plan is None:
            return
        yield "place", self.place
        yield "draft", self.draft
        if "place" not in self.held or not self.run.program.is_file():
            return
        yield "lint", self.lint
        if self.under_way:
            return
        if not self.go_on and any(OF_WORLD.search(w.what) for w in self.wrong):
            told = "not simulated: plan or model is wrong as told; to measure it all the same: "
            self.remark("physics", [f"{told}worldwright stage rehearse {State(self.original).place} --go-on"])
            return
        yield "physics", self.physics
        if self.under_way:
            return
        if "physics" in self.held:
            yield "scan", self.scan
            yield "expect", self.expect
            if not self.under_way:
                self.draw()

    def rehearsed(self) -> Rehearsed:
        """Walk, and tell all of it."""
        self.go()
        state = State(self.run)
        report = state.expect.value if "physics" in self.held else None
        self._remark()
        if not stands(self.original, self.run):
            self.under_way.append("what is rehearsed was changed meanwhile")
        if not (self.wrong or self.under_way or "expect" in self.held):
            self.wrong.append(Wrong(step="expect", what="nothing was measured", next_move=self.anew()))
        said = {_of_plan(w.what) for w in self.wrong if w.step == "check"} - {""}
        told = [w for w in self.wrong if w.step != "lint" or _of_plan(w.what) not in said]
        blocking = [Mend(step=w.step, blocks=True, what=w.what, next_move=w.next_move) for w in told]
        found = [*sorted(blocking, key=_order), *sorted(self.remarks, key=_order)]
        running = bool(self.under_way)
        place = State(self.original).place
        again = self.anew()
        move = (
            again
            if running
            else self.told_of_original(blocking[0].next_move)
            if blocking
            else f"worldwright go {place}"
        )
        return Rehearsed(
            run=self.original.name,
            state="running" if running else "stopped" if blocking else "holds",
            program=self.whose(),
            objectives=report.objectives if report else (),
            findings=tuple(
                one.model_copy(update={n: self.told_of_original(getattr(one, n)) for n in ("what", "next_move")})
                for one in found
            ),
            storyboard=tuple(map(str, sorted(Path(self.storyboard).glob("*.jpg")))) if self.storyboard else (),
            under_way=tuple(self.under_way),
            cpu_s=round(processor_time.spent_s() - self.began_s + self._passes_s(), 2),
            next_move=move,
        )

    # -- the steps that differ from those of `go` ----------------------------------------------------------------------

    def check(self) -> str:
        """The plan is one; it is read where its author wrote it, for its lines."""
        from ..lint.tools import check_plan

        report = check_plan(self.original.plan)
        self.remark("check", (str(f) for f in report.findings if f.severity != "error"))
        if errors := [f for f in report.findings if f.severity == "error"]:
            raise WrongError(*((str(f), f"edit {self.original.plan}") for f in errors))
        return f"{report.rules} rules"

    def draft(self) -> str:
        """A program is there; what a draft leaves to its author is not rehearsed, and told."""
        from ..draft.writing import write_program

        written = write_program(self.run)
        self.remark(
            "draft", (f"left to the program's author, so not rehearsed: {place}" for place in written.open_places)
        )
        self.remark("draft", [f"constants read nowhere: {', '.join(written.unread)}"] if written.unread else [])
        return "its author's" if written.outcome == "kept" else f"drafted, {written.lines} lines"

    def lint(self) -> str:
        """The program may run; what lint says of it already is not asked again, unless it saw no world, which the machine can cause."""
        report = State(self.run).lint.value
        if report is not None and not report.ok and all(f.code != NO_WORLD for f in report.findings):
            raise WrongError(*((str(f), self.patch()) for f in report.findings if f.severity == "error"))
        try:
            return super().lint()
        except WrongError as no:  # which tells to edit the copy
            raise WrongError(*((what, self.patch()) for what, _ in no.found)) from no

    def draw(self) -> None:
        """Draw the storyboard; one that cannot be drawn is a remark."""
        from ..stage.tools import latest

        super().draw()
        job = latest(self.run, "storyboard")
        if job is not None and job.ended and not job.result:
            self.remark("stills", [job.text()])

    def patch(self) -> str:
        """What mends a world that does not hold."""
        mended = "plan.md" if self.whose() == "drafted" else "simulation.py; or plan.md, if it is wrong"
        return f"correct {State(self.original).place}/{mended}, then rehearse again"

    def anew(self) -> str:
        """The command that rehearses the run again."""
        return f"worldwright stage rehearse {State(self.original).place}{' --go-on' * self.go_on}"

    # -- what is told --------------------------------------------------------------------------------------------------

    def whose(self) -> Whose:
        """Whose program is rehearsed."""
        if not self.run.program.is_file():
            return "none"
        drafted = {e.get("program_sha256") for e in self.run.entries() if e.get("action") == "draft"}
        return "drafted" if sha256_file(self.run.program) in drafted else "its author's"

    def remark(self, step: StepName, said: Iterable[str]) -> None:
        """Keep what would not stop the run."""
        texts = list(said)
        more = len(texts) - MOST_REMARKS
        texts = texts[:MOST_REMARKS] + ([f"and {more} more"] if more > 0 else [])
        self.remarks += [Mend(step=step, blocks=False, what=text) for text in texts]

    def _remark(self) -> None:
        """The remarks of the steps whose reports lie in the rehearsal."""
        self.remark("place", (str(f) for f in self.of_layout if f.severity == "warning"))
        state = State(self.run)
        if "lint" in self.held and (lint := state.lint.value):
            self.remark("lint", (str(f) for f in lint.findings if f.severity == "warning"))
        if "physics" in self.held and (scan := state.scan.value):
            self.remark("scan", (str(a) for a in scan.anomalies if a.severity == "warn"))

    def told_of_original(self, text: str) -> str:
        """The same text about the run that is rehearsed: its folder, its own files, and the lines of its own plan."""
        if OWN_LOG in text:
            return text
        lines = self._lines()
        here = f"{self.original.folder.name}/{rehearsed.FOLDER}"
        text = re.sub(
            rf"({re.escape(here)}/plan\.md:|(?<![\w/])plan\.md:)(\d+)",
            lambda found: f"{found[1]}{lines.get(int(found[2]), int(found[2]))}",
            text,
        )
        own = "|".join(map(re.escape, names(self.run)))
        file = rf"(?=/(?:{own})(?![\w-]))" if own else r"(?!)"
        return re.sub(rf"(?<![\w-]){re.escape(here)}(?:{file}|(?![\w/-]))", lambda _: self.original.folder.name, text)

    def _lines(self) -> dict[int, int]:
        """The line of the author's plan for each line of the copy, into which poses were written."""
        mine, theirs = (
            path.read_text(encoding="utf-8", errors="replace").splitlines()
            for path in (self.run.plan, self.original.plan)
        )
        found: dict[int, int] = {}
        for _, start, end, first, last in difflib.SequenceMatcher(None, mine, theirs, autojunk=False).get_opcodes():
            found |= {start + n + 1: min(first + n, max(last - 1, first)) + 1 for n in range(end - start)}
        return found

    def _passes_s(self) -> float:
        """Processor time of the passes of the rehearsed program and plan, s."""
        from ..stage.tools import spent

        with suppress(WorldwrightError):
            return spent(self.run)
        return 0.0


def _of_plan(what: str) -> str:
    """What a finding says of the plan itself, wherever in it; empty for any other."""
    found = OF_PLAN.search(what)
    return found[0] if found else ""


def _order(found: Mend) -> int:
    return STEPS.index(found.step)
