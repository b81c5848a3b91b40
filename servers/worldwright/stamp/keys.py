"""`worldwright keys`: which keys sign here, and whose signatures are known."""

import sys
from pathlib import Path

import click

from ..cli import report_errors
from ..model.printable import line


@click.group("keys")
def command() -> None:
    """Manage the key that signs what is accepted here, and the keys that are known."""


@command.command()
def show() -> None:
    """Print this machine's key (made now, if there is none) and every known one."""
    from . import keyring, signing

    def work() -> None:
        click.echo(f"sha256:{signing.fingerprint(keyring.own().public_key())} this machine ({keyring.folder()})")
        for key in keyring.known():
            click.echo(line(f"sha256:{key.fingerprint} {key.name}"))

    report_errors(work)


@command.command()
@click.argument("key")
@click.option("--name", required=True, help="Whose key it is, as you know it from another source than the folder.")
def trust(key: str, name: str) -> None:
    """Call a key known: a fingerprint (sha256:…), a public key file, or the stamped folder that it signed."""
    from . import keyring, signing

    def work() -> None:
        fingerprint = key.removeprefix("sha256:")
        if not keyring.LINE.fullmatch(f"sha256:{fingerprint}"):
            path = Path(key)
            found = [p for p in (path / signing.PUBLIC, path / "accepted" / signing.PUBLIC) if p.is_file()]
            fingerprint = signing.fingerprint(signing.public_key(found[0] if found else path))
        keyring.trust(fingerprint, name)
        click.echo(f"known from now on: sha256:{fingerprint} {name}")

    report_errors(work)


@command.command()
@click.argument("fingerprint")
def forget(fingerprint: str) -> None:
    """Take a key off your list of known ones, by its fingerprint or the beginning of it."""
    from . import keyring

    gone = report_errors(lambda: keyring.forget(fingerprint.removeprefix("sha256:")))
    click.echo("forgotten" if gone else "no such key is on the list")
    sys.exit(0 if gone else 1)
