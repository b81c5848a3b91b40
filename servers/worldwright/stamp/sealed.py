"""Which lines of a run's journal a key has sealed that can be looked at here: the one beside the stamp, or this machine's."""

from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..model.evidence import seals
from ..model.evidence.journal import Journal
from . import keyring, signing

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey


def told(journal: Journal, keys: Iterable["Ed25519PublicKey"]) -> str:
    """One clause about the key that has sealed most of them, with its fingerprint."""
    found = [(seals.by(journal, key), signing.fingerprint(key)) for key in keys]
    if not found:
        return "no key lies there by which its lines could be sealed"
    most, name = max(found, key=lambda one: one[0].many)
    return most.text(f"key sha256:{name[:16]}")


def known(*beside: Path) -> "list[Ed25519PublicKey]":
    """The public keys in these files and this machine's own, as far as they can be read."""
    keys = []
    for path in (*beside, keyring.folder() / keyring.PUBLIC):
        with suppress(signing.SigningError):
            keys.append(signing.public_key(path))
    return keys
