"""Claude Code as the judge, headless, with no tools: the pictures are handed to it in the message itself.

No settings of a project, no memory files, no MCP servers, no session on the disk; its own coding instructions are replaced. Its
program is `claude`, or what `WORLDWRIGHT_JUDGE_CLAUDE` names. Tried with version 2.1.329 against a scripted model.
"""

import base64
import json

from .. import headless
from . import Answer, Limits, Question

ADDRESS = "WORLDWRIGHT_JUDGE_CLAUDE"
LIMITS = Limits(pictures=100, bytes_each=5 << 20, bytes_together=24 << 20)
PLAIN = (
    "-p", "--input-format", "stream-json", "--output-format", "stream-json", "--verbose", "--tools", "",
    "--safe-mode", "--strict-mcp-config", "--no-session-persistence", "--system-prompt", "You judge films.",
)  # fmt: skip
KEEPS = ("ANTHROPIC_API_KEY", "ANTHROPIC_BASE_URL", "CLAUDE_CODE_OAUTH_TOKEN", "IS_SANDBOX")


def starting() -> str:
    """How a user comes by one, in a few words."""
    return "install Claude Code, log in once, then: --address claude"


def ask(question: Question) -> Answer:
    """Ask once.

    Raises:
        JudgeError: it gave no answer.
    """
    pictures = [
        {
            "type": "image",
            "source": {"type": "base64", "media_type": p.media_type, "data": base64.b64encode(p.data).decode()},
        }
        for p in question.pieces
    ]
    content = [*pictures, {"type": "text", "text": question.words}]
    message = json.dumps({"type": "user", "message": {"role": "user", "content": content}}) + "\n"
    words = (*PLAIN, *(("--model", question.model) if question.model else ()))
    return headless.run(question, lambda _: words, _read, stdin=message.encode(), keeps=KEEPS)


def _read(said: str) -> Answer:
    """The last line of its kind `result`; `is_error` there is a failure that its status may not tell."""
    lines = [json.loads(line) for line in said.splitlines() if line.strip()]
    (result,) = [line for line in lines if line.get("type") == "result"][-1:]
    if result.get("is_error"):
        raise ValueError(str(result.get("result")))
    usage, models = result.get("usage") or {}, list(result.get("modelUsage") or {})
    return Answer(
        result["result"], models[0] if len(models) == 1 else "", usage.get("input_tokens"), usage.get("output_tokens"),
        result.get("total_cost_usd"),
    )  # fmt: skip
