"""Any server that speaks OpenAI's chat completions with pictures: OpenAI, vLLM, llama.cpp, Ollama, LM Studio, gateways.

POST `ADDRESS/chat/completions`, each picture an `image_url` of data. The key is `WORLDWRIGHT_JUDGE_KEY`, which a server on this
machine may need none of; `OPENAI_API_KEY` is sent to OpenAI's own host alone. Written after the protocol; no real service
was reached from here, only stand-ins on the loopback.
"""

import base64
from typing import Any
from urllib.parse import urlsplit

from ..one_call import garbage, key, place_of, post
from . import Answer, JudgeError, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_OPENAI"
LIMITS = Limits(pictures=50, bytes_each=20 << 20, bytes_together=40 << 20)
KEY, OWN_KEY, OWN_HOST = "WORLDWRIGHT_JUDGE_KEY", "OPENAI_API_KEY", "api.openai.com"


def starting() -> str:
    """How a user comes by one, in a few words."""
    return f"name a server that speaks chat completions: --address https://api.openai.com/v1, with its key in {KEY}"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    place = place_of(question.address)
    own = place.startswith("https:") and urlsplit(place).hostname == OWN_HOST
    secret = key(KEY, place, needed=False) or key(OWN_KEY, place) if own else key(KEY, place, needed=False)
    pictures = [
        {"type": "image_url", "image_url": {"url": f"data:{p.media_type};base64,{base64.b64encode(p.data).decode()}"}}
        for p in question.pieces
    ]
    body = {
        "model": question.model,
        "messages": [{"role": "user", "content": [{"type": "text", "text": question.words}, *pictures]}],
    }
    headers = {"Authorization": f"Bearer {secret}"} if secret else {}
    return _read(post(question.address, "/chat/completions", body, headers, question.silent_s), place)


def _read(told: dict[str, Any], place: str) -> Answer:
    try:
        choice = told["choices"][0]
        message, why = choice["message"], choice.get("finish_reason")
        text, refusal = message.get("content"), message.get("refusal")
        usage = told.get("usage") or {}
        if isinstance(text, list):  # some servers answer in parts
            text = "".join(part.get("text", "") for part in text if part.get("type") == "text")
        counts = usage.get("prompt_tokens"), usage.get("completion_tokens")
        model = str(told.get("model") or "")
    except (KeyError, IndexError, TypeError, AttributeError) as cause:
        raise garbage(f"it answered no chat completion: {str(told)[:80]}", place) from cause
    if refusal or why == "content_filter":
        raise JudgeError(
            f"it declines to judge this film: {str(refusal or why)[:120]}", code="declined", place=place,
            next_move="take another judge for it, and for all others",
        )  # fmt: skip
    if why == "length":
        raise JudgeError("its answer was cut off", code="cut_off", place=place, next_move="raise its output limit")
    if not isinstance(text, str) or not text.strip():
        raise garbage("it answered nothing", place)
    return Answer(text, model, *(n if isinstance(n, int) else None for n in counts))
