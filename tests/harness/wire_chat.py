"""The chat completions stream, as OpenCode reads it."""

import json
from itertools import count
from typing import Any

from script import Request, Say, Turn, agent_of
from wire_messages import text_of

NUMBERS = count(1)


def read(body: dict[str, Any]) -> Request:
    """What is asked."""
    tools = body.get("tools", [])
    messages = body.get("messages", [])
    system = "\n".join(text_of(m.get("content")) for m in messages if m.get("role") in ("system", "developer"))
    results = [text_of(m.get("content")) for m in messages if m.get("role") == "tool"]
    before = [*(json.dumps(tool) for tool in tools), *(text_of(m.get("content")) for m in messages)]
    return Request(agent_of(system), {tool["function"]["name"] for tool in tools}, results, "\n".join(before))


def stream(turn: Turn, body: dict[str, Any]) -> str:
    """A turn as server-sent events."""
    chunks: list[dict[str, Any]] = []
    number = 0
    for step in turn:
        if isinstance(step, Say):
            chunks.append({"role": "assistant", "content": step.text})
        else:
            call = {
                "index": number, "id": f"call_{next(NUMBERS)}", "type": "function",
                "function": {"name": step.tool, "arguments": json.dumps(step.given)},
            }  # fmt: skip
            chunks.append({"role": "assistant", "tool_calls": [call]})
            number += 1
    base = {"id": "chat_scripted", "object": "chat.completion.chunk", "created": 0, "model": "scripted"}
    lines = [{**base, "choices": [{"index": 0, "delta": delta, "finish_reason": None}]} for delta in chunks]
    lines.append({**base, "choices": [{"index": 0, "delta": {}, "finish_reason": "tool_calls" if number else "stop"}]})
    return "".join(f"data: {json.dumps(line)}\n\n" for line in lines) + "data: [DONE]\n\n"
