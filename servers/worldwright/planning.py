"""`worldwright plan`: begin a plan from the nearest accepted world, complete one from the world that is built."""

import sys

import click

from . import expose
from .cli import report_errors, show


@click.group("plan")
def command() -> None:
    """Begin a plan from the nearest accepted world; complete one from the world that its program builds."""


@command.command()
@click.argument("sentence")
@click.option("--like", help="The accepted world to begin from; without it the nearest.")
@click.option("--run", "run", help="Name of the run folder; without it, words of the sentence.")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print.")
def new(sentence: str, like: str | None, run: str | None, style: str) -> None:
    """Make a run folder with prompt.md and a whole plan.md to change; what to decide is marked TO_CHANGE."""
    from .retrieve.tools import begin

    show(report_errors(lambda: begin(sentence, like, run), style), style)


@command.command()
@click.argument("run")
@click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print.")
def complete(run: str, style: str) -> None:
    """Write what the program's world has and the plan does not name into plan.md, marked as built."""
    from .lint.tools import complete_plan

    result = report_errors(lambda: complete_plan(run), style)
    show(result, style)
    sys.exit(expose.exit_code(result))
