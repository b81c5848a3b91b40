"""`worldwright serve NAME` runs one MCP server over stdio, or over streamable HTTP on the loopback interface."""

import threading

import click

from . import expose

STARTING = ("stage", "scan", "stamp")
"""Servers that start passes, one after the other."""


@click.command("serve")
@click.argument("name", type=click.Choice(list(expose.SERVERS)))
@click.option("--transport", type=click.Choice(["stdio", "http"]), default="stdio", show_default=True)
@click.option("--host", default="127.0.0.1", show_default=True, help="Interface to bind (http).")
@click.option("--port", type=int, default=8000, show_default=True, help="Port to bind (http).")
def command(name: str, transport: str, host: str, port: int) -> None:
    """Run one MCP server over stdio or streamable HTTP."""
    if name == "retrieve":  # a server lives long enough for missing vectors to be made beside it
        from .retrieve.semantic import ranker

        ranker.LASTING.set()
        threading.Thread(target=ranker.warm, daemon=True).start()
    if name in STARTING:
        from .stage.warm import kept_warm

        kept_warm.keep()
    expose.serve(name, transport, host, port)
