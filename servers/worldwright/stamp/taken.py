"""The files beside a program, its plan and its film, read once as an acceptance begins: what is proved is what is published."""

import os
from pathlib import Path
from typing import NamedTuple

from worldkit.files import write_atomic

from ..model.errors import GateError
from ..model.evidence import pictures_of
from ..model.evidence.run import Run
from .proof import beside

LARGEST = 4 << 30
"""A film or a report is at most so large, bytes."""


class Taken(NamedTuple):
    """Bytes of files of a run, by path relative to it."""

    near: dict[str, bytes]
    """What belongs to the program and the plan."""
    film: dict[str, bytes]
    """`film.py` and what belongs to it; empty where nobody wrote one."""
    prompt: bytes | None

    @property
    def film_sha256(self) -> str:
        """Hash of the film with all that belongs to it; empty where there is none."""
        return pictures_of.sha256_of(self.film)

    def lay(self, folder: Path) -> None:
        """Write all of them into a folder."""
        prompt = {} if self.prompt is None else {"prompt.md": self.prompt}
        for name, content in (self.near | self.film | prompt).items():
            write_atomic(folder / name, content)

    def still(self, run: Run) -> None:
        """Refuse (`GateError`) if one of them was changed since, as for the gates, which look at the run itself."""
        now = take(run)
        mine, others = ({**found.near, **found.film, "prompt.md": found.prompt} for found in (self, now))
        changed = sorted(name for name in mine.keys() | others.keys() if mine.get(name) != others.get(name))
        if changed:
            raise GateError(
                f"{', '.join(changed[:3])} changed while the run was being accepted",
                place=str(run.folder / changed[0]),
                next_move=f"worldwright stamp status {run.folder}",
            )


def take(run: Run) -> Taken:
    """Read them as they are now; refuse (`GateError`) what is reached by a link, which is somebody else's to publish."""
    for path in (run.plan, run.program, run.folder / pictures_of.FILM):
        if os.path.lexists(path):
            plain(run, path)
    prompt = plain(run, run.prompt) if os.path.lexists(run.prompt) else None
    return Taken(beside(run.folder), pictures_of.files(run), prompt)


def plain(run: Run, path: Path) -> bytes:
    """The content of a file of a run; what is no plain file may be somebody else's, and is not published (`GateError`)."""
    from ..stage import tools as stage

    content = (
        stage.read_plain(path, LARGEST) if path.resolve() == path else None
    )  # no folder on the way is a link either
    if content is None:
        raise GateError(
            f"{path.relative_to(run.folder)} is no plain file of at most {LARGEST >> 30} GB: a link, or one with "
            "another name elsewhere, is not copied",
            place=str(path),
            next_move=f"put the file itself there, or remove it and make it again: worldwright stamp status {run.folder}",
        )
    return content
