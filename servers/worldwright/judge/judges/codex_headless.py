"""Codex as the judge, headless: the pictures are attached, it has no shell, may write nothing, and starts in an empty folder.

No session is kept. Its program is `codex`, or what `WORLDWRIGHT_JUDGE_CODEX` names. Tried with version 0.169.0 against a
scripted model. Two tools are left to it that cannot be taken away: it may open a picture whose path it knows, and patch
files, which its sandbox denies.
"""

import json

from .. import headless
from . import Answer, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_CODEX"
LIMITS = Limits(pictures=20, bytes_each=10 << 20, bytes_together=40 << 20)
PLAIN = ("--json", "--ephemeral", "--skip-git-repo-check", "--sandbox", "read-only", "--disable", "shell_tool")
KEEPS = ("OPENAI_API_KEY", "CODEX_HOME", "CODEX_API_KEY")


def starting() -> str:
    """How a user comes by one, in a few words."""
    return "install Codex, log in once, then: --address codex"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    model = ("-m", question.model) if question.model else ()
    return headless.run(
        question,
        lambda pictures: ("exec", *(w for path in pictures for w in ("-i", str(path))), *PLAIN, *model, "-"),
        _read,
        stdin=question.words.encode(),
        keeps=KEEPS,
    )


def _read(said: str) -> Answer:
    """The last message of the agent, and the tokens of the turn."""
    lines = [json.loads(line) for line in said.splitlines() if line.startswith("{")]
    items = [line["item"] for line in lines if line.get("type") == "item.completed"]
    text = [item["text"] for item in items if item.get("type") == "agent_message"][-1]
    usage = next((line.get("usage") or {} for line in lines if line.get("type") == "turn.completed"), {})
    return Answer(text, "", usage.get("input_tokens"), usage.get("output_tokens"))
