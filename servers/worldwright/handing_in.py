"""`worldwright hand-in RUN FILE`: take in a film that the author drew with a renderer of their own."""

from pathlib import Path

import click

from worldkit.files import write_atomic

from .cli import report_errors
from .model.evidence import handed_in
from .model.evidence.run import Run
from .model.storage import writing


def take(run: Run, film: Path) -> handed_in.HandedIn:
    """Copy a film into a run, in place of one that was handed in before.

    Raises:
        HandedInError: it is no film that can be shown.
    """
    data = handed_in.content(film, linked=True)
    told = handed_in.looked_at(film, data)
    with writing("the handed-in film", run.folder):
        write_atomic(run.folder / told.name, data)
        for name in handed_in.NAMES:
            if name != told.name:
                (run.folder / name).unlink(missing_ok=True)
    return told


@click.command("hand-in")
@click.argument("run")
@click.argument("film", type=click.Path(path_type=Path))
def command(run: str, film: Path) -> None:
    """Hand in a film of a run that you drew yourself (.mp4, .webm, .mov).

    The report shows it as its author's, and the stamp lists its hash. It is never evidence: nothing compares it with the
    recording, and no claim may rest on it.
    """

    def work() -> None:
        told = take(Run.find(run), film)
        click.echo(
            f"{told.name}: {told.seconds:g} s, {told.size[0]}x{told.size[1]}, shown as the author's, no evidence"
        )
        click.echo("  an accepted run stays accepted; the stamp lists the film when it is accepted anew")
        click.echo(f"  next: worldwright report {run}")

    report_errors(work)
