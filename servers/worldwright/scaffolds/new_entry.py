"""`worldwright new KIND NAME` writes one new file on a shelf, or of a seam, and tells what to do next.

The code is chosen, the cases are laid out, one of them fails, and everything left to the author is marked AUTHOR. A lint
rule can quote the failed iteration of a run that it comes from: `--run RUN`, `--entry N`.
"""

import ast
import re
import sys
from pathlib import Path

import click

from worldkit.files import write_atomic

from ..cli import report_errors
from ..model.errors import NotFoundError, WorldwrightError
from ..new_rule import EMPTY_PROGRAM, NAME, Failure, chosen, quoted
from .kinds import HERE, KINDS, Kind
from .seam_kinds import SEAMS
from .seam_texts import SEAM_TEXTS
from .texts import TEMPLATE, TEXTS


def scaffold(kind: str, name: str, family: str = "", failure: Failure | None = None, root: Path = HERE) -> list[Path]:
    """Write a new entry; returns its files.

    Args:
        kind: one of `KINDS`, or of `SEAMS`.
        name: the defect, the claim or the relation: lower case, words joined by `_`; for a seam one word will do.
        family: the folder of a shelf that has folders.
        failure: a failed iteration that a lint rule quotes.
        root: the folder of the package `worldwright` to write into.

    Raises:
        WorldwrightError: the name is not valid, or taken.
        NotFoundError: there is no such family, or this is no source checkout.
    """
    if kind in SEAMS:
        return [_scaffold_seam(kind, name, root)]
    of = KINDS[kind]
    if not NAME.fullmatch(name):
        raise WorldwrightError(
            f"'{name}' is no name for a {kind}", next_move="two words or more, in lower case, joined by _"
        )
    _free(name, root)
    folder = _folder(of, family, root)
    code = of.code(of.open(), folder, name)
    if code in of.open():
        raise WorldwrightError(f"there is a {kind} {code}", next_move="extend it, or choose another name")
    seen, bad = quoted(failure) if failure else ("", repr(EMPTY_PROGRAM))
    text = TEXTS[kind].format(name=name, code=code, seen=seen, excerpt=bad)
    ast.parse(text)  # a quoted failure must not make the shelf unloadable
    files = {folder / f"{name}.py": text}
    if kind == "section":
        files[root / "report" / "templates" / f"{name}.html"] = TEMPLATE.format(name=name)
    for path, said in files.items():
        write_atomic(path, said)
    return list(files)


def _scaffold_seam(kind: str, name: str, root: Path) -> Path:
    """Write a new entry of a seam; returns its file."""
    if not re.fullmatch(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*", name):
        raise WorldwrightError(
            f"'{name}' is no name for a {kind}", next_move="two words or more, in lower case, joined by _"
        )
    _free(name, root)
    folder = root.parent / SEAMS[kind].folder
    if not folder.is_dir():
        raise NotFoundError("this is no source checkout: there is no folder to write in", place=str(folder))
    path = folder / f"{name}.py"
    write_atomic(path, SEAM_TEXTS[kind].format(name=name))
    return path


def _free(name: str, root: Path) -> None:
    """Refuse a name that a module has already."""
    if taken := [*sorted(root.parent.rglob(f"{name}.py")), *sorted(root.parent.rglob(f"{name}/__init__.py"))]:
        raise WorldwrightError(
            f"there is a module {name}", place=str(taken[0]), next_move="extend it, or choose another"
        )


def _folder(of: Kind, family: str, root: Path) -> Path:
    folder = root / of.folder
    if not folder.is_dir():
        raise NotFoundError("this is no source checkout: there is no shelf to write on", place=str(folder))
    if not of.families:
        return folder
    known = sorted(path.parent.name for path in folder.glob("*/__init__.py"))
    if family not in known:
        cause = f"there is no family {family!r}" if family else "this shelf has families: say which"
        raise NotFoundError(cause, next_move=f"--family: {', '.join(known)}")
    return folder / family


@click.command("new")
@click.argument("kind", type=click.Choice([*KINDS, *SEAMS]))
@click.argument("name")
@click.option("--family", default="", help="The folder of an expectation, e.g. kinematics.")
@click.option("--run", type=click.Path(path_type=Path), help="A run whose failed iteration a lint rule quotes.")
@click.option("--entry", type=int, help="Number of the failed entry in that run's journal; default: the latest.")
def command(kind: str, name: str, family: str, run: Path | None, entry: int | None) -> None:
    """Scaffold an entry of a shelf or of a seam: a case that fails, and what is left to write marked AUTHOR."""

    def work() -> int:
        of = SEAMS.get(kind) or KINDS[kind]
        for path in scaffold(kind, name, family, chosen(run, entry) if run else None):
            click.echo(f"{path}: write what is marked AUTHOR")
        click.echo("what such an entry defines:")
        for attribute, meaning in of.members():
            click.echo(f"    {attribute:<14} {meaning}")
        if of.also:
            click.echo(of.also)
        click.echo(f"then: python -m pytest -q {of.tests} -k {name}")
        for page in of.pages:
            click.echo(f"      {page}")
        return 0

    sys.exit(report_errors(work))
