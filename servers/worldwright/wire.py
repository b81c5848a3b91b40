"""Use standard input and output as an MCP server's wire, where a line that is no request gets an answer, too.

The SDK drops a line that it cannot read, while its sender waits. Here each such line is answered with JSON-RPC's own
error, under the request's id if it has one (JSON-RPC 2.0, section 5.1). Everything else is passed on unchanged.
"""

import json
import os
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from mcp_types import JSONRPCError

PARSE_ERROR, INVALID_REQUEST, INVALID_PARAMS = -32700, -32600, -32602
SHAPE = 'a request looks like {"jsonrpc": "2.0", "id": 1, "method": "tools/call", "params": {"name": ..., "arguments": {...}}}'


def problem(line: str) -> tuple[int, str, Any] | None:
    """(JSON-RPC error code, fault, the request's id or None) of a line that is no message; None for a message."""
    try:
        message = json.loads(line)
    except (ValueError, RecursionError) as cause:
        return PARSE_ERROR, f"the line is not JSON: {cause}", None
    if not isinstance(message, dict):
        return INVALID_REQUEST, f"a message is an object, not {_kind(message)}; {SHAPE}", None
    number = message.get("id")
    if "id" in message and (isinstance(number, bool) or not isinstance(number, str | int)):
        return INVALID_REQUEST, f"`id` is a text or a whole number, not {_kind(number)}", None
    if message.get("jsonrpc") != "2.0":
        return INVALID_REQUEST, f'`jsonrpc` must be "2.0"; {SHAPE}', number
    if "result" in message or "error" in message:
        return None  # an answer to a question of ours
    if not isinstance(message.get("method"), str):
        return INVALID_REQUEST, f"`method` is a text, not {_kind(message.get('method'))}; {SHAPE}", number
    given = message.get("params")
    if not isinstance(given, dict | None):
        return INVALID_PARAMS, f"`params` is an object, not {_kind(given)}; {SHAPE}", number
    if message["method"] == "tools/call":
        given = given or {}
        if not isinstance(given.get("name"), str):
            return (
                INVALID_PARAMS,
                f"`params.name` is the name of a tool, not {_kind(given.get('name'))}; {SHAPE}",
                number,
            )
        if not isinstance(given.get("arguments"), dict | None):
            return INVALID_PARAMS, f"`params.arguments` is an object, not {_kind(given['arguments'])}; {SHAPE}", number
    return None


def _kind(value: Any) -> str:
    for kind, name in ((bool, "true or false"), (int | float, "a number"), (str, "a text"), (list, "a list")):
        if isinstance(value, kind):
            return name
    return "nothing" if value is None else "an object"


@asynccontextmanager
async def streams() -> AsyncIterator[tuple[Any, Any]]:
    """The SDK's streams of messages over this process's standard input and output.

    Processes that it starts, and accidental prints, read nothing from the wire and write nothing to it.
    """
    import anyio
    from mcp.server.stdio import stdio_server
    from mcp.shared.message import SessionMessage

    wire, nothing = os.dup(0), os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    with os.fdopen(wire, encoding="utf-8", errors="replace") as source:
        lines = _Lines(anyio.wrap_file(source))
        async with stdio_server(stdin=lines) as (incoming, outgoing):  # type: ignore[arg-type]

            async def answer(error: "JSONRPCError") -> None:
                await outgoing.send(SessionMessage(error))

            lines.answer = answer
            yield incoming, outgoing


class _Lines:
    """Yields the lines of a file that are messages, and answers the others."""

    answer: Any = None

    def __init__(self, source: Any) -> None:
        self._source = source

    def __aiter__(self) -> "_Lines":
        return self

    async def __anext__(self) -> str:
        from mcp_types import ErrorData, JSONRPCError

        while True:
            line: str = await self._source.readline()
            if not line:
                raise StopAsyncIteration
            if not line.strip():
                continue
            found = problem(line)
            if found is None:
                return line
            code, what, number = found
            await self.answer(JSONRPCError(jsonrpc="2.0", id=number, error=ErrorData(code=code, message=what)))
