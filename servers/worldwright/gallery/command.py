"""`worldwright gallery`: keep an accepted run as an example; prove, build and accept the examples, all or some."""

import os
import sys
from pathlib import Path

import click

from ..cli import report_errors

JOBS = click.option(
    "--jobs", default=min(2, os.cpu_count() or 1), show_default=True, help="Worlds that are worked on at once."
)
SLUGS = click.argument("slug", nargs=-1)


@click.group("gallery")
def command() -> None:
    """The accepted worlds under examples/: keep one, prove, build or accept all."""


@command.command()
@click.argument("run")
@click.option("--name", help="Name of the folder under examples/; the run's own without it.")
def keep(run: str, name: str | None) -> None:
    """Write the small form of an accepted run into examples/."""
    from ..stamp import small_form
    from ..stamp.state import State
    from . import pages, worlds

    def work() -> None:
        found = State.find(run).run
        target = worlds.EXAMPLES.resolve() / (name or found.name)
        for file in small_form.write(found, target):
            click.echo(str(worlds.EXAMPLES / target.name / file))
        if pages.README.is_file():
            pages.write_table()

    report_errors(work)


@command.command()
@SLUGS
@JOBS
def prove(slug: tuple[str, ...], jobs: int) -> None:
    """Prove the examples again from what is kept of them: physics and measurements, no pictures."""
    sys.exit(report_errors(lambda: _each("prove", slug, jobs)))


@command.command()
@SLUGS
@JOBS
def build(slug: tuple[str, ...], jobs: int) -> None:
    """Prove the examples and build all that is not kept (recording, stills, films, report) in runs/gallery.

    What is there already is not done again. A page, runs/gallery/index.html, shows them all.
    """

    def work() -> int:
        from . import pages, worlds

        code = _each("build", slug, jobs)
        built = [path.parent.name for path in sorted(worlds.BUILT.glob("*/plan.md"))]
        click.echo(f"open {Path(pages.write_index(built)).resolve()}")
        return code

    sys.exit(report_errors(work))


@command.command()
@SLUGS
@JOBS
@click.option("--redraft", is_flag=True, help="Draft the drafted programs again, by the code as it is now.")
def accept(slug: tuple[str, ...], jobs: int, redraft: bool) -> None:
    """Build the examples from their plans and programs in this environment, accept them, and keep their small forms.

    A plan is approved as before: in auto mode, or in your name. Description and review are by measurement. An example whose world cannot be
    accepted stays as it was. When all are accepted, examples/known_keys names the one key that signed them.
    """

    def work() -> int:
        from ..stamp import keyring, signing
        from . import pages, worlds

        code = _each("redraft" if redraft else "accept", slug, jobs)
        if not code and not slug:
            path = worlds.EXAMPLES / keyring.KNOWN
            path.unlink(missing_ok=True)
            keyring.trust(signing.fingerprint(keyring.own().public_key()), "the examples of this repository", path)
        pages.write_table()
        return code

    sys.exit(report_errors(work))


def _each(work: str, wanted: tuple[str, ...], jobs: int) -> int:
    """Do it for every world and print a line for each; 1 when one says no."""
    from . import making, worlds

    worst = 0
    for made in making.each(work, worlds.slugs(wanted), jobs):
        head, *rest = made.detail.splitlines() or [""]
        click.echo(f"{'ok  ' if made.ok else 'FAIL'} {made.slug}: {head} ({made.seconds:.1f} s)")
        for line in rest:
            click.echo(f"       {line}")
        worst = max(worst, int(not made.ok))
    return worst
