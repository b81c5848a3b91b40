"""The small form of an accepted world: what a person reads of it, and nothing that a machine can make again.

It is one folder: prompt, plan, the accepted program, the files that they name, the journal, the sampled motion, one
poster, and the stamp with its signature and its checksums. The stamp is the same, byte for byte, as in `accepted/`: it
vouches for the films, the recording and the reports too, which are left out and built again when somebody wants to see
them (`worldwright gallery build`). A world's file that is small is kept with what drove it, so that `stamp verify` runs no
program; without it, the program builds it again.
"""

import shutil
import uuid
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import GateError, NotFoundError
from ..model.evidence.run import Run, sha256_file
from ..model.storage import writing
from . import bundle, signing
from .kept import Kept
from .statement import Statement

WORLD_BYTES = 250_000
"""So large may a kept world be, with its facts and the inputs that drove it: version control never forgets, a new stamp has a new world,
and the program builds it again."""


def write(run: Run, target: Path) -> tuple[str, ...]:
    """Write the small form of an accepted run as the folder `target`, whole or not at all; returns its files.

    A folder that stands there already is replaced with everything in it.

    Raises:
        NotFoundError: the run is not accepted.
        GateError: the accepted folder is not as it was stamped.
    """
    source = run.stamped
    kept = Kept.read(source / bundle.STAMP, Statement)
    if kept.value is None or not run.journal.is_file():
        raise NotFoundError(
            kept.problem or "only an accepted run has a small form, and this one is not accepted",
            place=str(run.folder),
            next_move=f"worldwright stamp status {run.folder}",
        )
    if broken := bundle.damage(source, kept.value):
        raise GateError(
            f"the accepted folder is not as it was stamped: {broken[0]}",
            place=str(source),
            next_move=f"worldwright stamp accept {run.folder}",
        )
    names = [s.name for s in kept.value.subject if not bundle.may_be_missing(s.name)]
    world = [s.name for s in kept.value.subject if bundle.of_world(s.name) and (source / s.name).is_file()]
    if sum((source / name).stat().st_size for name in world) <= WORLD_BYTES:
        names += world
    names += [name for name in (bundle.STAMP, signing.ENVELOPE, signing.PUBLIC) if (source / name).is_file()]
    with writing("the small form", target.parent):
        target.parent.mkdir(parents=True, exist_ok=True)
        draft = target.parent / f"{bundle.PREFIX}{uuid.uuid4().hex[:8]}"
        try:
            for name in names:
                write_atomic(draft / name, (source / name).read_bytes())
            write_atomic(draft / run.journal.name, run.journal.read_bytes())
            present = [s for s in kept.value.subject if (draft / s.name).is_file()]
            write_atomic(draft / bundle.SUMS, bundle.sums(present, sha256_file(draft / bundle.STAMP)))
            bundle.publish(draft, target)
        finally:
            shutil.rmtree(draft, ignore_errors=True)
    return tuple(bundle.files_in(target))
