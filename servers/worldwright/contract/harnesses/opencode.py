"""OpenCode: permissions by pattern for each agent, and a plugin that asks the guard before every tool use.

It has no sandbox: the guard starts every shell so that it cannot write to the runs and the suite (`shell.py`).
"""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..generated import COMMAND, GENERATED, GUARD, PERSONAL, instructions
from ..heard import Heard, mapping, money, whole
from ..roles import COMMANDS, MAIN_TOOLS, ON_REQUEST, RUNS, SERVERS, SKILLS_ON_REQUEST, Role
from ..tool_names import ToolNames

if TYPE_CHECKING:
    from ...doctor.diagnosis import Diagnosis

NAME, SHELL_SETS = "OpenCode", ("OPENCODE",)
PROGRAM, PACKAGE, TESTED = "opencode", "opencode-ai", "1.18.33"
LINKS = (".opencode/commands",)
TRUST = ""
UNCOUNTED = "its agents"
TELLS_MONEY, TELLS_AT_END = True, False
TOOLS = ToolNames(
    writers=frozenset({"write", "edit", "multiedit", "patch", "apply_patch"}),
    readers=frozenset({"read", "glob", "grep", "list", "skill"}),
    shells=frozenset({"bash"}),
    agents=("task",),
    harmless=frozenset({"todowrite", "todoread", "invalid"}),
    confined_by_guard=True,
)


def files() -> dict[str, str]:
    """Its configuration and its plugin."""
    from worldkit.files import json_text

    return {".opencode/opencode.json": json_text(_config()), ".opencode/plugins/guard.js": _plugin()}


def agent(role: Role) -> tuple[str, str]:
    """The agent's file: every tool is denied but those it is given."""
    edit = {"*": "deny", **{f"{RUNS}/*/{name}{'*' * name.endswith('/')}": "allow" for name in role.writes}}
    reading = "allow" if role.reads_files else "deny"
    permission: dict[str, object] = {
        "*": "deny",
        "edit": edit,
        "bash": "deny",
        "task": "deny",
        "webfetch": "deny",
        "external_directory": "deny",
        "skill": {"*": reading},
        "read": reading,
        "grep": reading,
        "glob": reading,
        "list": reading,
        **_tools(role.tools),
    }
    lines = ["---", f"# {GENERATED}", f"description: {json.dumps(role.purpose)}", "mode: subagent", "permission:"]
    for key, value in permission.items():
        if isinstance(value, dict):
            lines += [f"  {key}:", *(f'    "{pattern}": {verdict}' for pattern, verdict in value.items())]
        else:
            lines.append(f'  "{key}": {value}')
    return f".opencode/agents/{role.agent}.md", "\n".join([*lines, "---"]) + "\n" + instructions(role)


def diagnose(root: Path) -> Diagnosis | None:
    """OpenCode searches with ripgrep."""
    from ...doctor.diagnosis import Diagnosis

    if shutil.which("opencode") is None:
        return None
    here = shutil.which("rg") is not None
    found = "finds ripgrep" if here else "does not find `rg` on the path"
    return Diagnosis("opencode", here, found, "sudo apt-get install -y ripgrep", essential=False)


def unattended(files: dict[str, str], folder: Path) -> dict[str, str]:
    """Its configuration, in which a plan's approval is not asked about."""
    config = json.loads(files[".opencode/opencode.json"])
    config["permission"] |= {tool.replace(".", "_"): "allow" for tool in PERSONAL}
    return {".opencode/opencode.json": json.dumps(config, indent=2) + "\n"}


def headless(prompt: str, model: str, folder: Path, most_usd: float | None) -> list[str]:
    """`opencode run`, each event a line; the command's own words come after `--`, since `--auto` is a word of OpenCode's, too."""
    words = ["run", "--format", "json", "--command", "generate", *(("--model", model) if model else ())]
    return [*words, "--", "--auto", prompt]


def heard(event: dict[str, Any]) -> Heard:
    """Of a step its tokens and its money; of its agents nothing."""
    part, kind = mapping(event.get("part")), event.get("type")
    if kind == "error":
        error = mapping(event.get("error"))
        said = str(mapping(error.get("data")).get("message") or error.get("message") or error.get("name") or kind)
        return Heard(said=said, wrong=True)
    if kind == "text":
        return Heard(said=str(part.get("text", "")))
    if kind != "step_finish":
        return Heard()
    tokens = mapping(part.get("tokens"))
    cache = mapping(tokens.get("cache"))
    cached = whole(cache.get("read"))
    return Heard(
        of=str(part.get("id") or "step"),
        read=whole(tokens.get("input")) + cached + whole(cache.get("write")),
        cached=cached,
        written=whole(tokens.get("output")) + whole(tokens.get("reasoning")),
        usd=money(part.get("cost")),
        counted=True,
        ended=part.get("reason") == "stop",
    )


def _tools(tools: tuple[str, ...]) -> dict[str, str]:
    rules = {f"{server}_*": "deny" for server in SERVERS}
    for tool in tools:
        server, name = tool.split(".")
        rules[f"{server}_{name}"] = "allow"
    return rules


def _plugin() -> str:
    """OpenCode's permissions know patterns only; its plugin asks the guard too, which resolves links and confines shells."""
    return f"""// {GENERATED}
import {{ spawnSync }} from "node:child_process";
import {{ join }} from "node:path";

const agents = new Map();
const ours = /^({"|".join(SERVERS)})_(.+)$/;

export const WriteScope = async ({{ directory, worktree }}) => ({{
  "chat.params": async (input) => {{
    agents.set(input.sessionID, input.agent?.name ?? input.agent);
  }},
  "tool.execute.before": async (input, output) => {{
    const event = {{
      tool_name: input.tool.replace(ours, "mcp__$1__$2"),
      tool_input: output.args,
      cwd: directory,
      agent_type: agents.get(input.sessionID) ?? "",
    }};
    const root = worktree && worktree !== "/" ? worktree : directory;
    const told = {{ input: JSON.stringify(event), encoding: "utf8", timeout: 20000 }};
    const done = spawnSync("python3", [join(root, "{GUARD}"), "opencode"], told);
    if (done.status !== 0) throw new Error(`scope guard failed or denied: ${{done.stderr}}`);
    const changed = done.stdout ? JSON.parse(done.stdout).hookSpecificOutput.updatedInput : undefined;
    if (changed) Object.assign(output.args, changed);
  }},
}});
"""


def _config() -> dict[str, object]:
    return {
        "$schema": "https://opencode.ai/config.json",
        "mcp": {
            name: {"type": "local", "command": [COMMAND, "serve", name], "enabled": True, "timeout": 30000}
            for name in SERVERS
        },
        "permission": {
            "edit": {"*": "ask", f"{RUNS}/**": "deny"},
            "external_directory": "deny",
            "skill": {"*": "deny", **dict.fromkeys((*COMMANDS, *SKILLS_ON_REQUEST), "allow")},
            **_tools(MAIN_TOOLS),
            **{tool.replace(".", "_"): "ask" for tool in PERSONAL},
        },
        # Every tool that is allowed is loaded in full. Who builds one world is not told of these; a person picks this agent for many.
        "agent": {
            "campaign": {
                "description": "Run many worlds at once (skill `campaign`).",
                "mode": "primary",
                "permission": {tool.replace(".", "_"): "allow" for tool in ON_REQUEST},
            }
        },
    }
