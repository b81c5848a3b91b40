"""OpenAI's images and all that speaks like it: POST `/v1/images/generations`, answered by a picture in base64 or its address.

Written after the public reference; no real server was reached from here, only stand-ins on the loopback that speak as it does.
"""

import base64

from ..orders import Price, Terms
from ..web_calls import Server

TERMS = Terms(
    "WORLDWRIGHT_OPENAI_IMAGES",
    "make a key at platform.openai.com and export it as OPENAI_API_KEY",
    "https://api.openai.com",
    "OPENAI_API_KEY",
)
MODEL = "gpt-image-1"
SIZE, QUALITY = "1024x1024", "medium"


def price(model: str) -> Price:
    """What a picture by a model costs."""
    known = 0.042 if model == MODEL else None
    return Price(known, "US dollars", f"2025, {QUALITY}, {SIZE}")


def paint(words: str, model: str, server: Server) -> bytes:
    """The picture that it paints.

    Raises:
        MintError: it is not there, refuses, or answers something else.
    """
    asked = {"model": model, "prompt": words, "n": 1, "size": SIZE}
    if model.startswith("gpt-image"):
        asked |= {"quality": QUALITY, "output_format": "png"}
    told = server.post("/v1/images/generations", asked)
    rows = told.get("data")
    row = rows[0] if isinstance(rows, list) and rows and isinstance(rows[0], dict) else {}
    if isinstance(row.get("b64_json"), str):
        try:
            return base64.b64decode(row["b64_json"], validate=True)
        except ValueError as error:
            raise server.garbage("base64 that is none", "picture") from error
    if isinstance(row.get("url"), str):
        return server.download(row["url"])
    raise server.garbage(list(told), "picture")
