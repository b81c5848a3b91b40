"""The coding harnesses on this machine: versions, generated files, the guard's hook, and what the person must still grant.

A harness is asked through its own commands and nothing is written. What is missing here is weak, not broken: the command
line works without any harness.
"""

import json
import os
import re
import shutil
import subprocess
import threading
from pathlib import Path
from typing import Any

from ..contract.command import project, stale
from ..contract.harnesses import LINKS, TESTED
from .diagnosis import Diagnosis

PATIENCE_S = 20.0
PACKAGES = {"claude": "@anthropic-ai/claude-code", "codex": "@openai/codex", "opencode": "opencode-ai"}


def contract() -> Diagnosis | None:
    """The harnesses' generated files are as the roles say, and the links that share skills and commands lead somewhere."""
    root = project()
    if not (root / ".mcp.json").parent.joinpath("skills").is_dir():
        return None  # installed without a checkout: no harness is configured from here
    drifted = [f"{name} {why}" for name, why in stale(root).items()]
    if drifted:
        return Diagnosis("contract", False, "; ".join(drifted[:3]), "worldwright contract sync")
    broken = [link for link in LINKS if not (root / link).is_dir()]
    fix = f"git config core.symlinks true && git checkout -- {' '.join(LINKS)}"
    found = f"no folder behind {', '.join(broken)}" if broken else "agents, permissions, hooks and links are in place"
    return Diagnosis("contract", not broken, found, fix)


def guard() -> Diagnosis | None:
    """The write-scope guard, by the very command of the hook: it lets one write pass and denies another."""
    root = project()
    hooks = root / ".codex/hooks.json"
    if not hooks.is_file():
        return None
    command = json.loads(hooks.read_text(encoding="utf-8"))["hooks"]["PreToolUse"][0]["hooks"][0]["command"]
    codes = []
    for path in ("runs/doctor/plan.md", "README.md"):
        event = {"tool_name": "Write", "tool_input": {"file_path": path}, "agent_type": "world-plan", "cwd": str(root)}
        done = subprocess.run(
            ["sh", "-c", command], input=json.dumps(event), cwd=root, capture_output=True, text=True, timeout=30, check=False
        )  # fmt: skip
        codes.append(done.returncode)
    found = (
        "lets a role's own file pass and denies another" if codes == [0, 2] else f"answers {codes} instead of [0, 2]"
    )
    fix = "the hook needs `python3` on the path, and servers/worldwright/contract as in the repository"
    return Diagnosis("guard", codes == [0, 2], found, fix)


def installed() -> Diagnosis:
    """Which harnesses there are, and whether in the versions that the contract was proven with."""
    found, old = [], []
    for name, tested in TESTED.items():
        version = _version(name)
        if version is None:
            continue
        found.append(f"{name} {version}" + ("" if version == tested else f" (proven with {tested})"))
        if _number(version) < _number(tested):
            old.append(name)
    if not found:
        fix = f"install one: {', '.join(f'npm install -g {package}' for package in PACKAGES.values())}"
        return Diagnosis("harnesses", False, "none on the path", fix, essential=False)
    fix = "; ".join(f"npm install -g {PACKAGES[name]}@{TESTED[name]}" for name in old)
    return Diagnosis("harnesses", not old, ", ".join(found), fix, essential=False)


def claude() -> Diagnosis | None:
    """Claude Code starts the project's servers and agents only in a folder that the person trusts."""
    if shutil.which("claude") is None:
        return None
    settings = Path(os.environ.get("CLAUDE_CONFIG_DIR", str(Path.home()))) / ".claude.json"
    try:
        known = json.loads(settings.read_text(encoding="utf-8")).get("projects", {})
    except (OSError, ValueError):
        known = {}
    trusted = bool(known.get(str(project()), {}).get("hasTrustDialogAccepted"))
    fix = f"start `claude` in {project()} once and accept its question"
    return Diagnosis(
        "claude", trusted, "trusts this folder" if trusted else "does not trust this folder yet", fix, False
    )


def codex() -> Diagnosis | None:
    """Codex runs the guard only when the person has trusted the project and its hook; it tells by its app server."""
    if shutil.which("codex") is None:
        return None
    root = str(project())
    answer = _ask_codex("hooks/list", {"cwds": [root]})
    hooks = [hook for entry in answer["data"] for hook in entry["hooks"] if hook["source"] == "project"]
    ours = [hook for hook in hooks if "contract/guard.py" in (hook.get("command") or "")]
    if not ours:
        fix = f'start `codex` in {root} and choose "Trust and continue"'
        return Diagnosis("codex", False, "does not read this project's settings: it is not trusted", fix, False)
    state = ours[0]["trustStatus"] if ours[0]["enabled"] else "disabled"
    found = f"the write-scope guard's hook is {state}" + ("" if state == "trusted" else ", so it does not run")
    fix = f'start `codex` in {root}; at "Hooks need review" read the hook and trust it'
    return Diagnosis("codex", state in ("trusted", "managed"), found, fix, essential=False)


def opencode() -> Diagnosis | None:
    """OpenCode searches with ripgrep."""
    if shutil.which("opencode") is None:
        return None
    here = shutil.which("rg") is not None
    found = "finds ripgrep" if here else "does not find `rg` on the path"
    return Diagnosis("opencode", here, found, "sudo apt-get install -y ripgrep", essential=False)


def _version(name: str) -> str | None:
    program = shutil.which(name)
    if program is None:
        return None
    try:
        done = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=30, check=False)
    except OSError as cause:
        return f"does not start ({cause.strerror})"
    number = re.search(r"\d+\.\d+\.\d+", done.stdout)
    return number.group() if number else "of unknown version"


def _number(version: str) -> tuple[int, ...]:
    return tuple(map(int, re.findall(r"\d+", version)[:3]))


def _ask_codex(method: str, params: dict[str, Any]) -> dict[str, Any]:
    """One question to Codex's app server; it reads the person's settings and writes none of them."""
    lines = [
        {"id": 1, "method": "initialize", "params": {"clientInfo": {"name": "worldwright", "version": "1"}}},
        {"method": "initialized"},
        {"id": 2, "method": method, "params": params},
    ]
    with subprocess.Popen(
        [str(shutil.which("codex")), "app-server"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
    ) as server:  # fmt: skip
        assert server.stdin and server.stdout
        patience = threading.Timer(PATIENCE_S, server.kill)
        patience.start()
        try:
            server.stdin.write("".join(json.dumps(line) + "\n" for line in lines))
            server.stdin.flush()
            for line in server.stdout:
                answer = json.loads(line)
                if answer.get("id") == 2:
                    result: dict[str, Any] = answer["result"]
                    return result
        finally:
            patience.cancel()
            server.kill()
    raise RuntimeError("codex app-server ended without an answer")


CHECKS = (contract, guard, installed, claude, codex, opencode)
