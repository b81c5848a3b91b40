"""The write-scope guard, as the harnesses start it: in scope passes, everything else is denied, a broken guard denies."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from worldkit import data_folders
from worldwright.contract import authors_judge, guard, harnesses, users_data
from worldwright.contract.roles import ROLES, SUITE
from worldwright.stamp import keyring

REPO = Path(__file__).parents[3]
CLAUDE = json.loads((REPO / ".claude/settings.json").read_text())["sandbox"]["filesystem"]


@pytest.fixture
def project(tmp_path):
    for name in ("runs/ball/evidence/k", "runs/other", "src"):
        (tmp_path / name).mkdir(parents=True)
    (tmp_path / "runs/ball/plan.md").write_text("# plan\n")
    return tmp_path


def verdict(project, tool, given, agent="", cwd=None, harness="claude_code"):
    """None when allowed, else the reason."""
    event = {"tool_name": tool, "tool_input": given, "cwd": str(cwd or project)}
    if agent:
        event["agent_type"] = agent
    try:
        guard.judge(event, project, harnesses.find(harness).TOOLS)
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
    for harness, tools in (("claude_code", ("Write", "Edit", "MultiEdit")), ("opencode", ("write", "edit"))):
        for tool in tools:
            assert verdict(project, tool, write(path), agent, harness=harness) is None
            assert verdict(project, tool, write(project / path), agent, harness=harness) is None


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


@pytest.mark.parametrize(
    ("agent", "path", "may"),
    [
        ("world-code", "runs/ball/sculpt/boy.py", True),
        ("world-code", "runs/ball/sculpt/skins/face.svg", True),
        ("world-code", "runs/ball/laws/sand.py", True),
        ("world-code", "runs/ball/data/track.csv", True),
        ("world-code", "runs/ball/helper.py", True),
        ("world-plan", "runs/ball/sculpt/boy.py", True),
        ("world-plan", "runs/ball/laws/sand.py", True),
        ("world-plan", "runs/ball/helper.py", False),
        ("world-code", "runs/ball/helper.sh", False),
        ("world-code", "runs/ball/sculpt", False),
        ("world-code", "runs/ball/sculpt/../journal.jsonl", False),
        ("world-code", "runs/ball/sculpt/.hidden/x.py", False),
        ("world-code", "runs/ball/evidence/k/source/simulation.py", False),
        ("world-code", "runs/ball/accepted/sculpt/boy.py", False),
        ("world-review", "runs/ball/sculpt/boy.py", False),
    ],
)
def test_what_belongs_to_a_program_may_lie_beside_it(project, agent, path, may):
    assert (verdict(project, "Write", write(path), agent) is None) == may


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
        assert verdict(project, "apply_patch", {key: good}, "world-code", harness="codex") is None
        assert verdict(project, "apply_patch", {key: bad}, "world-code", harness="codex")
        assert verdict(project, "apply_patch", {key: moved}, "world-code", harness="codex")
    assert verdict(project, "apply_patch", {"input": good}, harness="codex")
    assert verdict(project, "apply_patch", {"input": "nothing"}, "world-code", harness="codex")


AGENTS = {"claude_code": ("Task", "Agent"), "codex": ("spawn_agent", "collaborationspawn_agent"), "opencode": ("task",)}


@pytest.mark.parametrize("agent", [role.agent for role in ROLES])
@pytest.mark.parametrize(("harness", "tools"), AGENTS.items(), ids=AGENTS)
def test_roles_start_and_address_no_agents(project, agent, harness, tools):
    for tool in tools:
        assert "starts no agents" in verdict(project, tool, {"message": "x"}, agent, harness=harness)
        assert verdict(project, tool, {"message": "x"}, harness=harness) is None


@pytest.mark.parametrize("agent", [role.agent for role in ROLES])
def test_a_role_looks_by_shell_only_where_it_has_no_other_way(project, agent):
    given = {"command": "ls runs"}
    assert "has no shell" in verdict(project, "Bash", given, agent, harness="claude_code")
    assert "has no shell" in verdict(project, "bash", given, agent, harness="opencode")
    assert (verdict(project, "Bash", given, agent, harness="codex") is None) == (agent != "world-visual")


@pytest.mark.parametrize("harness", harnesses.known())
@pytest.mark.parametrize("agent", [role.agent for role in ROLES])
def test_a_tool_that_nobody_knows_is_denied_to_a_role(project, harness, agent):
    for tool in ("WebFetch", "RemoteTrigger", "mcp__somebody__tool", "mcp__stamp", "a_tool_of_tomorrow"):
        assert "is no tool of" in verdict(project, tool, {}, agent, harness=harness)
        assert (
            verdict(project, tool, {}, harness=harness) is None
        )  # the main thread's are the person's and the harness' business


@pytest.mark.parametrize("agent", ["", "general-purpose"])
def test_another_servers_tool_is_given_no_file_of_a_run(project, data, agent):
    tool = "mcp__filesystem__write_file"
    (project / "by").symlink_to(project / "runs/ball")
    for path in (
        "runs/ball/evidence/k/scan.json",
        "by/plan.md",
        f"file://{project}/runs/ball/new",
        "runs/ball",
        data / "known_keys",
    ):
        for given in ({"path": str(path)}, {"edits": [{"destination": str(path)}]}):
            assert "is no tool of ours" in verdict(project, tool, given, agent)
    for text in (
        "runs",
        "src/notes.md",
        "The ball runs/rolls well",
        "runs/ball/plan.md is\nthe plan",
        "x" * 9000,
        "a\0b",
        "~5 kg",
        3,
    ):
        assert (verdict(project, tool, {"path": text}, agent) is None) == (text != "runs"), text


TRIES = [
    "echo x > runs/ball/evidence/k/scan.json",
    "mkdir -p runs/new/evidence",
    "p=run; p=${p}s; rm -r $p/ball",
    "$(printf 'r\\155') -r ru*/ball",
    "echo cm0gLXIgcnVucwo= | base64 -d | sh",
    "python3 -c \"import os; os.truncate('r'+'uns/ball/plan.md', 0)\"",
    "cd /; cd - >/dev/null; find . -name plan.md -delete",
    "ln src/own runs/ball/evidence/k/linked; mv src runs/",
    "ln -s $PWD/runs out; echo x > out/ball/plan.md",
    "(sleep 0.2; rm -r runs/ball) & wait",
    "mv runs elsewhere; mv servers elsewhere",
    "echo raise > servers/gate.py",
    "unshare -Ur sh -c 'mount -t tmpfs x runs && rm -r runs/ball' ; rm -r runs/ball",
    "echo x > /proc/self/cwd/runs/ball/plan.md; echo x > /proc/$PPID/cwd/runs/ball/plan.md",
]


@pytest.mark.parametrize("command", TRIES)
def test_a_confined_shell_cannot_write_to_runs_and_suite(project, command):
    (project / "servers").mkdir()
    (project / "servers/gate.py").write_text("pass\n")
    (project / "src/own").write_text("mine\n")
    kept = ("runs", "servers")
    before = {path: path.read_bytes() for name in kept for path in (project / name).rglob("*") if path.is_file()}
    folders = {path for name in kept for path in (project / name).rglob("*")}
    done = shell(project, f"{command}\necho changed >> src/own; cat runs/ball/plan.md; echo it ran")
    assert {path: path.read_bytes() for path in before} == before
    assert {path for name in kept for path in (project / name).rglob("*")} == folders
    assert done.stdout.endswith("# plan\nit ran\n"), done.stderr  # looking goes on
    assert "changed" in next(path for path in project.rglob("own")).read_text()  # and so does other work


def test_a_shell_starts_below_a_folder_that_may_be_entered_and_not_listed(tmp_path):
    above, home = tmp_path / "above", tmp_path / "above/home"
    for name in ("place/runs/ball", "place/src", "home/own"):
        (above / name).mkdir(parents=True)
    above.chmod(0o311)
    # Root lists every folder, unless it gives that up.
    alone = [] if os.geteuid() else ["setpriv", "--bounding-set=-dac_override,-dac_read_search"]
    try:
        done = shell(
            above / "place",
            "echo x > src/a && echo x > ~/own/a && echo written; touch runs/ball/b",
            through=alone,
            env={**os.environ, "HOME": str(home)},
        )
        assert done.stdout == "written\n" and "runs/ball/b" in done.stderr, done.stderr
    finally:
        above.chmod(0o755)


def shell(project, command, through=(), env=None):
    """Run a command as Codex and OpenCode do: as the guard has rewritten it."""
    event = {"tool_name": "bash", "tool_input": {"command": command, "description": "try"}}
    changed = guard.confined(event, project, harnesses.find("opencode").TOOLS)
    assert changed["description"] == "try"
    words = [*through, "sh", "-c", changed["command"]]
    return subprocess.run(words, cwd=project, capture_output=True, text=True, timeout=60, env=env)


def test_an_author_in_a_folder_of_the_suite_changes_nothing_of_what_judges_it(tmp_path):
    """Its shell and its file tools, from runs/C/authors/xx/W/1/project of the checkout that runs it."""
    campaign = tmp_path / "suite/runs/many"
    place = campaign / "authors/ab/world/1/project"
    for name in ("servers", ".venv", "examples", "runs/other"):
        (tmp_path / "suite" / name).mkdir(parents=True, exist_ok=True)
        (tmp_path / "suite" / name / "judges").write_text("true\n")
    for name in ("servers", "runs", "src"):
        (place / name).mkdir(parents=True)
    (campaign / "rows").mkdir()
    authors_judge.name(place, tmp_path / "suite", campaign)
    kept = [tmp_path / "suite" / name / "judges" for name in ("servers", ".venv", "examples", "runs/other")]
    kept += [campaign / "rows/a", place.parent / "told.json", place / authors_judge.FILE, Path(sys.prefix) / "judges"]
    before = (place / authors_judge.FILE).read_text()
    tries = "; ".join(f"echo changed > {path}" for path in kept)
    done = shell(place, f"{tries}; rm {kept[0]} {kept[-2]}; echo mine > src/own; cat {kept[0]} src/own")
    assert done.stdout == "true\nmine\n", done.stderr
    assert {path.read_text() for path in kept[:4]} == {"true\n"} and (place / authors_judge.FILE).read_text() == before
    assert not any(path.exists() for path in (*kept[4:6], kept[-1]))
    for path in kept:
        assert "what judges this world" in verdict(place, "Write", write(str(path)))
        assert verdict(place, "mcp__files__write", {"path": str(path)})
    assert verdict(place, "Write", write(str(place / "src/own"))) is None


@pytest.fixture
def data(tmp_path_factory, monkeypatch):
    """A person's data folder, with a key that signs."""
    folder = tmp_path_factory.mktemp("person") / "data"
    (folder / "assets").mkdir(parents=True)
    (folder / "proofs").mkdir()
    (folder / "judged/eighty").mkdir(parents=True)
    (folder / "judged/eighty/verdict.json").write_text("secret\n")
    (folder / "signing-key.pem").write_text("secret\n")
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(folder))
    return folder


PLANTS = [
    "cat $D/judged/eighty/*; ln -s $D/judged src/j; cat src/j/eighty/verdict.json; cp -r $D/judged src/",
    "cat $D/signing-key.pem; cat $D/proofs/../signing-key.pem; tail -c 9 /proc/self/root$D/signing-key.pem",
    "cp -r $D src/; ln $D/signing-key.pem src/key; mv $D/signing-key.pem src/key; ln -s $D src/d; cat src/d/signing-key.pem",
    "echo x > $D/known_keys; mkdir $D/proofs/0; echo x > $D/proofs/0; echo x > $D/sandbox-landlock-0.json; mv $D src/other",
    "echo x > examples/known_keys; echo x >> examples/a/stamp.json; rm -r examples",
]


@pytest.mark.parametrize("command", PLANTS)
def test_a_confined_shell_neither_reads_the_key_nor_says_whose_word_counts(project, data, command):
    (project / "examples/a").mkdir(parents=True)
    (project / "examples/known_keys").write_text("")

    def kept():
        files = [path for top in (data, project / "examples") for path in top.rglob("*")]
        return {path: path.is_file() and path.read_bytes() for path in files}

    before = kept()
    done = shell(project, f"D={data}\n{command}\necho mine > $D/assets/a && cat $D/assets/a <(echo piped)")
    assert "secret" not in done.stdout and done.stdout.endswith("mine\npiped\n"), done.stderr
    (data / "assets/a").unlink()
    assert kept() == before and not (project / "src/key").exists()


def test_a_data_folder_that_is_not_there_yet_is_not_made_by_a_confined_shell(project, tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(tmp_path / "home/share/data"))
    (tmp_path / "home").mkdir()
    done = shell(project, f"mkdir -p {tmp_path}/home/share/data; echo it ran")
    assert done.stdout == "it ran\n" and not (tmp_path / "home/share").exists()


def test_the_guard_means_the_data_folder_that_the_suite_means(tmp_path, monkeypatch):
    for named, value in (
        ("WORLDWRIGHT_DATA", str(tmp_path)),
        ("XDG_DATA_HOME", str(tmp_path)),
        ("HOME", str(tmp_path)),
    ):
        for name in ("WORLDWRIGHT_DATA", "XDG_DATA_HOME"):
            monkeypatch.delenv(name, raising=False)
        monkeypatch.setenv(named, value)
        assert users_data.folder() == keyring.folder().resolve()
    assert users_data.KEY == keyring.OWN and REPO / users_data.KNOWN_HERE == keyring.SHIPPED
    assert users_data.folder() / users_data.ASSETS == data_folders.own_root().resolve()
    assert CLAUDE["denyRead"] == [f"~/.local/share/worldwright/{name}" for name in (keyring.OWN, users_data.JUDGED)]


@pytest.mark.parametrize("agent", ["", "general-purpose", "world-plan", "world-code"])
def test_no_file_tool_takes_the_key_or_says_whose_word_counts(project, data, agent):
    (project / "link").symlink_to(data)
    for path in ("link/signing-key.pem", data / "signing-key.pem", data, data.parent):
        for tool in ("Read", "Grep"):
            assert "signing key" in verdict(
                project, tool, {"file_path" if tool == "Read" else "path": str(path)}, agent
            )
    assert "signing key" in verdict(project, "Grep", {"pattern": "PRIVATE"}, agent, cwd=data)
    for path in (data / "judged", "link/judged/eighty/verdicts/039.json"):
        assert "a benchmark's verdicts" in verdict(project, "Read", {"file_path": str(path)}, agent)
    assert verdict(project, "Grep", {"pattern": "ball"}, agent) is None
    assert verdict(project, "Read", {"file_path": str(data / "assets/a")}, agent) is None
    for path in ("examples/known_keys", "link/known_keys", data / "proofs/0/proof/plan.md", data / "signing-key.pem"):
        assert "no agent writes it" in verdict(project, "Write", write(path), agent)
    if not agent:
        assert verdict(project, "Write", write(data / "assets/cup/asset.yaml")) is None


def test_a_folder_above_the_verdicts_is_not_searched_where_the_key_lies_elsewhere(project, data, tmp_path_factory):
    (data / "signing-key.pem").rename(elsewhere := tmp_path_factory.mktemp("stick") / "key.pem")
    (data / "signing-key.pem").symlink_to(elsewhere)
    for path in (data, data.parent):
        assert "a benchmark's verdicts" in verdict(project, "Grep", {"path": str(path)})


def test_where_the_harness_confines_its_shell_the_guard_leaves_it_as_it_is(project):
    event = {"tool_name": "Bash", "tool_input": {"command": "ls"}}
    assert guard.confined(event, project, harnesses.find("claude_code").TOOLS) is None
    settings = json.loads((REPO / ".claude/settings.json").read_text())["sandbox"]
    assert settings["enabled"] and not settings["allowUnsandboxedCommands"]
    assert set(settings["filesystem"]["denyWrite"]) == {f"./{name}" for name in ("runs", *SUITE)}
    for name in ("codex", "opencode"):
        names = harnesses.find(name).TOOLS
        assert guard.confined({"tool_name": "Read", "tool_input": {}}, project, names) is None
        with pytest.raises(guard.DeniedError):
            guard.confined({"tool_name": "bash", "tool_input": {"words": "ls"}}, project, names)


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
    assert verdict(project, "mcp__somebody__tool", {}) is None
    assert verdict(project, "Read", {"file_path": "runs/ball/plan.md"}, "world-visual")
    assert verdict(project, "Read", {"file_path": "runs/ball/plan.md"}, "world-review") is None


@pytest.mark.parametrize(
    "given", ["", "not json", "[]", "{}", '{"tool_name": "apply_patch"}', '{"tool_name": "Bash", "tool_input": {}}']
)
def test_what_it_cannot_read_it_denies(given):
    done = subprocess.run(
        [sys.executable, REPO / "servers/worldwright/contract/guard.py", "codex"],
        input=given,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 2 and done.stderr.startswith("scope guard")


@pytest.mark.parametrize(
    ("break_it", "denied"), [("", False), ("raise RuntimeError('broken')", True), ("import nothing_there", True)]
)
def test_the_hook_as_installed_fails_closed(tmp_path, break_it, denied):
    settings = json.loads((REPO / ".claude/settings.json").read_text())
    command = settings["hooks"]["PreToolUse"][0]["hooks"][0]["command"]
    target = tmp_path / "servers/worldwright"
    shutil.copytree(REPO / "servers/worldwright/contract", target / "contract")
    shutil.copy(REPO / "servers/worldwright/__init__.py", target)
    with (target / "contract/roles.py").open("a") as roles:
        roles.write("\n" + break_it)
    event = json.dumps({"tool_name": "Write", "tool_input": write(tmp_path / "README.md"), "cwd": str(tmp_path)})
    env = {"CLAUDE_PROJECT_DIR": str(tmp_path), "PATH": os.environ["PATH"], "HOME": str(tmp_path)}
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
