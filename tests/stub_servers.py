"""Stand-ins for servers on the loopback: each path answers by the next of its replies, and what was asked is kept."""

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import Any

import trimesh

BOX = trimesh.creation.box((0.4, 1.0, 0.4)).export(file_type="glb")
Reply = tuple[int, bytes, dict[str, str]]


def said(value: Any, status: int = 200) -> Reply:
    """A reply in JSON."""
    return status, json.dumps(value).encode(), {"Content-Type": "application/json"}


class StandIn:
    """A server: `replies` by path, the last of each again and again."""

    def __init__(self) -> None:
        self.replies: dict[str, list[Reply]] = {}
        self.asked: list[tuple[str, str, bytes, dict[str, str]]] = []
        held = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"] or 0))
                held.asked.append((self.command, self.path, body, dict(self.headers)))
                left = held.replies.get(self.path.partition("?")[0], [said({"detail": "no such path"}, 404)])
                status, content, headers = left.pop(0) if len(left) > 1 else left[0]
                self.send_response(status)
                for name, value in {"Content-Length": str(len(content)), **headers}.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(content)

            do_GET = do_POST  # noqa: N815

            def log_message(self, *_: object) -> None:
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()

    def paths(self) -> list[str]:
        """What was asked for, in order."""
        return [path.partition("?")[0] for _, path, _, _ in self.asked]

    def json(self, path: str) -> list[dict[str, Any]]:
        """The objects that were posted to a path."""
        return [json.loads(body) for method, asked, body, _ in self.asked if method == "POST" and asked == path]


@contextmanager
def stand_in() -> Iterator[StandIn]:
    """One, as long as it is needed."""
    made = StandIn()
    try:
        yield made
    finally:
        made.server.shutdown()
        made.server.server_close()
