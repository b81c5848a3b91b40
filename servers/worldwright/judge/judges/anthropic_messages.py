"""Anthropic's Messages API, by Anthropic's client (`anthropic`), each picture a block of base64; the key is `ANTHROPIC_API_KEY`.

No real service was reached from here, only stand-ins on the loopback.
"""

import base64
from typing import Any

from .. import one_call
from . import Answer, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_ANTHROPIC"
LIMITS = Limits(pictures=100, bytes_each=5 << 20, bytes_together=24 << 20)
"""Of a request of at most 32 MB, in which pictures are a third longer."""
KEY, MOST_TOKENS = "ANTHROPIC_API_KEY", 4096


def starting() -> str:
    """How a user comes by one, in a few words."""
    return f"pip install anthropic, then: --address https://api.anthropic.com, with your key in {KEY}"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    place = one_call.place_of(question.address)
    secret = one_call.key(KEY, place)
    pictures: list[dict[str, Any]] = [
        {
            "type": "image",
            "source": {"type": "base64", "media_type": p.media_type, "data": base64.b64encode(p.data).decode()},
        }
        for p in question.pieces
    ]
    content = [*pictures, {"type": "text", "text": question.words}]
    with one_call.line(question.address, secret, question.silent_s) as http:
        from anthropic import Anthropic

        told = Anthropic(
            api_key=secret, base_url=question.address.rstrip("/"), http_client=http, max_retries=0,
            timeout=question.silent_s,
        ).messages.create(
            model=question.model, max_tokens=MOST_TOKENS, messages=[{"role": "user", "content": content}]
        )  # fmt: skip
        text = "".join(block.text for block in told.content if block.type == "text")
        if told.stop_reason == "refusal":
            raise one_call.declined(text, place)
        counts = (told.usage.input_tokens, told.usage.output_tokens) if told.usage else ()
        return one_call.answer(text, told.stop_reason == "max_tokens", place, told.model, *counts)
