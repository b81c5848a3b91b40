"""A progress bar for long work at the command line."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

from ..model.progress import Progress


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
