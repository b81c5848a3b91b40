"""`worldwright sculpt sheet FILE.py[:NAME]`: see something sculpted from four sides, before anything else is run."""

import click

from .cli import verb
from .stage.tools import sheet

command = click.Group(
    "sculpt", {"sheet": verb(sheet)}, help="See something sculpted from four sides, and what it measures."
)
