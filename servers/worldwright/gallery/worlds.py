"""The accepted worlds of a checkout, and the folders in which they are built again."""

import shutil
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import NotFoundError
from ..model.evidence.run import Run
from ..stamp import bundle, keyring
from ..stamp.kept import Kept
from ..stamp.statement import Statement

EXAMPLES = Path("examples")
BUILT = Path("runs") / "gallery"
"""The folder of each world with its recording, films and report; a cache that may be deleted."""
ANEW = Path("runs") / "accept"
"""The folder of worlds on their way to a new stamp."""


def vouched() -> bool:
    """Whether the checkout lists the keys that sign its examples; every example then needs one of these."""
    return (EXAMPLES / keyring.KNOWN).is_file()


def slugs(wanted: tuple[str, ...] = ()) -> list[str]:
    """The names of all worlds, or of the wanted ones (also given as `examples/NAME`).

    Raises:
        NotFoundError: there is no world of that name, or no `examples/` here.
    """
    known = sorted(path.parent.name for path in EXAMPLES.glob("*/plan.md"))
    names = [Path(name).name for name in wanted]
    missing = [name for name in names if name not in known]
    if missing or not known:
        raise NotFoundError(
            f"there is no accepted world named {', '.join(missing)}" if missing else "there are no examples here",
            place=str(EXAMPLES),
            next_move=f"name some of: {', '.join(known)}" if known else "call it from the root of the repository",
        )
    return names or known


def seeded(slug: str) -> Run:
    """The folder in which a world is built: a copy of its small form, made anew if that has another stamp."""
    source, target = EXAMPLES / slug, BUILT / slug
    stamp = source / "stamp.json"
    same = target.is_dir() and _bytes(target / "stamp.json") == _bytes(stamp)
    if not same:
        shutil.rmtree(target, ignore_errors=True)
        left = bundle.left_by_builds(Kept.read(stamp, Statement).value)
        shutil.copytree(source, target, ignore=lambda folder, _: left if Path(folder) == source else set())
    return Run(target)


def restarted(slug: str, redraft: bool = False) -> Run:
    """The folder in which a world is accepted anew: its prompt, its plan, its program and film, and what belongs to them.

    With `redraft`, a program that was drafted from the plan is left out, so that the present code drafts it again. A folder
    that was accepted in another environment (an older suite, engine or catalog) begins again from nothing.
    """
    from ..go import started_from
    from ..model import companions
    from ..model.evidence import environment, pictures_of
    from ..stamp.state import State

    source, before = Run(EXAMPLES / slug), State(Run(ANEW / slug)).stamp.value
    if before is not None and before.predicate.environment != environment.current():
        shutil.rmtree(ANEW / slug)
    target = started_from(source, ANEW / slug)
    own = source.program.is_file() and not (redraft and drafted(source))
    if own and (not target.program.exists() or drafted(target)):
        for name, content in {**companions.of(source.program), **pictures_of.files(source)}.items():
            write_atomic(target.folder / name, content)
        write_atomic(target.program, source.program.read_bytes())
    return target


def drafted(run: Run) -> bool:
    """Whether, by the journal, the program is still the draft."""
    from ..model.evidence.run import sha256_file

    present = sha256_file(run.program)
    return any(e.get("action") == "draft" and e.get("program_sha256") == present for e in run.entries())


def _bytes(path: Path) -> bytes:
    return path.read_bytes() if path.is_file() else b""
