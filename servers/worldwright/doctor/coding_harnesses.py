"""Check the coding harnesses on this machine: versions, generated files, the guard's hook, and what the person must grant.

A harness is asked through its own commands, and nothing is written. A missing part is `weak`, not a failure, as the
command line works without any harness.
"""

import functools
import json
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator

from ..contract import harnesses
from ..contract.command import project, stale
from ..contract.generated import links
from ..contract.roles import RUNS
from .diagnosis import Diagnosis, last_line

SHELL = "servers/worldwright/contract/shell.py"


def contract() -> Diagnosis | None:
    """Check that the harnesses' generated files fit the roles, and that the links to skills and commands lead somewhere."""
    root = project()
    if not (root / ".mcp.json").parent.joinpath("skills").is_dir():
        return None  # without a checkout, no harness is configured from here
    drifted = [f"{name} {why}" for name, why in stale(root).items()]
    if drifted:
        return Diagnosis("contract", False, "; ".join(drifted[:3]), "worldwright contract sync")
    broken = [link for link in links() if not (root / link).is_dir()]
    fix = f"git config core.symlinks true && git checkout -- {' '.join(links())}"
    found = f"no folder behind {', '.join(broken)}" if broken else "agents, permissions, hooks and links are in place"
    return Diagnosis("contract", not broken, found, fix)


def guard() -> Diagnosis | None:
    """Check the write-scope guard by the hook's own command: it must let one write pass and deny another."""
    root = project()
    hooks = root / ".codex/hooks.json"
    if not hooks.is_file():
        return None
    command = json.loads(hooks.read_text(encoding="utf-8"))["hooks"]["PreToolUse"][0]["hooks"][0]["command"]
    codes = []
    for path in ("runs/doctor/plan.md", "README.md"):
        patch = {"input": f"*** Begin Patch\n*** Add File: {path}\n+x\n*** End Patch"}
        event = {"tool_name": "apply_patch", "tool_input": patch, "agent_type": "world-plan", "cwd": str(root)}
        done = subprocess.run(
            ["sh", "-c", command], input=json.dumps(event), cwd=root, capture_output=True, text=True, timeout=30, check=False
        )  # fmt: skip
        codes.append(done.returncode)
    found = (
        "lets a role's own file pass and denies another; it reads no commands of shells"
        if codes == [0, 2]
        else f"answers {codes} instead of [0, 2]"
    )
    fix = "the hook needs `python3` on the path, and servers/worldwright/contract as in the repository"
    return Diagnosis("guard", codes == [0, 2], found, fix)


def installed() -> Diagnosis:
    """Check which harnesses are installed, and whether in the versions with which the contract was proven."""
    found, old = [], []
    known = {harness.PROGRAM: harness for harness in harnesses.known().values()}
    for name, harness in known.items():
        version, tested = _version(name), harness.TESTED
        if version is None:
            continue
        found.append(f"{name} {version}" + ("" if version == tested else f" (proven with {tested})"))
        if _number(version) < _number(tested):
            old.append(name)
    if not found:
        fix = f"install one: {', '.join(f'npm install -g {harness.PACKAGE}' for harness in known.values())}"
        return Diagnosis("harnesses", False, "none on the path", fix, essential=False)
    fix = "; ".join(f"npm install -g {known[name].PACKAGE}@{known[name].TESTED}" for name in old)
    return Diagnosis("harnesses", not old, ", ".join(found), fix, essential=False)


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


def shells() -> Diagnosis | None:
    """Check what keeps the shells of Codex and OpenCode from the runs: a command that it starts cannot write there."""
    root = project()
    if not (root / SHELL).is_file():
        return None
    (root / RUNS).mkdir(exist_ok=True)
    attempt = f"touch {RUNS}/.doctor 2>/dev/null && rm {RUNS}/.doctor && echo wrote; echo ran"
    call = ["python3", str(root / SHELL), str(root), attempt]
    done = subprocess.run(call, cwd=root, capture_output=True, text=True, timeout=30, check=False)
    if done.returncode:
        fix = "a kernel with Landlock (Linux 5.13 or newer); Claude Code has a sandbox of its own"
        return Diagnosis("shells", False, f"do not start in Codex and OpenCode: {last_line(done.stderr)}", fix, False)
    found = "in Codex and OpenCode cannot write to the runs and the suite"
    return Diagnosis("shells", done.stdout.split() == ["ran"], found, "worldwright contract sync", essential=False)


def each() -> Iterator[functools.partial[Diagnosis | None]]:
    """One check for each harness, of what it lacks."""
    for name, harness in harnesses.known().items():
        check = functools.partial(lambda harness: harness.diagnose(project()), harness)
        check.__name__ = name  # type: ignore[attr-defined]
        yield check


CHECKS: tuple[Callable[[], Diagnosis | None], ...] = (contract, guard, shells, installed, *each())
