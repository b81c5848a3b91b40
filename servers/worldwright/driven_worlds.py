"""`worldwright drive`: what is left of live drives: list them, prove one again, film it, make a run of it."""

import sys
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from .ends.driven import Driven


@click.group("drive", no_args_is_help=True)
def command() -> None:
    """What is left of live drives: list them, prove one again, film it, keep it as a run. DRIVE is a folder of RUN/drives, or RUN for the newest."""


@command.command("list")
@click.argument("run")
def list_(run: str) -> None:
    """The drives of a run, with who drove and who signed, held against their files; only `prove` drives them again."""
    from .cli import report_errors

    def told() -> None:
        from .ends import driven
        from .model.errors import WorldwrightError
        from .model.evidence.run import Run
        from .model.printable import line

        for folder in driven.listed(Run.find(run).folder):
            try:
                said = driven.checked(folder)
            except WorldwrightError as cause:
                click.echo(f"{folder}: {line(cause.cause)}; {line(cause.next_move)}")
                continue
            names = ", ".join(dict.fromkeys(line(span["driver"]) for span in said.driven_by))
            apart = f"; NOT OF THIS RUN AS IT IS: {line(said.apart)}" if said.apart else ""
            click.echo(f"{folder}: {said.simulated_s:.1f} s, {names or 'nobody'}; {said.signed}{apart}")

    report_errors(told)


@command.command("prove")
@click.argument("name", metavar="DRIVE")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text")
def prove_(name: str, style: str) -> None:
    """Drive it again by its stream, in a clean process, and compare; finish, unsigned, one whose process was killed.

    Exit status 3: proved, but not signed by the live run with a key that is known here.
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

        made, stated = drive_film.film(driven.find(name), cameras)
        for path in made:
            click.echo(str(path))
        if not stated.vouched:
            click.echo(f"not checked: {stated.signed}; next: worldwright drive prove {stated.folder}", err=True)

    report_errors(filmed)


@command.command("keep")
@click.argument("name", metavar="DRIVE")
@click.option("--as", "run", required=True, help="The run's folder.")
@click.option("--check", is_flag=True, help="It was made: hold its recording against the drive.")
def keep_(name: str, run: str, check: bool) -> None:
    """Make a run of a drive, whose program gives the recorded commands: it is scanned, filmed and accepted as any other."""
    from .cli import report_errors

    def kept() -> None:
        from pathlib import Path

        from .ends import driven, kept_drive

        folder = driven.find(name)
        if check:
            rows = kept_drive.same(kept_drive.recording_of(Path(run)), folder)
            click.echo(f"{run} moves as {folder.name}: it passes through {rows} rows recorded live, bit for bit")
            return
        stated = kept_drive.keep(folder, Path(run))
        click.echo(f"{run}: {stated.simulated_s:.2f} s; {stated.signed}")
        click.echo(
            f"next: read {run}/plan.md, whose objectives are those of the world that was driven; worldwright go {run} --approve; "
            f"worldwright drive keep {name} --as {run} --check"
        )

    report_errors(kept)
