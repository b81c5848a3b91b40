"""`go`: how far a run comes without anybody's decision, and all that is wrong with it, told together.

The steps are the servers' own tools, a group after the other (`GROUPS`); nothing here can do what a tool would refuse. What
was found wrong in one group ends the walk before the next: nobody pays for a film of a world that does not hold. What the
evidence of this program and plan answers is not done again, so a walk that ran out of time is taken up by calling again.
"""

import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Literal

from ..model.errors import CallOverError, WorldwrightError
from ..model.evidence import approval, pictures_of
from ..model.evidence.build_steps import StepName
from ..model.evidence.reports import PassName
from ..model.evidence.run import Run, sha256_file
from ..model.finding import Finding, by_kind
from ..model.progress import Progress, silent
from . import at_work, audited, begun_beside, gates, next_repair, picture_claims, rough_film, scope, uncaused
from .gone import Gone, Wrong
from .halts import RunningError, TurnError, WrongError
from .smallest_seen import smallest_seen
from .state import State
from .steps import Step, one

Say = Callable[[str, str, str], None]
"""Told each step, `done`, `stopped` or `waiting`, and what there is to say about it."""
GROUPS: tuple[tuple[StepName, ...], ...] = (
    ("check", "place"),
    ("approve",),
    ("draft",),
    ("lint",),
    ("physics",),
    ("scan", "expect"),
    ("causes", "stills", "video"),
)
"""What of one group is wrong is told together."""
FOR_EVER_S, MOST_REMARKS = 1e9, 5


class Going:
    """One walk along a run.

    Args:
        run: the run folder.
        timeout_s: return after about this long, s; what is under way goes on by itself.
        refine: also repeat the physics at half the time step.
        until: the step after whose group the walk ends, as before a film that is still to be written.
        approve: gives the approval that is missing; None: the walk waits for it.
        say: told each step as it is done.
        progress: told how far a long step is.
        memory_mb: resident memory limit of each pass that it starts, MiB.
    """

    groups = GROUPS
    attended = True
    """Whether somebody looks and changes: a first film is drafted where nobody wrote one, and drawn roughly once the claims hold."""

    def __init__(
        self,
        run: Run,
        *,
        timeout_s: float = FOR_EVER_S,
        refine: bool = False,
        until: StepName | None = None,
        approve: Callable[[], str] | None = None,
        say: Say = lambda *_: None,
        progress: Progress = silent,
        memory_mb: int = 4096,
    ) -> None:
        self.run, self.name, self.refine, self.until = run, str(run.folder), refine, until
        self.grant, self.say, self.progress, self.memory_mb = approve, say, progress, memory_mb
        self.deadline = time.monotonic() + timeout_s
        self.held: dict[StepName, str] = {}
        self.wrong: list[Wrong] = []
        self.under_way: list[str] = []
        self.storyboard = self.robust = self.proof = self.moving = self.traced = ""
        self.of_layout: tuple[Finding, ...] = ()
        self.ended: dict[PassName, tuple[str, ...]] = {}

    def go(self) -> Gone:
        """Walk until something is wrong, a decision is due, the time is over, or nothing is left to do."""
        turn = ""
        for name, action in self.actions():
            try:
                self.held[name] = action()
            except WrongError as no:
                self.wrong += [Wrong(step=name, what=what, next_move=move) for what, move in no.found]
                self.say(name, "stopped", "\n".join(what for what, _ in no.found) + f"\nnext: {no.found[0][1]}")
            except CallOverError as early:  # nothing is known to be wrong
                self.under_way.append(f"{name}: {early.cause}; {early.next_move}")
            except WorldwrightError as no:
                findings = "".join(f"{finding}\n" for finding in getattr(no, "findings", ()))
                where = f"{no.place}: " if no.place else ""
                self.wrong.append(Wrong(step=name, what=f"{findings}{where}{no.cause}", next_move=no.next_move))
                self.say(name, "stopped", f"{findings}{no}")
            except TurnError as due:
                turn = due.next_move
                self.say(name, "waiting", f"{due}\nnext: {turn}")
                break
            except RunningError as still:
                self.under_way += [str(still)] if str(still) not in self.under_way else []
            else:
                self.say(name, "done", self.held[name])
        begun = begun_beside.begin(self.run, self.held, self.say, sound=not self.wrong, attended=self.attended)
        self.proof, self.robust, self.traced = begun
        return self.told(turn)

    def told(self, turn: str) -> Gone:
        """The answer: the next move is the first wrong thing's, then whoever's turn it is."""
        from .status import status

        state: Literal["running", "stopped", "waiting", "accepted"] = "waiting"
        if self.wrong:
            state, turn = "stopped", self.wrong[0].next_move
        elif self.under_way:
            state, turn = "running", f"worldwright go {State(self.run).place}"
        elif not turn:
            now = status(State(self.run))
            state, turn = "accepted" if now.state == "accepted" else "waiting", now.next_move
            if state == "waiting" and self.until == "expect" and self.step("video").status == "missing":
                turn = next_repair.film_first(State(self.run), self.moving)
        return Gone(
            run=self.run.name, state=state, held=self.held, wrong=tuple(self.wrong), under_way=tuple(self.under_way),
            storyboard=self.storyboard, moving=self.moving, proof=self.proof, robust=self.robust, traced=self.traced,
            next_move=turn,
        )  # fmt: skip

    def actions(self) -> Iterator[tuple[StepName, Callable[[], str]]]:
        """The steps in order, as far as nothing of an earlier group is wrong or under way."""
        last = next((n for n, group in enumerate(self.groups) if self.until in group), len(self.groups))
        for group in self.groups[: last + 1]:
            if self.wrong or self.under_way:
                return
            if "video" in group:
                self.begin_pictures()
            for name in group:
                if name != "place" or State(self.run).plan is not None:  # what cannot be read cannot be placed
                    yield name, getattr(self, name)
            first = self.film_due() and not self.wrong and self.until not in group
            if ("expect" in group and not first) or ("video" in group and not (self.storyboard or self.under_way)):
                self.draw()
            if "expect" in group and self.attended and not (self.wrong or self.under_way):
                try:
                    self.moving = rough_film.drawn(self.run, self.say)
                except CallOverError as early:
                    self.under_way.append(f"moving: {early.cause}; {early.next_move}")

    def film_due(self) -> bool:
        """Whether the author's own film is still to be drawn: it comes before any other picture, as it is what was asked for."""
        from ..draft.writing import film_as_drafted

        there = (self.run.folder / pictures_of.FILM).is_file() and not film_as_drafted(self.run)
        return there and self.step("video").status == "missing"

    def step(self, name: StepName) -> Step:
        """Where a step stands now, by the files."""
        return one(State(self.run), name)

    # -- before the physics --------------------------------------------------------------------------------------------

    def check(self) -> str:
        """The plan is one."""
        from ..lint.tools import check_plan

        report = check_plan(self.run.plan)
        if errors := [f for f in report.findings if f.severity == "error"]:
            raise WrongError(*((str(f), f"edit {self.run.plan}") for f in errors))
        return f"{report.rules} rules" + (f", {len(report.findings)} remarks" if report.findings else "")

    def place(self) -> str:
        """Everything has its place; poses are written into a plan that is one and is not approved yet."""
        from ..place.tools import check, resolve

        placed = resolve(self.run.plan, write=not self.wrong and not self.approved())
        checked = check(self.run.plan) if placed.ok else None
        found = self.of_layout = (checked or placed).findings
        if checked is None or not checked.ok:
            errors = [f for f in found if f.severity == "error"] or found
            moves = {"WP305": f"worldwright place resolve {self.run.plan}, then approve it again"}
            raise WrongError(*((str(f), moves.get(f.code, f"edit {self.run.plan}")) for f in errors))
        smallest = f"; smallest in the pictures: {checked.smallest}" if checked.smallest else ""
        small = [f"{f.message}; {f.fix}" for f in found if f.code == "WP328"]
        return "\n".join([f"{len(placed.objects)} objects{smallest}", *small])

    def approved(self) -> bool:
        """Whether the plan was approved as it stands, with the models that it names."""
        if not self.run.plan.is_file():
            return False
        models = approval.model_hashes(self.run)
        return approval.standing(self.run.entries(), sha256_file(self.run.plan), models) is not None

    def approve(self) -> str:
        """A person's word."""
        if self.approved():
            return "already approved"
        state = State(self.run)
        if refused := gates.refusals("approve", state):
            raise WrongError(*((r.cause, r.next_move) for r in refused))
        if self.grant is None:
            move = f"read {self.run.plan}, then `worldwright stamp approve {state.place}`"
            raise TurnError("the plan is not approved", move)
        return self.grant()

    def draft(self) -> str:
        """The program is there: drafted, unless its author wrote it."""
        from ..draft.writing import write_film, write_program

        written = write_program(self.run)
        filmed = self.attended and write_film(self.run)
        first = "; a first film.py, drafted: change what it marks CHANGE" if filmed else ""
        if written.outcome == "kept":
            return f"kept simulation.py as its author left it{first}"
        unread = f"; read nowhere: {', '.join(written.unread)}" if written.unread else ""
        if written.outcome == "written" and written.open_places:
            places = "".join(f"\n- {place}" for place in written.open_places)
            raise TurnError(
                f"the draft leaves places to its author{unread}{places}",
                f"write what is marked AUTHOR in {self.run.program}{unread}, then `worldwright go {State(self.run).place}`",
            )
        return ("unchanged" if written.outcome == "unchanged" else f"{written.lines} lines") + unread + first

    def lint(self) -> str:
        """The program may run."""
        from ..lint.tools import check_program

        if (known := self.step("lint")).holds and not scope.changed(State(self.run), self.run.program.name):
            return "\n".join([known.detail, *self.film()])
        with suppress(WrongError, WorldwrightError):  # what went wrong lint tells together with all the rest
            self.passed("bundle")
        report = check_program([self.run.program], plan=self.run.plan)
        if errors := [f for f in report.findings if f.severity == "error"]:
            raise WrongError(*((str(f), f"edit {f.file or self.run.program}") for f in errors))
        remarks = [str(f) for f in report.findings][:MOST_REMARKS]
        return "\n".join([f"{report.rules} rules", *report.worlds, *remarks, *self.film()])

    def film(self) -> list[str]:
        """What is said of `film.py`, tried before motion is paid for, and later by its pass: a faulty one holds up only the film."""
        from ..draft.writing import film_as_drafted
        from ..lint.tools import check_program

        path = self.run.folder / pictures_of.FILM
        if not path.is_file() or self.step("physics").holds or film_as_drafted(self.run):
            return []
        report = check_program([path])
        if errors := [str(f) for f in report.findings if f.severity == "error"]:
            return [f"{path.name} FAILS, which keeps only the film waiting, not the physics: edit {path}", *errors]
        return [*report.worlds]

    # -- what the recording says ---------------------------------------------------------------------------------------

    def physics(self) -> str:
        """The world is simulated and recorded."""
        return self.passed("physics")

    def passed(self, stage: PassName) -> str:
        """Bring a pass to its end. One that failed while nobody waited for it is told, once, and not begun again."""
        from ..stage.tools import latest, start, wait

        job = latest(self.run, stage)
        told = self.run.jobs / job.job / "told" if job else None
        if job is None or told is None or job.state not in ("failed", "cancelled") or told.exists():
            job = start(self.name, stage=stage, memory_mb=self.memory_mb)
            told, self.ended[stage] = self.run.jobs / job.job / "told", () if job.cached else job.account
        waiting = at_work.Waiting(self.say, State(self.run))
        while not job.ended:
            left = self.deadline - time.monotonic()
            if left <= 0:
                raise RunningError(at_work.line(job, waiting.state))
            job = wait(self.name, job=job.job, timeout_s=waiting.within_s(job, left), progress=self.progress)
        if job.state != "succeeded":
            told.touch()
            where = f"{job.place}: " if job.place else ""
            raise WrongError(
                (
                    f"{job.code}: {where}{job.message or f'the {stage} pass {job.state}'}",
                    job.next_move or f"worldwright stage log {State(self.run).place}",
                )
            )
        said = ["from its evidence" if job.cached else f"{job.wall_s:.1f} s"]
        return "\n".join([*said, *self.ended.get(stage, ()), *(job.account if stage == "physics" else ())])

    def scan(self) -> str:
        """Nothing in the motion is impossible."""
        from ..scan.tools import scan

        if not self.step("scan").done:
            scan(self.name)
        report = State(self.run).scan.value
        anomalies = report.anomalies if report else ()
        if blocking := [a for a in anomalies if a.severity == "blocking"]:
            raise WrongError(*((str(a), next_repair.of_anomaly(State(self.run), a.code)) for a in blocking))
        remarks = by_kind(a for a in anomalies if a.severity == "warn")
        said = [self.step("scan").detail]
        with suppress(WorldwrightError):  # without the recording there is nothing to add
            said += [f"smallest in the pictures: {small}"] if (small := smallest_seen(self.run)) else []
        return "\n".join([*said, *remarks[:MOST_REMARKS]])

    def expect(self) -> str:
        """The world does what the plan claims, and nothing of it where its cause is taken away."""
        from ..scan.tools import expect

        if not self.step("expect").done:
            expect(self.name)
        report = picture_claims.measured(self.run, lambda: self.passed("stills"))
        found: list[str] = []
        for objective in report.objectives if report else ():
            if objective.status in ("refuted", "unproved"):
                told = [f"{e.name}: {e.message}" for e in objective.expectations if e.status != "holds"]
                told += [objective.reason] if objective.status == "unproved" and objective.reason else []
                found.append("\n".join([f"objective {objective.index} {objective.status}: {objective.claim}", *told]))
        if found := found or uncaused.wrong(self.run, self.deadline - time.monotonic(), self.progress):
            raise WrongError(*((said, self.patch()) for said in found))
        return self.step("expect").detail

    def draw(self) -> None:
        """Draw a few small pictures of what was recorded, also of a world that does not hold: they may tell why."""
        from ..scan.tools import moments
        from ..stage.tools import latest, start_storyboard, wait

        job = latest(self.run, "storyboard")
        try:
            if job is None or job.state == "lost":
                job = start_storyboard(self.run, moments(self.run))
            waiting = at_work.Waiting(self.say, State(self.run))
            while not job.ended and (left := self.deadline - time.monotonic()) > 0:
                within = waiting.within_s(job, left)
                job = wait(self.name, job=job.job, timeout_s=min(5.0, within), progress=self.progress)
        except WorldwrightError as refused:
            self.say("storyboard", "stopped", str(refused))
            return
        if not job.ended:  # audits and films, which would take its processor, wait for the first picture
            self.under_way.append(job.text().splitlines()[0])
            return
        self.storyboard = job.result
        self.say("storyboard", "done" if job.result else "stopped", job.result or job.text())

    def patch(self) -> str:
        """What mends a world that does not hold."""
        return f"correct {State(self.run).place}/simulation.py, one patch; or the plan, if it is wrong"

    # -- last: audits behind, pictures in front ----------------------------------------------------------------------

    def begin_pictures(self) -> None:
        """Have the pictures made beside the audits."""
        from ..stage.tools import latest, start

        with suppress(WorldwrightError):  # the pass says so itself when its turn comes
            for stage in self.pictures():  # the author's film, too, is drawn behind the stills, which it needs
                job = latest(self.run, stage)
                if job is None or job.state == "lost":
                    self.ended[stage] = start(self.name, stage=stage, memory_mb=self.memory_mb).account

    def pictures(self) -> tuple[PassName, ...]:
        """The passes that the plan asks for."""
        return ("stills",) if self.step("video").status == "not_needed" else ("stills", "video")

    def causes(self) -> str:
        """No effect comes without its cause, and with `refine` no claim by the time step."""
        from ..scan.tools import scan

        state = State(self.run)
        needed = bool(audited.why_causes(state)) and not self.step("causes").done
        finer = self.refine and audited.standing(state, state.refine) not in ("holds", "fails")
        waiting, heard = at_work.Waiting(self.say, state, silent_s=0.0), at_work.Heard(self.progress)
        while needed or finer:
            waiting.tell("causes", lambda: at_work.beside(self.run, heard.said, self.pictures()))
            left = max(0.0, self.deadline - time.monotonic())
            done = scan(self.name, refine=finer, causes=needed, timeout_s=min(left, at_work.MOST_S), progress=heard)
            if not (pending := done.pending):
                break
            if left <= 0:
                raise RunningError(f"audits: {', '.join(pending)}")
        state = State(self.run)
        wrong = [
            finding
            for kept in (state.causes, state.refine)
            if kept.value is not None and audited.standing(state, kept) == "fails"
            for finding in audited.findings(kept.value)
        ]
        if wrong:
            raise WrongError(*((said, self.patch()) for said in wrong))
        return self.step("causes").detail

    def stills(self) -> str:
        """Each camera's picture of the beginning; an author's film comes first."""
        if self.film_due():
            self.passed("video")
        return self.passed("stills")

    def video(self) -> str:
        """Each camera's film."""
        return self.passed("video") if "video" in self.pictures() else self.step("video").detail
