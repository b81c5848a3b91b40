"""Ed25519 keys in files, private and public, and how a key is known by its fingerprint."""

import hashlib
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model.errors import WorldwrightError

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey, Ed25519PublicKey

PASSWORD = "WORLDWRIGHT_KEY_PASSWORD"


class SigningError(WorldwrightError):
    """A key cannot be used, or a signature cannot be made."""

    code = "signing"


def private_key(path: Path) -> "Ed25519PrivateKey":
    """The key in a PEM or OpenSSH file; a `SigningError` says what is wrong with it."""
    from cryptography.exceptions import UnsupportedAlgorithm
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import load_pem_private_key, load_ssh_private_key

    word = os.environ.get(PASSWORD)
    content = _read(path)
    load: Any = load_ssh_private_key if b"OPENSSH PRIVATE KEY" in content else load_pem_private_key
    try:
        key = load(content, password=word.encode() if word else None)
    except (ValueError, TypeError, UnsupportedAlgorithm) as cause:  # also a missing or wrong password
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
    from cryptography.exceptions import UnsupportedAlgorithm
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
    from cryptography.hazmat.primitives.serialization import load_pem_public_key, load_ssh_public_key

    content = _read(path)
    try:
        key = load_ssh_public_key(content) if content.startswith(b"ssh-") else load_pem_public_key(content)
    except (ValueError, TypeError, UnsupportedAlgorithm) as cause:
        raise SigningError(
            f"the public key cannot be read: {cause}", place=str(path), next_move="give an Ed25519 public key"
        ) from cause
    if not isinstance(key, Ed25519PublicKey):
        raise SigningError("the public key is not Ed25519", place=str(path), next_move="give an Ed25519 public key")
    return key


def public_text(key: "Ed25519PublicKey") -> str:
    """The public key as PEM."""
    from cryptography.hazmat.primitives.serialization import Encoding, PublicFormat

    return key.public_bytes(Encoding.PEM, PublicFormat.SubjectPublicKeyInfo).decode()


def fingerprint(key: "Ed25519PublicKey") -> str:
    """SHA-256 of the raw public key, hexadecimal."""
    return hashlib.sha256(key.public_bytes_raw()).hexdigest()


def _read(path: Path) -> bytes:
    try:
        return path.read_bytes()
    except OSError as cause:
        raise SigningError(
            f"the key file cannot be read: {cause.strerror or cause}", place=str(path), next_move="name the key's file"
        ) from cause
