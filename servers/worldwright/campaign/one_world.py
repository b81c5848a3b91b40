"""One world of a campaign, from its seed to its row, by the walk that `worldwright go` takes.

Whoever does it, here or on another node, does this: hold the world, look whether its row stands, note that it is begun, walk,
write the row. A world that says no is a row with its cause; nothing that it does raises.
"""

import os
import re
import resource
import socket
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from worldkit.files import write_atomic

from ..model.errors import WorldwrightError
from ..model.evidence import came, environment
from ..model.evidence.build_steps import STEPS, StepName
from ..model.evidence.reports import PassResult
from ..model.evidence.run import Run, sha256_file
from ..model.frozen import Frozen
from . import author_watch, world_author
from .author_folder import AuthorError
from .campaign_store import Base, Begun, Store, address, seed
from .world_row import Cause, Margin, Outcome, Row

POLL_S = 0.2
OVER = ("over_time", "over_usd", "over_runs")
"""Kinds of cause by which a world is given up, and has not failed."""
_RULE = re.compile(r"\bW[A-Z]\d{3}\b")
_JOB = re.compile(r"^([a-z_]+): ")


class Task(Frozen):
    """What is handed out: a few numbers. The rest lies in the campaign's folder."""

    folder: str
    number: int
    base: int
    values: dict[str, float] = {}
    world: str


@dataclass
class Walked:
    """How far a world came."""

    outcome: Outcome
    cause: Cause | None = None
    also: tuple[Cause, ...] = ()


def task(store: Store, begun: Begun, number: int) -> Task:
    """World `number` of a campaign."""
    from . import points

    campaign = begun.campaign
    base = 0 if campaign.sweep else number
    values = points.at(campaign.sweep, number) if campaign.sweep else {}
    world = address(begun.bases[base], number, values, campaign)
    return Task(folder=str(store.folder), number=number, base=base, values=values, world=world)


def perform(one: Task) -> Row:
    """Take a world as far as its campaign asks, and write its row; one that stands is handed back as it is."""
    store = Store(one.folder)
    begun = store.begun
    if (row := store.row(one.world)) is not None:
        return row
    while True:
        with store.working(one.world) as mine:
            if (row := store.row(one.world)) is not None:  # whoever held it has done it meanwhile
                return row
            if mine:
                return _done(store, begun, one)
        time.sleep(POLL_S)


def gave_up(store: Store, one: Task, kind: str, said: str, next_move: str = "", seconds: float = 0.0) -> Row:
    """The row of a world that nobody works on any more, written by whoever watched it (for `seconds`), unless it has one."""
    if (row := store.row(one.world)) is not None:
        return row
    stop_jobs(store, one.world)
    cause = Cause(kind=kind, step="worker", said=said, next_move=next_move)
    with suppress(Exception):  # what it left may be broken in any way
        return store.keep(_row(store, store.begun, one, Walked("gave_up", cause), {}, seconds))
    return store.keep(
        Row(world=one.world, number=one.number, values=one.values, outcome="gave_up", cause=cause, seconds=seconds)
    )


def stop_jobs(store: Store, world: str) -> None:
    """End the passes of a world that are under way, and its author."""
    world_author.stop(store, world)
    author_watch.end_passes(Run(store.world(world)))


def _done(store: Store, begun: Begun, one: Task) -> Row:
    began, minutes, used = time.monotonic(), dict[str, float](), _cpu()
    most = begun.campaign.per_world.begun
    if store.begun_before(one.world) >= most:
        said = f"it was begun {most} times and never came to its end: each time its worker died"
        move = "see its folder; `worldwright campaign resume --again worker_died` begins it once more"
        return gave_up(store, one, "worker_died", said, move)
    store.begin_world(one.world)
    walked = _walked(store, begun, one, minutes, began + begun.campaign.per_world.seconds)
    if begun.campaign.report and store.world(one.world).is_dir():
        _report(store.world(one.world), minutes)
    row = _row(store, begun, one, walked, minutes, time.monotonic() - began)
    return store.keep(row.model_copy(update={"cpu_seconds": round(_cpu() - used, 3)}))


def _cpu() -> float:
    """Seconds of processors that this process took so far, with all that it started and saw end."""
    ours, theirs = (resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
    return ours.ru_utime + ours.ru_stime + theirs.ru_utime + theirs.ru_stime


def _walked(store: Store, begun: Begun, one: Task, minutes: dict[str, float], deadline: float) -> Walked:
    """The walk, and every way in which it can end; it is given up at `deadline`, monotonic, s."""
    step: StepName | Literal["seed", "author"] = "seed"
    try:
        _refuse(begun.bases[one.base])
        if begun.campaign.author is not None:
            step = "author"
            run = _written(store, begun, one, minutes, deadline)
        else:
            run = _seeded(store, one)
        step = "check"
        gone = _walk(run, begun, minutes, max(1.0, deadline - time.monotonic()))
    except WorldwrightError as error:
        findings = [str(finding) for finding in getattr(error, "findings", ())]
        kind = next((_RULE.search(said)[0] for said in findings if _RULE.search(said)), error.code)  # type: ignore[index]
        outcome: Outcome = "gave_up" if kind in OVER and step == "author" else "failed"
        said = "\n".join([error.cause, *findings])
        return Walked(outcome, Cause(kind=kind, step=step, said=said, next_move=error.next_move))
    except Exception as error:  # a defect of ours is this world's cause, and not the end of the others
        return Walked("failed", Cause(kind="internal", step=step, said=f"{type(error).__name__}: {error}"))
    if gone.wrong:
        first, *others = (_cause(wrong.step, wrong.what, wrong.next_move, run.folder) for wrong in gone.wrong)
        measured = gone.wrong[0].step in ("scan", "expect", "causes")
        return Walked("refuted" if measured else "failed", first, tuple(others))
    if gone.under_way:
        stop_jobs(store, one.world)
        seconds = begun.campaign.per_world.seconds
        said = f"it was not done within the {seconds:g} s that a world may take: {'; '.join(gone.under_way)}"
        last = next((name for name in reversed(STEPS) if name in gone.held), "check")
        return Walked("gave_up", Cause(kind="over_time", step=last, said=said, next_move="raise per_world.seconds"))
    if gone.state == "accepted" and begun.campaign.until == "accept":
        return Walked("accepted")
    if begun.campaign.until in gone.held:
        return Walked("held")
    last = next((name for name in STEPS if name not in gone.held), begun.campaign.until)
    return Walked("waiting", Cause(kind="waiting", step=last, said=gone.next_move, next_move=gone.next_move))


def _refuse(about: Base) -> None:
    """Refuse a base that no world can be made of."""
    from .campaign_file import CampaignError

    if about.wrong:
        error = CampaignError(about.wrong, place=about.source, next_move=about.next_move)
        error.code = about.kind
        raise error


def _written(store: Store, begun: Begun, one: Task, minutes: dict[str, float], deadline: float) -> Run:
    """The run folder of a world that its author writes, or has written.

    Raises:
        AuthorError: it did not, or it gave the world up.
    """
    from ..stamp.state import State
    from ..stamp.status import status

    began, run = time.monotonic(), Run(store.world(one.world))
    prompt = (store.base(one.base) / "prompt.md").read_text(encoding="utf-8")
    try:
        world_author.write(store, begun, one.world, prompt, deadline)
    finally:
        minutes["author"] = (time.monotonic() - began) / 60
    if (now := status(State(run))).state == "blocked":
        raise AuthorError("blocked", f"its author gave it up: {now.cause}", str(run.folder), now.next_move)
    return run


def _seeded(store: Store, one: Task) -> Run:
    """The run folder of a world: what its base holds, with the plan's numbers set.

    Raises:
        WorldwrightError: a number cannot be set in it.
    """
    from ..model.plan.plan_edit import edit
    from ..model.plan.plan_text import read_plan
    from .plan_fields import path_of

    base, run = store.base(one.base), Run(store.world(one.world))
    if run.plan.is_file() and any(True for _ in run.entries()):
        return run  # it was begun before, and goes on there
    text = (base / "plan.md").read_bytes()
    if one.values:
        document = read_plan(base / "plan.md")
        changes = [(path_of(document, name), value) for name, value in one.values.items()]
        text = edit(document, [(path, _like(document, path, value)) for path, value in changes]).encode()
    run.folder.mkdir(parents=True, exist_ok=True)
    write_atomic(run.plan, text)
    seed(base, run.folder)
    run.log("build", "plan", origin_sha256=sha256_file(base / "plan.md"))
    return run


def _like(document: Any, path: tuple[str | int, ...], value: float) -> float:
    """A number of the kind that stands there: a whole one for a whole one, if it is whole."""
    old = document.node(str(path[0]), *path[1:]).data()
    return int(value) if isinstance(old, int) and float(value).is_integer() else value


def _walk(run: Run, begun: Begun, minutes: dict[str, float], seconds: float) -> Any:
    """`worldwright go` up to the campaign's last step, without pictures unless they are asked for, for so many seconds."""
    from ..go import Accepting
    from ..stamp.going import GROUPS, Going

    campaign, at = begun.campaign, [time.monotonic()]

    def say(name: str, _outcome: str, _detail: str) -> None:
        now = time.monotonic()
        minutes[name] = minutes.get(name, 0.0) + (now - at[0]) / 60
        at[0] = now

    class Plain(Going):
        """A walk that draws only what was asked for."""

        groups = GROUPS if any(campaign.until in group for group in GROUPS) else Accepting.groups

        def draw(self) -> None:
            """Draw the storyboard, if pictures are wanted."""
            if campaign.pictures:
                super().draw()

    class Stamped(Plain, Accepting):
        """The same up to the stamp."""

    walk = Plain if Plain.groups is GROUPS else Stamped
    limits: dict[str, Any] = {
        "timeout_s": seconds,
        "refine": campaign.refine,
        "until": campaign.until,
    }
    return walk(run, approve=_granting(run, begun), say=say, **limits).go()


def _granting(run: Run, begun: Begun) -> Callable[[], str]:
    """What gives the approval: auto mode, or the word that a person gave for all worlds when the campaign began."""

    def grant() -> str:
        from ..stamp.tools import approve

        with came.entered(begun.word):
            approve(str(run.folder), by="command line", auto=not begun.approved)
        return "approved for the campaign"

    return grant


def _report(folder: Path, minutes: dict[str, float]) -> None:
    """The world's own page; a world without one is still a world."""
    from .. import report

    began = time.monotonic()
    with suppress(Exception):
        report.write(Run(folder))
    minutes["report"] = (time.monotonic() - began) / 60


def _cause(step: StepName, what: str, next_move: str, folder: Path) -> Cause:
    """What a step said, with the code in it by which failures are grouped; files are named relative to the world's folder."""
    what, next_move = (said.replace(f"{folder}/", "") for said in (what, next_move))
    if step == "expect":
        kind = "unproved" if " unproved: " in what.splitlines()[0] else "refuted"
    else:
        rule, job = _RULE.search(what), _JOB.match(what)
        kind = rule[0] if rule else job[1] if job else step
    return Cause(kind=kind, step=step, said=what, next_move=next_move)


def _row(store: Store, begun: Begun, one: Task, walked: Walked, minutes: dict[str, float], seconds: float) -> Row:
    """What the files of a world say, with how its walk ended."""
    from ..stamp.state import State

    base, folder = begun.bases[one.base], store.world(one.world)
    state = State(Run(folder))
    key = state.key.key if state.key else ""
    evidence = folder / "evidence"
    physics = [
        p for p in evidence.glob("*/physics*/result.json") if (r := _result(p)) and "reused_from" not in r.summary
    ]
    expected, acting = state.expect.value, state.interventions.value
    recording = state.folder / "physics" / "trajectory"
    plan = state.plan
    return Row(
        world=one.world,
        number=one.number,
        category=base.category or (str(plan.plan_type) if plan else ""),
        prompt=base.prompt or (plan.title if plan else ""),
        values=one.values,
        outcome=walked.outcome,
        cause=walked.cause,
        also=walked.also,
        iterations=len(list(evidence.glob("*/key.json"))),
        runs=len(physics),
        begun=max(1, store.begun_before(one.world)),
        seconds=round(seconds, 3),
        minutes={name: round(value, 5) for name, value in minutes.items()},
        interventions=tuple(
            f"{row.kind} on {row.target}" + ("" if row.declared else " (undeclared)")
            for row in (acting.acting if acting else ())
        ),
        margins=tuple(
            Margin(objective=o.index, name=e.name, status=e.status, measured=e.measured, margin=e.margin, unit=e.unit)
            for o in (expected.objectives if expected else ())
            for e in o.expectations
        ),
        plan_sha256=state.plan_sha256,
        program_sha256=state.program_sha256,
        world_sha256=sha256_file(world) if (world := state.folder / "physics" / "world.mjz").is_file() else "",
        trajectory_sha256=state.trajectory_sha256,
        environment_sha256=environment.current().sha256(),
        key=key,
        folder=_inside(store, folder),
        recording=_inside(store, recording),
        report=_inside(store, folder / "report.html"),
        poster=_poster(store, folder, state.folder),
        film=_film(store, folder, state.folder),
        memory_mb=round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, 1),
        worker=f"{socket.gethostname()}:{os.getpid()}",
        **world_author.written(store, begun, one.world).model_dump(),
    )


def _inside(store: Store, path: Path) -> str:
    """A path relative to the campaign's folder; empty where nothing is there."""
    return path.relative_to(store.folder).as_posix() if path.exists() else ""


def _poster(store: Store, folder: Path, evidence: Path) -> str:
    """The picture that shows a world: its poster, else a still, else its storyboard."""
    found = [
        folder / "accepted/poster.webp",
        *sorted(evidence.glob("stills/*.png")),
        *sorted(evidence.glob("storyboard/*.jpg")),
    ]
    return next((name for path in found if (name := _inside(store, path))), "")


def _film(store: Store, folder: Path, evidence: Path) -> str:
    """Its film: of those that lie together the author's, else the first by name."""
    films = [sorted((place / "video").glob("*.mp4")) for place in (folder / "accepted", evidence)]
    ordered = [sorted(some, key=lambda path: path.stem != "film") for some in films]
    return next((name for some in ordered for path in some if (name := _inside(store, path))), "")


def _result(path: Path) -> PassResult | None:
    try:
        return PassResult.model_validate_json(path.read_bytes())
    except (OSError, ValueError):
        return None
