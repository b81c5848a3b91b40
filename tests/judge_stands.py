"""Stand-ins on the loopback that speak what the judges' servers speak, and what they answer."""

import base64
import json
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from worldwright.judge.criteria import Criteria

CRITERIA = Criteria(objects=("a red ball",), event="it falls", standards=("it gets faster", "it bounces"))

URL_SAFE = str.maketrans("-_", "+/")
"""The letters of base64 that some clients write in another way, which their servers read as well."""


class StandIn:
    """Answers each POST by the next of its replies, or for ever by the last: (status, body, headers), or a number: silence, s."""

    def __init__(self) -> None:
        self.replies: list = []
        self.asked: list[tuple[str, dict, dict[str, str]]] = []
        held = self

        class Handler(BaseHTTPRequestHandler):
            def do_POST(self) -> None:
                body = self.rfile.read(int(self.headers["Content-Length"]))
                held.asked.append((self.path, json.loads(body), {k.lower(): v for k, v in self.headers.items()}))
                reply = held.replies.pop(0) if len(held.replies) > 1 else held.replies[0]
                if isinstance(reply, float):
                    time.sleep(reply)
                    return
                status, content, headers = reply
                content = content if isinstance(content, bytes) else json.dumps(content).encode()
                self.send_response(status)
                for name, value in {"Content-Length": str(len(content)), **headers}.items():
                    self.send_header(name, value)
                self.end_headers()
                self.wfile.write(content)

            def log_message(self, *_: object) -> None:
                pass

        self.server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        self.address = f"http://127.0.0.1:{self.server.server_port}"
        threading.Thread(target=self.server.serve_forever, args=(0.02,), daemon=True).start()


def said(*no: str) -> str:
    """An answer: Yes to all but these fields."""
    return json.dumps({name: "No" if name in no else "Yes" for name in CRITERIA.fields})


def chat(text: str, why: str = "stop") -> dict:
    """A chat completion."""
    usage = {"prompt_tokens": 900, "completion_tokens": 20, "total_tokens": 920}
    choice = {"index": 0, "message": {"role": "assistant", "content": text}, "finish_reason": why}
    return {"id": "c", "object": "chat.completion", "model": "eye-1-2026", "choices": [choice], "usage": usage}


def message(text: str, why: str = "end_turn") -> dict:
    """An answer of the Messages API."""
    usage = {"input_tokens": 900, "output_tokens": 20}
    content = [{"type": "text", "text": text}]
    return {"id": "m", "type": "message", "role": "assistant", "model": "eye-1-2026", "content": content, "stop_reason": why, "usage": usage}  # fmt: skip


def candidate(text: str, why: str = "STOP") -> dict:
    """An answer of generateContent, with a thought before it."""
    parts = [{"text": "let me see", "thought": True}, {"text": text}]
    found = [{"content": {"role": "model", "parts": parts}, "finishReason": why, "index": 0}]
    usage = {"promptTokenCount": 900, "candidatesTokenCount": 20}
    return {"candidates": found, "usageMetadata": usage, "modelVersion": "eye-1-2026"}


def pictures_of(body: dict) -> list[bytes]:
    """The bytes of every picture or film in a request, whichever protocol it is of."""
    found = []

    def look(value: object) -> None:
        if isinstance(value, dict):
            for key, one in value.items():
                if key == "url":
                    found.append(base64.b64decode(one.partition(";base64,")[2], validate=True))
                elif key == "data" and isinstance(one, str):
                    found.append(base64.b64decode(one.translate(URL_SAFE), validate=True))
                else:
                    look(one)
        elif isinstance(value, list):
            for one in value:
                look(one)

    look(body)
    return found
