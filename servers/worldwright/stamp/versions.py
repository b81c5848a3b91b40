"""The accepted versions of a run: the one that stands, and earlier ones, whole as they were stamped.

When a run is accepted anew, the version before goes to `earlier/<name>/`, called by the beginning of its stamp's SHA-256. Any
two are compared by their claims, their measured numbers, their motion and their films, and an earlier one is brought back
together with the prompt, the plan, the program and the film that it was made of. What it takes the place of is kept as well,
and a standing version that is not whole any more goes to `earlier/damaged-<time>/`. A small form (`small_form`), whose stamp
lies in the run folder itself, is no version before: of it only what another version's files replace goes to `earlier/`.
"""

import math
from collections.abc import Iterator, Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

from worldkit.files import write_atomic

from ..model import companions
from ..model.errors import GateError, NotFoundError
from ..model.evidence import handed_in, pictures_of
from ..model.evidence.run import DAMAGED, EARLIER, SOURCE, Run, sha256_file
from ..model.frozen import Frozen
from ..model.printable import line
from ..model.storage import writing
from . import bundle, digest, poster, signing
from .kept import Kept
from .proof import beside
from .statement import Statement

LETTERS = 12
MADE = (*bundle.LEFT_OUT, digest.NAME, poster.NAME)
"""Files of an accepted folder that were made of the others."""
CLOSE = 1e-6


class Version(NamedTuple):
    """One accepted folder."""

    name: str
    folder: Path
    statement: Statement

    def __str__(self) -> str:
        said = self.statement.predicate
        claims = [o.status for o in said.objectives]
        return line(
            f"{self.name}, accepted {said.accepted_at}: {claims.count('proved')} of {len(claims)} claims proved"
        )


class Compared(Frozen):
    """How two accepted versions differ."""

    first: str
    second: str
    differences: tuple[str, ...]

    def text(self) -> str:
        """Both, and one line for each difference."""
        return "\n".join([f"from {self.first}\nto   {self.second}", *(f"- {line(said)}" for said in self.differences)])


def known(run: Run) -> list[Version]:
    """Every version, the one that stands last; what is no accepted folder, or was damaged when it went aside, is left out."""
    earlier = [v for path in run.earlier() if (v := _read(path))]
    standing = _read(run.stamped)
    return sorted(earlier, key=lambda v: v.statement.predicate.accepted_at) + ([standing] if standing else [])


def find(run: Run, name: str) -> Version:
    """A version by its name or the beginning of it; a `NotFoundError` lists them."""
    versions = known(run)
    found = [v for v in versions if name and v.name.startswith(name)]
    if len(found) != 1:
        raise NotFoundError(
            f"{len(found) or 'no'} accepted versions of this run are called '{name}'",
            place=str(run.folder),
            next_move=f"name one of: {'; '.join(map(str, versions)) or '(none was accepted yet)'}",
        )
    return found[0]


def aside(run: Run) -> Path:
    """Where the accepted folder goes when another takes its place; what is not whole is kept too, but not as that version."""
    version = _read(run.accepted)
    if version is None or bundle.damage(version.folder, version.statement):
        return _dated(run, DAMAGED)
    return run.folder / EARLIER / version.name


def _dated(run: Run, what: str) -> Path:
    """A folder that is not there yet, for what is kept and is no version."""
    return run.folder / EARLIER / f"{what}-{datetime.now(UTC):%Y%m%d-%H%M%S-%f}"


def compare(first: Version, second: Version) -> Compared:
    """What the second has otherwise than the first."""
    return Compared(
        first=str(first), second=str(second), differences=tuple(_differences(first, second)) or ("nothing",)
    )


def restore(run: Run, name: str, *, anybody: bool = False) -> Version:
    """Bring a version back: its plan, program and film, and its stamp; what stood there is kept under `earlier/`.

    Args:
        run: whose version it is.
        name: of the version, or the beginning of it.
        anybody: bring it back whoever signed it, and if nobody did.

    Raises:
        NotFoundError: there is no such version.
        GateError: it is not whole, it was not accepted here, no key that is known here signed it, or the run is being accepted.
    """
    version = find(run, name)
    other = f"bring another one back: worldwright versions {run.folder}"
    broken, move = _unfit(run, version), other
    signature = signing.check(version.folder, bundle.STAMP)
    if not broken and not (signature.vouched or anybody):
        broken = f"is {signature.text()}" if signature.holder == "unsigned" else f"was {signature.text()}"
        move = (
            f"{other}; or see whether its world is proved: `worldwright stamp verify {version.folder}`, then, if who accepted it "
            f"does not matter, `worldwright versions {run.folder} --restore {version.name} --anybody`"
        )
    if broken:
        raise GateError(f"version {version.name} {broken}", place=str(version.folder), next_move=move)
    with writing("the accepted version", run.folder), bundle.only_one(run):
        content = _made_of(run, version)
        _put(run, content)
        if version.folder != run.stamped:
            bundle.publish(version.folder, run.accepted, aside(run))
        run.blocked.unlink(missing_ok=True)
        run.log("stamp", "restore", version=version.name, key=version.statement.predicate.source.key)
    return version


def _unfit(run: Run, version: Version) -> str:
    """Why a version is not what was accepted here; empty when it is."""
    if broken := bundle.damage(version.folder, version.statement):
        return f"is not as it was stamped: {broken[0]}"
    signature = signing.check(version.folder, bundle.STAMP)
    if signature.holder == "broken":
        return f"has a signature that does not hold: {signature.problem}"
    stamp_sha256 = sha256_file(version.folder / bundle.STAMP)
    if not any(e.get("action") == "accept" and e.get("stamp_sha256") == stamp_sha256 for e in run.entries()):
        return "was not accepted in this run: its journal has no such line"
    return ""


def _read(folder: Path) -> Version | None:
    statement = Kept.read(folder / bundle.STAMP, Statement).value
    return Version(sha256_file(folder / bundle.STAMP)[:LETTERS], folder, statement) if statement else None


def _differences(first: Version, second: Version) -> Iterator[str]:
    a, b = first.statement, second.statement
    for name in ("prompt.md", "plan.md", "simulation.py", pictures_of.FILM, *handed_in.NAMES):
        if a.digest_of(name) != b.digest_of(name):
            how = "is new" if not a.digest_of(name) else "is gone" if not b.digest_of(name) else "is another one"
            yield f"{name} {how}"
    yield from _changed(
        {o.claim: o.status for o in a.predicate.objectives}, {o.claim: o.status for o in b.predicate.objectives}
    )
    before, after = (_numbers(version.statement) for version in (first, second))
    for key in before:
        if key in after and not math.isclose(before[key][0], after[key][0], rel_tol=CLOSE, abs_tol=CLOSE):
            yield f"{key[1]} of “{key[0]}” measures {after[key][0]:.4g} {after[key][1]}, before {before[key][0]:.4g}"
    if a.predicate.proof.trajectory_sha256 == b.predicate.proof.trajectory_sha256:
        yield "the motion is the same, bit for bit"
    else:
        was, now = (digest.stamped_motion(version.folder, version.statement) for version in (first, second))
        yield f"the motion differs: {digest.compare(was, now).message}" if was and now else "the motion differs"
    drawn = [{s.name: s.digest.sha256 for s in x.subject if s.name.startswith(("stills/", "video/"))} for x in (a, b)]
    yield from _changed(drawn[0], drawn[1], same="is drawn otherwise")


def _changed(before: Mapping[str, str], after: Mapping[str, str], same: str = "") -> Iterator[str]:
    """A line for each name that has another value, or stands on one side only."""
    for name in dict.fromkeys((*before, *after)):
        old, new = before.get(name), after.get(name)
        if old != new:
            yield f"{name}: {'gone' if new is None else 'new' if old is None else same or f'{old}, now {new}'}"


def _numbers(statement: Statement) -> dict[tuple[str, str, int], tuple[float, str]]:
    """What was measured, by claim, expectation, and how many of that name came before it; with its unit."""
    claims = {o.index: o.claim for o in statement.predicate.objectives}
    found: dict[tuple[str, str, int], tuple[float, str]] = {}
    for row in statement.predicate.expectations:
        if row.measured is not None:
            claim = claims.get(row.objective, "")
            nth = sum(key[:2] == (claim, row.name) for key in found)
            found[claim, row.name, nth] = (row.measured, row.unit)
    return found


def _made_of(run: Run, version: Version) -> dict[str, bytes]:
    """The files of the run that a version was made of, by name; the program with its instrumentation, where that was kept."""
    source = version.statement.predicate.source
    own = (run.prompt.name, run.plan.name, run.program.name, pictures_of.FILM, *handed_in.NAMES)
    names = [s.name for s in version.statement.subject if not s.name.startswith(MADE)]
    names = [name for name in names if name in own or name.split("/")[0] not in companions.OURS]
    # The small form lists a handed-in film and does without it.
    names = [name for name in names if name not in handed_in.NAMES or (version.folder / name).is_file()]
    found = {name: (version.folder / name).read_bytes() for name in names}
    kept = run.evidence(source.key) / SOURCE / run.program.name
    if kept.is_file() and sha256_file(kept) == source.program_sha256:
        found[run.program.name] = kept.read_bytes()
    return found


def _put(run: Run, content: Mapping[str, bytes]) -> None:
    """Write these files in place of what belongs to the program now, which is kept unless it stands accepted, byte for byte."""
    now = beside(run.folder) | pictures_of.files(run)
    now |= {path.name: path.read_bytes() for path in (run.prompt, run.plan, run.program) if path.is_file()}
    if (film := handed_in.find(run.folder)) is not None:
        now[film.name] = handed_in.content(film)
    kept = {} if _stands(run, now) or all(content.get(name) == held for name, held in now.items()) else dict(now)
    if run.blocked.is_file():
        kept[run.blocked.name] = run.blocked.read_bytes()
    place = _dated(run, "replaced")
    for name, held in kept.items():
        write_atomic(place / name, held)
    for name in now.keys() - content.keys() - {run.prompt.name}:  # a wish stays, also for what was made without one
        (run.folder / name).unlink()
    for name, data in content.items():
        write_atomic(run.folder / name, data)


def _stands(run: Run, now: Mapping[str, bytes]) -> bool:
    """Whether the accepted version that stands, in a folder of its own that is kept whole, holds each of these files."""
    standing = _read(run.accepted)
    if standing is None or bundle.damage(standing.folder, standing.statement):
        return False
    accepted = _made_of(run, standing)
    return all(accepted.get(name) == held for name, held in now.items())
