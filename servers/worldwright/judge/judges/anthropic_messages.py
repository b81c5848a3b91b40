"""Anthropic's Messages API: POST `ADDRESS/v1/messages`, each picture a block of base64; the key is `ANTHROPIC_API_KEY`.

Written after the protocol (version 2023-06-01); no real service was reached from here, only stand-ins on the loopback.
"""

import base64
from typing import Any

from ..one_call import garbage, key, place_of, post
from . import Answer, JudgeError, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_ANTHROPIC"
LIMITS = Limits(pictures=100, bytes_each=5 << 20, bytes_together=24 << 20)
"""Of a request of at most 32 MB, in which pictures are a third longer."""
KEY, VERSION, MOST_TOKENS = "ANTHROPIC_API_KEY", "2023-06-01", 4096


def starting() -> str:
    """How a user comes by one, in a few words."""
    return f"--address https://api.anthropic.com, with your key in {KEY}"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    place = place_of(question.address)
    pictures: list[dict[str, Any]] = [
        {
            "type": "image",
            "source": {"type": "base64", "media_type": p.media_type, "data": base64.b64encode(p.data).decode()},
        }
        for p in question.pieces
    ]
    content = [*pictures, {"type": "text", "text": question.words}]
    body = {
        "model": question.model,
        "max_tokens": MOST_TOKENS,
        "messages": [{"role": "user", "content": content}],
    }
    headers = {"x-api-key": key(KEY, place), "anthropic-version": VERSION}
    return _read(post(question.address, "/v1/messages", body, headers, question.silent_s), place)


def _read(told: dict[str, Any], place: str) -> Answer:
    try:
        text = "".join(block["text"] for block in told["content"] if block["type"] == "text")
        why, usage = told.get("stop_reason"), told.get("usage") or {}
        counts = usage.get("input_tokens"), usage.get("output_tokens")
    except (KeyError, TypeError, AttributeError) as cause:
        raise garbage(f"it answered no message: {str(told)[:80]}", place) from cause
    if why == "refusal":
        raise JudgeError(
            f"it declines to judge this film: {text[:120]}", code="declined", place=place,
            next_move="take another judge for it, and for all others",
        )  # fmt: skip
    if why == "max_tokens":
        raise JudgeError("its answer was cut off", code="cut_off", place=place, next_move="take a model that says less")
    if not text.strip():
        raise garbage("it answered nothing", place)
    return Answer(text, str(told.get("model") or ""), *(n if isinstance(n, int) else None for n in counts))
