"""What lies in a run beside its accepted folder, and is another than what was accepted: a genuine stamp says nothing of it."""

from collections.abc import Iterator
from pathlib import Path

from ..model.evidence.run import Run, sha256_file
from .statement import Statement

COPIED = ("evidence", "stills", "video")


def other(run: Run, statement: Statement) -> Iterator[str]:
    """Prompt, reports and pictures of the accepted key that differ from the accepted ones, or are links, by path in the run."""
    for subject in statement.subject:
        for path in _of(run, subject.name, statement.predicate.source.key):
            if path.is_file() and (path.resolve() != path or sha256_file(path) != subject.digest.sha256):
                yield path.relative_to(run.folder).as_posix()


def _of(run: Run, name: str, key: str) -> Iterator[Path]:
    """Where a file of the accepted folder was copied from; nothing for what was made for it."""
    top, *below = Path(name).parts
    if name == run.prompt.name:
        yield run.prompt
    elif top in COPIED and len(below) == 1 and key.isalnum():
        evidence = run.evidence(key)
        if top != "evidence":
            yield evidence / name
        else:  # a report, or the result of a pass
            yield from (evidence / below[0], evidence / Path(below[0]).stem / "result.json")
