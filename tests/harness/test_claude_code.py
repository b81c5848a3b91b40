"""The contract in the real Claude Code: what the hooks deny and let pass, and one `/generate` from words to a stamp."""

import json
import subprocess

import pytest
from model_server import Model
from script import ROLES, Call, Say, Script
from story import TRIES, evidence, story


def claude(harnesses, project, clean, script, prompt, timeout=900):
    """Run one headless session; returns its result."""
    with Model(script) as model:
        done = subprocess.run(
            [harnesses["claude"], "-p", prompt, "--output-format", "json"],
            cwd=project,
            env={
                **clean,
                "ANTHROPIC_BASE_URL": model.url,
                "CLAUDE_CODE_DISABLE_NONESSENTIAL_TRAFFIC": "1",
                "DISABLE_AUTOUPDATER": "1",
            },
            capture_output=True,
            text=True,
            timeout=timeout,
            stdin=subprocess.DEVNULL,
        )
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr[-2000:]
    return json.loads(done.stdout)


def write(project, path):
    return Call("Write", {"file_path": str(project / path), "content": "# text\n"})


def spawn(role):
    given = {"description": role, "prompt": "the run is runs/ball", "subagent_type": f"world-{role}"}
    return [[Call("Agent", given)]]


def test_the_guard_holds_for_every_role(harnesses, project, clean):
    (project / "outside").mkdir()
    (project / "runs/link").symlink_to(project / "outside")
    forbidden = [
        "README.md",
        "runs/ball/journal.jsonl",
        "runs/ball/../../x.md",
        "runs/link/simulation.py",
        "runs/link/plan.md",
    ]
    turns = {
        "main": [
            [write(project, "runs/ball/plan.md")],
            *(turn for role in ROLES for turn in spawn(role)),
            [Call("mcp__stamp__review", {"run": "runs/ball"})],
        ],
        "plan": [
            [write(project, "runs/ball/plan.md")],
            *([write(project, p)] for p in [*forbidden, "runs/ball/simulation.py"]),
        ],
        "code": [
            [write(project, "runs/ball/simulation.py")],
            *([write(project, p)] for p in [*forbidden, "runs/ball/plan.md"]),
        ],
        "visual": [[Call("mcp__stamp__accept", {"run": "runs/ball"})]],
        "review": [[Call("mcp__stage__start", {"run": "runs/ball"})]],
    }
    script = Script(turns)
    claude(harnesses, project, clean, script, "do what the script says")
    assert (project / "runs/ball/plan.md").is_file() and (project / "runs/ball/simulation.py").is_file()
    assert sorted(p.name for p in (project / "runs/ball").iterdir()) == ["plan.md", "simulation.py"]
    assert not list((project / "outside").iterdir()) and not (project / "x.md").exists()
    for role in ("plan", "code"):
        first, *others = script.results[role]
        assert "scope guard" not in first
        assert len(others) == 6 and all("scope guard" in text for text in others)
    main = script.results["main"]
    assert "scope guard" in main[0] and "scope guard" in main[-1]
    assert not any(tool in script.tools[role] for role in ("visual", "review") for tool in ("Write", "Edit", "Bash"))


def test_the_shell_writes_neither_evidence_nor_the_suite(harnesses, project, clean):
    """The person allows every command, and the model asks for the sandbox to be left out."""
    settings = project / ".claude/settings.json"
    allowed = json.loads(settings.read_text())
    allowed["permissions"]["allow"] = ["Bash"]
    settings.write_text(json.dumps(allowed))
    home = project.parent / "home" / ".claude.json"
    home.write_text(json.dumps({"projects": {str(project): {"hasTrustDialogAccepted": True}}}))
    calls = [
        Call("Bash", {"command": command, "description": "try", "dangerouslyDisableSandbox": True}) for command in TRIES
    ]
    script = Script({"main": [*([call] for call in calls), [Say("tried")]]})
    before = evidence(project)
    claude(harnesses, project, clean, script, "do what the script says")
    assert evidence(project) == before
    results = script.results["main"]
    assert len(results) == len(TRIES)
    assert all("Read-only file system" in text for text in results[:-1]), results
    assert (project / "notes.md").is_file() and "chained" in results[-1]  # other work goes on, and so does looking


def test_a_broken_guard_denies(harnesses, project, clean):
    (project / "servers/worldwright/contract/roles.py").write_text("raise RuntimeError('broken')\n")
    script = Script({"main": [[write(project, "notes.md")], [Say("tried")]]})
    claude(harnesses, project, clean, script, "write a note")
    assert not (project / "notes.md").exists() and "denied" in script.results["main"][0]


@pytest.mark.slow
def test_a_sentence_becomes_a_stamped_world(harnesses, project, clean, small_plan):
    script = Script(
        story(
            project, small_plan,
            write=lambda path, text: Call("Write", {"file_path": str(project / path), "content": text}),
            tool=lambda server, name, /, **given: Call(f"mcp__{server}__{name}", given),
            spawn=spawn,
        )
    )  # fmt: skip
    # The person approves: headless, by allowing the one tool that would otherwise ask.
    settings = project / ".claude/settings.json"
    allowed = json.loads(settings.read_text())
    allowed["permissions"] = {"allow": ["mcp__stamp__approve"]}
    settings.write_text(json.dumps(allowed))
    home = project.parent / "home" / ".claude.json"
    home.write_text(json.dumps({"projects": {str(project): {"hasTrustDialogAccepted": True}}}))
    result = claude(harnesses, project, clean, script, "/generate a ball is dropped")
    said = json.dumps(dict(script.results.items()), indent=1)[-6000:]
    assert result["result"].startswith("accepted"), said
    assert (project / "runs/ball/accepted/stamp.json").is_file(), said
    done = subprocess.run(
        [project / ".venv/bin/worldwright", "stamp", "verify", "runs/ball"],
        cwd=project,
        env=clean,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout
