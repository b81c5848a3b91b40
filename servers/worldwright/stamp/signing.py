"""A signature on the stamp, with a key of the user's: who accepted this world, not only what was accepted.

The signature is a DSSE envelope (Dead Simple Signing Envelope v1, the one in-toto uses) beside the stamp: Ed25519 over
the pre-authentication encoding of the payload type and the stamp's bytes. Keys are PEM or OpenSSH files; a private key's
password is taken from WORLDWRIGHT_KEY_PASSWORD. The public key lies beside the signature, so that anybody can check the
bytes; whose key it is follows from the keys known to this machine (`keyring`), or from a key obtained elsewhere (`verify
--signer`).
"""

import base64
import json
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from worldkit.files import write_atomic

from ..model.frozen import Frozen
from . import keyring
from .key_files import PASSWORD, SigningError, fingerprint, private_key, public_key

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

__all__ = [
    "ENVELOPE",
    "PASSWORD",
    "PUBLIC",
    "Signature",
    "SigningError",
    "check",
    "fingerprint",
    "private_key",
    "public_key",
    "sign",
]
ENVELOPE = "stamp.dsse.json"
PUBLIC = "stamp.pub"
TYPE = "application/vnd.in-toto+json"


def encoded(payload: bytes) -> bytes:
    """What is signed: DSSE's pre-authentication encoding, `DSSEv1 LEN(type) type LEN(payload) payload`."""
    return b"DSSEv1 %d %s %d %s" % (len(TYPE), TYPE.encode(), len(payload), payload)


def sign(folder: Path, stamp: str, key: "Ed25519PrivateKey") -> str:
    """Sign the stamp of an accepted folder; returns the key's fingerprint."""
    from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat

    payload = (folder / stamp).read_bytes()
    public = key.public_key()
    envelope = {
        "payloadType": TYPE,
        "payload": base64.b64encode(payload).decode(),
        "signatures": [{"keyid": fingerprint(public), "sig": base64.b64encode(key.sign(encoded(payload))).decode()}],
    }
    write_atomic(folder / PUBLIC, public.public_bytes(Encoding.PEM, PublicFormat.SubjectPublicKeyInfo))
    write_atomic(folder / ENVELOPE, json.dumps(envelope, indent=2) + "\n")
    return fingerprint(public)


class Signature(Frozen):
    """What the signature on a stamp says about who accepted the world."""

    holder: Literal["own", "known", "unknown", "unsigned", "broken"]
    """`own`: this machine's key. `known`: a key that a person here has called known. `broken`: it does not hold."""
    fingerprint: str = ""
    """SHA-256 of the raw public key, hexadecimal."""
    name: str = ""
    """The name under which the key is known here."""
    problem: str = ""
    """Why it does not hold."""

    @property
    def vouched(self) -> bool:
        """Whether a key that is known here signed every byte of the stamp."""
        return self.holder in ("own", "known")

    def text(self) -> str:
        """A clause that says who signed, or why the signature does not count."""
        key = f"sha256:{self.fingerprint[:16]}"
        return {
            "own": f"signed by this machine's key {key}",
            "known": f"signed by {self.name or 'a known key'}, key {key}",
            "unknown": f"signed by a key UNKNOWN here, {key}",
            "unsigned": "UNSIGNED: whoever can write the folder can have made it",
            "broken": self.problem,
        }[self.holder]


def check(folder: Path, stamp: str, signer: Path | None = None) -> Signature:
    """Whether the signature holds, and whose it is.

    Args:
        folder: the accepted folder.
        stamp: name of the stamp in it.
        signer: the public key that must have signed; with None, the one beside the signature.
    """
    from cryptography.exceptions import InvalidSignature

    def broken(problem: str) -> Signature:
        return Signature(holder="broken", problem=problem)

    if not (folder / ENVELOPE).is_file():
        return Signature(holder="unsigned") if signer is None else broken("the stamp is not signed")
    try:
        key = public_key(signer or folder / PUBLIC)
        envelope = json.loads((folder / ENVELOPE).read_bytes())
        payload = base64.b64decode(envelope["payload"], validate=True)
        (signature,) = envelope["signatures"]
        key.verify(base64.b64decode(signature["sig"], validate=True), encoded(payload))
    except InvalidSignature:
        return broken("the signature is not that key's" if signer else "the signature does not fit")
    except SigningError:
        if signer:
            raise
        return broken(f"{PUBLIC} cannot be read")
    except (ValueError, KeyError, TypeError, OSError, RecursionError) as cause:
        return broken(f"{ENVELOPE} is damaged: {cause}")
    if payload != (folder / stamp).read_bytes():
        return broken("another stamp was signed")
    if signer:
        return Signature(holder="known", fingerprint=fingerprint(key), name=signer.name)
    holder, name = keyring.holder(fingerprint(key))
    return Signature(holder=holder, fingerprint=fingerprint(key), name=name)
