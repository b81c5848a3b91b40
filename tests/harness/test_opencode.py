"""The contract in the real OpenCode: what its permissions deny and let pass, and one `/generate` from words to a stamp."""

import json
import shutil
import subprocess

import pytest
from model_server import Model
from script import ROLES, Call, Say, Script
from story import TRIES, evidence, story


def opencode(harnesses, project, clean, script, *arguments, timeout=900):
    """Run one headless session; returns what it printed."""
    if shutil.which("rg", path=clean["PATH"]) is None:
        pytest.fail("OpenCode needs ripgrep: run `bash .ci/system.sh suites`")
    with Model(script) as model:
        path = project / ".opencode/opencode.json"
        config = json.loads(path.read_text())
        options = {"baseURL": f"{model.url}/v1", "apiKey": "dummy"}
        limits = {"limit": {"context": 200000, "output": 8000}, "tool_call": True}
        config["provider"] = {
            "scripted": {"npm": "@ai-sdk/openai-compatible", "options": options, "models": {"scripted": limits}}
        }
        config["model"] = config["small_model"] = "scripted/scripted"
        config["permission"]["stamp_approve"] = "allow"  # the person, who is not there to be asked
        path.write_text(json.dumps(config))
        done = subprocess.run(
            [harnesses["opencode"], "run", *arguments],
            cwd=project, env={**clean, "OPENCODE_DISABLE_AUTOUPDATE": "1"},
            capture_output=True, text=True, timeout=timeout, stdin=subprocess.DEVNULL,
        )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-3000:]
    return done.stdout


def write(project, path):
    return Call("write", {"filePath": str(project / path), "content": "# text\n"})


def spawn(role):
    given = {"description": role, "prompt": "the run is runs/ball", "subagent_type": f"world-{role}"}
    return [[Call("task", given)]]


FORBIDDEN = [
    "README.md",
    "runs/ball/journal.jsonl",
    "runs/ball/../../x.md",
    "runs/link/simulation.py",
    "runs/link/plan.md",
]


def test_the_scopes_hold_for_every_role(harnesses, project, clean):
    (project / "outside").mkdir()
    (project / "runs/link").symlink_to(project / "outside")
    shell = [
        Call("bash", {"command": "mkdir -p runs/ball && echo x > runs/ball/plan.md", "description": "write"}),
        Call("bash", {"command": "echo x > notes.md", "workdir": str(project / "runs"), "description": "write"}),
    ]
    turns = {
        "main": [
            [write(project, "runs/ball/plan.md")],
            *([call] for call in shell),
            *(turn for role in ROLES for turn in spawn(role)),
        ],
        "plan": [
            [write(project, "runs/ball/plan.md")],
            *([write(project, p)] for p in [*FORBIDDEN, "runs/ball/simulation.py"]),
        ],
        "code": [
            [write(project, "runs/ball/simulation.py")],
            *([write(project, p)] for p in [*FORBIDDEN, "runs/ball/plan.md"]),
        ],
        "visual": [[Call("stamp_accept", {"run": "runs/ball"})], [write(project, "runs/ball/plan.md")]],
        "review": [[Call("stage_start", {"run": "runs/ball"})], [write(project, "runs/ball/plan.md")]],
    }
    script = Script(turns)
    before = (project / "README.md").read_text()
    opencode(harnesses, project, clean, script, "do what the script says")
    assert sorted(p.name for p in (project / "runs").iterdir()) == ["ball", "link"]
    assert sorted(p.name for p in (project / "runs/ball").iterdir()) == ["plan.md", "simulation.py"], dict(
        script.results
    )
    assert not list((project / "outside").iterdir())
    assert (project / "README.md").read_text() == before and not (project / "x.md").exists()
    for role in ROLES:
        assert not any(tool in script.tools[role] for tool in ("bash", "task"))
    assert all("scope guard" in text or "permission" in text.lower() for text in script.results["main"][:3])


def test_the_shell_writes_neither_evidence_nor_the_suite(harnesses, project, clean):
    (project / "notes.md").write_text("")  # by shell the project's own folder takes no new files
    calls = [Call("bash", {"command": command, "description": "try"}) for command in TRIES]
    script = Script({"main": [*([call] for call in calls), [Say("tried")]]})
    before = evidence(project)
    opencode(harnesses, project, clean, script, "do what the script says")
    assert evidence(project) == before
    results = script.results["main"]
    assert len(results) == len(TRIES)
    assert all("ermission denied" in text for text in results[:-1]), results
    assert (project / "notes.md").read_text() == "x\n" and "chained" in results[-1]


def test_a_broken_guard_denies(harnesses, project, clean):
    (project / "servers/worldwright/contract/roles.py").write_text("raise RuntimeError('broken')\n")
    script = Script({"main": [[Call("bash", {"command": "touch notes.md", "description": "touch"})]]})
    opencode(harnesses, project, clean, script, "write a note")
    assert not (project / "notes.md").exists() and "scope guard failed or denied" in script.results["main"][0]


@pytest.mark.slow
def test_a_sentence_becomes_a_stamped_world(harnesses, project, clean, small_plan):
    script = Script(
        story(
            project, small_plan,
            write=lambda path, text: Call("write", {"filePath": str(project / path), "content": text}),
            tool=lambda server, name, /, **given: Call(f"{server}_{name}", given),
            spawn=spawn,
        )
    )  # fmt: skip
    opencode(harnesses, project, clean, script, "--command", "generate", "a ball is dropped")
    said = json.dumps(script.results, indent=1)[-6000:]
    assert (project / "runs/ball/accepted/stamp.json").is_file(), said
    assert [Say("accepted")] not in script.turns["main"]
    done = subprocess.run(
        [project / ".venv/bin/worldwright", "stamp", "verify", "runs/ball"],
        cwd=project,
        env=clean,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
