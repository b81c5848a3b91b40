"""Start the MCP servers as a harness does, and check that they answer `initialize` and list their tools."""

import json
import sys
import tempfile
import time
from pathlib import Path

from .. import expose
from ..contract.command import project
from .diagnosis import Diagnosis, last_line

PATIENCE_S = 30.0
"""Claude Code, Codex (as configured) and OpenCode wait so long for a server to start, s."""


def servers() -> Diagnosis:
    """Check that every server answers over stdio, by the command in the project's `.mcp.json`."""
    import anyio

    began = time.monotonic()
    answers: dict[str, str | int] = {}

    async def all_at_once() -> None:
        async with anyio.create_task_group() as group:
            for name in expose.SERVERS:
                group.start_soon(_ask, name, answers)

    anyio.run(all_at_once)
    wrong = {name: answer for name, answer in answers.items() if isinstance(answer, str)}
    found = "; ".join(f"{name}: {answer}" for name, answer in wrong.items())
    if not wrong:
        tools = sum(answer for answer in answers.values() if isinstance(answer, int))
        found = f"all {len(answers)} answer initialize with {tools} tools, in {time.monotonic() - began:.1f} s together"
    fix = f"see what it prints: {' '.join(_command(next(iter(wrong), 'lint'))[0])} (set up again with `make demo`)"
    return Diagnosis("servers", not wrong, found, fix)


def _command(name: str) -> tuple[list[str], Path]:
    """The command by which a harness starts the server, and its folder."""
    config = project() / ".mcp.json"
    if config.is_file():
        entry = json.loads(config.read_text(encoding="utf-8"))["mcpServers"][name]
        return [entry["command"], *entry["args"]], project()
    return [sys.executable, "-P", "-m", "worldwright.cli", "serve", name], Path.cwd()


async def _ask(name: str, answers: dict[str, str | int]) -> None:
    """Put the number of its tools, or what is wrong, into `answers`."""
    import anyio
    import mcp
    from mcp.client.stdio import StdioServerParameters, stdio_client

    words, folder = _command(name)
    parameters = StdioServerParameters(command=str(folder / words[0]), args=words[1:], cwd=str(folder))
    with tempfile.TemporaryFile("w+", encoding="utf-8", errors="replace") as log:
        try:
            with anyio.fail_after(PATIENCE_S):
                async with mcp.Client(stdio_client(parameters, errlog=log)) as client:
                    listed = {tool.name for tool in (await client.list_tools()).tools}
            known = {function.__name__ for function in expose.tools(name)}
            answers[name] = len(listed) if listed == known else f"lists {sorted(listed ^ known)} wrongly"
        except TimeoutError:
            answers[name] = f"no answer in {PATIENCE_S:.0f} s"
        except Exception as cause:
            log.seek(0)
            answers[name] = last_line(log.read() or _innermost(cause))


def _innermost(cause: BaseException) -> str:
    while isinstance(cause, BaseExceptionGroup):
        cause = cause.exceptions[0]
    return f"{type(cause).__name__}: {cause}"


CHECKS = (servers,)
