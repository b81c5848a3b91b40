"""OpenCode as the judge, headless: the pictures are attached, every tool is denied, and it starts in an empty folder.

Models are named `provider/model`, as in its own settings. Its program is `opencode`, or what `WORLDWRIGHT_JUDGE_OPENCODE` names.
Tried with version 1.18.33 against a scripted model.
"""

import json
from typing import Any

from .. import headless
from . import Answer, JudgeError, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_OPENCODE"
LIMITS = Limits(pictures=20, bytes_each=10 << 20, bytes_together=40 << 20)
SETTINGS = json.dumps({"permission": {"*": "deny"}, "share": "disabled", "autoupdate": False})
MOST_WORDS = 128 << 10
"""The question is one word of its command line, of which Linux takes no longer ones, bytes (MAX_ARG_STRLEN)."""
KEEPS = ("ANTHROPIC_API_KEY", "OPENAI_API_KEY", "GEMINI_API_KEY", "OPENCODE_CONFIG", "XDG_DATA_HOME", "XDG_CONFIG_HOME")


def starting() -> str:
    """How a user comes by one, in a few words."""
    return "install OpenCode and ripgrep, log in once, then: --address opencode --model provider/model"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    if (size := len(question.words.encode())) >= MOST_WORDS:
        raise JudgeError(
            f"a question of {size:,} B is more than a command line takes", code="too_large", place=question.address,
            next_move="take shorter criteria or words, or another judge",
        )  # fmt: skip
    model = ("-m", question.model) if question.model else ()
    return headless.run(
        question,
        lambda pictures: (
            "run", "--pure", "--format", "json", *model, *(w for path in pictures for w in ("-f", str(path))),
            "--", question.words,
        ),
        _read,
        keeps=KEEPS,
        files={"opencode.json": SETTINGS},
    )  # fmt: skip


def _read(said: str) -> Answer:
    """All its text, and the tokens and cost of its last step."""
    lines = [json.loads(line) for line in said.splitlines() if line.startswith("{")]
    text = "".join(line["part"]["text"] for line in lines if line.get("type") == "text")
    if not text.strip():
        raise ValueError("no text")
    step: dict[str, Any] = next((line["part"] for line in reversed(lines) if line.get("type") == "step_finish"), {})
    tokens = step.get("tokens") or {}
    return Answer(text, "", tokens.get("input"), tokens.get("output"), step.get("cost"))
