"""What lies in a run beside its accepted folder, and is another than what was accepted: a genuine stamp says nothing of it."""

from collections.abc import Iterator
from pathlib import Path

from ..model.evidence.run import Run, sha256_file
from . import digest, poster, sampled
from .proof import WORLD
from .statement import Statement

COPIED = ("evidence", "stills", "video")
MADE = (digest.NAME, sampled.NAME, WORLD, poster.NAME, "world")
"""What an acceptance makes: nothing in the run was copied to it."""
HELD = (
    "plan.md", "simulation.py", "journal.jsonl", "blocked.json", "environment.lock", "accepted", "earlier", "evidence", "jobs", "rehearsal",
    "proof", "out", "report.html",
)  # fmt: skip
"""What lies at the top of every run: held against its stamp, nothing that a person looks at, or drawn anew by our own commands, whose
word it is: a note that every honest run bears would be read by nobody."""
MADE_SINCE = "final"
"""The pass whose films no acceptance takes."""


def other(run: Run, statement: Statement) -> Iterator[str]:
    """The program, and what of prompt, film, files beside them, reports and pictures of the accepted key was copied, where it
    differs from the accepted or is a link, by path in the run. Whoever goes on with a run makes such: they are no lies yet.
    """
    program = run.program
    if program.is_file() and (_led(program) or sha256_file(program) != statement.predicate.source.program_sha256):
        yield program.name
    for subject in statement.subject:
        for path in _of(run, subject.name, statement.predicate.source.key):
            if path.is_file() and (_led(path) or sha256_file(path) != subject.digest.sha256):
                yield path.relative_to(run.folder).as_posix()


def added(run: Run, statement: Statement) -> Iterator[str]:
    """What lies in the run and nothing accepted was copied from, by path in it: a film or a report made since, by whomever."""
    listed = {Path(s.name).parts[0] for s in statement.subject if Path(s.name).parts} - {*COPIED, *MADE}
    for path in sorted(run.folder.iterdir()):
        named = path.name in listed or path.name in HELD or path.name.startswith((".", "__pycache__"))
        if not named and path.name not in statement.predicate.source.materials:
            yield f"{path.name}{'/' * path.is_dir()}"
    key = statement.predicate.source.key
    if key.isalnum() and (final := run.evidence(key) / MADE_SINCE).exists():
        yield f"{final.relative_to(run.folder).as_posix()}/"


def _led(path: Path) -> bool:
    """Whether a file, or a folder on the way, is a link."""
    return path.resolve() != path


def _of(run: Run, name: str, key: str) -> Iterator[Path]:
    """Where a file of the accepted folder was copied from; nothing for what was made for it."""
    top, *below = Path(name).parts or ("..",)
    if name == run.prompt.name:
        yield run.prompt
    elif top in COPIED and len(below) == 1 and key.isalnum():
        evidence = run.evidence(key)
        if top != "evidence":
            yield evidence / name
        else:  # a report, or the result of a pass
            yield from (evidence / below[0], evidence / Path(below[0]).stem / "result.json")
    # the plan is compared by itself, the program is stripped, and a name that leads elsewhere is damage
    elif not {"..", "/"} & {top, *below} and top not in (*MADE, *COPIED, run.plan.name, run.program.name):
        yield run.folder / name
