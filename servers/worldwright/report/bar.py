"""Progress of long work at the command line: a bar, or lines where there is no terminal."""

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ..model import printable
from ..model.progress import Progress, silent


@contextmanager
def shown(listens: bool, lines: bool) -> Iterator[Progress]:
    """A bar on a terminal; elsewhere silence, or with `lines` a line on standard error for each new message.

    Args:
        listens: whether the work tells its progress at all.
        lines: whether whoever waits is to hear of it without a terminal, too.
    """
    if listens and sys.stderr.isatty():
        with bar() as drawn:
            yield drawn
        return
    said = ""

    def tell(done: float, total: float, message: str = "") -> None:  # noqa: ARG001
        nonlocal said
        if message and message != said:
            said = message
            sys.stderr.write(f"{printable.words(message)}\n")
            sys.stderr.flush()

    yield tell if listens and lines else silent


@contextmanager
def bar() -> Iterator[Progress]:
    """A `Progress` that draws a bar on standard error, with the message, the share done and the time left.

    The bar appears with the first report, goes with the block, and leaves the terminal as it was. On something that is
    no terminal nothing is drawn.
    """
    from rich.console import Console
    from rich.progress import BarColumn, SpinnerColumn, TaskProgressColumn, TextColumn, TimeRemainingColumn
    from rich.progress import Progress as Bar

    console = Console(stderr=True)
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(bar_width=32),
        TaskProgressColumn(),
        TimeRemainingColumn(compact=True),
    )
    with Bar(*columns, console=console, transient=True, disable=not console.is_terminal) as drawn:
        task = None
        last = 0.0

        def report(done: float, total: float, message: str = "") -> None:
            nonlocal task, last
            if task is None:
                task = drawn.add_task(message or "working", total=total or None)
            now = time.monotonic()
            finished = bool(total) and done >= total
            if finished or now - last >= 0.05:  # a simulation may report thousands of times a second
                last = now
                text = message or drawn.tasks[drawn.task_ids.index(task)].description
                drawn.update(task, completed=done, total=total or None, description=text)

        yield report
