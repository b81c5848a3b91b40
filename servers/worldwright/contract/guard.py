#!/usr/bin/env python3
"""The write-scope guard: a hook that every tool use passes before it happens.

Reads the hook's JSON from standard input; exits 0 to let the call through and 2, with the reason on standard error, to
deny it. Whatever goes wrong denies. Real paths are judged, so `..` and symbolic links do not help.

- A role (plan, code, visual, review) writes only its own files inside one run folder, uses only its own MCP tools, and
  has no shell, save for looking at files where the harness has no other way to (Codex).
- The main thread, and any agent that is none of our roles, writes nothing under `runs/`; its shell may only look there.

With `--allow` (Claude Code understands it) a call that belongs to a run need not be confirmed by the person, save the
approval of a plan, which is theirs.

Only the standard library, so that it starts in a few hundredths of a second with any Python. The gates check the same
by hash: what slips past a hook is refused at acceptance. No hook sees everything: Codex asks none about text that is typed
into a shell already running, so a shell that waits for input is not started at all.
"""

import json
import os
import re
import shlex
import sys
from pathlib import Path

try:
    from .roles import BY_AGENT, RESERVED, RUNS, Role
except ImportError:  # started as a program: the folder of this file is on the path
    from roles import BY_AGENT, RESERVED, RUNS, Role  # type: ignore[no-redef]

SERVERS = frozenset({"retrieve", "lint", "place", "stage", "scan", "stamp"})
WRITERS = frozenset({"write", "edit", "multiedit", "notebookedit", "apply_patch", "patch", "create", "str_replace"})
SHELLS = frozenset(
    {"bash", "shell", "exec", "local_shell", "exec_command", "unified_exec", "write_stdin", "powershell"}
)
READERS = frozenset({"read", "glob", "grep", "ls", "list", "notebookread", "view_image", "read_file", "list_dir"})
LOOKING = frozenset(
    [
        "ls",
        "cat",
        "head",
        "tail",
        "nl",
        "wc",
        "stat",
        "sha256sum",
        "md5sum",
        "du",
        "diff",
        "cmp",
        "rg",
        "grep",
        "egrep",
        "fgrep",
        "jq",
        "realpath",
        "pwd",
        "echo",
        "true",
    ]
)
"""Commands that cannot write without a redirection (`tree -o`, `less -o` and `file -C` can)."""
STARTERS = re.compile(r"^--(?:pre|hostname-bin)(?:=|$)")
"""Options of `rg` that start another program."""
PRINTED = re.compile(r"^\d+(?:,(?:\d+|\$))?p$")
"""The one script of `sed` that only looks: `sed -n 10,20p FILE`."""
INTERACTIVE = re.compile(
    r"(?:^|[;&|\n])\s*(?:\S*/)?(?:(?:ba|da|z|fi)?sh|i?python[\d.]*|node|perl|ruby)(?:\s+-[il]+)*\s*(?:$|[;&\n])"
)
"""An interpreter that is given neither a program nor a file, and so would read what is typed into it later."""
SILENCED = re.compile(r"\b2>\s*(?:/dev/null|&1)(?=[\s;|&]|$)")
"""Errors thrown away or joined to the output: the redirections that write no file."""
COLLABORATION = ("collaboration", "multi_agent")
"""Namespaces of Codex's tools for other agents; a hook sees them run together: `collaborationspawn_agent`."""
PATCHED = re.compile(r"^\*\*\* (?:Add|Update|Delete) File: (.+)$|^\*\*\* Move to: (.+)$", re.MULTILINE)


class DeniedError(Exception):
    """The call is not allowed; the message says why and what to do instead."""


def judge(event: dict, project: Path) -> bool:
    """Raise `DeniedError` unless the tool use is allowed; True when it is one of a run's own, which nobody need confirm.

    Args:
        event: the hook's input: `tool_name`, `tool_input`, and for sub-agents `agent_type`.
        project: the folder that holds `runs/`.
    """
    tool = str(event.get("tool_name") or "")
    given = event.get("tool_input")
    if not tool:
        raise DeniedError("the hook's input names no tool")
    agent = str(event.get("agent_type") or event.get("agent_name") or "")
    role = BY_AGENT.get(agent.rsplit(":", 1)[-1].lower())
    base = Path(str(event.get("cwd") or project))
    kind = tool.lower()
    if kind.startswith("mcp__"):
        return _judge_mcp(kind, role)
    if kind in WRITERS:
        for path in _targets(given):
            _judge_write(path, base, project, role)
        return role is not None
    if kind in SHELLS:
        folder = given.get("workdir") or given.get("cwd") or "." if isinstance(given, dict) else "."
        _judge_shell(_command(given), base / str(folder), project, role)
    elif role is not None and kind in READERS and not role.reads_files:
        raise DeniedError(f"the {role.name} role sees only what its tools show it: {', '.join(role.tools)}")
    elif role is not None and (kind in ("agent", "task", "spawn_agent") or kind.startswith(COLLABORATION)):
        raise DeniedError(f"the {role.name} role starts no agents: answer, and let the main thread go on")
    return False


def _judge_mcp(kind: str, role: "Role | None") -> bool:
    parts = kind.split("__")
    if len(parts) < 3 or parts[1] not in SERVERS:
        return False
    name = f"{parts[1]}.{parts[2]}"
    if role is None:
        _refuse_reserved(name)
    elif name not in role.tools:
        raise DeniedError(f"{name} is not a tool of the {role.name} role; it has: {', '.join(role.tools)}")
    return name != "stamp.approve"  # whether a plan is approved, the person is asked


def _refuse_reserved(name: str) -> None:
    if name in RESERVED:
        raise DeniedError(f"{name} is not a tool of the main thread: spawn the role whose it is, and let it report")


def _targets(given: object) -> list[str]:
    """Every path a writing tool names; none found is a refusal."""
    found: list[str] = []
    if isinstance(given, dict):
        for key in ("file_path", "filePath", "path", "notebook_path", "filename"):
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


def _judge_write(path: str, base: Path, project: Path, role: "Role | None") -> None:
    target = _real(path, base)
    inside = _inside(target, project)
    if role is None:
        if inside is not None:
            raise DeniedError(
                f"{path} belongs to a run, and the main thread writes nothing there: the plan role writes plan.md, the "
                "code role simulation.py, the tools everything else"
            )
        return
    scope = " or ".join(f"{RUNS}/<slug>/{name}" for name in role.writes) or "nothing"
    if inside is None or len(inside.parts) != 2 or inside.parts[1] not in role.writes:
        raise DeniedError(f"{path} is outside the write scope of the {role.name} role, which is {scope}")
    link = Path(os.path.normpath(base / path))
    if link.is_symlink() or (link.exists() and link.stat().st_nlink > 1):
        raise DeniedError(f"{path} is a link; the {role.name} role writes plain files")


def _judge_shell(command: str, base: Path, project: Path, role: "Role | None") -> None:
    if role is not None and not role.reads_files:
        raise DeniedError(f"the {role.name} role has no shell; its tools are: {', '.join(role.tools)}")
    if role is None:
        if INTERACTIVE.search(command):
            raise DeniedError("a shell that waits for input cannot be judged: give the whole command at once")
        runs = project / RUNS
        here = _inside(_real(".", base), project) is not None
        if not (here or RUNS in command or str(runs) in command or _globs_into(command, base, runs)):
            return
    who = f"the {role.name} role has a shell only to look" if role else "the main thread writes nothing under runs/"
    if re.search(r"[`]|\$\(|<\(|>\(|\$\{?[A-Za-z_]", command):
        raise DeniedError(f"{who}, and a command may not compute its arguments: write the paths out")
    for words in _commands(command, who):
        if role is not None or not _hands_over_image(words, base, project):
            _judge_command(words, who, project, role)


def _hands_over_image(words: list[str], base: Path, project: Path) -> bool:
    """`cp PICTURE runs/<slug>/reference.png`: the one file the main thread puts into a run, as the person gave it."""
    if len(words) != 3 or words[0] != "cp" or words[1].startswith("-"):
        return False
    link = Path(os.path.normpath(base / words[2]))
    target = _inside(_real(words[2], base), project)
    kinds = (".png", ".jpg", ".jpeg", ".webp")
    named = target is not None and len(target.parts) == 2 and target.stem == "reference" and target.suffix in kinds
    return named and not link.is_symlink() and words[1].lower().endswith(kinds)


def _commands(command: str, who: str) -> list[list[str]]:
    """The simple commands of a line of shell, as words; a redirection or a job in the background is refused."""
    found: list[list[str]] = [[]]
    for line in SILENCED.sub(" ", command).splitlines():
        reader = shlex.shlex(line, posix=True, punctuation_chars=True)
        reader.whitespace_split, reader.commenters = True, ""
        try:
            words = list(reader)
        except ValueError as cause:
            raise DeniedError(f"the command cannot be read: {cause}") from cause
        for word in words:
            if word in ("&&", "||", ";", "|"):
                found.append([])
            elif word and not word.strip("();<>|&"):
                raise DeniedError(f"{who}, and may not redirect (`{word}`) there")
            else:
                found[-1].append(word)
        found.append([])
    return [words for words in found if words]


def _judge_command(words: list[str], who: str, project: Path, role: "Role | None") -> None:
    if words[0] in LOOKING and not (words[0] == "rg" and any(STARTERS.match(word) for word in words)):
        return
    if words[:2] == ["sed", "-n"] and len(words) > 3 and PRINTED.match(words[2]) and words[3][:1] != "-":
        return
    if role is None and words[0] in ("worldwright", ".venv/bin/worldwright", str(project / ".venv/bin/worldwright")):
        _refuse_reserved(".".join(words[1:3]).replace("-", "_"))
        return
    raise DeniedError(
        f"`{words[0]}` may write, and {who}: only looking commands ({', '.join(sorted(LOOKING))}, sed -n 1,9p)"
        + (" and `worldwright …` may name a run; a role writes its own file" if role is None else " are for it")
    )


def _command(given: object) -> str:
    if isinstance(given, dict):
        value = given.get("command", given.get("cmd", given.get("input")))
        if isinstance(value, list):
            words = [str(word) for word in value]
            shell = len(words) >= 3 and Path(words[0]).name in ("bash", "sh", "zsh") and words[1].startswith("-")
            return words[-1] if shell else shlex.join(words)
        if isinstance(value, str):
            return value
    if isinstance(given, str):
        return given
    raise DeniedError("the command cannot be told from the hook's input")


def _real(path: str, base: Path) -> Path:
    """The file that would really be written: links resolved as far as the path exists."""
    return Path(os.path.realpath(base / Path(path).expanduser()))


def _inside(target: Path, project: Path) -> "Path | None":
    """The path below `runs/`, or None when it is elsewhere."""
    runs = Path(os.path.realpath(project / RUNS))
    try:
        return target.relative_to(runs)
    except ValueError:
        return None


def _globs_into(command: str, base: Path, runs: Path) -> bool:
    """Whether a pattern of the command matches the runs folder (`ru*`, `r?ns`)."""
    for word in re.findall(r"[^\s;|&<>'\"]*[*?\[][^\s;|&<>'\"]*", command):
        head = word.strip("./").split("/")[0]
        if head and re.fullmatch(
            re.escape(head).replace(r"\*", ".*").replace(r"\?", ".").replace(r"\[", "[").replace(r"\]", "]"), RUNS
        ):
            return True
    return bool(re.match(r"\s*(?:cd|pushd)\s", command)) and _real(command.split(None, 1)[1].split()[0], base) == runs


def main() -> int:
    """Judge one event from standard input."""
    try:
        event = json.load(sys.stdin)
        if not isinstance(event, dict):
            raise DeniedError("the hook's input is no object")
        own = judge(event, Path(os.path.realpath(Path(__file__).parents[3])))
    except DeniedError as reason:
        sys.stderr.write(f"scope guard: {reason}\n")
        return 2
    except BaseException as defect:  # a guard that fails must not let anything through
        sys.stderr.write(f"scope guard failed, so the call is denied: {type(defect).__name__}: {defect}\n")
        return 2
    if own and "--allow" in sys.argv[1:]:
        decision = {
            "hookEventName": "PreToolUse",
            "permissionDecision": "allow",
            "permissionDecisionReason": "in scope",
        }
        sys.stdout.write(json.dumps({"hookSpecificOutput": decision}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
