"""`worldwright versions RUN [A [B]]` lists what was accepted of a run, compares two of it, and brings one back."""

import sys

import click

from .cli import report_errors
from .model.evidence.run import Run


@click.command("versions")
@click.argument("run")
@click.argument("first", required=False)
@click.argument("second", required=False)
@click.option("--restore", metavar="VERSION", help="Bring this one back; what stands now is kept.")
@click.option("--anybody", is_flag=True, help="Bring it back though no key that is known here signed it.")
def command(run: str, first: str | None, second: str | None, restore: str | None, anybody: bool) -> None:
    """List the accepted versions of a run, or compare two (the second is the one that stands unless you name it)."""
    from .stamp import versions

    def work() -> bool:
        found = Run.find(run)
        if restore:
            version = versions.restore(found, restore, anybody=anybody)
            click.echo(f"{version} stands again\n  next: worldwright stamp status {found.folder}")
            return True
        known = versions.known(found)
        if first:
            other = versions.find(found, second) if second else known[-1] if known else versions.find(found, "")
            click.echo(versions.compare(versions.find(found, first), other).text())
            return True
        click.echo("\n".join(map(str, known)) or "nothing was accepted yet")
        return bool(known)

    sys.exit(0 if report_errors(work) else 1)
