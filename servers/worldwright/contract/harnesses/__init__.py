"""The coding harnesses, one module each: its own files, its names of tools, and what it lacks on this machine.

The folder is the list: a module that defines what `Harness` names is a harness to `worldwright contract sync`, the guard
and the doctor. Only the standard library is imported here and at the top of each module, since
the guard reads them before every tool use.
"""

from __future__ import annotations

import importlib
import os
import pkgutil
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, cast

from ..tool_names import ToolNames

if TYPE_CHECKING:
    from ...doctor.diagnosis import Diagnosis
    from ..heard import Heard
    from ..roles import Role


class Harness(Protocol):
    """The protocol of the modules of this folder."""

    NAME: str
    """The name that people give it."""
    SHELL_SETS: tuple[str, ...]
    """Environment variables that it sets in its shells: a terminal that was opened there is its own."""
    PROGRAM: str
    """The command that starts it."""
    PACKAGE: str
    """Its package on npm."""
    TESTED: str
    """The version that `make test-harness` installs and drives."""
    LINKS: tuple[str, ...]
    """Links in the project by which it shares `skills/` and `commands/`."""
    TOOLS: ToolNames
    """Its names of tools, for the guard."""

    def files(self) -> dict[str, str]:
        """Its generated files, without the agents, by their path in the project."""

    def agent(self, role: Role) -> tuple[str, str]:
        """The path and the text of one role's file."""

    def diagnose(self, root: Path) -> Diagnosis | None:
        """Tell what the person must do before it works in the project at `root`; None when it is not installed."""

    TRUST: str
    """Why it is not safe without a person's word for its hooks, in a folder that it has never seen; empty where it is."""

    def unattended(self, files: dict[str, str], folder: Path) -> dict[str, str]:
        """Those of all generated files that are other where nobody is there to be asked, as in a campaign.

        Args:
            files: all of them, by path.
            folder: the project's, which has a git root of its own; what lies in the folders around it is not to be read.
        """

    def headless(self, prompt: str, model: str, folder: Path, most_usd: float | None) -> list[str]:
        """The words after its program that make a world of a prompt with nobody there, each event told as a line of JSON.

        Args:
            prompt: the sentence, handed on with `/generate --auto`.
            model: by the harness's own name; empty: its own choice.
            folder: the project that it works in.
            most_usd: what it may cost, where it can keep to that.
        """

    def heard(self, event: dict[str, Any]) -> Heard:
        """What one of these events says."""

    UNCOUNTED: str
    """Whose tokens and money these events do not tell, as `its agents`; empty where they tell of all."""
    TELLS_MONEY: bool
    """Whether they tell US dollars; without, a limit of them needs the campaign's prices."""
    TELLS_AT_END: bool
    """Whether tokens and money are known only when it has ended, so that no limit of them ends it before."""


def known() -> dict[str, Harness]:
    """Every harness by the name of its module."""
    names = sorted(info.name for info in pkgutil.iter_modules(__path__))
    return {name: find(name) for name in names}


def around() -> str:
    """The name of the harness in whose shell this process, or one that it descends from, began; empty when there is none.

    A process that let its parent die before, and a shell whose variables were taken away from its beginning, are not told.
    """
    began = [{name for name, value in os.environ.items() if value}, *_above()]
    found = (harness for harness in known().values() if any(names & {*harness.SHELL_SETS} for names in began))
    return next((harness.NAME for harness in found), "")


def _above() -> Iterator[set[str]]:
    """The names of the variables that each process above this one began with, as far as they can be read."""
    pid = os.getppid()
    with suppress(OSError, ValueError, IndexError):
        while pid > 1:
            folder = Path("/proc") / str(pid)
            yield {
                word.partition(b"=")[0].decode(errors="replace")
                for word in (folder / "environ").read_bytes().split(b"\0")
            }
            pid = int((folder / "stat").read_text().rpartition(")")[2].split()[1])


def find(name: str) -> Harness:
    """The harness of this name.

    Raises:
        ModuleNotFoundError: there is no module of this name in the folder.
    """
    return cast(Harness, importlib.import_module(f"{__name__}.{name}"))
