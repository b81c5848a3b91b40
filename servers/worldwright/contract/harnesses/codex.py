"""Codex has servers, agents and a permissions profile in one configuration, and a hook that the person must trust first.

Its profile keeps shells and patches from the suite. It knows no pattern inside `runs/`, where roles must write a file by
patch, so the guard starts every shell so that it cannot write there (`shell.py`).
"""

from __future__ import annotations

import json
import math
import shutil
import subprocess
import threading
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..generated import GENERATED, PERSONAL, hook, instructions, server
from ..heard import Heard, mapping, whole
from ..roles import ROLES, SERVERS, SUITE, Role
from ..tool_names import ToolNames

if TYPE_CHECKING:
    from ...doctor.diagnosis import Diagnosis

NAME, SHELL_SETS = "Codex", ("CODEX_SANDBOX", "CODEX_THREAD_ID")
PROGRAM, PACKAGE, TESTED = "codex", "@openai/codex", "0.169.0"
LINKS = (".agents/skills",)
TRUST = "Codex runs no hook, and so no write-scope guard, in a folder that nobody trusts"
UNCOUNTED = "its agents"
TELLS_MONEY, TELLS_AT_END = False, True
PATIENCE_S = 20.0
TOOLS = ToolNames(
    writers=frozenset({"apply_patch"}),
    readers=frozenset({"view_image"}),
    shells=frozenset({"bash", "shell", "exec_command", "local_shell", "unified_exec", "write_stdin"}),
    agents=("collaboration", "multi_agent", "spawn_agent"),  # a hook sees the namespace and the name run together
    harmless=frozenset({"exec", "wait", "update_plan", "tool_search"}),
    roles_look_by_shell=True,
    confined_by_guard=True,
)


def files() -> dict[str, str]:
    """Its configuration and its hook."""
    from worldkit.files import json_text

    judged = {"type": "command", "command": hook("", "codex"), "timeout": 20}
    hooks = {"hooks": {"PreToolUse": [{"matcher": ".*", "hooks": [judged]}]}}
    return {".codex/config.toml": _config(), ".codex/hooks.json": json_text(hooks)}


def agent(role: Role) -> tuple[str, str]:
    """The agent's file, of which Codex takes only the instructions."""
    import tomli_w

    fields = {"name": role.agent, "description": role.purpose, "developer_instructions": instructions(role)}
    return f".codex/agents/{role.agent}.toml", f"# {GENERATED}\n" + tomli_w.dumps(fields, multiline_strings=True)


def diagnose(root: Path) -> Diagnosis | None:
    """Ask Codex's app server whether the person trusts the project and its hook: only then Codex runs the guard."""
    from ...doctor.diagnosis import Diagnosis

    if shutil.which("codex") is None:
        return None
    answer = _ask("hooks/list", {"cwds": [str(root)]})
    hooks = [hook for entry in answer["data"] for hook in entry["hooks"] if hook["source"] == "project"]
    ours = [hook for hook in hooks if "contract/guard.py" in (hook.get("command") or "")]
    if not ours:
        fix = f'start `codex` in {root} and choose "Trust and continue"'
        return Diagnosis("codex", False, "does not read this project's settings: it is not trusted", fix, False)
    state = ours[0]["trustStatus"] if ours[0]["enabled"] else "disabled"
    found = f"the write-scope guard's hook is {state}" + ("" if state == "trusted" else ", so it does not run")
    fix = f'start `codex` in {root}; at "Hooks need review" read the hook and trust it'
    return Diagnosis("codex", state in ("trusted", "managed"), found, fix, essential=False)


def unattended(files: dict[str, str], folder: Path) -> dict[str, str]:
    """Its configuration, in which a plan's approval is not asked about."""
    import tomllib

    import tomli_w

    config = tomllib.loads(files[".codex/config.toml"])
    for tool in PERSONAL:
        owner, name = tool.split(".")
        del config["mcp_servers"][owner]["tools"][name]
    return {".codex/config.toml": f"# {GENERATED}\n" + tomli_w.dumps(config)}


def headless(prompt: str, model: str, folder: Path, most_usd: float | None) -> list[str]:
    """`codex exec`, with the trust in this one folder that the campaign's file gives."""
    trusted = f'projects={{{json.dumps(str(folder))}={{trust_level="trusted"}}}}'  # a dotted name is not read as one, of a path
    words = ["exec", "--json", "--dangerously-bypass-hook-trust", "-c", trusted]
    return [*words, *(("--model", model) if model else ()), f"$generate --auto {prompt}"]


def heard(event: dict[str, Any]) -> Heard:
    """Of a turn its tokens, which are known when it ends; it tells no money, and of its agents nothing."""
    kind = event.get("type")
    if kind == "turn.completed":
        usage = mapping(event.get("usage"))
        read, cached, written = (whole(usage.get(f"{n}_tokens")) for n in ("input", "cached_input", "output"))
        return Heard("", read, cached, written, counted=True, ended=True)
    if kind in ("turn.failed", "error"):
        said = str(mapping(event.get("error")).get("message") or event.get("message") or kind)
        return Heard(said=said, wrong=True, ended=kind == "turn.failed")
    item = mapping(event.get("item"))
    return Heard(said=str(item.get("text", ""))) if item.get("type") == "agent_message" else Heard()


def _config() -> str:
    import tomli_w

    from ...model.call_time import CALL_S  # the guard runs these modules with nothing but the contract beside them

    # Without `required`, the first call may come before its server is up. What a call reports does not prolong its time here, which
    # differs by release.
    common = {
        "startup_timeout_sec": 90,
        "tool_timeout_sec": math.ceil(CALL_S) + 20,
        "required": True,
        "default_tools_approval_mode": "approve",
    }
    servers: dict[str, dict[str, Any]] = {name: server(name) | common for name in SERVERS}
    for tool in PERSONAL:
        owner, name = tool.split(".")
        servers[owner].setdefault("tools", {})[name] = {"approval_mode": "prompt"}
    allowed = {":root": "read", ":workspace_roots": {".": "write"} | dict.fromkeys(SUITE, "read")}
    config = {
        "default_permissions": "worldwright",
        "mcp_servers": servers,
        "agents": {r.agent: {"description": r.purpose, "config_file": f"agents/{r.agent}.toml"} for r in ROLES},
        "permissions": {"worldwright": {"filesystem": allowed}},
    }
    return f"# {GENERATED}\n" + tomli_w.dumps(config)


def _ask(method: str, params: dict[str, Any]) -> dict[str, Any]:
    """Ask Codex's app server one question; it reads the person's settings and writes none of them."""
    lines = [
        {"id": 1, "method": "initialize", "params": {"clientInfo": {"name": "worldwright", "version": "1"}}},
        {"method": "initialized"},
        {"id": 2, "method": method, "params": params},
    ]
    with subprocess.Popen(
        [str(shutil.which("codex")), "app-server"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    ) as app:  # fmt: skip
        assert app.stdin and app.stdout
        patience = threading.Timer(PATIENCE_S, app.kill)
        patience.start()
        try:
            app.stdin.write("".join(json.dumps(line) + "\n" for line in lines))
            app.stdin.flush()
            for line in app.stdout:
                answer = json.loads(line)
                if answer.get("id") == 2:
                    result: dict[str, Any] = answer["result"]
                    return result
        finally:
            patience.cancel()
            app.kill()
    raise RuntimeError("codex app-server ended without an answer")
