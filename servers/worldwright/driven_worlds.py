"""`worldwright drive`: what is left of live drives: list them, prove one again, film it."""

import sys
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from .ends.driven import Driven


@click.group("drive", no_args_is_help=True)
def command() -> None:
    """What is left of live drives: list them, prove one again, film it. DRIVE is a folder of RUN/drives, or RUN for the newest."""


@command.command("list")
@click.argument("run")
def list_(run: str) -> None:
    """The drives of a run, with who drove, and whether they are proved."""
    from .cli import report_errors

    def told() -> None:
        from .ends import drive_folder, driven
        from .model.errors import GateError
        from .model.evidence.run import Run
        from .model.printable import line

        for folder in driven.listed(Run.find(run).folder):
            if not (folder / driven.STATEMENT).is_file():
                click.echo(f"{folder}: not proved yet, worldwright drive prove {folder}")
                continue
            try:
                said = drive_folder.statement(folder).predicate
            except GateError as cause:
                click.echo(f"{folder}: {line(cause.cause)}")
                continue
            names = ", ".join(dict.fromkeys(line(span.driver) for span in said.driven_by))
            click.echo(f"{folder}: {said.simulated_s:.1f} s, {names or 'nobody'}")

    report_errors(told)


@command.command("prove")
@click.argument("name", metavar="DRIVE")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text")
def prove_(name: str, style: str) -> None:
    """Drive it again by its stream, in a clean process, and compare; finish one whose process was killed.

    Exit status 3: proved, but signed by no key that is known here.
    """
    from .cli import report_errors, show

    def proved() -> "Driven":
        from .ends import driven

        return driven.prove(driven.find(name))

    found = report_errors(proved, style)
    show(found, style)
    sys.exit(found.exit_code)


@command.command("film")
@click.argument("name", metavar="DRIVE")
@click.option("--camera", "cameras", multiple=True, help="Of the plan; all of them without it.")
def film_(name: str, cameras: tuple[str, ...]) -> None:
    """Film a proved drive through the plan's cameras, into its folder."""
    from .cli import report_errors

    def filmed() -> None:
        from .ends import drive_film, driven

        for path in drive_film.film(driven.find(name), cameras):
            click.echo(str(path))

    report_errors(filmed)
