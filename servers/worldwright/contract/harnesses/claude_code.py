"""Claude Code has agents with lists of tools, a hook before every tool use, and a sandbox around the shell.

The sandbox keeps the shell from writing to the runs and to the suite; it needs bubblewrap and socat on Linux. File tools and
MCP servers run outside it: the guard judges the former, the latter write the evidence.
"""

from __future__ import annotations

import json
import os
import re
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..generated import GENERATED, PERSONAL, hook, instructions, mcp_names
from ..heard import Heard, mapping, money, whole
from ..roles import RUNS, SUITE, Role
from ..tool_names import ToolNames

if TYPE_CHECKING:
    from ...doctor.diagnosis import Diagnosis

NAME, SHELL_SETS = "Claude Code", ("CLAUDECODE",)
PROGRAM, PACKAGE, TESTED = "claude", "@anthropic-ai/claude-code", "2.1.329"
LINKS = (".claude/skills", ".claude/commands")
TRUST = ""
UNCOUNTED = ""
TELLS_MONEY, TELLS_AT_END = True, False
READERS = ("Read", "Glob", "Grep")
WRITERS = ("Write", "Edit")
CONFINES = ("bwrap", "socat")
"""Programs that its sandbox needs on Linux."""
DEFAULT_KEY, DEFAULT_JUDGED = "~/.local/share/worldwright/signing-key.pem", "~/.local/share/worldwright/judged"
"""The signing key and a benchmark's verdicts where nothing names another data folder. Beyond the project its shell writes nothing."""
TOOLS = ToolNames(
    writers=frozenset({"write", "edit", "multiedit", "notebookedit"}),
    readers=frozenset({"read", "glob", "grep", "ls", "notebookread", "skill"}),
    shells=frozenset({"bash", "powershell", "monitor"}),
    agents=("agent", "task", "sendmessage", "team"),
    harmless=frozenset({"toolsearch", "todowrite", "structuredoutput"}),
    allows_in_scope=True,
)


def files() -> dict[str, str]:
    """Its settings: servers, hook, sandbox, and the questions to the person."""
    from worldkit.files import json_text

    judged = {"type": "command", "command": hook('"$CLAUDE_PROJECT_DIR"/', "claude_code"), "timeout": 20}
    settings = {
        "enableAllProjectMcpServers": True,
        "env": {"CLAUDE_CODE_DISABLE_BACKGROUND_TASKS": "1"},
        "permissions": {"ask": list(mcp_names(PERSONAL))},
        "sandbox": {
            "enabled": True,
            "allowUnsandboxedCommands": False,
            "filesystem": {
                "denyWrite": [f"./{name}" for name in (RUNS, *SUITE)],
                "denyRead": [DEFAULT_KEY, DEFAULT_JUDGED],
            },
        },
        "hooks": {"PreToolUse": [{"matcher": "*", "hooks": [judged]}]},
    }
    return {".claude/settings.json": json_text(settings)}


def agent(role: Role) -> tuple[str, str]:
    """The agent's file, with its tools by name, so that it gets no others."""
    tools = [*(READERS if role.reads_files else ()), *(WRITERS if role.writes else ()), *mcp_names(role.tools)]
    header = [
        "---",
        f"name: {role.agent}",
        f"description: {json.dumps(role.purpose)}",
        f"tools: {', '.join(tools)}",
        "omitClaudeMd: true",
        "---",
        f"<!-- {GENERATED} -->",
    ]
    return f".claude/agents/{role.agent}.md", "\n".join(header) + "\n" + instructions(role)


def diagnose(root: Path) -> Diagnosis | None:
    """Tell whether the person trusts the folder: else Claude Code starts none of the project's servers and agents."""
    from ...doctor.diagnosis import Diagnosis

    if shutil.which("claude") is None:
        return None
    settings = Path(os.environ.get("CLAUDE_CONFIG_DIR", str(Path.home()))) / ".claude.json"
    try:
        known = json.loads(settings.read_text(encoding="utf-8")).get("projects", {})
    except (OSError, ValueError):
        known = {}
    trusted = bool(known.get(str(root), {}).get("hasTrustDialogAccepted"))
    if not trusted:
        fix = f"start `claude` in {root} once and accept its question"
        return Diagnosis("claude", False, "does not trust this folder yet", fix, essential=False)
    missing = [name for name in CONFINES if shutil.which(name) is None] if sys.platform == "linux" else []
    found = "trusts this folder" + (
        f", but finds no {' and no '.join(missing)} to confine its shell with" if missing else ""
    )
    return Diagnosis("claude", not missing, found, "sudo apt-get install -y bubblewrap socat", essential=False)


def unattended(files: dict[str, str], folder: Path) -> dict[str, str]:
    """Its settings without the question whether a plan is approved, and without the words of the projects around its folder.

    It reads them in every folder above its own, whatever its git root is; those of the person's home are the person's.
    """
    settings = json.loads(files[".claude/settings.json"])
    settings["permissions"]["ask"] = []
    # As patterns: a sign that means something in one stands for any sign, since Claude Code reads a backslash as a slash.
    around = [
        re.sub(r"[][\\*?{}()!+@|]", "?", str(above)) for above in folder.resolve().parents if above != Path.home()
    ]
    words = ("CLAUDE.md", "CLAUDE.local.md", ".claude/CLAUDE.md", ".claude/rules/**", "AGENTS.md")
    settings["claudeMdExcludes"] = [f"{above.rstrip('/')}/{name}" for above in around for name in words]
    return {".claude/settings.json": json.dumps(settings, indent=2) + "\n"}


def headless(prompt: str, model: str, folder: Path, most_usd: float | None) -> list[str]:
    """Print mode, each event a line; it ends by itself when it has cost as much as it may. No servers but its folder's own."""
    words = ["-p", f"/generate --auto {prompt}", "--output-format", "stream-json", "--verbose"]
    words += ["--strict-mcp-config", "--mcp-config", str(folder / ".mcp.json")]
    words += ["--allowedTools", ",".join(mcp_names(PERSONAL))]
    words += ["--model", model] if model else []
    return words + (["--max-budget-usd", f"{most_usd:.6g}"] if most_usd is not None else [])


def heard(event: dict[str, Any]) -> Heard:
    """Of a message its tokens; of the result the figures of the whole session, sub-agents among them."""
    if event.get("type") == "assistant":
        message = mapping(event.get("message"))
        read, cached, written = _tokens(mapping(message.get("usage")))
        blocks = message.get("content") if isinstance(message.get("content"), list) else []
        said = " ".join(str(block.get("text", "")) for block in blocks or [] if isinstance(block, dict)).strip()
        of = str(message.get("id") or "message")
        return Heard(of, read, cached, written, None, counted=bool(read or written), said=said)
    if event.get("type") != "result":
        return Heard()
    models = [mapping(model) for model in mapping(event.get("modelUsage")).values()]
    cached = sum(whole(model.get("cacheReadInputTokens")) for model in models)
    read = cached + sum(whole(model.get(n)) for model in models for n in ("inputTokens", "cacheCreationInputTokens"))
    written = sum(whole(model.get("outputTokens")) for model in models)
    if not models:
        read, cached, written = _tokens(mapping(event.get("usage")))
    kind = str(event.get("subtype", ""))
    return Heard(
        read=read,
        cached=cached,
        written=written,
        usd=money(event.get("total_cost_usd")),
        counted=True,
        said=str(event.get("result") or kind),
        wrong=bool(event.get("is_error")) or kind.startswith("error"),
        ended=True,
        over_usd=kind == "error_max_budget_usd",
    )


def _tokens(usage: dict[str, Any]) -> tuple[int, int, int]:
    cached = whole(usage.get("cache_read_input_tokens"))
    read = cached + whole(usage.get("input_tokens")) + whole(usage.get("cache_creation_input_tokens"))
    return read, cached, whole(usage.get("output_tokens"))
