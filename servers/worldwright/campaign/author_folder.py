"""A project of its own for one author: the contract, synced there, and an empty `runs/`; its author writes nowhere else in the suite.

Its git root is its own, so that no harness takes the project around it for this one, and its permissions are those of a
checkout but for one: an approval in auto mode is asked of nobody. The suite itself runs from where it is installed, above this folder as a rule: where that is, and the campaign, is
written down here, and the guard and its shells keep both (`contract.authors_judge`). Claude Code and Codex keep their shells in the
folder by a sandbox of their own.
"""

import shutil
import subprocess
import sys
from pathlib import Path

from worldkit.files import write_atomic

from ..contract import authors_judge, generated, harnesses
from ..contract.command import project
from ..model.errors import WorldwrightError

COPIED = (
    "AGENTS.md",
    "CLAUDE.md",
    "skills",
    "commands",
    "servers/worldwright/__init__.py",
    "servers/worldwright/contract",
)
"""What a harness and the guard read. Copies, since a link would lead a writer out of the folder."""


class AuthorError(WorldwrightError):
    """A world that its author did not write; the message says why."""

    code = "author"

    def __init__(self, kind: str, cause: str, place: str = "", next_move: str = "") -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code = kind


def make(folder: Path, harness: str, campaign: Path) -> None:
    """Make the project at an empty folder, for an author whom nothing lets write to the rest of its `campaign`.

    Raises:
        AuthorError: the suite is not a checkout, or git is not here.
    """
    source = project()
    if missing := [name for name in COPIED if not (source / name).exists()]:
        raise AuthorError(
            "no_contract",
            f"the contract is not installed here: {', '.join(missing)}",
            str(source),
            "run it in a checkout",
        )
    folder.mkdir(parents=True)
    for name in COPIED:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if (source / name).is_dir():
            shutil.copytree(source / name, target, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
        else:
            shutil.copyfile(source / name, target)
    files = generated.files()
    for name, text in (files | harnesses.find(harness).unattended(files, folder)).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        write_atomic(folder / name, text)
    for link in generated.links():
        (folder / link).parent.mkdir(parents=True, exist_ok=True)
        (folder / link).symlink_to((source / link).readlink())
    (folder / ".venv/bin").mkdir(parents=True)  # a folder: Codex protects none that is itself a link
    for name in ("worldwright", "python"):
        (folder / ".venv/bin" / name).symlink_to(Path(sys.executable).with_name(name))
    (folder / "runs").mkdir()
    authors_judge.name(folder, source, campaign)
    try:
        subprocess.run(["git", "init", "--quiet"], cwd=folder, check=True, capture_output=True, timeout=60)
    except (OSError, subprocess.SubprocessError) as cause:
        raise AuthorError(
            "no_git", f"git is needed to set the author's folder apart: {cause}", str(folder), "install git"
        ) from cause
