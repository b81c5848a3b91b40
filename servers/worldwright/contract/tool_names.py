"""The names, in lower case, that a harness gives the tools which the guard judges."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class ToolNames:
    """The tools of one harness by what they do. A name that is not listed is unknown, and denied to every role."""

    writers: frozenset[str]
    """Tools that write the files which their input names."""
    readers: frozenset[str]
    """Tools that only read files, or skills."""
    shells: frozenset[str]
    """Tools that run commands."""
    agents: tuple[str, ...]
    """The names of tools that start or address other agents begin so."""
    harmless: frozenset[str]
    """Tools that touch neither files nor agents: to-do lists, searches for tools, waiting."""
    roles_look_by_shell: bool = False
    """Whether roles can read files only by the shell."""
    confined_by_guard: bool = False
    """Whether the guard confines shells (`shell.py`), since the harness itself cannot keep `runs/` from them."""
    allows_in_scope: bool = False
    """Whether its hook may answer that the person need not confirm a call."""
