"""`worldwright report RUN`: write the run's page, and a Rerun recording when asked."""

import click

from ..cli import report_errors


@click.command("report")
@click.argument("run")
@click.option(
    "--rerun", "recording", is_flag=True, help="Also write recording.rrd for the Rerun viewer (extra `view`)."
)
@click.option(
    "--replay/--no-replay", default=True, help="Also write scene.glb, which the page shows to be turned by hand."
)
def command(run: str, recording: bool, replay: bool) -> None:
    """Write a run's self-contained report.html; works for half-finished and blocked runs too."""

    def work() -> None:
        from .. import exported
        from ..model.errors import WorldwrightError
        from ..stamp.state import State
        from . import write

        found = State.find(run).run
        if replay:
            try:
                exported.write(found)
            except WorldwrightError as without:  # a page about what there is comes out all the same
                click.echo(f"no replay: {without.cause}", err=True)
        click.echo(str(write(found)))
        if recording:
            from .rerun import record

            click.echo(str(record(found)))

    report_errors(work)
