"""Google's Gemini models that paint: POST `/v1beta/models/MODEL:generateContent`, answered by a picture in base64.

Written after the public reference; no real server was reached from here, only stand-ins on the loopback that speak as it does.
"""

import base64
from typing import Any
from urllib.parse import quote

from ..orders import Price, Terms
from ..web_calls import Server

TERMS = Terms(
    "WORLDWRIGHT_GOOGLE_IMAGES",
    "make a key at aistudio.google.com and export it as GEMINI_API_KEY",
    "https://generativelanguage.googleapis.com",
    "GEMINI_API_KEY",
    key_header="x-goog-api-key",
)
MODEL = "gemini-2.5-flash-image"


def price(model: str) -> Price:
    """What a picture by a model costs."""
    return Price(0.039 if model == MODEL else None, "US dollars", "2025, one picture of 1024 x 1024")


def paint(words: str, model: str, server: Server) -> bytes:
    """The picture that it paints.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    asked = {
        "contents": [{"parts": [{"text": words}]}],
        "generationConfig": {"responseModalities": ["TEXT", "IMAGE"]},
    }
    told = server.post(f"/v1beta/models/{quote(model, safe='')}:generateContent", asked)
    said = []
    for part in _parts(told):
        held = part.get("inlineData") or part.get("inline_data")
        if isinstance(held, dict) and isinstance(held.get("data"), str):
            try:
                return base64.b64decode(held["data"], validate=True)
            except ValueError as error:
                raise server.garbage("base64 that is none", "picture") from error
        said.append(str(part.get("text") or ""))
    blocked = told.get("promptFeedback")
    why = blocked.get("blockReason") if isinstance(blocked, dict) else None
    if why or any(said):
        raise server.refused(why or " ".join(said), "say it in other words, or sculpt the thing (skill sculpting)")
    raise server.garbage(list(told), "picture")


def _parts(told: dict[str, Any]) -> list[dict[str, Any]]:
    """What its first candidate consists of."""
    rows = told.get("candidates")
    first = rows[0] if isinstance(rows, list) and rows and isinstance(rows[0], dict) else {}
    content = first.get("content")
    parts = content.get("parts") if isinstance(content, dict) else None
    return [part for part in parts if isinstance(part, dict)] if isinstance(parts, list) else []
