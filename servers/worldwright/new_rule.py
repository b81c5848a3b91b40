"""`worldwright new-rule RUN` scaffolds a lint rule from a failed iteration, so that no other run meets the same cause.

Without `--name` it lists what failed in the run's journal. With it, a module is written on a shelf of rules: docstring,
code, cases and evidence are laid out, the failure and its lines of the program are quoted, and everything
left to the author is marked `AUTHOR:`. The new rule finds nothing until it is written, and its tests fail until then.
Source: the reference paper's write-back of root causes.
"""

import ast
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import click

from worldkit.files import write_atomic

from .cli import report_errors
from .model import json_object
from .model.errors import NotFoundError, WorldwrightError
from .model.evidence.run import Run

RULES = Path(__file__).parent / "lint" / "rules"
PREFIXES = {"program": "WL", "model": "WM", "run": "WR", "plan": "WP"}
NAME = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)+")
AROUND = 4
"""So many lines of the program are quoted on each side of the failed one."""


@dataclass(frozen=True)
class Failure:
    """A failed iteration."""

    number: int
    """Position in the journal, from 1."""
    what: str
    why: str
    excerpt: str = ""
    """Lines of the program around the place, when the place is known."""


def failures(run: Run) -> list[Failure]:
    """Every entry of the journal that tells of a failure, in its order."""
    found = []
    for number, entry in enumerate(run.entries(), 1):
        action = entry.get("action")
        if action == "lint" and entry.get("ok") is False:
            codes = ", ".join(map(str, entry.get("codes") or ())) or "see lint.json"
            found.append(Failure(number, "the program did not lint clean", codes))
        elif action == "stage" and entry.get("ok") is False:
            found.append(_pass(run, number, entry))
        elif action in ("scan", "expect") and entry.get("ok") is False:
            found.append(Failure(number, f"{action} said no", _kept(run, str(entry.get("key")), action)))
        elif action == "review" and entry.get("outcome") == "repair":
            target = entry.get("repair_target") or entry.get("target") or "no target named"
            found.append(Failure(number, "a review ordered a repair", str(target)))
        elif action == "block":
            found.append(Failure(number, "the run was blocked", str(entry.get("cause", ""))))
    return found


def _pass(run: Run, number: int, entry: dict) -> Failure:
    """Read a failed pass: the program's own words, and the lines at which it failed."""
    folder = run.jobs / str(entry.get("job"))
    result = json_object.read(folder / "result.json") or {}
    place, said = str(result.get("place", "")), str(result.get("message", ""))
    line = place.rpartition(":")[2]
    excerpt = ""
    if line.isdigit():
        try:
            lines = (folder / "inputs" / "simulation.py").read_text(encoding="utf-8").splitlines()
        except OSError:
            lines = []
        excerpt = "\n".join(lines[max(0, int(line) - 1 - AROUND) : int(line) + AROUND])
    why = said or str(entry.get("code") or "see the job's log")
    return Failure(number, f"the {entry.get('stage')} pass failed", f"{place}: {why}" if place else why, excerpt)


def _kept(run: Run, key: str, action: str) -> str:
    """The first complaint of a kept report."""
    report = json_object.read(run.folder / "evidence" / key / f"{action}.json") or {}
    for anomaly in report.get("anomalies") or ():
        return str(anomaly.get("message", ""))
    for objective in report.get("objectives") or ():
        if objective.get("status") not in ("proved", "visual_only"):
            return f"{objective.get('claim')}: {objective.get('status')}"
    return "see its report"


def next_code(shelf: str, rules: Path) -> str:
    """The code after the highest on a shelf; codes are never reused, and 199 stays the last of its hundred."""
    prefix, used = PREFIXES[shelf], [100]
    for path in (rules / shelf).glob("*.py"):
        used += [
            int(n) for n in re.findall(rf'^CODE = "{prefix}(\d{{3}})"', path.read_text(encoding="utf-8"), re.MULTILINE)
        ]
    return f"{prefix}{max([n for n in used if n != 199]) + 1}"


RULE_HEAD = '''"""AUTHOR: what is wrong, in one sentence.

What it does: AUTHOR: what it looks for, and where it stays silent.

Why is this bad: AUTHOR: what happens, as the installed simulator showed it.{seen}

Use instead: AUTHOR: the right form.
"""
'''
EMPTY_PROGRAM = "AUTHOR = 'the smallest program'\n"
BODIES = {
    "program": '''
from collections.abc import Iterator

from ...problem import Problem
from ...program_view import Program
from ...harm import Argued

CODE = "{code}"
SEVERITY = "warning"
SCOPE = "any"
# AUTHOR: cut BAD down to the fewest lines that show the fault; GOOD is the same, done right.
GOOD = ("x = 1\\n",)
BAD = ({excerpt},)
EVIDENCE = Argued("AUTHOR: replace this by Raises, Warns or Measured, or say why no run can show the harm")


def check(program: Program) -> Iterator[Problem]:
    """AUTHOR: yield a Problem for every hit."""
    yield from ()
''',
    "model": '''
from collections.abc import Iterator

from ...compiled.view import ModelView
from ...problem import Problem
from ...harm import Argued

CODE = "{code}"
SEVERITY = "warning"
SCOPE = "any"
# AUTHOR: the smallest worlds that show the fault, and the same done right.
GOOD = ("<mujoco/>",)
BAD = ("<mujoco/>",)
EVIDENCE = Argued("AUTHOR: replace this by Raises, Warns or Measured, or say why no run can show the harm")


def check(view: ModelView) -> Iterator[Problem]:
    """AUTHOR: yield a Problem for every hit."""
    yield from ()
''',
    "run": '''
from collections.abc import Iterator

from ...harm import Argued
from ...observed.run_view import Run
from ...problem import Problem

CODE = "{code}"
SEVERITY = "warning"
# AUTHOR: cut BAD down to the fewest lines that show the fault; GOOD is the same, done right. Both are run under watch.
GOOD = ("import mujoco\\n",)
BAD = ({excerpt},)
EVIDENCE = Argued("AUTHOR: replace this by Raises, Warns or Measured, or say why no run can show the harm")


def check(run: Run) -> Iterator[Problem]:
    """AUTHOR: yield from run.say(EVENT, message, fix); a module of lint/observed/inside tells the event."""
    yield from ()
''',
    "plan": '''
from collections.abc import Iterator

from ...case import Changes
from ...plan_view import PlanView
from ...problem import Problem
from ...harm import Argued

CODE = "{code}"
SEVERITY = "warning"
# AUTHOR: changes to lint/case.py's SOUND_PLAN that show the fault, and changes that do not.
GOOD: Changes = ({{}},)
BAD: Changes = ({{"title": "AUTHOR"}},)
EVIDENCE = Argued("AUTHOR: replace this by Measured, or say why no run can show the harm")


def check(view: PlanView) -> Iterator[Problem]:
    """AUTHOR: yield view.at(place, message, fix) for every hit."""
    yield from ()
''',
}


def quoted(failure: Failure, slug: str = "") -> tuple[str, str]:
    """(the failure for a rule's docstring, its lines of the program as a literal)."""
    source = "\n".join(failure.excerpt.splitlines()) + "\n" if failure.excerpt else EMPTY_PROGRAM
    why = " ".join(failure.why.replace("\\", "/").replace('"""', "'''").split())[:400]
    where = f"run {slug}, " if slug else ""
    return f" Seen in {where}journal entry {failure.number}:\n{failure.what}: {why}", repr(source)


def chosen(run: Path, entry: int | None) -> Failure:
    """A failure of a run by the number of its entry, or the latest; a `NotFoundError` lists the known ones."""
    found = failures(folder := Run.find(str(run)))
    meant = [failure for failure in found if entry is None or failure.number == entry]
    if not meant:
        known = "\n".join(f"{f.number:4}  {f.what}: {f.why.splitlines()[0] if f.why else ''}" for f in found)
        raise NotFoundError(
            "there is no such failure", place=str(folder.folder), next_move=f"name one of:\n{known or '(none)'}"
        )
    return meant[-1]


def scaffold(run: Run, failure: Failure, name: str, shelf: str, rules: Path | None = None) -> Path:
    """Write the module and return its path.

    Raises:
        WorldwrightError: the name is taken, or is no name for a rule.
    """
    rules = rules or RULES
    if not NAME.fullmatch(name):
        raise WorldwrightError(
            f"'{name}' is no name for a rule", next_move="name the defect: lower case, words joined by _"
        )
    taken = list(rules.glob(f"*/{name}.py"))
    if taken:
        raise WorldwrightError(
            f"there is a rule {name}", place=str(taken[0]), next_move="extend it, or take another name"
        )
    if not (rules / shelf).is_dir():
        raise NotFoundError("this is no source checkout: there is no shelf to write on", place=str(rules / shelf))
    seen, excerpt = quoted(failure, run.folder.name)
    text = (RULE_HEAD + BODIES[shelf]).format(code=next_code(shelf, rules), seen=seen, excerpt=excerpt)
    ast.parse(text)  # a quoted failure must not make the shelf unloadable
    path = rules / shelf / f"{name}.py"
    write_atomic(path, text)
    return path


@click.command("new-rule")
@click.argument("run", type=click.Path(path_type=Path))
@click.option("--name", help="The defect, e.g. spring_without_damping; without it, the failures are listed.")
@click.option("--entry", type=int, help="Number of the failed entry in the journal; default: the latest.")
@click.option("--shelf", type=click.Choice(list(PREFIXES)), default="program", show_default=True)
def command(run: Path, name: str | None, entry: int | None, shelf: str) -> None:
    """Scaffold a lint rule from a failed iteration of RUN."""

    def work() -> int:
        found = failures(folder := Run.find(str(run)))
        known = "\n".join(f"{f.number:4}  {f.what}: {f.why.splitlines()[0] if f.why else ''}" for f in found)
        if name is None:
            click.echo(known or "nothing failed in this run")
            return 0
        path = scaffold(folder, chosen(run, entry), name, shelf)
        click.echo(f"{path}: fill in what is marked AUTHOR:, then")
        click.echo("    python -m pytest -q tests/worldwright/lint -k CODE     # its cases and its evidence")
        click.echo("    python -m worldwright.lint.reference                   # the page of rules")
        return 0

    sys.exit(report_errors(work))
