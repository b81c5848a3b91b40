"""The write-scope guard, as the harnesses start it: in scope passes, everything else is denied, a broken guard denies."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from worldwright.contract import guard
from worldwright.contract.roles import ROLES

REPO = Path(__file__).parents[3]


@pytest.fixture
def project(tmp_path):
    for name in ("runs/ball/evidence/k", "runs/other", "src"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "runs/ball/plan.md").write_text("# plan\n")
    return tmp_path


def verdict(project, tool, given, agent="", cwd=None):
    """None when allowed, else the reason."""
    event = {"tool_name": tool, "tool_input": given, "cwd": str(cwd or project)}
    if agent:
        event["agent_type"] = agent
    try:
        guard.judge(event, project)
    except guard.DeniedError as reason:
        return str(reason)
    return None


def write(path):
    return {"file_path": str(path), "content": "x"}


@pytest.mark.parametrize(
    ("agent", "path"),
    [
        ("world-plan", "runs/ball/plan.md"),
        ("world-plan", "runs/new/prompt.md"),
        ("world-code", "runs/ball/simulation.py"),
    ],
)
def test_a_role_writes_its_own_file(project, agent, path):
    for tool in ("Write", "Edit", "MultiEdit", "write", "edit"):
        assert verdict(project, tool, write(path), agent) is None
        assert verdict(project, tool, write(project / path), agent) is None


OUTSIDE = [
    "runs/ball/journal.jsonl",
    "runs/ball/evidence/k/scan.json",
    "runs/ball/accepted/stamp.json",
    "runs/plan.md",
    "runs/ball/sub/plan.md",
    "plan.md",
    "src/plan.md",
    "runs/ball/../../plan.md",
    "runs/ball/../ball/evidence/plan.md",
    "/etc/plan.md",
    "~/plan.md",
    "servers/worldwright/contract/roles.py",
]


@pytest.mark.parametrize("path", OUTSIDE)
@pytest.mark.parametrize("agent", ["world-plan", "world-code", "world-visual", "world-review"])
def test_no_role_writes_anywhere_else(project, agent, path):
    assert "outside the write scope" in verdict(project, "Write", write(path), agent)


@pytest.mark.parametrize(
    ("agent", "path"),
    [
        ("world-code", "runs/ball/plan.md"),
        ("world-plan", "runs/ball/simulation.py"),
        ("world-visual", "runs/ball/plan.md"),
        ("world-review", "runs/ball/simulation.py"),
    ],
)
def test_no_role_writes_the_file_of_another(project, agent, path):
    assert verdict(project, "Edit", write(path), agent)


def test_links_do_not_help(project):
    (project / "runs/ball/simulation.py").symlink_to(project / "src/secret.py")
    (project / "runs/link").symlink_to(project / "src")
    os.link(project / "runs/ball/plan.md", project / "src/twin.md")
    assert verdict(project, "Write", write("runs/ball/simulation.py"), "world-code")
    assert verdict(project, "Write", write("runs/link/simulation.py"), "world-code")
    assert "link" in verdict(project, "Write", write("runs/ball/plan.md"), "world-plan")


def test_a_patch_is_judged_by_every_file_it_names(project):
    good = "*** Begin Patch\n*** Update File: runs/ball/simulation.py\n@@\n-a\n+b\n*** End Patch"
    bad = good.replace("*** End", "*** Add File: runs/ball/plan.md\n+x\n*** End")
    moved = good.replace("@@", "*** Move to: runs/ball/evidence/k/x.json\n@@")
    for key in ("input", "patch", "command"):
        assert verdict(project, "apply_patch", {key: good}, "world-code") is None
        assert verdict(project, "apply_patch", {key: bad}, "world-code")
        assert verdict(project, "apply_patch", {key: moved}, "world-code")
    assert verdict(project, "apply_patch", {"input": good})
    assert verdict(project, "apply_patch", {"input": "nothing"}, "world-code")


@pytest.mark.parametrize("agent", [role.agent for role in ROLES])
def test_roles_start_and_address_no_agents(project, agent):
    for tool in ("Task", "Agent", "spawn_agent", "collaborationspawn_agent", "collaborationsend_message"):
        assert "starts no agents" in verdict(project, tool, {"message": "x"}, agent)
    assert verdict(project, "collaborationspawn_agent", {"message": "x"}) is None


LOOKING = [
    "ls -R runs",
    "cat runs/ball/plan.md | head -5; pwd",
    "sed -n 1,20p runs/ball/plan.md",
    "rg 'a|b' skills 2>&1",
]


@pytest.mark.parametrize("agent", [role.agent for role in ROLES])
def test_a_role_has_a_shell_for_looking_at_most(project, agent):
    sees = agent not in ("world-visual",)
    for command in LOOKING:
        assert (verdict(project, "Bash", {"command": command}, agent) is None) == sees
        assert (verdict(project, "shell", {"command": ["bash", "-lc", command]}, agent) is None) == sees
    for command in [*WRITING, "echo x > /elsewhere", "touch x", "sed -n w1 x", "worldwright stamp accept runs/ball"]:
        assert verdict(project, "Bash", {"command": command}, agent)


WRITING = [
    "echo x > runs/ball/plan.md",
    "echo x >> runs/ball/journal.jsonl",
    "cat a | tee runs/ball/plan.md",
    "cp a runs/ball/plan.md",
    "rm -rf runs/ball",
    "sed -i s/a/b/ runs/ball/plan.md",
    "python3 -c \"open('runs/ball/plan.md','w')\"",
    "cd runs && rm -r ball",
    "ls runs; rm -r runs/ball",
    "ls runs | xargs rm",
    "cat runs/ball/plan.md && touch runs/ball/x",
    "find runs -delete",
    "rm -rf ru*",
    "rm -rf ./r?ns/ball",
    "X=runs; echo > $X/ball/plan.md # runs",
    "cat $(echo runs)/ball/plan.md",
    "git checkout -- runs/ball/plan.md",
    "ls runs & rm -r runs",
    "bash -c 'rm runs/ball/plan.md'",
    "cat runs/ball/plan.md&rm -r runs/ball",
    "tree runs -o runs/ball/plan.md",
    "rg --pre=./x runs",
    "sed -n '1,5w runs/x' a",
    "cat a >| runs/ball/plan.md",
    "cat a 2>/dev/null>runs/ball/plan.md",
    "ls runs\nrm -r runs/ball",
    "./worldwright runs",
    "worldwright stamp describe runs/ball x",
    "worldwright stamp review runs/ball x",
]


@pytest.mark.parametrize("command", WRITING)
def test_the_main_thread_changes_nothing_under_runs_by_the_shell(project, command):
    assert verdict(project, "Bash", {"command": command})
    assert verdict(project, "shell", {"command": ["bash", "-lc", command]})


def test_a_reference_image_is_handed_over(project):
    assert verdict(project, "Bash", {"command": "cp 'my photos/desk.PNG' runs/ball/reference.png"}) is None
    assert verdict(project, "Bash", {"command": "cp desk.png reference.jpg"}, cwd=project / "runs/ball") is None
    (project / "runs/other/reference.png").symlink_to(project / "src/x.png")
    for wrong in (
        "cp desk.png runs/ball/plan.md",
        "cp script.py runs/ball/reference.png",
        "cp -r desk.png runs/ball/reference.png",
        "cp desk.png runs/ball/evidence/reference.png",
        "cp desk.png runs/other/reference.png",
        "cp desk.png runs/ball/reference.png; rm runs/ball/plan.md",
        "mv desk.png runs/ball/reference.png",
    ):
        assert verdict(project, "Bash", {"command": wrong}), wrong
    assert verdict(project, "Bash", {"command": "cp desk.png runs/ball/reference.png"}, "world-plan")


def test_a_shell_is_judged_where_it_runs(project):
    for key in ("workdir", "cwd"):
        assert verdict(project, "bash", {"command": "rm plan.md", key: "runs/ball"})
        assert verdict(project, "bash", {"command": "rm plan.md", key: str(project / "runs")})
        assert verdict(project, "bash", {"command": "rm plan.md", key: "src"}) is None
    assert verdict(project, "Bash", {"command": "rm plan.md"}, cwd=project / "runs/ball")


@pytest.mark.parametrize(
    "command",
    [
        "ls -la runs/ball",
        "cat runs/ball/plan.md | head -5",
        "grep -n claim runs/ball/plan.md 2>/dev/null",
        "worldwright stamp status runs/ball",
        ".venv/bin/worldwright stamp verify runs/ball && ls runs",
        "echo 'a > b' runs",
        "make test",
        "pip install x > log.txt",
        "rm -rf build",
        "rg 'a|b; c' runs",
        "python3 x.py",
        "bash build.sh && make",
        "printf x | python3 -",
    ],
)
def test_looking_and_other_work_is_left_alone(project, command):
    assert verdict(project, "Bash", {"command": command}) is None


@pytest.mark.parametrize("command", ["sh", "bash -i", "cd x && python3", "/usr/bin/node", "python3.12 -i"])
def test_what_waits_for_input_is_not_started(project, command):
    assert "waits for input" in verdict(project, "Bash", {"command": command})


def test_the_main_thread_writes_elsewhere_and_not_in_a_run(project):
    assert verdict(project, "Write", write("README.md")) is None
    assert verdict(project, "Edit", write("servers/worldwright/cli.py"), "general-purpose") is None
    assert "main thread" in verdict(project, "Write", write("runs/ball/plan.md"))
    assert verdict(project, "Write", write("runs/ball/plan.md"), "general-purpose")
    assert verdict(project, "Write", write("../" + project.name + "/runs/ball/x"))
    assert verdict(project, "Write", write("plan.md"), cwd=project / "runs/ball")


def test_tools_belong_to_roles(project):
    assert verdict(project, "mcp__stamp__review", {}, "world-review") is None
    assert "not a tool of the main thread" in verdict(project, "mcp__stamp__review", {})
    assert "not a tool of the world-" not in (verdict(project, "mcp__stamp__describe", {}, "world-visual") or "")
    assert verdict(project, "mcp__stamp__accept", {}, "world-code")
    assert verdict(project, "mcp__scan__expect", {}, "world-visual")
    assert verdict(project, "mcp__somebody__tool", {}, "world-code") is None
    assert verdict(project, "Read", {"file_path": "runs/ball/plan.md"}, "world-visual")
    assert verdict(project, "Read", {"file_path": "runs/ball/plan.md"}, "world-review") is None


@pytest.mark.parametrize(
    "given", ["", "not json", "[]", "{}", '{"tool_name": "Write"}', '{"tool_name": "Bash", "tool_input": {}}']
)
def test_what_it_cannot_read_it_denies(given):
    done = subprocess.run(
        [sys.executable, REPO / "servers/worldwright/contract/guard.py"], input=given, capture_output=True, text=True
    )
    assert done.returncode == 2 and done.stderr.startswith("scope guard")


@pytest.mark.parametrize(
    ("break_it", "denied"), [("", False), ("raise RuntimeError('broken')", True), ("import nothing_there", True)]
)
def test_the_hook_as_installed_fails_closed(tmp_path, break_it, denied):
    settings = json.loads((REPO / ".claude/settings.json").read_text())
    command = settings["hooks"]["PreToolUse"][0]["hooks"][0]["command"]
    target = tmp_path / "servers/worldwright/contract"
    target.mkdir(parents=True)
    for name in ("guard.py", "roles.py"):
        source = (REPO / "servers/worldwright/contract" / name).read_text()
        (target / name).write_text(source + ("\n" + break_it if name == "roles.py" else ""))
    event = json.dumps({"tool_name": "Write", "tool_input": write(tmp_path / "README.md"), "cwd": str(tmp_path)})
    env = {"CLAUDE_PROJECT_DIR": str(tmp_path), "PATH": os.environ["PATH"]}
    done = subprocess.run(["bash", "-c", command], input=event, capture_output=True, text=True, env=env, cwd=tmp_path)
    assert done.returncode == (2 if denied else 0), done.stderr
    missing = subprocess.run(
        ["bash", "-c", command],
        input=event,
        capture_output=True,
        text=True,
        env={**env, "CLAUDE_PROJECT_DIR": "/nowhere"},
    )
    assert missing.returncode == 2
