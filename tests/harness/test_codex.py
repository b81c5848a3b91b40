"""The contract in the real Codex: hook trust, what the hooks deny and let pass, and one `$generate` from words to a stamp.

Its present models work in code mode (one tool that runs JavaScript), older ones call tools directly: scopes are tried in both.
"""

import json
import re
import subprocess
from itertools import count

import pytest
from model_server import Model
from script import ROLES, Call, Say, Script
from story import TRIES, evidence, story

CODE_MODE, DIRECT = "gpt-6.1-sol", "gpt-5.5"
TRUSTED = "--dangerously-bypass-hook-trust"


def configure(project, clean, url, model=CODE_MODE, more=""):
    """The person's own settings in an empty home: a model on loopback, and that this project is trusted."""
    folder = project.parent / "home" / ".codex"
    folder.mkdir(exist_ok=True)
    (folder / "config.toml").write_text(f'''
model = "{model}"
model_provider = "scripted"
{more}
[model_providers.scripted]
name = "scripted"
base_url = "{url}/v1"
wire_api = "responses"
env_key = "OPENAI_API_KEY"
supports_websockets = false
[projects."{project}"]
trust_level = "trusted"
''')


def codex(harnesses, project, clean, script, prompt, *options, model=CODE_MODE, more="", timeout=900):
    """Run one headless session; returns what it printed."""
    with Model(script) as server:
        configure(project, clean, server.url, model, more)
        done = subprocess.run(
            [harnesses["codex"], "exec", *options, prompt],
            cwd=project, env=clean, capture_output=True, text=True, timeout=timeout, stdin=subprocess.DEVNULL,
        )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-3000:]
    return done.stdout


def ask(harnesses, project, clean, method, params):
    """One question to Codex's app server."""
    asked = [
        {"id": 1, "method": "initialize", "params": {"clientInfo": {"name": "test", "version": "0"}}},
        {"method": "initialized"},
        {"id": 2, "method": method, "params": params},
    ]
    server = subprocess.Popen(
        [harnesses["codex"], "app-server"], cwd=project, env=clean, text=True,
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        server.stdin.write("".join(json.dumps(line) + "\n" for line in asked))
        server.stdin.flush()
        for line in server.stdout:
            answer = json.loads(line)
            if answer.get("id") == 2:
                return answer["result"]
        raise AssertionError("no answer")
    finally:
        server.kill()
        server.wait()


def patch(path, text="# text\n"):
    """A patch that adds the file, or replaces it whole."""
    lines = "".join(f"+{line}\n" for line in text.splitlines())
    return Call("apply_patch", f"*** Begin Patch\n*** Add File: {path}\n{lines}*** End Patch")


NUMBERS = count(1)


def spawn(role):
    """Two turns; every task needs a name of its own."""
    name = f"{role}_{next(NUMBERS)}"
    given = {"task_name": name, "message": "the run is runs/ball", "agent_type": f"world-{role}", "fork_turns": "none"}
    wait = Call("collaboration.wait_agent", {"timeout_ms": 300_000})
    return [[Call("collaboration.spawn_agent", given)], [wait]]


def spawn_directly(script):
    """In the older form an agent is waited for by the name that spawning answered with."""

    def turns(role):
        def wait():
            ident = re.search(r'"agent_id":\s*"([^"]+)"', script.results["main"][-1])
            return [Call("multi_agent_v1.wait_agent", {"targets": [ident.group(1)], "timeout_ms": 300_000})]

        given = {"message": "the run is runs/ball", "agent_type": f"world-{role}"}
        return [[Call("multi_agent_v1.spawn_agent", given)], wait]

    return turns


FORBIDDEN = [
    "README.md",
    "runs/ball/journal.jsonl",
    "runs/ball/../../x.md",
    "runs/link/simulation.py",
    "runs/link/plan.md",
]


def scopes():
    """Every role tries its own file, then everything it may not."""
    shell = Call("exec_command", {"cmd": "echo x > runs/ball/plan.md"})
    own = {"plan": "runs/ball/plan.md", "code": "runs/ball/simulation.py"}
    turns = {"main": [[patch("runs/ball/plan.md")], [shell], [Call("mcp__stamp__review", {"run": "runs/ball"})]]}
    for role in ROLES:
        foreign = [path for name, path in own.items() if name != role]
        turns[role] = [
            *([[patch(own[role])]] if role in own else []),
            [Call("exec_command", {"cmd": "head -1 AGENTS.md"})],
            *([patch(path)] for path in [*FORBIDDEN, *foreign]),
            [shell],
            [Call("mcp__stamp__accept", {"run": "runs/ball"})],
            [Say(f"{role} is done")],
        ]
    return turns


def check_scopes(script, project):
    assert sorted(p.name for p in (project / "runs/ball").iterdir()) == ["plan.md", "simulation.py"]
    assert not list((project / "outside").iterdir()) and not (project / "x.md").exists()
    patched, shelled, reviewed = script.results["main"][:3]
    assert "scope guard" in patched and "Permission denied" in shelled and "scope guard" in reviewed, script.results[
        "main"
    ]
    for role in ROLES:
        results = list(script.results[role])
        if role in ("plan", "code"):
            assert "scope guard" not in results.pop(0)
        looked, *others = results
        assert ("Worldwright" in looked) == (role != "visual"), looked
        assert len(others) >= 8
        for text in others:
            assert "scope guard" in text or (role != "visual" and "Permission denied" in text), others


@pytest.fixture
def tempting(project):
    """A project with a run folder and a link that leads out of it."""
    (project / "runs/ball").mkdir(parents=True)
    (project / "outside").mkdir()
    (project / "runs/link").symlink_to(project / "outside")
    return project


@pytest.mark.parametrize("model", [CODE_MODE, DIRECT])
def test_the_guard_holds_for_every_role(harnesses, tempting, clean, model):
    script = Script(scopes())
    start = spawn if model == CODE_MODE else spawn_directly(script)
    script.turns["main"] += [turn for role in ROLES for turn in start(role)]
    before = (tempting / "README.md").read_text()
    codex(harnesses, tempting, clean, script, "do what the script says", TRUSTED, model=model)
    check_scopes(script, tempting)
    assert (tempting / "README.md").read_text() == before


@pytest.mark.parametrize("agent", ["main", "code"])
@pytest.mark.parametrize("model", [CODE_MODE, DIRECT])
def test_the_shell_writes_neither_evidence_nor_the_suite(harnesses, tempting, clean, model, agent):
    (tempting / "notes.md").write_text("")  # by shell the project's own folder takes no new files
    script = Script({})
    tries = [[Call("exec_command", {"cmd": command})] for command in TRIES]
    script.turns[agent] = [*tries, [Say("tried")]]
    if agent != "main":
        script.turns["main"] = (spawn if model == CODE_MODE else spawn_directly(script))(agent)
    before = evidence(tempting)
    codex(harnesses, tempting, clean, script, "do what the script says", TRUSTED, model=model)
    assert evidence(tempting) == before
    results = script.results[agent]
    assert len(results) == len(TRIES)
    assert all("Permission denied" in text or "Read-only" in text for text in results[:-1]), results
    assert (tempting / "notes.md").read_text() == "x\n" and "chained" in results[-1]


def test_a_shell_that_goes_on_listening_is_confined_too(harnesses, tempting, clean):
    script = Script({})

    def typed():
        session = re.search(r'session_id"?:\s*(\d+)', script.results["main"][-1]).group(1)
        line = {"session_id": int(session), "chars": "echo x > runs/ball/plan.md; echo typed\n", "yield_time_ms": 3000}
        return [Call("write_stdin", line)]

    script.turns["main"] = [
        [Call("exec_command", {"cmd": "bash", "tty": True, "yield_time_ms": 500})],
        typed,
        [Say("tried")],
    ]
    codex(harnesses, tempting, clean, script, "do what the script says", TRUSTED)
    assert "typed" in script.results["main"][-1] and not (tempting / "runs/ball/plan.md").exists()


def test_a_role_starts_no_agents(harnesses, tempting, clean):
    script = Script({"main": spawn("plan"), "plan": [*spawn("code"), [Say("tried")]], "code": [[Say("started")]]})
    codex(harnesses, tempting, clean, script, "do what the script says", TRUSTED)
    assert "starts no agents" in script.results["plan"][0] and "code" not in script.first


def test_without_trust_the_hooks_are_silent_and_codex_says_so(harnesses, tempting, clean):
    configure(tempting, clean, "http://127.0.0.1:9")
    (hook,) = ask(harnesses, tempting, clean, "hooks/list", {"cwds": [str(tempting)]})["data"][0]["hooks"]
    assert hook["trustStatus"] == "untrusted" and "guard.py" in hook["command"]
    script = Script({"main": [[patch("runs/ball/plan.md")]]})
    codex(harnesses, tempting, clean, script, "write")
    assert (tempting / "runs/ball/plan.md").is_file()


def test_trust_once_given_lasts_until_the_hook_changes(harnesses, tempting, clean):
    configure(tempting, clean, "http://127.0.0.1:9")
    (hook,) = ask(harnesses, tempting, clean, "hooks/list", {"cwds": [str(tempting)]})["data"][0]["hooks"]
    trust = f'[hooks.state."{hook["key"]}"]\ntrusted_hash = "{hook["currentHash"]}"\n'
    script = Script({"main": [[patch("runs/ball/plan.md")]]})
    codex(harnesses, tempting, clean, script, "write", more=trust)
    assert "scope guard" in script.results["main"][0] and not (tempting / "runs/ball/plan.md").exists()
    path = tempting / ".codex/hooks.json"
    path.write_text(path.read_text().replace("|| {", "; true || {"))
    (hook,) = ask(harnesses, tempting, clean, "hooks/list", {"cwds": [str(tempting)]})["data"][0]["hooks"]
    assert hook["trustStatus"] == "modified"


def test_a_broken_guard_denies(harnesses, project, clean):
    (project / "servers/worldwright/contract/roles.py").write_text("raise RuntimeError('broken')\n")
    script = Script({"main": [[patch("notes.md")], [Call("exec_command", {"cmd": "touch notes.md"})]]})
    codex(harnesses, project, clean, script, "write a note", TRUSTED)
    assert not (project / "notes.md").exists()
    assert all("scope guard failed" in text for text in script.results["main"])


def test_only_the_person_approves(harnesses, project, clean):
    script = Script({"main": [[Call("mcp__stamp__approve", {"run": "runs/ball"})]]})
    codex(harnesses, project, clean, script, "approve", TRUSTED)
    assert "requires approval" in script.results["main"][0]


@pytest.mark.slow
def test_a_sentence_becomes_a_stamped_world(harnesses, project, clean, small_plan):
    script = Script(
        story(
            project, small_plan, write=patch, spawn=spawn,
            tool=lambda server, name, /, **given: Call(f"mcp__{server}__{name}", given),
        )
    )  # fmt: skip
    person = 'mcp_servers.stamp.tools.approve.approval_mode="approve"'  # who is not there to be asked
    printed = codex(harnesses, project, clean, script, "$generate a ball is dropped", TRUSTED, "-c", person)
    said = json.dumps(script.results, indent=1)[-6000:]
    assert printed.strip().endswith("accepted"), said
    assert (project / "runs/ball/accepted/stamp.json").is_file(), said
    assert "# Generate a world from a sentence" in script.first["main"]
    assert "a ball is dropped" not in script.first["visual"]
    done = subprocess.run(
        [project / ".venv/bin/worldwright", "stamp", "verify", "runs/ball"],
        cwd=project,
        env=clean,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
