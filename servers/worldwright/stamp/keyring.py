"""The keys of this machine: its own, which signs what is accepted here, and those that a person has called known.

Both are in the user's data folder: `signing-key.pem`, made on first use and readable by its owner only, and `known_keys`,
one `sha256:FINGERPRINT NAME` a line. A key gets onto that list by `worldwright keys trust` alone, never by being met. The
checkout that this code runs from may list the keys of its own examples in `examples/known_keys`. An agent's shell in a harness
can neither write there nor read the signing key (`contract/users_data.py`): it signs nothing, and knows this machine's key
by `signing-key.pub` beside it.
"""

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from worldkit.data_folders import data_root
from worldkit.files import write_atomic

from ..model.evidence import seals
from ..model.storage import writing
from .key_files import SigningError, fingerprint, private_key, public_key, public_text

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

OWN, PUBLIC, KNOWN = seals.KEY, "signing-key.pub", "known_keys"
SHIPPED = Path(__file__).resolve().parents[3] / "examples" / KNOWN
LINE = re.compile(r"sha256:([0-9a-f]{64})(?:\s+(.*))?")
Holder = Literal["own", "known", "unknown"]


@dataclass(frozen=True)
class Known:
    """A key that a person has called known."""

    fingerprint: str
    """SHA-256 of the raw public key, hexadecimal."""
    name: str


def folder() -> Path:
    """The user's data folder: WORLDWRIGHT_DATA, or `worldwright` where the system keeps such data."""
    return data_root()


def own() -> "Ed25519PrivateKey":
    """This machine's signing key, made the first time it is asked for.

    Raises:
        SigningError: others may read the file, or it holds no Ed25519 key.
        StorageError: the data folder cannot be written.
    """
    path = folder() / OWN
    if not path.exists():
        _make(path)
    if path.stat().st_mode & 0o077:
        raise SigningError(
            "others may read the signing key, so its signatures prove nothing",
            place=str(path),
            next_move=f"chmod 600 {path}, if nobody else has read it; else move it away, and a new one is made",
        )
    try:
        path.open("rb").close()
    except PermissionError as cause:
        raise SigningError(
            "this process may not read the signing key; the shell of an agent may not, so that none signs in this machine's name",
            place=str(path),
            next_move="let the tool `stamp.accept` sign, whose server runs outside of that shell, or type `worldwright stamp "
            "accept RUN` in a terminal of your own",
        ) from cause
    key = private_key(path)
    with suppress(OSError, SigningError):  # read where the key may not be
        beside, text = path.with_name(PUBLIC), public_text(key.public_key())
        if not beside.is_file() or beside.read_text(encoding="utf-8") != text:
            write_atomic(beside, text)
    return key


def own_fingerprint() -> str:
    """The fingerprint of this machine's signing key; empty when there is none yet or it cannot be used."""
    if not (folder() / OWN).exists():
        return ""
    try:
        return fingerprint(own().public_key())
    except SigningError as no:
        if not isinstance(no.__cause__, PermissionError):
            return ""
    try:
        return fingerprint(public_key(folder() / PUBLIC))
    except SigningError:
        return ""


def known(path: Path | None = None) -> tuple[Known, ...]:
    """The known keys: those of the user's list and of the checkout's; with `path`, those of that list alone."""
    lists = [path] if path else [folder() / KNOWN, SHIPPED]
    return tuple(key for one in lists for key in _listed(one))


def holder(fingerprint: str) -> tuple[Holder, str]:
    """Whose key it is, as far as this machine knows: ("own" | "known" | "unknown", the name it is known by)."""
    if fingerprint == own_fingerprint():
        return "own", "this machine"
    name = next((key.name for key in known() if key.fingerprint == fingerprint), None)
    return ("unknown", "") if name is None else ("known", name)


def trust(fingerprint: str, name: str, path: Path | None = None) -> None:
    """Add a key to the known ones under a name: to the user's list, or to the one at `path`."""
    path = path or folder() / KNOWN
    others = [key for key in _listed(path) if key.fingerprint != fingerprint]
    _write(path, [*others, Known(fingerprint, " ".join(name.split()))])


def forget(fingerprint: str) -> bool:
    """Take a key off the user's list, by the beginning of its fingerprint; whether one was there."""
    path = folder() / KNOWN
    before = list(_listed(path))
    left = [key for key in before if not key.fingerprint.startswith(fingerprint)]
    if len(left) < len(before):
        _write(path, left)
    return len(left) < len(before)


def _listed(path: Path) -> Iterator[Known]:
    try:
        lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return
    for line in lines:
        if match := LINE.fullmatch(line.strip()):
            yield Known(match[1], match[2] or "")


def _write(path: Path, keys: list[Known]) -> None:
    with writing("the list of known keys", path):
        write_atomic(path, "".join(f"sha256:{key.fingerprint} {key.name}\n" for key in keys))


def _make(path: Path) -> None:
    """Write a new key, whole or not at all, never over another and never readable by others."""
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import Encoding, NoEncryption, PrivateFormat

    pem = Ed25519PrivateKey.generate().private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    with writing("the signing key", path):
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        draft = path.with_name(f".{path.name}.{os.getpid()}")
        draft.unlink(missing_ok=True)
        handle = os.open(draft, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW, 0o600)
        try:
            with os.fdopen(handle, "wb") as stream:
                stream.write(pem)
                os.fsync(stream.fileno())
            os.link(draft, path)
        except FileExistsError:
            pass  # another process made one in the same moment: that one counts
        finally:
            draft.unlink(missing_ok=True)
