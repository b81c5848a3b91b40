"""`worldwright contract sync|check|show`: the harnesses' files, written from the roles or compared with them."""

import sys
from pathlib import Path

import click

from worldkit.files import write_atomic

from . import generated
from .roles import ROLES


def project() -> Path:
    """The checkout: the folder that holds `servers/`."""
    return Path(__file__).resolve().parents[3]


@click.group("contract")
def command() -> None:
    """The roles of a run, in each harness's own files."""


@command.command("sync")
def sync() -> None:
    """Write the agents, tool lists, permissions, hooks and MCP configuration of every harness."""
    for name, text in generated.files().items():
        path = project() / name
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomic(path, text)
            click.echo(f"wrote {name}")


@command.command("check")
def check() -> None:
    """Say which files have drifted from the roles; exit code 1 when one has."""
    drifted = stale(project())
    for name, why in drifted.items():
        click.echo(f"{name}: {why}")
    click.echo("next: worldwright contract sync" if drifted else f"{len(generated.files())} files are as the roles say")
    sys.exit(1 if drifted else 0)


@command.command("show")
def show() -> None:
    """The roles, with what each may use and write."""
    for role in ROLES:
        click.echo(
            f"{role.name}: {role.purpose}\n  tools: {', '.join(role.tools)}\n  writes: {', '.join(role.writes) or '-'}"
        )


def stale(root: Path) -> dict[str, str]:
    """Generated files that are missing or differ, each with which of the two it is."""
    found = {}
    for name, text in generated.files().items():
        path = root / name
        if not path.is_file():
            found[name] = "missing"
        elif path.read_text(encoding="utf-8") != text:
            found[name] = "differs from the roles"
    return found
