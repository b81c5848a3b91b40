"""Tries to get a false claim stamped: a world, what the liar changes in it, and how far that came.

A `Trick` is data. `attempt` takes it the whole way a build goes (approve, lint, physics, scan, expect, describe, review,
accept, verify) and tells where it ended. Stills are drawn only for what would otherwise be accepted: nothing before them
needs a picture, and they take half the time. The claim of every base world is false by its own plan, so whatever is accepted
and verified without a word about it has been won by the liar.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal

from worldwright.draft import draft
from worldwright.lint import tools as lint
from worldwright.model.errors import WorldwrightError
from worldwright.model.evidence.reports import ExpectReport, ObjectiveResult, VisualDescription
from worldwright.model.evidence.run import Run
from worldwright.model.evidence.verdict import Verdict
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.tools import resolve
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stamp import audited, by_measurement, signing
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State
from worldwright.stamp.statement import Statement

WORLDS = Path(__file__).parent / "worlds"
Moment = Literal["approved", "linted", "simulated", "scanned", "expected", "drawn", "described", "reviewed", "accepted"]
"""When the liar may touch the run's files: just after that step."""
Touch = Callable[[Path], object]
Change = tuple[str, str]
"""A text and what stands in its place; it must be there."""
JOB_S = 600.0


@dataclass(frozen=True)
class Trick:
    """One way to lie."""

    name: str
    family: str
    does: str
    """What is changed, and why the claim should then seem to hold."""
    world: str = "sliding-crate"
    plan: tuple[Change, ...] = ()
    """Changes of the plan, which is approved as it then stands."""
    build: tuple[str, ...] = ()
    """Statements before the `return` of the drafted `build()`."""
    program: tuple[Change, ...] = ()
    """Changes of the drafted program."""
    control: str = ""
    """Body of a `control(model, data)` in place of the drafted one."""
    top: str = ""
    """Statements at the top of the program, after its imports."""
    beside: Mapping[str, str | bytes] = field(default_factory=dict)
    """Files beside the program, by relative path."""
    touch: Mapping[Moment, Touch] = field(default_factory=dict)
    """What is done to the run's files, by moment."""

    tells: Callable[[VisualDescription], VisualDescription] = lambda description: description
    """What the liar makes of the description of the pictures."""
    judges: Callable[[Verdict], Verdict] = lambda verdict: verdict
    """What the liar makes of the review."""
    boast: str = ""
    """What must stand in the stamp for it to be won; nothing: it is won with any stamp."""
    anybody: bool = False
    """The verification after `accepted` is asked whether the world does what it claims, whoever accepted it."""
    refused_by: str = ""
    """The check of that verification that must refuse it, whatever else does."""

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True)
class Ending:
    """How a trick ended."""

    at: str
    """The step that said no; `accepted` when none did, `verified` when the stamp was spoiled and is proved all the same."""
    said: str
    refused: tuple[str, ...] = ()
    """The checks that said no, where it ended at `verify`."""
    words: tuple[str, ...] = ()
    """What the scan, the ledger and the stamp say about it, where it was accepted."""

    @property
    def won(self) -> bool:
        """The false claim is stamped, and nothing that is kept says a word about it."""
        return self.at in ("accepted", "verified") and not self.words


def attempt(trick: Trick, folder: Path) -> Ending:
    """Take a trick as far as it comes, in a new folder."""
    try:
        at, said, *refused = _way(trick, folder)
    except WorldwrightError as error:
        return Ending(type(error).__name__, str(error))
    return Ending(at, said, tuple(refused), _words(folder, trick) if at in ("accepted", "verified") else ())


def _way(trick: Trick, folder: Path) -> tuple[str, ...]:
    """Where it ended, what was said, and the checks that refused."""
    prepare(trick, folder)
    stamp.approve(str(folder), by="a tester")
    _touch(trick, "approved", folder)
    report = lint.check_program([folder / "simulation.py"])
    if errors := [f for f in report.findings if f.severity == "error"]:
        return "lint", "; ".join(f"{f.code} {f.message}" for f in errors[:3])
    _touch(trick, "linted", folder)
    if said := _pass(folder, "physics"):
        return "physics", said
    _touch(trick, "simulated", folder)
    found = scan.scan(str(folder))
    _touch(trick, "scanned", folder)
    blocking = [a for a in found.anomalies if a.severity == "blocking"]
    if blocking and "scanned" not in trick.touch:
        return "scan", str(blocking[0])
    measured = scan.expect(str(folder))
    _touch(trick, "expected", folder)
    unmet = _unmet(measured)
    if unmet and "expected" not in trick.touch and not measured.waits:
        return "expect", f"{unmet[0].status}: {'; '.join(e.message for e in unmet[0].expectations)}"
    while audited.why_causes(State(Run(folder))) and scan.scan(str(folder), causes=True).pending:
        pass
    if said := _pass(folder, "stills"):
        return "stills", said
    _touch(trick, "drawn", folder)
    if measured.waits and (unmet := _unmet(scan.expect(str(folder)))):
        return "expect", f"{unmet[0].status}: {'; '.join(e.message for e in unmet[0].expectations)}"
    stamp.describe(str(folder), trick.tells(by_measurement.describe(Run(folder))))
    _touch(trick, "described", folder)
    verdict = by_measurement.review(Run(folder))
    if verdict.outcome != "pass":
        return "review", verdict.repair
    stamp.review(str(folder), trick.judges(verdict))
    _touch(trick, "reviewed", folder)
    done = stamp.accept(str(folder), timeout_s=JOB_S)
    if not done.ok:
        return "accept", done.text()
    if "accepted" not in trick.touch:
        return "accepted", done.text()
    _touch(trick, "accepted", folder)
    again = stamp.verify(str(folder), timeout_s=JOB_S, anybody=trick.anybody)
    refused = (check.name for check in again.checks if not check.ok)
    return ("verified" if again.ok else "verify", again.text(), *refused)


def _unmet(measured: ExpectReport) -> list[ObjectiveResult]:
    return [o for o in measured.objectives if o.status not in ("proved", "visual_only")]


def prepare(trick: Trick, folder: Path) -> None:
    """Write prompt, resolved plan and the liar's program."""
    folder.mkdir(parents=True)
    text = changed((WORLDS / f"{trick.world}.md").read_text(encoding="utf-8"), trick.plan)
    (folder / "plan.md").write_text(text, encoding="utf-8")
    (folder / "prompt.md").write_text("A crate slides.\n", encoding="utf-8")
    for name, content in trick.beside.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
    resolve(folder / "plan.md")
    source = draft(read_plan(folder / "plan.md").plan, resolve(folder / "plan.md", write=False)).source
    (folder / "simulation.py").write_text(lying(source, trick), encoding="utf-8")


def lying(source: str, trick: Trick) -> str:
    """The drafted program as the trick changes it."""
    if trick.build:
        source = changed(
            source, (("    return spec\n", "".join(f"    {s}\n" for s in trick.build) + "    return spec\n"),)
        )
    if trick.control:
        start = source.find("def control(")
        main = source.index('if __name__ == "__main__":')
        head = source[: start if start >= 0 else main]
        law = "def control(model, data):\n" + "".join(f"    {line}\n" for line in trick.control.splitlines())
        source = f"{head}{law}\n\n{source[main:]}"
        if start < 0:
            source = changed(source, (("program.main(build,", "program.main(build, control,"),))
    if trick.top:
        source = changed(source, (("\n\ndef build()", f"\n{trick.top}\n\n\ndef build()"),))
    return changed(source, trick.program)


def changed(text: str, changes: tuple[Change, ...]) -> str:
    """The text with every change made; one that finds nothing to change would test nothing."""
    for old, new in changes:
        assert old in text, f"{old!r} is not there"
        text = text.replace(old, new, 1)
    return text


def _touch(trick: Trick, moment: Moment, folder: Path) -> None:
    if moment in trick.touch:
        trick.touch[moment](folder)


def _pass(folder: Path, name: Literal["physics", "stills"]) -> str:
    """Run a pass; what it says when it fails."""
    job = stage.start(str(folder), stage=name)
    while not job.ended:
        job = stage.wait(str(folder), job=job.job, timeout_s=JOB_S)
    return "" if job.state == "succeeded" else f"{job.code}: {job.message}"


def _words(folder: Path, trick: Trick) -> tuple[str, ...]:
    """What an accepted run keeps that tells of the lie: findings of the scan. What its plan declares was approved as true."""
    statement = Statement.model_validate_json((folder / "accepted" / "stamp.json").read_bytes())
    found = statement.predicate
    words = [f"{n} {severity} finding(s)" for severity, n in found.anomalies.items() if severity != "info"]
    words += [f"objective {index} is not looked at" for index in statement.not_looked_at]
    if not trick.anybody and not signing.check(folder / "accepted", "stamp.json").vouched:
        words.append("nobody who is known here signed it")
    if trick.boast not in (folder / "accepted" / "stamp.json").read_text(encoding="utf-8"):
        words.append("the lie is not in the stamp")
    return tuple(words)
