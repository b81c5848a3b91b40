#!/usr/bin/env python3
"""The write-scope guard: a hook that every tool use passes before it happens.

Started with the name of the harness, it reads the hook's JSON from standard input and exits with 0 to let the call
through, or with 2
and the reason on standard error to deny it. Any failure denies. Real paths are judged, so `..` and symbolic links do not
help.

- A role (plan, code, visual, review) writes only its own files inside one run folder and uses only its own MCP tools. A tool
  whose name the harness' file does not list is denied to it. It has no shell, unless the harness offers no other way to look
  at files (Codex).
- The main thread, and any agent that is none of our roles, writes nothing under `runs/` with a file tool.
- The tool of another MCP server is given no path of a run. A command that such a tool runs is not read, either.
- Nobody's file tool writes a list of known keys or the person's data folder, nor reads the signing key and
  the verdicts there (`users_data`); nor, in the folder of a campaign's author, any file of the suite or of the campaign
  (`authors_judge`).

It does not read commands, as a shell can spell a name in a thousand ways. The kernel decides what a shell may write:
Claude Code's own sandbox keeps it from `runs/` and the suite, and in Codex and OpenCode the guard has the
command started by `shell.py`, which gives these rights up first. Nor is it a wall against the person, who may turn the hook
or the sandbox off, or against other programs on the machine. Evidence is written by the MCP servers, which run outside
every sandbox of a harness, and the gates check by hash what stands in a run, whoever wrote it.

With Claude Code a call that belongs to a run need not be confirmed by the person, except the approval of a plan, which is
theirs. Only the standard library is imported, so that it starts in a few hundredths of a second with any Python.
"""

from __future__ import annotations

import fnmatch
import json
import os
import re
import shlex
import sys
import time
from pathlib import Path

if not __package__:  # it was started as a program
    sys.path.insert(0, str(Path(__file__).resolve().parents[2]))

from worldwright.contract import authors_judge, harnesses, users_data
from worldwright.contract.roles import BY_AGENT, RESERVED, RUNS, SERVERS, Role
from worldwright.contract.tool_names import ToolNames

PATCHED = re.compile(r"^\*\*\* (?:Add|Update|Delete) File: (.+)$|^\*\*\* Move to: (.+)$", re.MULTILINE)
NAMES_A_FILE = ("file_path", "filePath", "path", "notebook_path", "filename")
MOST_OF_A_PATH = 4096
"""The kernel's limit, bytes."""
STARTER = Path(__file__).with_name("shell.py")


class DeniedError(Exception):
    """The call is not allowed; the message says why and what to do instead."""


def judge(event: dict, project: Path, names: ToolNames) -> bool:
    """Raise `DeniedError` unless the tool use is allowed; returns True for a run's own call, which nobody need confirm.

    Args:
        event: the hook's input: `tool_name`, `tool_input`, and for sub-agents `agent_type`.
        project: the folder that holds `runs/`.
        names: the harness's names of tools.
    """
    tool = str(event.get("tool_name") or "")
    if not tool:
        raise DeniedError("the hook's input names no tool")
    agent = str(event.get("agent_type") or event.get("agent_name") or "")
    role = BY_AGENT.get(agent.rsplit(":", 1)[-1].lower())
    kind = tool.lower()
    base = Path(str(event.get("cwd") or project))
    if kind.startswith("mcp__"):
        own = _judge_mcp(kind, role)
        if not own and kind.split("__")[1] not in SERVERS:
            _judge_stranger(kind, event.get("tool_input"), base, project)
        return own
    if kind in names.writers:
        for path in _targets(event.get("tool_input")):
            _judge_write(path, base, project, role)
        return role is not None
    if kind in names.readers:
        _judge_read(event.get("tool_input"), base)
    if role is not None:
        _judge_other(kind, role, names)
    return False


def _judge_other(kind: str, role: Role, names: ToolNames) -> None:
    """Judge what a role does besides writing and calling our tools: it may read where it is allowed to, and wait."""
    if kind.startswith(names.agents):
        raise DeniedError(f"the {role.name} role starts no agents: answer, and let the main thread go on")
    looks = kind in names.readers or (kind in names.shells and names.roles_look_by_shell)
    if looks and not role.reads_files:
        raise DeniedError(f"the {role.name} role sees only what its tools show it: {', '.join(role.tools)}")
    if kind in names.shells and not looks:
        raise DeniedError(f"the {role.name} role has no shell; its tools are: {', '.join(role.tools)}")
    if not looks and kind not in names.harmless:
        raise DeniedError(f"`{kind}` is no tool of the {role.name} role; it has: {', '.join(role.tools)}")


def confined(event: dict, project: Path, names: ToolNames) -> dict | None:
    """The input of a shell's call, changed so that it cannot write to the runs and the suite; None for other calls."""
    given = event.get("tool_input")
    if not names.confined_by_guard or str(event.get("tool_name")).lower() not in names.shells:
        return None
    for key in ("command", "cmd"):
        command = given.get(key) if isinstance(given, dict) else None
        if isinstance(given, dict) and isinstance(command, str | list):
            text = command if isinstance(command, str) else shlex.join(map(str, command))
            start = shlex.join(["exec", "python3", str(STARTER), str(project), text])
            return {**given, key: start if isinstance(command, str) else ["bash", "-c", start]}
    if isinstance(given, dict) and "session_id" in given:
        return None  # typed into a shell that was itself started so
    raise DeniedError("the command cannot be told from the hook's input")


def _judge_mcp(kind: str, role: Role | None) -> bool:
    parts = kind.split("__")
    if len(parts) < 3 or parts[1] not in SERVERS:
        if role is not None:
            raise DeniedError(f"`{kind}` is no tool of the {role.name} role; it has: {', '.join(role.tools)}")
        return False
    name = f"{parts[1]}.{parts[2]}"
    if role is None:
        _refuse_reserved(name)
    elif name not in role.tools:
        raise DeniedError(f"{name} is not a tool of the {role.name} role; it has: {', '.join(role.tools)}")
    return name != "stamp.approve"  # the person is asked whether a plan is approved


def _judge_stranger(kind: str, given: object, base: Path, project: Path) -> None:
    """Of another server's tool nobody knows whether it reads or writes: it is given no file of a run, no key and no proof."""
    if isinstance(given, dict | list):
        for value in given.values() if isinstance(given, dict) else given:
            _judge_stranger(kind, value, base, project)
    elif isinstance(given, str) and "\n" not in given and len(given) < MOST_OF_A_PATH:
        try:
            target = _real(given.removeprefix("file://"), base)
        except (ValueError, RuntimeError):
            return  # a text that can be no path
        inside = _inside(target, project)
        shut = users_data.shut(target, project) or authors_judge.keeps(target, project)
        if shut or (inside and (len(inside.parts) > 1 or target.exists())):
            raise DeniedError(
                f"`{kind}` is no tool of ours, and {given} belongs to a run or says whose word counts: look at it with your own "
                "tools; a run's files are written by its roles and our servers"
            )


def _refuse_reserved(name: str) -> None:
    if name in RESERVED:
        raise DeniedError(f"{name} is not a tool of the main thread: spawn the role whose it is, and let it report")


def _targets(given: object) -> list[str]:
    """Every path that a writing tool names; without any, the call is denied."""
    found: list[str] = []
    if isinstance(given, dict):
        for key in NAMES_A_FILE:
            if isinstance(given.get(key), str):
                found.append(given[key])
        for key in ("input", "patch", "patchText", "command", "content_patch"):
            value = given.get(key)
            text = "\n".join(map(str, value)) if isinstance(value, list) else value
            if isinstance(text, str):
                found += [a or b for a, b in PATCHED.findall(text)]
    elif isinstance(given, str):
        found += [a or b for a, b in PATCHED.findall(given)]
    if not found:
        raise DeniedError("the file this call would write cannot be told from its input")
    return [path.strip() for path in found]


def _judge_read(given: object, base: Path) -> None:
    """Whoever has read the signing key signs as this machine; a search of a folder that holds it reads it, too."""
    named = [given[key] for key in NAMES_A_FILE if isinstance(given.get(key), str)] if isinstance(given, dict) else []
    for path in named or ["."]:
        real, judged = _real(path, base), users_data.judged()
        if users_data.key().is_relative_to(real):
            raise DeniedError(
                f"{path} is or holds the signing key, which no agent reads: name the file or folder you need"
            )
        if real.is_relative_to(judged) or judged.is_relative_to(real):
            raise DeniedError(f"{path} is or holds a benchmark's verdicts, which nobody who builds reads")


def _judge_write(path: str, base: Path, project: Path, role: Role | None) -> None:
    target = _real(path, base)
    if users_data.shut(target, project):
        raise DeniedError(
            f"{path} says whose signature and which proof count, and no agent writes it: a person calls a key known, in a "
            "terminal of theirs, with `worldwright keys trust`"
        )
    if authors_judge.keeps(target, project):
        raise DeniedError(f"{path} belongs to what judges this world, which its author does not write: stay in {RUNS}/")
    inside = _inside(target, project)
    if role is None:
        if inside is not None:
            raise DeniedError(
                f"{path} belongs to a run, and the main thread writes nothing there: the plan role writes plan.md, the "
                "code role simulation.py, the tools everything else"
            )
        return
    scope = " or ".join(f"{RUNS}/<slug>/{name}" for name in role.writes) or "nothing"
    if inside is None or not any(_names(name, inside.parts[1:]) for name in role.writes):
        raise DeniedError(f"{path} is outside the write scope of the {role.name} role, which is {scope}")
    link = Path(os.path.normpath(base / path))
    if link.is_symlink() or (link.exists() and link.stat().st_nlink > 1):
        raise DeniedError(f"{path} is a link; the {role.name} role writes plain files")


def _names(scope: str, parts: tuple[str, ...]) -> bool:
    """Whether a name of a role's scope is a file of a run: `film.py`, any one such as `*.py`, or any below `sculpt/`."""
    if scope.endswith("/"):
        return len(parts) > 1 and parts[0] == scope[:-1] and not any(part.startswith(".") for part in parts)
    return len(parts) == 1 and not parts[0].startswith(".") and fnmatch.fnmatchcase(parts[0], scope)


def _real(path: str, base: Path) -> Path:
    """The file that would really be written, with links resolved as far as the path exists."""
    return Path(os.path.realpath(base / Path(path).expanduser()))


def _inside(target: Path, project: Path) -> Path | None:
    """The path below `runs/`, or None when it is elsewhere."""
    runs = Path(os.path.realpath(project / RUNS))
    try:
        return target.relative_to(runs)
    except ValueError:
        return None


def _leave_word(event: dict[str, object], folder: Path) -> None:
    """Tell the stamp server which role is about to approve, describe or review; `model/evidence/came.py` reads it."""
    tool, given = str(event.get("tool_name") or ""), event.get("tool_input")
    named = re.search(r"stamp_{1,2}(approve|describe|review)$", tool)
    if not (named and isinstance(given, dict)):
        return
    try:
        folder.mkdir(parents=True, exist_ok=True)
        word = {
            "agent": str(event.get("agent_type") or event.get("agent_name") or "main"),
            "run": str(given.get("run", "")),
        }
        (folder / f"{named[1]}-{time.time_ns()}.json").write_text(json.dumps(word), encoding="utf-8")
    except OSError:  # the stamp then says that no hook told the role
        return


def main() -> int:
    """Judge one event from standard input for the harness that the command line names."""
    try:
        event = json.load(sys.stdin)
        if not isinstance(event, dict):
            raise DeniedError("the hook's input is no object")
        names = harnesses.find(sys.argv[1]).TOOLS
        project = Path(os.path.realpath(Path(__file__).parents[3]))
        own = judge(event, project, names)
        changed = confined(event, project, names)
    except DeniedError as reason:
        sys.stderr.write(f"scope guard: {reason}\n")
        return 2
    except BaseException as defect:  # a failing guard must not let anything through
        sys.stderr.write(f"scope guard failed, so the call is denied: {type(defect).__name__}: {defect}\n")
        return 2
    _leave_word(event, project / RUNS / ".spoken")
    if changed is not None:
        _answer({"permissionDecision": "allow", "updatedInput": changed})
    elif own and names.allows_in_scope:
        _answer({"permissionDecision": "allow", "permissionDecisionReason": "in scope"})
    return 0


def _answer(decision: dict) -> None:
    sys.stdout.write(json.dumps({"hookSpecificOutput": {"hookEventName": "PreToolUse", **decision}}))


if __name__ == "__main__":
    sys.exit(main())
