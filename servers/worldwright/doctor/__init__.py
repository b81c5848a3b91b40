"""`worldwright doctor` tests whether all that a build and a harness need is here, and prints a fix for each problem."""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import click

from . import coding_harnesses, machine, servers
from .diagnosis import Diagnosis

CHECKS: tuple[Callable[[], Diagnosis | None], ...] = (*machine.CHECKS, *servers.CHECKS, *coding_harnesses.CHECKS)
"""A check returns None if it does not apply."""


def diagnose() -> Iterator[Diagnosis]:
    """Run every check; one that itself fails is a problem like any other."""
    for check in CHECKS:
        try:
            found = check()
        except Exception as cause:
            fix = "run `make demo` again to set up"
            found = Diagnosis(check.__name__, False, f"{type(cause).__name__}: {cause}", fix)
        if found is not None:
            yield found


@click.command("doctor")
@click.option(
    "--lock", type=click.Path(path_type=Path), help="Only pin a run to this environment: write its lock here."
)
def command(lock: Path | None) -> None:
    """Check Python, wheels, OpenGL, the sandbox, the MCP servers and the harnesses; name a fix for each problem.

    `FAIL` stops builds and ends with exit code 1; `weak` is worth mending, but a build works without it.
    """
    if lock is not None:
        from worldkit.files import write_json
        from worldkit.lock import observe

        from ..stage.sandbox.confinement import gl_backend

        write_json(lock, observe(gl_backend()))
        click.echo(f"{lock}: a run that holds it runs in this environment or not at all")
        return
    broken = False
    for diagnosis in diagnose():
        mark = "ok  " if diagnosis.ok else "FAIL" if diagnosis.essential else "weak"
        click.echo(f"{mark} {diagnosis.name:<9} {diagnosis.found}")
        if not diagnosis.ok:
            click.echo(f"     fix: {diagnosis.fix}")
            broken = broken or diagnosis.essential
    sys.exit(1 if broken else 0)
