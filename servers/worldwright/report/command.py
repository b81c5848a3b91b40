"""`worldwright report RUN`: write the run's page, and a Rerun recording when asked."""

import click

from ..cli import report_errors


@click.command("report")
@click.argument("run")
@click.option(
    "--rerun", "recording", is_flag=True, help="Also write recording.rrd for the Rerun viewer (extra `view`)."
)
def command(run: str, recording: bool) -> None:
    """Write a run's self-contained report.html; works for half-finished and blocked runs too."""

    def work() -> None:
        from ..stamp.state import State
        from . import write

        found = State.find(run).run
        click.echo(str(write(found)))
        if recording:
            from .rerun import record

            click.echo(str(record(found)))

    report_errors(work)
