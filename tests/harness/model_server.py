"""A scripted model on loopback that speaks what the three harnesses speak: Messages, chat completions, Responses."""

import json
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import wire_chat
import wire_messages
import wire_responses
from script import Script

WIRES = {"/messages": wire_messages, "/chat/completions": wire_chat, "/responses": wire_responses}


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


def _handler(script: Script) -> type[BaseHTTPRequestHandler]:
    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def log_message(self, *_: object) -> None:
            pass

        def do_GET(self) -> None:
            self._json({"data": [{"id": "scripted", "object": "model"}], "models": []})

        def do_HEAD(self) -> None:
            self._json({})

        def do_POST(self) -> None:
            body = json.loads(self.rfile.read(int(self.headers.get("Content-Length", 0))) or b"{}")
            if "count_tokens" in self.path:
                self._json({"input_tokens": 100})
                return
            wire = next((wire for path, wire in WIRES.items() if path in self.path), None)
            if wire is None:
                self._json({"error": {"message": f"no {self.path} here"}}, 404)
            else:
                self._send(wire.stream(script.next(wire.read(body)), body).encode(), "text/event-stream")

        def _json(self, value: Any, status: int = 200) -> None:
            self._send(json.dumps(value).encode(), "application/json", status)

        def _send(self, data: bytes, kind: str, status: int = 200) -> None:
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(data)))
            self.end_headers()
            if self.command != "HEAD":
                self.wfile.write(data)

    return Handler
