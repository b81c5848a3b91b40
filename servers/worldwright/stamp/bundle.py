"""The accepted folder: written whole or not at all, and checkable by anyone with `sha256sum -c SHA256SUMS`."""

import hashlib
import os
import shutil
import uuid
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from worldkit.files import write_atomic

from ..model import try_lock
from ..model.errors import GateError
from ..model.evidence import handed_in
from ..model.evidence.run import Run, sha256_file
from . import signing
from .statement import Digest, Statement, Subject

STAMP = "stamp.json"
SUMS = "SHA256SUMS"
UNLISTED = (STAMP, SUMS, signing.ENVELOPE, signing.PUBLIC)
"""Files that the stamp cannot list: itself, and what is made from it."""
PREFIX = ".accepting-"
WORLD = "world"
"""Folder beside `world.mjz` with the facts of the program and the inputs that drove the world."""
OF_WORLD = ("world.mjz", f"{WORLD}/")
LEFT_OUT = ("evidence/", "stills/", "video/", *OF_WORLD, "trajectory.npz", *handed_in.NAMES)
"""What the small form of an accepted world may leave out: a build makes it again, but for a handed-in film, which proves nothing."""
BESIDE = (
    "journal.jsonl", "accepted", "earlier", "evidence", "jobs", "proof", "report.html", "recording.rrd", "overlays.json",
    "scene.glb", "scene.usda", "recording.mcap", "recording.bag", "recording.zip", "out", "drives",
)  # fmt: skip
"""What may lie beside the stamp of a small form without being listed in it: the journal, and what a build leaves there."""


@contextmanager
def only_one(run: Run) -> Iterator[None]:
    """Hold a lock on the run folder itself (no lock file to leave behind; the kernel lets go when the process dies)."""
    handle = os.open(run.folder, os.O_RDONLY | os.O_CLOEXEC)
    try:
        if not try_lock.taken(handle):
            raise GateError(
                "another process is accepting this run",
                place=str(run.folder),
                next_move=f"wait for it, then `worldwright stamp status {run.folder}`",
            )
        yield
    finally:
        os.close(handle)


def files_in(folder: Path) -> list[str]:
    """Everything below `folder` that is no folder, relative, sorted; a link is named itself, and never gone through."""
    found: list[Path] = []
    for inside, folders, names in os.walk(folder):
        links = [name for name in folders if (Path(inside) / name).is_symlink()]
        found += [Path(inside) / name for name in (*names, *links)]
    return sorted(str(path.relative_to(folder)) for path in found)


def subjects(folder: Path) -> tuple[Subject, ...]:
    """Every file of a bundle with its hash; the stamp and the sums do not list themselves."""
    return tuple(
        Subject(name=name, digest=Digest(sha256=sha256_file(folder / name)))
        for name in files_in(folder)
        if name not in UNLISTED
    )


def seal(folder: Path, statement: Statement) -> str:
    """Write the stamp and the sums into a finished bundle; returns the stamp's SHA-256."""
    text = statement.to_json()
    write_atomic(folder / STAMP, text)
    stamp_sha256 = hashlib.sha256(text.encode()).hexdigest()
    write_atomic(folder / SUMS, sums(statement.subject, stamp_sha256))
    return stamp_sha256


def sums(listed: Iterable[Subject], stamp_sha256: str) -> str:
    """The lines of SHA256SUMS: the files that are there, then the stamp."""
    lines = [f"{s.digest.sha256}  {s.name}\n" for s in listed]
    return "".join([*lines, f"{stamp_sha256}  {STAMP}\n"])


def is_small(folder: Path) -> bool:
    """Whether a folder is the small form of an accepted world: its stamp stands beside the journal."""
    return (folder / STAMP).is_file() and (folder / "journal.jsonl").is_file()


def unlisted(folder: Path, statement: Statement) -> list[str]:
    """What lies in an accepted folder and its stamp does not list; in a small form, besides the journal."""
    known = {*(s.name for s in statement.subject), *UNLISTED, *["journal.jsonl"] * is_small(folder)}
    return [name for name in files_in(folder) if name not in known]


def empty_folders(folder: Path) -> list[str]:
    """Folders below `folder` in which nothing lies, as `NAME/`: no list of files can name them."""
    return sorted(
        f"{path.relative_to(folder).as_posix()}/"
        for path in (Path(inside) for inside, folders, names in os.walk(folder) if not folders and not names)
        if path != folder
    )


def beside_small(folder: Path, statement: Statement) -> list[str]:
    """What lies beside the listed files of a small form, as a build or a film handed in since is left there, each file or
    folder once, empty ones too; the stamp says nothing of it. Of another folder the empty folders alone: there all else that is
    not listed is damage."""
    empty = empty_folders(folder)
    if not is_small(folder):
        return empty
    left = [name for name in unlisted(folder, statement) if _left(folder, name)]
    shown = (f"{name.split('/')[0]}{'/' * ('/' in name)}" for name in left)
    tops = [*dict.fromkeys(shown)]
    return [*tops, *(name for name in empty if f"{name.split('/')[0]}/" not in tops)]


def _left(folder: Path, name: str) -> bool:
    """Whether something unlisted in a small form is what a build leaves there, of evidence folders by key, or a film handed in
    to the run that stands accepted there; no link."""
    top, *below = name.split("/")
    kept = name in handed_in.NAMES or (top in BESIDE and (len(below) > 1 or top != "evidence"))
    return kept and not (folder / top).is_symlink()


def left_by_builds(statement: Statement | None) -> set[str]:
    """Names beside a small form that a build left there; what its stamp lists is its own, whatever it is called."""
    own = {s.name.split("/")[0] for s in statement.subject if not may_be_missing(s.name)} if statement else set()
    return {*BESIDE} - {"journal.jsonl"} - own


def may_be_missing(name: str) -> bool:
    """Whether a file that the stamp lists may be missing from the small form."""
    return name.startswith(LEFT_OUT)


def of_world(name: str) -> bool:
    """Whether a file is the world's, or one of those that say how it was driven."""
    return name.startswith(OF_WORLD)


def draft_folder(run: Run) -> Path:
    """A new empty folder beside what is accepted; leftovers of killed attempts are removed (call under the lock)."""
    for leftover in run.folder.glob(f"{PREFIX}*"):
        shutil.rmtree(leftover, ignore_errors=True)
    folder = run.folder / f"{PREFIX}{uuid.uuid4().hex[:8]}"
    folder.mkdir()
    return folder


def publish_copy(made: Path, run: Run, aside: Path | None) -> None:
    """Make a copy of a finished folder, which lies elsewhere, the run's accepted one."""
    draft = draft_folder(run)
    try:
        shutil.copytree(made, draft, dirs_exist_ok=True)
        publish(draft, run.accepted, aside)
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def publish(folder: Path, target: Path, aside: Path | None = None) -> None:
    """Make a finished folder the folder `target` of the same disk: one rename, after everything is on disk.

    An older folder there changes places with it in the same instant where the system can do that (Linux), so that a kill
    at any moment leaves one whole folder. It is then kept as `aside`, or removed without one.
    """
    for name in files_in(folder):
        _sync(folder / name)
    for path in (*(p for p in folder.rglob("*") if p.is_dir()), folder):
        _sync(path)
    if target.exists() and _exchanged(folder, target):
        _sync(target.parent)
        _put_aside(folder, aside)
        return
    if target.exists():
        # the older folder is moved aside first: a rename cannot replace a folder that has files in it
        target.rename(target.parent / f"{PREFIX}older-{uuid.uuid4().hex[:8]}")
    folder.rename(target)
    _sync(target.parent)
    for older in target.parent.glob(f"{PREFIX}older-*"):
        _put_aside(older, aside)


def _put_aside(older: Path, aside: Path | None) -> None:
    if aside is not None and not aside.exists():
        aside.parent.mkdir(exist_ok=True)
        older.rename(aside)
    else:
        shutil.rmtree(older, ignore_errors=True)


def _exchanged(one: Path, other: Path) -> bool:
    """Let two folders change places at once; False where the system cannot."""
    import ctypes

    try:
        swap = ctypes.CDLL(None, use_errno=True).renameat2
    except (AttributeError, OSError):
        return False
    here, exchange = -100, 2  # AT_FDCWD, RENAME_EXCHANGE
    return swap(here, os.fsencode(one), here, os.fsencode(other), exchange) == 0


def damage(folder: Path, statement: Statement) -> list[str]:
    """How an accepted folder differs from its stamp, one line each; empty when every byte is as stamped.

    In the small form, what a build makes again may be missing; what is there must be as stamped, and beside it may lie what
    a build leaves there (`beside_small`).
    """
    found = [f"{folder.name} is a link"] if folder.is_symlink() else []
    small = is_small(folder)
    present = [s for s in statement.subject if not small or not may_be_missing(s.name) or (folder / s.name).exists()]
    for subject in present:
        name, path = subject.name, folder / subject.name
        if path.is_symlink() or not _inside(path, folder):
            found.append(f"{name} is a link" if path.is_symlink() else f"{name} leads outside the folder")
            continue
        try:
            if sha256_file(path) != subject.digest.sha256:
                found.append(f"{name} was changed after it was stamped")
        except OSError as cause:
            found.append(f"{name} cannot be read ({cause.strerror or cause})")
    try:
        extra = [name for name in unlisted(folder, statement) if not (small and _left(folder, name))]
        links = {name for name in extra if (folder / name).is_symlink()}
        found += [f"{name} is {'a link, and ' * (name in links)}not in the stamp" for name in extra]
        summed = [s for s in present if not small or s.name not in handed_in.NAMES]  # the small form's never name it
        if (folder / SUMS).read_bytes() != sums(summed, sha256_file(folder / STAMP)).encode():
            found.append(f"{SUMS} and {STAMP} do not match")
    except OSError as cause:
        found.append(f"{SUMS} cannot be read ({cause})")
    return found


def _inside(path: Path, folder: Path) -> bool:
    return path.resolve().is_relative_to(folder.resolve())


def _sync(path: Path) -> None:
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
