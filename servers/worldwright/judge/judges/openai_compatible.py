"""Any server that speaks OpenAI's chat completions with pictures: OpenAI, vLLM, llama.cpp, Ollama, LM Studio, gateways.

By OpenAI's client (`openai`), each picture an `image_url` of data. The key is `WORLDWRIGHT_JUDGE_KEY`, which a server on this
machine may need none of; `OPENAI_API_KEY` is sent to OpenAI's own host alone. No real service was reached from here, only
stand-ins on the loopback.
"""

import base64
from typing import Any
from urllib.parse import urlsplit

from .. import one_call
from . import Answer, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_OPENAI"
LIMITS = Limits(pictures=50, bytes_each=20 << 20, bytes_together=40 << 20)
KEY, OWN_KEY, OWN_HOST = "WORLDWRIGHT_JUDGE_KEY", "OPENAI_API_KEY", "api.openai.com"


def starting() -> str:
    """How a user comes by one, in a few words."""
    return f"pip install openai, then name a server: --address https://api.openai.com/v1, with its key in {KEY}"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    place = one_call.place_of(question.address)
    own = place.startswith("https:") and urlsplit(place).hostname == OWN_HOST
    secret = one_call.key(KEY, place, needed=False) or (one_call.key(OWN_KEY, place) if own else "")
    pictures: list[Any] = [
        {"type": "image_url", "image_url": {"url": f"data:{p.media_type};base64,{base64.b64encode(p.data).decode()}"}}
        for p in question.pieces
    ]
    content = [{"type": "text", "text": question.words}, *pictures]
    with one_call.line(question.address, secret, question.silent_s) as http:
        from openai import OpenAI

        told = OpenAI(
            api_key=secret or "none",  # without a secret, `line` sends no key at all
            base_url=question.address, http_client=http, max_retries=0, timeout=question.silent_s,
        ).chat.completions.create(model=question.model, messages=[{"role": "user", "content": content}])  # fmt: skip
        choice, usage = told.choices[0], told.usage
        text, why = choice.message.content, choice.finish_reason
        if choice.message.refusal or why == "content_filter":
            raise one_call.declined(choice.message.refusal or why, place)
        if isinstance(text, list):  # some servers answer in parts
            text = "".join(part["text"] for part in text if part["type"] == "text")
        counts = (usage.prompt_tokens, usage.completion_tokens) if usage else ()
        return one_call.answer(text, why == "length", place, told.model, *counts)
