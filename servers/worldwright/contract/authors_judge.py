"""What judges the author of a campaign's world, and lies outside the folder that it works in: named in a file of that folder.

The suite runs from where it is installed, and the campaign's rows and other worlds lie above the author's folder. `author_folder`
writes these paths down; the guard and the shells that it starts keep them, and the suite's copies in the folder itself. Only the
standard library is imported, for both.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

from .roles import RUNS, SUITE

FILE = "servers/judged-by.json"
"""Within the copied suite, which no shell writes."""


def name(project: Path, suite: Path, campaign: Path) -> None:
    """Write down what an author's folder keeps: the checkout `suite`, its interpreter, and all of the campaign's folder."""
    prefixes = [Path(prefix) for prefix in (sys.prefix, sys.base_prefix)]
    paths = [*(suite / name for name in (RUNS, *SUITE)), *prefixes, campaign]
    (project / FILE).write_text(
        json.dumps(sorted({os.path.realpath(path) for path in paths} - {"/"})), encoding="utf-8"
    )


def outside(project: Path) -> set[Path]:
    """The paths that judge this author, with links resolved; empty in a person's own project.

    Raises:
        OSError, ValueError: they are named, and cannot be read.
    """
    if not os.path.lexists(project / FILE):
        return set()
    return {Path(path) for path in json.loads((project / FILE).read_text(encoding="utf-8"))}


def keeps(target: Path, project: Path) -> bool:
    """Whether a file, with links resolved, is one of those, or of the suite's copies here: no author writes it."""
    if not (kept := outside(project)):
        return False
    if not target.is_relative_to(project):
        return any(target.is_relative_to(path) for path in kept)
    own = {path for name in SUITE for path in (project / name, Path(os.path.realpath(project / name)))}
    return any(target.is_relative_to(path) for path in own)
