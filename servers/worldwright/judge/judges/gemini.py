"""Google's Gemini API, by Google's client (`google-genai`), pictures or the film as inline data; the key is `GEMINI_API_KEY`.

The reference's own judge was one of these models, shown the whole film at 24 frames a second: `--shows film`. No real service
was reached from here, only stand-ins on the loopback.
"""

import logging

from .. import one_call
from . import Answer, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_GEMINI"
LIMITS = Limits(pictures=256, bytes_each=14 << 20, bytes_together=14 << 20, films=True)
"""Of a request of at most 20 MB, in which pictures are a third longer."""
KEY, FRAMES_PER_S = "GEMINI_API_KEY", 24.0


def starting() -> str:
    """How a user comes by one, in a few words."""
    return (
        f"pip install google-genai, then: --address https://generativelanguage.googleapis.com, with your key in {KEY}"
    )


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    place = one_call.place_of(question.address)
    secret = one_call.key(KEY, place)
    with one_call.line(question.address, secret, question.silent_s) as http:
        from google.genai import Client, types

        logging.getLogger("google_genai").setLevel(logging.ERROR)  # it tells which key of the environment it would take
        parts = [
            types.Part(
                inline_data=types.Blob(mime_type=piece.media_type, data=piece.data),
                # without it, one frame a second of a film is looked at
                video_metadata=types.VideoMetadata(fps=FRAMES_PER_S) if piece.media_type.startswith("video/") else None,
            )
            for piece in question.pieces
        ]
        over = types.HttpOptions(
            base_url=question.address, api_version="v1beta", httpx_client=http, timeout=int(question.silent_s * 1000)
        )
        told = Client(api_key=secret, vertexai=False, http_options=over).models.generate_content(
            model=question.model, contents=types.Content(role="user", parts=[*parts, types.Part(text=question.words)])
        )
        first = told.candidates[0] if told.candidates else None
        why = first.finish_reason.value if first and first.finish_reason else ""
        blocked = told.prompt_feedback.block_reason if told.prompt_feedback else None
        if blocked or why not in ("", "STOP", "MAX_TOKENS"):
            raise one_call.declined(blocked.value if blocked else why, place)
        said = (first.content.parts if first and first.content else None) or []
        text = "".join(part.text or "" for part in said if not part.thought)
        usage = told.usage_metadata
        counts = (usage.prompt_token_count, usage.candidates_token_count) if usage else ()
        return one_call.answer(text, why == "MAX_TOKENS", place, told.model_version, *counts)
