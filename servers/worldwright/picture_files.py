"""Where the pictures that a command shows lie as files: nobody draws for minutes and has nothing in hand."""

import inspect
import typing
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click


def illustrated(annotation: Any) -> bool:
    """Whether a tool that is annotated so returns pictures."""
    from .model.picture import Illustrated

    kind = typing.get_origin(annotation) or annotation
    return inspect.isclass(kind) and issubclass(kind, Illustrated)


def write(result: Any, folder: Path | None, style: str, as_png: bool, aside: Callable[[], Path | None]) -> None:
    """Tell where the pictures of a result lie: in `folder`, where they were kept, else in `aside`; written there if they are not."""
    from .model.picture import Illustrated, file_name, png

    if not isinstance(result, Illustrated) or not result.pictures:
        return
    from worldkit.files import write_atomic

    kept = result.folder if folder is None and not as_png else None
    if (place := folder or kept or aside()) is None:
        count = len(result.pictures)
        click.echo(
            f"{count} picture{'s' if count > 1 else ''}: --save FOLDER writes {'them' if count > 1 else 'it'}", err=True
        )
        return
    for number, picture in enumerate(map(png, result.pictures) if as_png else result.pictures, 1):
        path = place / file_name(number, picture)
        if kept is None:
            place.mkdir(parents=True, exist_ok=True)
            write_atomic(path, picture.data)
        click.echo(str(path), err=style != "text")
    if style == "text" and not as_png and any(picture.format == "jpeg" for picture in result.pictures):
        click.echo("(for a viewer without JPEG: the same with --png)")


def beside(name: str, arguments: dict[str, Any]) -> Path | None:
    """The folder of a run for pictures that somebody asked to see, which enters no hash; None of what is no run's."""
    from .model.errors import WorldwrightError
    from .model.evidence.run import Run

    try:
        return Run.find(arguments["run"]).folder / "out" / name if "run" in arguments else None
    except WorldwrightError:
        return None
