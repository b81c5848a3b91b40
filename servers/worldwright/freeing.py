"""`worldwright gc RUN…` frees what can be made again of runs: recordings, pictures and trials of earlier programs, old jobs."""

import sys

import click

from .cli import report_errors
from .model.errors import NotFoundError
from .model.evidence.reports import EvidenceKey
from .model.evidence.run import Run


@click.command("gc")
@click.argument("runs", nargs=-1, required=True)
@click.option("--dry-run", is_flag=True, help="Only say what would go.")
def command(runs: tuple[str, ...], dry_run: bool) -> None:
    """Free what can be made again of runs; never evidence of an accepted world, of the present program, or of a running job."""
    from .model.evidence import environment
    from .stage import disk

    def work() -> None:
        for name in runs:
            run = Run.find(name)
            click.echo(disk.free(run, _key(run, environment.current().sha256()), dry=dry_run).text())

    report_errors(work)
    sys.exit(0)


def _key(run: Run, environment_sha256: str) -> EvidenceKey | None:
    """The present key; None for a run without a program, which may have a rehearsal all the same."""
    try:
        return run.evidence_key(environment_sha256)
    except NotFoundError:
        return None
