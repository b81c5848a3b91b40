"""`worldwright campaign`: run many worlds, see how far they are, stop, go on, and report."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..cli import report_errors, show

if TYPE_CHECKING:
    from .campaign_store import Store
    from .conducting import Standing
    from .world_row import Row

EVERY_S = 5.0
"""A log is told how far it is so often."""
FORMAT = click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print.")
WORKERS = click.option(
    "--workers", type=click.IntRange(1), help="Worlds at work at once, in place of what the file says."
)
HANDS = click.option(
    "--hands",
    "by",
    type=click.Choice(["auto", "ray", "processes"]),
    help="Who does the work: Ray, or our own processes.",
)
ADDRESS = click.option("--address", help="Of a Ray cluster, host:port.")


@click.group("campaign")
def command() -> None:
    """Many worlds at once: sweeps of one plan, or many plans, with a table of what came of them."""


@command.command()
@click.argument("file", type=click.Path(path_type=Path))
@click.option("--folder", type=click.Path(path_type=Path), help="Where; else runs/ and the campaign's name.")
@click.option("--approve", is_flag=True, help="You answer for the plans of all its worlds; else auto mode approves.")
@WORKERS
@HANDS
@ADDRESS
@click.option("--count", is_flag=True, help="Only say how many worlds it would be, and the first of them.")
@FORMAT
def run(
    file: Path,
    folder: Path | None,
    approve: bool,
    workers: int | None,
    by: str | None,
    address: str | None,
    count: bool,
    style: str,
) -> None:
    """Run a campaign, or go on with it; it prints how far it is, and ends with the table and the page."""

    def work() -> "Standing | None":
        from . import setting_out

        campaign = setting_out.limited(setting_out.checked(file), workers, by, address)
        if count:
            click.echo("\n".join(setting_out.shown(campaign)))
            return None
        store = setting_out.begun(campaign, file, folder, approve)
        return _conducted(store)

    _end(report_errors(work, style), style)


@command.command()
@click.argument("campaign")
@click.option("--again", help="Begin once more what ended so: an outcome, or a kind of cause (`over_time`).")
@WORKERS
@HANDS
@ADDRESS
@FORMAT
def resume(
    campaign: str, again: str | None, workers: int | None, by: str | None, address: str | None, style: str
) -> None:
    """Go on with what is left of a campaign."""

    def work() -> "Standing":
        from . import conducting, setting_out
        from .campaign_store import Store

        store = Store.find(campaign)
        if again:
            click.echo(f"{conducting.forget(store, again)} worlds are begun once more", err=True)
        return _conducted(setting_out.changed(store, workers, by, address))

    _end(report_errors(work, style), style)


@command.command()
@click.argument("campaign")
@FORMAT
def status(campaign: str, style: str) -> None:
    """How far a campaign is."""

    def work() -> "Standing":
        from . import conducting
        from .campaign_store import Store

        return conducting.standing(Store.find(campaign))

    show(report_errors(work, style), style)


@command.command()
@click.argument("campaign")
def cancel(campaign: str) -> None:
    """Stop a campaign: what is under way ends now, what is done stays, and `resume` goes on."""

    def work() -> str:
        from . import setting_out
        from .campaign_store import Store

        return setting_out.cancelled(Store.find(campaign))

    click.echo(report_errors(work))


@command.command()
@click.argument("campaign")
def report(campaign: str) -> None:
    """Write the table (Parquet, CSV) and the page of what is done so far."""

    def work() -> None:
        from . import wall
        from .campaign_store import Store

        for path in wall.write(Store.find(campaign)):
            click.echo(str(path))

    report_errors(work)


@command.command()
@click.argument("campaign")
@click.option(
    "--column", "columns", multiple=True, help="A column of the recordings, again for each; else the usual ones."
)
@click.option("--shares", nargs=3, type=float, default=(0.8, 0.1, 0.1), help="Of train, validation and test.")
def trajectories(campaign: str, columns: tuple[str, ...], shares: tuple[float, float, float]) -> None:
    """Write the recordings as a data set to train on, split by the seed of the draw (Parquet)."""

    def work() -> None:
        from . import trajectories
        from .campaign_store import Store

        store = Store.find(campaign)
        counts = trajectories.write(store, columns or trajectories.COLUMNS, shares)
        click.echo(f"{store.folder / trajectories.FOLDER}: " + ", ".join(f"{n} {part}" for part, n in counts.items()))

    report_errors(work)


def _conducted(store: "Store") -> "Standing":
    """Drive a campaign with a bar on a terminal and lines elsewhere; the table and the page are written at its end."""
    import signal
    import time

    from . import conducting, wall

    told = [0.0]
    bar = sys.stderr.isatty()

    def watch(now: "Standing", row: "Row | None") -> None:
        if row is not None and not row.ok:
            click.echo(("\r\033[K" if bar else "") + row.text(), err=True)
        if bar or time.monotonic() - told[0] > EVERY_S:
            told[0] = time.monotonic()
            head, *more = now.text().splitlines()
            rate = more[0].strip() if now.rate_per_minute is not None else ""
            click.echo(f"\r\033[K{head} {rate}" if bar else f"{head} {rate}", err=True, nl=not bar)

    # Ended politely is as Ctrl-C: what is under way is ended, and does not count as begun.
    before = signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    try:
        standing = conducting.conduct(store, say=lambda said: click.echo(said, err=True), watch=watch)
    finally:
        signal.signal(signal.SIGTERM, before)
        if bar:
            click.echo(err=True)
    for path in wall.write(store):
        click.echo(str(path), err=True)
    return standing


def _end(standing: "Standing | None", style: str) -> None:
    """Exit code 0: every world is done, whatever came of it; 1: some are left."""
    if standing is None:
        return
    show(standing, style)
    sys.exit(0 if standing.ok else 1)
