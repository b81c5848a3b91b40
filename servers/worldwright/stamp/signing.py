"""A signature on the stamp, with a key of the user's: who accepted this world, not only what was accepted.

The signature is a DSSE envelope (Dead Simple Signing Envelope v1, the one in-toto uses) beside the stamp: Ed25519 over
the pre-authentication encoding of the payload type and the stamp's bytes. Keys are PEM or OpenSSH files; a private key's
password is taken from WORLDWRIGHT_KEY_PASSWORD. The public key lies beside the signature, so that anybody can check the
bytes; whose key it is, only a key got in another way can tell (`verify --signer`).
"""

import base64
import hashlib
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic

from ..model.errors import WorldwrightError

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

ENVELOPE = "stamp.dsse.json"
PUBLIC = "stamp.pub"
TYPE = "application/vnd.in-toto+json"
PASSWORD = "WORLDWRIGHT_KEY_PASSWORD"


class SigningError(WorldwrightError):
    """A key cannot be used, or a signature cannot be made."""

    code = "signing"


def encoded(payload: bytes) -> bytes:
    """What is signed: DSSE's pre-authentication encoding, `DSSEv1 LEN(type) type LEN(payload) payload`."""
    return b"DSSEv1 %d %s %d %s" % (len(TYPE), TYPE.encode(), len(payload), payload)


def private_key(path: Path) -> "Ed25519PrivateKey":
    """The key in a PEM or OpenSSH file; a `SigningError` says what is wrong with it."""
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import load_pem_private_key, load_ssh_private_key

    word = os.environ.get(PASSWORD)
    content = _read(path)
    load: Any = load_ssh_private_key if b"OPENSSH PRIVATE KEY" in content else load_pem_private_key
    try:
        key = load(content, password=word.encode() if word else None)
    except (ValueError, TypeError) as cause:  # also a missing or wrong password
        raise SigningError(
            f"the key cannot be read: {cause}",
            place=str(path),
            next_move=f"give an Ed25519 key; its password in {PASSWORD}",
        ) from cause
    if not isinstance(key, Ed25519PrivateKey):
        raise SigningError(
            f"the key is {type(key).__name__}, not Ed25519",
            place=str(path),
            next_move="make one: `openssl genpkey -algorithm ed25519 -out key.pem`, or `ssh-keygen -t ed25519`",
        )
    return key


def public_key(path: Path) -> "Ed25519PublicKey":
    """The public key in a PEM or OpenSSH file."""
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
    from cryptography.hazmat.primitives.serialization import load_pem_public_key, load_ssh_public_key

    content = _read(path)
    try:
        key = load_ssh_public_key(content) if content.startswith(b"ssh-") else load_pem_public_key(content)
    except (ValueError, TypeError) as cause:
        raise SigningError(
            f"the public key cannot be read: {cause}", place=str(path), next_move="give an Ed25519 public key"
        ) from cause
    if not isinstance(key, Ed25519PublicKey):
        raise SigningError("the public key is not Ed25519", place=str(path), next_move="give an Ed25519 public key")
    return key


def fingerprint(key: "Ed25519PublicKey") -> str:
    """SHA-256 of the raw public key, hexadecimal."""
    return hashlib.sha256(key.public_bytes_raw()).hexdigest()


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


def check(folder: Path, stamp: str, signer: Path | None = None) -> tuple[bool, str] | None:
    """Whether the signature holds, and what it says; None when there is none and none was asked for.

    Args:
        folder: the accepted folder.
        stamp: name of the stamp in it.
        signer: the public key that must have signed; with None, the one beside the signature.
    """
    from cryptography.exceptions import InvalidSignature

    if not (folder / ENVELOPE).is_file():
        return None if signer is None else (False, "the stamp is not signed")
    try:
        key = public_key(signer or folder / PUBLIC)
        envelope = json.loads((folder / ENVELOPE).read_bytes())
        payload = base64.b64decode(envelope["payload"], validate=True)
        (signature,) = envelope["signatures"]
        key.verify(base64.b64decode(signature["sig"], validate=True), encoded(payload))
    except InvalidSignature:
        return False, "the signature is not that key's" if signer else "the signature does not fit"
    except SigningError:
        if signer:
            raise
        return False, f"{PUBLIC} cannot be read"
    except (ValueError, KeyError, TypeError, OSError, RecursionError) as cause:
        return False, f"{ENVELOPE} is damaged: {cause}"
    if payload != (folder / stamp).read_bytes():
        return False, "another stamp was signed"
    known = "" if signer else "; whose key that is, say with --signer"
    return True, f"signed by Ed25519 key sha256:{fingerprint(key)[:16]}{known}"


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as cause:
        raise SigningError(
            f"the key file cannot be read: {cause.strerror or cause}", place=str(path), next_move="name the key's file"
        ) from cause
