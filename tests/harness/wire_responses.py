"""The OpenAI Responses stream, as Codex reads it, in both of its modes.

Newer models get one `exec` tool that runs JavaScript, in which every other tool is a function (code mode; its definition
comes in an `additional_tools` item of the input); older ones get the tools themselves, an MCP tool under the namespace of
its server. A script's `Call` is the same in both: `mcp__server__tool`, `apply_patch` with the patch as text,
`exec_command`; `collaboration.*` is direct in both.
"""

import json
from itertools import count
from typing import Any

from script import Call, Request, Say, Turn, agent_of
from wire_messages import text_of

NUMBERS = count(1)
CODE = """// @exec: {"yield_time_ms": 120000, "max_output_tokens": 10000}
try {
  const result = await tools.%s(%s);
  for (const part of result?.content ?? []) if (part.type === "image") image(part);
  text(result?.content ? result.content.filter((part) => part.type === "text").map((part) => part.text).join("\\n") : result);
} catch (reason) { text("refused: " + reason); }
"""
"""How a model in code mode calls one tool and looks at what comes back."""


def _offered(body: dict[str, Any]) -> list[dict[str, Any]]:
    """The definitions of all tools, those inside namespaces too."""
    found = list(body.get("tools") or [])
    for item in body.get("input", []):
        if item.get("type") == "additional_tools":
            found += item.get("tools", [])
    return [tool for outer in found for tool in [outer, *outer.get("tools", [])]]


def read(body: dict[str, Any]) -> Request:
    """What is asked."""
    items = body.get("input", [])
    told = [text_of(item.get("content")) for item in items if item.get("role") == "developer"]
    results = [
        text_of(item.get("output"))
        for item in items
        if item.get("type") in ("function_call_output", "custom_tool_call_output")
    ]
    tools = _offered(body)
    instructions = "\n".join([str(body.get("instructions") or ""), *told])
    before = [str(body.get("instructions") or ""), json.dumps(body.get("tools") or []), *(json.dumps(i) for i in items)]
    return Request(
        agent_of(instructions), {str(tool.get("name") or tool["type"]) for tool in tools}, results, "\n".join(before)
    )


def stream(turn: Turn, body: dict[str, Any]) -> str:
    """A turn as server-sent events."""
    in_code = any(tool.get("name") == "exec" for tool in _offered(body))
    usage = {"input_tokens": 10, "output_tokens": 5, "total_tokens": 15}
    events: list[dict[str, Any]] = [{"type": "response.created", "response": {"id": "resp_scripted"}}]
    for index, step in enumerate(turn):
        item = _said(step) if isinstance(step, Say) else _called(step, in_code)
        events.append({"type": "response.output_item.done", "output_index": index, "item": item})
    events.append({"type": "response.completed", "response": {"id": "resp_scripted", "usage": usage}})
    return "".join(f"event: {event['type']}\ndata: {json.dumps(event)}\n\n" for event in events)


def _said(step: Say) -> dict[str, Any]:
    return {"type": "message", "role": "assistant", "content": [{"type": "output_text", "text": step.text}]}


def _called(step: Call, in_code: bool) -> dict[str, Any]:
    ident = f"call_{next(NUMBERS)}"
    namespace, _, name = step.tool.rpartition(".")
    if not namespace and in_code:
        code = CODE % (step.tool, json.dumps(step.given))
        return {"type": "custom_tool_call", "call_id": ident, "name": "exec", "input": code}
    if isinstance(step.given, str):
        return {"type": "custom_tool_call", "call_id": ident, "name": step.tool, "input": step.given}
    if step.tool.startswith("mcp__"):
        namespace, _, name = step.tool.rpartition("__")
    call = {"type": "function_call", "call_id": ident, "name": name, "arguments": json.dumps(step.given)}
    return {**call, "namespace": namespace} if namespace else call
