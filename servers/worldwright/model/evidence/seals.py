"""The seal on a line of the journal: a signature by this machine's key, which no shell of an agent can read.

The chain of a journal binds its lines to each other, and anybody can chain invented ones. A seal is Ed25519 over the chain
before a line and the line; so a journal written anew by who has no key has none. It says that a process of worldwright which
could read the key wrote the line there, and no more: not that what the line says of a person is so, and a line that was typed
in an agent's shell has none, honest as it may be.
"""

import base64
from typing import TYPE_CHECKING, NamedTuple

from worldkit.data_folders import data_root

from .journal import Journal

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

KEY = "signing-key.pem"
MOST_NAMED = 4


class Sealed(NamedTuple):
    """The lines of a journal that one key has sealed."""

    many: int
    of: int
    others: tuple[tuple[int, str], ...]
    """Number and action of each line that it has not."""

    def text(self, key: str) -> str:
        """One clause; `key` names it."""
        if not self.many:
            return "NOT sealed: whoever can write the folder can have written it"
        named = ", ".join(f"{number} ({action})" for number, action in self.others[:MOST_NAMED])
        more = f" and {len(self.others) - MOST_NAMED} more" if len(self.others) > MOST_NAMED else ""
        return f"{self.many} of {self.of} lines sealed by {key}" + (f"; not sealed: {named}{more}" if named else "")


def made(previous: str, body: str) -> str:
    """The seal of a line that is about to be written; empty where there is no key, or this process may not use it."""
    path = data_root() / KEY
    try:
        if path.stat().st_mode & 0o077:  # others may have read it, so it says nothing
            return ""
        content = path.read_bytes()
    except OSError:
        return ""
    from cryptography.exceptions import UnsupportedAlgorithm
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import load_pem_private_key

    try:
        key = load_pem_private_key(content, password=None)
    except (ValueError, TypeError, UnsupportedAlgorithm):
        return ""
    return base64.b64encode(key.sign(_said(previous, body))).decode() if isinstance(key, Ed25519PrivateKey) else ""


def by(journal: Journal, key: "Ed25519PublicKey") -> Sealed:
    """Which lines of a journal a key has sealed."""
    lines = [(line, previous, _holds(line.unsealed, line.seal, previous, key)) for line, previous in journal.bound()]
    others = tuple((line.number, str((line.entry or {}).get("action", ""))) for line, _, holds in lines if not holds)
    return Sealed(len(lines) - len(others), len(lines), others)


def _holds(body: str, seal: str, previous: str, key: "Ed25519PublicKey") -> bool:
    from cryptography.exceptions import InvalidSignature

    try:
        key.verify(base64.b64decode(seal, validate=True), _said(previous, body))
    except (InvalidSignature, ValueError):
        return False
    return True


def _said(previous: str, body: str) -> bytes:
    return f"worldwright journal line\n{previous}\n{body}".encode()
