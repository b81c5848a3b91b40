#!/usr/bin/env python3
"""Run a shell command that cannot write to the runs and the suite: `python3 shell.py PROJECT COMMAND`.

The process gives rights up before it becomes the shell, by Landlock (landlock(7), Linux 5.13 and newer), and every process it
starts inherits that: to write to the protected paths, the user's data folder among them (its assets stay writable), and to
read the signing key and the verdicts there. In the folder of a campaign's author what judges it from outside is protected as well
(`authors_judge`). Landlock only knows what is allowed, which is everything beside these paths, up to the root. So a
shell can make no new entries in the folders above them, the project's own and the home among these, and cannot read what
appears beside the key later; existing files there and everything in other folders stay writable. All else is read as before.
Without Landlock in the kernel, the command does not run.

Only the standard library is imported, so that any Python starts it, also inside a harness' own sandbox.
"""

from __future__ import annotations

import ctypes
import os
import struct
import sys
from collections.abc import Iterator
from pathlib import Path

if not __package__:  # it was started as a program
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from worldwright.contract import authors_judge, users_data
from worldwright.contract.roles import RUNS, SUITE

CREATE_RULESET, ADD_RULE, RESTRICT_SELF, SET_NO_NEW_PRIVS = 444, 445, 446, 38
VERSION_FLAG, PATH_BENEATH = 1, 1
WRITE_FILE, READ_FILE, CHANGE_FOLDER, REFER, TRUNCATE = 1 << 1, 1 << 2, 0b1_1111_1111 << 4, 1 << 13, 1 << 14
"""Rights to write and read a file, make and remove entries of a folder, link across folders (ABI 2), truncate a file (ABI 3)."""
CANNOT = 126
"""Exit code of a command that cannot be run."""


def writable(project: Path) -> Iterator[Path]:
    """Everything beside the protected paths, up to the root, and the user's assets among their data.

    An author's folder lies in one of its own: what judges the author is protected, and the folder not.
    """
    named = {project / name for name in (RUNS, *SUITE)}
    own, outside = {*named, *(Path(os.path.realpath(path)) for path in named)}, authors_judge.outside(project)
    yield from _beside({*own, *outside, users_data.folder()}, project)
    if outside:
        yield from (path for path in _entries(project, project) if path not in own and not path.is_symlink())
    if (assets := users_data.folder() / users_data.ASSETS).is_dir() and not assets.is_symlink():
        yield assets


def readable(project: Path) -> Iterator[Path]:
    """Everything beside the signing key and a benchmark's verdicts, up to the root."""
    shut = {users_data.folder() / name for name in (users_data.KEY, users_data.JUDGED)}
    yield from _beside({*shut, users_data.key(), users_data.judged()}, project)


def _beside(kept: set[Path], project: Path) -> Iterator[Path]:
    """What lies in the folders above the paths, and neither is one of them nor holds one."""
    above = {folder for path in kept for folder in path.parents}
    for folder in sorted(above):
        if kept.isdisjoint((folder, *folder.parents)):
            for entry in _entries(folder, project):
                if entry not in kept and entry not in above and not entry.is_symlink():
                    yield entry


def _entries(folder: Path, project: Path) -> list[Path]:
    """What a folder holds; of one above homes that may be entered and not listed, what is known by name."""
    try:
        return sorted(folder.iterdir())
    except OSError:  # it may also not be there yet
        words = [
            os.environ.get("HOME"),
            os.environ.get("TMPDIR"),
            sys.prefix,
            *os.environ.get("PATH", "").split(os.pathsep),
        ]
        named = {project, *(Path(os.path.realpath(word)) for word in words if word)}
        return sorted({folder / path.relative_to(folder).parts[0] for path in named if folder in path.parents})


def confine(project: Path) -> None:
    """Take these rights from this process and all that it starts, for good: the runs and the suite are those of `project`.

    Raises:
        OSError: the kernel has no Landlock, or refused.
    """
    libc = ctypes.CDLL(None, use_errno=True)
    version = libc.syscall(CREATE_RULESET, None, 0, VERSION_FLAG)
    if version < 1:
        raise OSError(ctypes.get_errno(), "this kernel offers no Landlock")
    writing = WRITE_FILE | CHANGE_FOLDER | (REFER if version >= 2 else 0) | (TRUNCATE if version >= 3 else 0)
    ruleset = _called(libc, CREATE_RULESET, struct.pack("Q", writing | READ_FILE), 8, 0)
    for rights, paths in ((writing, writable(project)), (READ_FILE, readable(project))):
        for path in paths:
            try:
                handle = os.open(path, os.O_PATH | os.O_CLOEXEC)
            except OSError:
                continue  # it is gone, or may not be opened
            allowed = rights if path.is_dir() else rights & (WRITE_FILE | TRUNCATE | READ_FILE)
            _called(libc, ADD_RULE, ruleset, PATH_BENEATH, struct.pack("=Qi", allowed, handle), 0)
            os.close(handle)
    libc.prctl(SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    _called(libc, RESTRICT_SELF, ruleset, 0)
    os.close(ruleset)


def _called(libc: ctypes.CDLL, number: int, *arguments: object) -> int:
    answer: int = libc.syscall(number, *arguments)
    if answer < 0:
        raise OSError(ctypes.get_errno(), f"Landlock refused (system call {number})")
    return answer


def main() -> int:  # noqa: RET503 - after the shell is there, nothing returns
    """Confine this process, then become the shell."""
    project, command = Path(os.path.realpath(sys.argv[1])), sys.argv[2]
    try:
        confine(project)
    except OSError as cause:
        sys.stderr.write(f"scope guard: the shell cannot be kept from {RUNS}/ here, so it does not start: {cause}\n")
        return CANNOT
    os.execvp("bash", ["bash", "-c", command])


if __name__ == "__main__":
    sys.exit(main())
