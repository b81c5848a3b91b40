"""A scripted model on loopback: what each agent says next, streamed as the Anthropic Messages API or as chat completions.

A script maps an agent (`main`, or a role's name) to its turns; a turn is a list of steps: `Say(text)` or `Call(tool, input)`.
Which agent asks is read off its system prompt. What the tools answered is kept, so that a test can look at it.
"""

import json
import threading
from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

ROLES = ("plan", "code", "visual", "review")


@dataclass(frozen=True)
class Say:
    """The model says something."""

    text: str


@dataclass(frozen=True)
class Call:
    """The model calls a tool."""

    tool: str
    given: dict[str, Any]


Turn = list[Say | Call]
Lazy = Callable[[], Turn]
"""A turn that is made when its time comes, from what lies on disk by then."""


@dataclass
class Script:
    """Turns by agent; an agent without turns left says that it is done."""

    turns: dict[str, list[Turn | Lazy]]
    results: dict[str, list[str]] = field(default_factory=lambda: defaultdict(list))
    """What the tools answered, by agent, in order."""
    tools: dict[str, set[str]] = field(default_factory=lambda: defaultdict(set))
    """The tools each agent was offered."""
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def next(self, agent: str, tools: set[str], results: list[str]) -> Turn:
        """The agent's next turn; notes what came back."""
        with self._lock:
            self.tools[agent] |= tools
            known = self.results[agent]
            known += results[len(known) :] if results[: len(known)] == known else results
            queue = self.turns.get(agent, [])
            turn = queue.pop(0) if queue else [Say("Done.")]
        return turn() if callable(turn) else turn


def agent_of(system: str) -> str:
    """`main`, or the role whose instructions the system prompt holds."""
    return next((name for name in ROLES if f"You are the {name} role of one run" in system), "main")


class Model:
    """The server; a context manager with its `url`."""

    def __init__(self, script: Script) -> None:
        self.script = script
        self._server = ThreadingHTTPServer(("127.0.0.1", 0), _handler(script))
        self.url = f"http://127.0.0.1:{self._server.server_port}"

    def __enter__(self) -> "Model":
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_: object) -> None:
        self._server.shutdown()


def _text(content: Any) -> str:
    if isinstance(content, str):
        return content
    return "\n".join(str(part.get("text", "")) for part in content or [] if isinstance(part, dict))


def _handler(script: Script) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def log_message(self, *_: object) -> None:
            pass

        def do_GET(self) -> None:
            self._json({"data": [{"id": "scripted", "object": "model"}]})

        def do_HEAD(self) -> None:
            self._json({})

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers.get("Content-Length", 0))) or b"{}")
            if "count_tokens" in self.path:
                self._json({"input_tokens": 100})
            elif "/messages" in self.path:
                self._stream(_anthropic(_turn_of_messages(script, body), body))
            elif "/chat/completions" in self.path:
                self._stream(_chat(_turn_of_chat(script, body)))
            else:
                self._json({"error": {"message": f"no {self.path} here"}}, 404)

        def _json(self, value: Any, status: int = 200) -> None:
            data = json.dumps(value).encode()
            self.send_response(status)
            self.send_header("Content-Type", "application/json")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            if self.command != "HEAD":
                self.wfile.write(data)

        def _stream(self, events: str) -> None:
            data = events.encode()
            self.send_response(200)
            self.send_header("Content-Type", "text/event-stream")
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            self.wfile.write(data)

    return Handler


def _turn_of_messages(script: Script, body: dict[str, Any]) -> Turn:
    tools = {tool["name"] for tool in body.get("tools", []) if "name" in tool}
    if not tools:
        return [Say("A world.")]  # titles, summaries, topic checks
    results = [
        _text(block.get("content"))
        for message in body.get("messages", [])
        if isinstance(message.get("content"), list)
        for block in message["content"]
        if block.get("type") == "tool_result"
    ]
    return script.next(agent_of(_text(body.get("system"))), tools, results)


def _turn_of_chat(script: Script, body: dict[str, Any]) -> Turn:
    tools = {tool["function"]["name"] for tool in body.get("tools", [])}
    if not tools:
        return [Say("A world.")]
    messages = body.get("messages", [])
    system = "\n".join(_text(m.get("content")) for m in messages if m.get("role") in ("system", "developer"))
    results = [_text(m.get("content")) for m in messages if m.get("role") == "tool"]
    return script.next(agent_of(system), tools, results)


def _anthropic(turn: Turn, body: dict[str, Any]) -> str:
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
            block = {
                "type": "tool_use",
                "id": f"toolu_{abs(hash((step.tool, json.dumps(step.given)))) % 10**12}_{index}",
                "name": step.tool,
                "input": {},
            }
            delta = {"type": "input_json_delta", "partial_json": json.dumps(step.given)}
        events += [
            {"type": "content_block_start", "index": index, "content_block": block},
            {"type": "content_block_delta", "index": index, "delta": delta},
            {"type": "content_block_stop", "index": index},
        ]
    reason = "tool_use" if calls else "end_turn"
    events += [
        {
            "type": "message_delta",
            "delta": {"stop_reason": reason, "stop_sequence": None},
            "usage": {"output_tokens": 5},
        },
        {"type": "message_stop"},
    ]
    return "".join(f"event: {event['type']}\ndata: {json.dumps(event)}\n\n" for event in events)


def _chat(turn: Turn) -> str:
    chunks: list[dict[str, Any]] = []
    number = 0
    for step in turn:
        if isinstance(step, Say):
            chunks.append({"role": "assistant", "content": step.text})
        else:
            call = {
                "index": number, "id": f"call_{number}_{abs(hash(json.dumps(step.given))) % 10**9}", "type": "function",
                "function": {"name": step.tool, "arguments": json.dumps(step.given)},
            }  # fmt: skip
            chunks.append({"role": "assistant", "tool_calls": [call]})
            number += 1
    base = {"id": "chat_scripted", "object": "chat.completion.chunk", "created": 0, "model": "scripted"}
    lines = [{**base, "choices": [{"index": 0, "delta": delta, "finish_reason": None}]} for delta in chunks]
    lines.append({**base, "choices": [{"index": 0, "delta": {}, "finish_reason": "tool_calls" if number else "stop"}]})
    return "".join(f"data: {json.dumps(line)}\n\n" for line in lines) + "data: [DONE]\n\n"
