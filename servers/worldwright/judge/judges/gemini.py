"""Google's Gemini API: POST `ADDRESS/v1beta/models/MODEL:generateContent`, pictures or the film as inline data.

The reference's own judge was one of these models, shown the whole film at 24 frames a second: `--shows film`. The key is
`GEMINI_API_KEY`. Written after the protocol; no real service was reached from here, only stand-ins on the loopback.
"""

import base64
from typing import Any
from urllib.parse import quote

from ..one_call import garbage, key, place_of, post
from . import Answer, JudgeError, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_GEMINI"
LIMITS = Limits(pictures=256, bytes_each=14 << 20, bytes_together=14 << 20, films=True)
"""Of a request of at most 20 MB, in which pictures are a third longer."""
KEY, FRAMES_PER_S = "GEMINI_API_KEY", 24.0


def starting() -> str:
    """How a user comes by one, in a few words."""
    return f"--address https://generativelanguage.googleapis.com, with your key in {KEY}"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    place = place_of(question.address)
    parts: list[dict[str, Any]] = []
    for piece in question.pieces:
        part: dict[str, Any] = {
            "inlineData": {"mimeType": piece.media_type, "data": base64.b64encode(piece.data).decode()}
        }
        if piece.media_type.startswith("video/"):  # without it, one frame a second is looked at
            part["videoMetadata"] = {"fps": FRAMES_PER_S}
        parts.append(part)
    body = {"contents": [{"role": "user", "parts": [*parts, {"text": question.words}]}]}
    path = f"/v1beta/models/{quote(question.model, safe='')}:generateContent"
    return _read(post(question.address, path, body, {"x-goog-api-key": key(KEY, place)}, question.silent_s), place)


def _read(told: dict[str, Any], place: str) -> Answer:
    try:
        feedback = (told.get("promptFeedback") or {}).get("blockReason")
        first = (told.get("candidates") or [{}])[0]
        why = first.get("finishReason") or ""
        parts = (first.get("content") or {}).get("parts") or []
        text = "".join(part.get("text", "") for part in parts if not part.get("thought"))
        usage = told.get("usageMetadata") or {}
        counts = usage.get("promptTokenCount"), usage.get("candidatesTokenCount")
    except (IndexError, TypeError, AttributeError) as cause:
        raise garbage(f"it answered no candidate: {str(told)[:80]}", place) from cause
    if feedback or why not in ("", "STOP", "MAX_TOKENS"):
        raise JudgeError(
            f"it declines to judge this film: {str(feedback or why)[:120]}", code="declined", place=place,
            next_move="take another judge for it, and for all others",
        )  # fmt: skip
    if why == "MAX_TOKENS":
        raise JudgeError("its answer was cut off", code="cut_off", place=place, next_move="take a model that says less")
    if not text.strip():
        raise garbage("it answered nothing", place)
    return Answer(text, str(told.get("modelVersion") or ""), *(n if isinstance(n, int) else None for n in counts))
