"""`worldwright doctor` beside the real harnesses: versions, and the trust that a person has or has not granted in Codex."""

import subprocess

import pytest
from test_codex import ask, configure


@pytest.fixture
def examined(harnesses, project, clean):
    """Runs the doctor of a project with all three harnesses on the path."""

    def examine():
        path = ":".join([*(str(program.parent) for program in harnesses.values()), clean["PATH"]])
        call = [project / ".venv/bin/python", "-m", "worldwright.cli", "doctor"]
        env = {**clean, "PATH": path, "PYTHONPATH": str(project / "servers")}
        return subprocess.run(call, cwd=project, env=env, capture_output=True, text=True, timeout=120).stdout

    return examine


def test_the_doctor_knows_what_codex_trusts(harnesses, project, clean, examined):
    said = examined()
    assert "claude 2.1.329" in said and "codex 0.169.0" in said and "opencode 1.18.33" in said
    assert "weak codex     does not read this project's settings" in said
    configure(project, clean, "http://127.0.0.1:9")
    said = examined()
    assert "weak codex     the write-scope guard's hook is untrusted" in said and "read the hook and trust it" in said
    (hook,) = ask(harnesses, project, clean, "hooks/list", {"cwds": [str(project)]})["data"][0]["hooks"]
    trust = f'[hooks.state."{hook["key"]}"]\ntrusted_hash = "{hook["currentHash"]}"\n'
    configure(project, clean, "http://127.0.0.1:9", more=trust)
    assert "ok   codex     the write-scope guard's hook is trusted" in examined()
