"""The Anthropic Messages stream, as Claude Code reads it."""

import json
from itertools import count
from typing import Any

from script import Call, Request, Say, Turn, agent_of

NUMBERS = count(1)


def text_of(content: Any) -> str:
    """The text of a message's content, a string or a list of blocks."""
    if isinstance(content, str):
        return content
    return "\n".join(str(part.get("text", "")) for part in content or [] if isinstance(part, dict))


def read(body: dict[str, Any]) -> Request:
    """What is asked."""
    tools = [tool for tool in body.get("tools", []) if "name" in tool]
    messages = body.get("messages", [])
    results = [
        text_of(block.get("content"))
        for message in messages
        if isinstance(message.get("content"), list)
        for block in message["content"]
        if block.get("type") == "tool_result"
    ]
    system = text_of(body.get("system"))
    before = [system, *(json.dumps(tool) for tool in tools), *(text_of(m.get("content")) for m in messages)]
    return Request(agent_of(system), {tool["name"] for tool in tools}, results, "\n".join(before))


def stream(turn: Turn, body: dict[str, Any]) -> str:
    """A turn as server-sent events."""
    calls = any(isinstance(step, Call) for step in turn)
    message = {
        "id": "msg_scripted", "type": "message", "role": "assistant", "model": body.get("model", "scripted"),
        "content": [], "stop_reason": None, "stop_sequence": None, "usage": {"input_tokens": 10, "output_tokens": 1},
    }  # fmt: skip
    events: list[dict[str, Any]] = [{"type": "message_start", "message": message}]
    for index, step in enumerate(turn):
        if isinstance(step, Say):
            block: dict[str, Any] = {"type": "text", "text": ""}
            delta = {"type": "text_delta", "text": step.text}
        else:
            block = {"type": "tool_use", "id": f"toolu_{next(NUMBERS)}", "name": step.tool, "input": {}}
            delta = {"type": "input_json_delta", "partial_json": json.dumps(step.given)}
        events += [
            {"type": "content_block_start", "index": index, "content_block": block},
            {"type": "content_block_delta", "index": index, "delta": delta},
            {"type": "content_block_stop", "index": index},
        ]
    end = {"stop_reason": "tool_use" if calls else "end_turn", "stop_sequence": None}
    events += [{"type": "message_delta", "delta": end, "usage": {"output_tokens": 5}}, {"type": "message_stop"}]
    return "".join(f"event: {event['type']}\ndata: {json.dumps(event)}\n\n" for event in events)
