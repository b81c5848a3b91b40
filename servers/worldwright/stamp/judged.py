"""The evidence that is published, by the hashes it had as an acceptance began: what the gates judged is what is stamped.

Between the gates and the publishing lies the proof run, which takes from seconds to hours, and the run folder is anybody's
to write. So the names and hashes are taken first. Every file that is read afterwards, by a gate, by a step or to be
published, must have the hash that it had then; what appeared since is not published.
"""

import hashlib
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from ..model.errors import GateError
from ..model.evidence import handed_in
from ..model.evidence.journal import Journal
from . import taken
from .state import State

REPORTS = ("key", "lint", "scan", "expect", "interventions", "causes", "refine", "robust", "visual", "review")


class Judged(NamedTuple):
    """What an acceptance rests on."""

    files: dict[str, Path]
    """Files that are published, by their names in the accepted folder."""
    journal: Journal
    """The journal as it was then; lines that were added since are not of this acceptance."""

    def content(self, state: State, name: str) -> bytes:
        """The bytes of one of `files`; a `GateError` if they are others than those that were judged, or no plain file's."""
        content = _plain(state, self.files[name])
        state.sees(self.files[name], hashlib.sha256(content).hexdigest())
        self.still(state)
        return content

    def still(self, state: State) -> None:
        """Refuse (`GateError`) what was read with two contents, and a journal of which earlier lines are others now."""
        journal = self.journal.path
        if tuple(self.journal.entries()) != state.journal or not self.journal.goes_on():
            state.unsteady.append(journal)
        if state.unsteady:
            names = sorted({str(path.relative_to(state.run.folder)) for path in state.unsteady})
            raise GateError(
                f"{', '.join(names[:3])} changed while the run was being accepted",
                place=str(state.unsteady[0]),
                next_move=f"worldwright stamp status {state.place}",
            )


def take(state: State) -> Judged:
    """Look at everything that would be published now."""
    journal, _ = state.run.journal, state.journal  # that the gates will judge, read at the same moment
    held = Journal(journal, journal.read_bytes() if journal.is_file() else b"")
    files = dict(published(state))
    for path in files.values():
        state.sees(path, hashlib.sha256(_plain(state, path)).hexdigest())
    return Judged(files, held)


def published(state: State) -> Iterator[tuple[str, Path]]:
    """Files of the evidence that are copied, by their names in the accepted folder: reports, results, pictures, a film
    that was handed in.
    """
    kept = {f"{name}.json": state.folder / f"{name}.json" for name in REPORTS}
    kept |= {f"{name}.json": state.folder / name / "result.json" for name in state.passes}
    yield from ((f"evidence/{name}", path) for name, path in kept.items() if path.is_file())
    for stage, pattern in (("stills", "*.png"), ("video", "*.mp4")):
        yield from ((f"{stage}/{path.name}", path) for path in sorted((state.folder / stage).glob(pattern)))
    if (film := handed_in.find(state.run.folder)) is not None:
        yield film.name, film


def _plain(state: State, path: Path) -> bytes:
    """The content of a file of the evidence, or of the film that was handed in."""
    return handed_in.content(path) if path.parent == state.run.folder else taken.plain(state.run, path)
