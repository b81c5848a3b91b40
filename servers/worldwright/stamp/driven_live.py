"""Whether a world moves as it was driven live, where its plan says that it was: by the drive's own statement in `driven/`.

    driven/drive.json, stamp.dsse.json, stamp.pub    who drove it, signed by the live run (`worldwright drive keep`)

Rows of a plan are free text, so what they say of a drive is held against that statement, which nobody can write anew: its
names, its signature, and the commands and the motion of the proof run. What contradicts it is refused; what cannot be shown
is said not to be shown, beside the row, in the stamp.
"""

import hashlib
import json
import re
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Literal, NoReturn

from pydantic import ConfigDict, Field, ValidationError

from worldkit.files import write_atomic

from ..model.errors import GateError
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..model.plan.committed import Intervention
from . import signing
from .proof import Proved
from .taken import plain

FOLDER, STATEMENT, PREDICATE = "driven", "drive.json", "urn:worldwright:drive:v1"
SAYS = re.compile(r"driven\s+live|(?<!not )signed\s+by\s+the\s+live\s+run|\bdrive\.json\b", re.IGNORECASE)
"""Words of a row that say so."""
HASH = re.compile(r"drive\.json\s+sha256:([0-9a-f]{16,64})", re.IGNORECASE)
MOST_NAMES = 200


class _Said(Frozen):
    model_config = ConfigDict(frozen=True, extra="ignore")


class _Span(_Said):
    driver: str


class _Predicate(_Said):
    driven_by: tuple[_Span, ...]
    trajectory_sha256: str
    inputs_sha256: str
    witnessed: bool = False


class _Drive(_Said):
    type: Literal["urn:worldwright:drive:v1"] = Field(alias="predicateType")
    predicate: _Predicate


def named(drivers: Iterable[str]) -> str:
    """Names as a text may hold them that is read: of letters, digits and blanks alone, each once."""
    names = ("".join(c for c in name if c.isalnum() or c in " -_.") for name in drivers)
    return ", ".join(dict.fromkeys(name.strip() for name in names if name.strip()))[:MOST_NAMES] or "nobody"


def declared(run: Run, rows: Iterable[Intervention], proved: Proved) -> tuple[str, ...]:
    """The rows of a plan as a stamp tells them; one that says that it was driven live also tells whether that is shown.

    Raises:
        GateError: a row says so, and the drive's statement is missing or damaged, or says otherwise; or the world moves otherwise.
    """
    return tuple(
        f"{row.kind} on {', '.join(row.bodies)}: {row.law} (trigger: {row.trigger}; source: {row.source})"
        + "".join(f"; {found}" for found in _shown(run, row, proved))
        for row in rows
    )


def _shown(run: Run, row: Intervention, proved: Proved) -> Iterator[str]:
    words = f"{row.law} {row.trigger} {row.source}"
    if not SAYS.search(words):
        return
    drive, sha256, signature = _drive(run)
    said, names = drive.predicate, named(span.driver for span in drive.predicate.driven_by)
    if names not in row.law:
        _refuse(run, f"a row says `{row.law[:80]}`, and {STATEMENT} that it was driven by {names}")
    if any(not sha256.startswith(told.lower()) for told in HASH.findall(words)):
        _refuse(run, f"a row names another {STATEMENT} than the one in {FOLDER}/, sha256:{sha256[:16]}")
    moves = said.trajectory_sha256 == proved.trajectory_sha256
    if not moves and said.inputs_sha256 != proved.inputs_sha256:
        _refuse(run, f"what is commanded, and how the world moves, is not what {names} drove")
    what = "moves bit for bit as driven" if moves else "is commanded as driven, but NOT SHOWN to move so"
    if said.witnessed and signature.vouched:
        yield f"it {what} by {names}, whose drive was {signature.text()}"
    else:
        who = signature.text() if said.witnessed else "not signed by the live run"
        yield f"it {what}; NOT SHOWN that {names} drove it: {who}"


def _drive(run: Run) -> tuple[_Drive, str, signing.Signature]:
    """The drive's statement, its hash, and its signature, all of one copy."""
    files = {name: run.folder / FOLDER / name for name in (STATEMENT, signing.ENVELOPE, signing.PUBLIC)}
    if not files[STATEMENT].is_file():
        _refuse(run, f"a row says that it was driven live, and there is no {FOLDER}/{STATEMENT}")
    with tempfile.TemporaryDirectory(prefix="worldwright-") as place:
        for name, path in files.items():
            if path.is_file():
                write_atomic(Path(place) / name, plain(run, path))
        signature, data = signing.check(Path(place), STATEMENT), (Path(place) / STATEMENT).read_bytes()
    if signature.holder == "broken":
        _refuse(run, f"the signature of {FOLDER}/{STATEMENT} does not hold: {signature.problem}")
    try:
        return _Drive.model_validate(json.loads(data)), hashlib.sha256(data).hexdigest(), signature
    except (ValidationError, ValueError, RecursionError) as cause:
        _refuse(run, f"{FOLDER}/{STATEMENT} is no statement of a drive: {str(cause).splitlines()[0][:80]}")


def _refuse(run: Run, cause: str) -> NoReturn:
    raise GateError(
        cause,
        place=str(run.folder / FOLDER / STATEMENT),
        next_move="keep the drive anew: worldwright drive keep DRIVE --as RUN; or say in the plan's row who computed the commands",
    )
