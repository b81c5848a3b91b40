"""The doctor finds what is really wrong, and names a fix that mends it."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldkit import kept_kernels
from worldwright import cli, doctor
from worldwright.contract import generated, harnesses
from worldwright.contract.command import project
from worldwright.doctor import coding_harnesses, machine, servers
from worldwright.doctor.diagnosis import Diagnosis

REPO = Path(__file__).parents[3]


@pytest.fixture
def checkout(tmp_path, monkeypatch):
    """A folder with the contract's files, which may be broken."""
    for name, text in generated.files().items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    (tmp_path / "skills").mkdir()
    (tmp_path / "commands").mkdir()
    for link in generated.links():
        (tmp_path / link).parent.mkdir(exist_ok=True)
        (tmp_path / link).symlink_to(f"../{Path(link).name}")
    target = tmp_path / "servers/worldwright"
    shutil.copytree(REPO / "servers/worldwright/contract", target / "contract")
    shutil.copy(REPO / "servers/worldwright/__init__.py", target)
    for module in (coding_harnesses, servers):
        monkeypatch.setattr(module, "project", lambda: tmp_path)
    return tmp_path


def program(folder: Path, name: str, text: str) -> None:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\n{text}\n")
    path.chmod(0o755)


def test_the_doctor_asks_the_installed_engine_and_no_module_of_the_folder_it_is_called_in(tmp_path, monkeypatch):
    (tmp_path / "mujoco.py").write_text("import pathlib\npathlib.Path('ran').touch()\n__version__ = '4.liar'\n")
    monkeypatch.chdir(tmp_path)
    found = machine.simulator()
    assert found.ok and "liar" not in found.found and not (tmp_path / "ran").exists()


def test_the_doctor_says_whether_a_ros_network_can_be_spoken(monkeypatch):
    found = machine.ros()
    assert found.ok and "cyclonedds 11" in found.found and "rosbags 0" in found.found
    monkeypatch.setitem(sys.modules, "cyclonedds.domain", None)
    found = machine.ros()
    assert not (found.ok or found.essential) and found.fix.endswith("-m pip install 'worldwright[ros]'")


def test_the_doctor_says_whether_numba_is_here_and_has_compiled_and_what_compiles_it(monkeypatch):
    monkeypatch.setattr(kept_kernels, "compiled", lambda: True)
    found = machine.matter()
    assert found.ok and f"numba {kept_kernels.numba()}, compiled" in found.found
    monkeypatch.setattr(kept_kernels, "compiled", lambda: False)
    found = machine.matter()
    assert not found.ok and not found.essential and "not compiled yet" in found.found
    assert found.fix.endswith("-m worldkit.matter.ahead")
    monkeypatch.setattr(kept_kernels, "may_be_kept", lambda: False)
    assert "only who may write the installation" in machine.matter().found
    monkeypatch.setattr(kept_kernels, "numba", lambda: "")
    assert "pip install" in machine.matter().fix


def test_the_servers_really_answer():
    found = servers.servers()
    assert found.ok and "all 6 answer initialize" in found.found


def test_servers_that_do_not_answer_are_named(checkout, monkeypatch):
    monkeypatch.setattr(servers, "PATIENCE_S", 1.5)
    program(checkout, ".venv/bin/worldwright", '[ "$2" = lint ] && exec sleep 60; echo "no such module" >&2; exit 1')
    found = servers.servers()
    assert not found.ok and found.essential and "make demo" in found.fix
    assert "lint: no answer in 2 s" in found.found and "stamp: no such module" in found.found


def test_drift_and_lost_links_are_named_with_their_fix(checkout):
    assert coding_harnesses.contract().ok
    (checkout / ".claude/skills").unlink()
    (checkout / ".claude/skills").write_text("../skills")  # a checkout without symbolic links
    found = coding_harnesses.contract()
    assert not found.ok and ".claude/skills" in found.found and "core.symlinks" in found.fix
    (checkout / ".codex/hooks.json").write_text("{}")
    found = coding_harnesses.contract()
    assert ".codex/hooks.json differs" in found.found and found.fix == "worldwright contract sync"


def test_a_guard_that_lets_everything_pass_or_nothing_is_found(checkout):
    assert coding_harnesses.guard().ok
    for text in ("", "raise RuntimeError"):
        (checkout / "servers/worldwright/contract/guard.py").write_text(text)
        assert not coding_harnesses.guard().ok


@pytest.mark.parametrize(
    ("prints", "ok", "says"),
    [
        ("echo '2.1.329 (Claude Code)'", True, "claude 2.1.329"),
        ("echo 99.0.0", True, "claude 99.0.0 (proven with 2.1.329)"),
        ("echo 1.0.44", False, "claude 1.0.44 (proven"),
        ("exit 1", False, "claude of unknown version"),
    ],
)
def test_versions_are_compared_with_the_proven_ones(tmp_path, monkeypatch, prints, ok, says):
    program(tmp_path, "claude", prints)
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    found = coding_harnesses.installed()
    assert found.ok == ok and says in found.found and not found.essential
    assert ok or "npm install -g @anthropic-ai/claude-code@2.1.329" in found.fix


def test_without_a_harness_the_doctor_names_all_three(tmp_path, monkeypatch):
    monkeypatch.setenv("PATH", str(tmp_path))
    found = coding_harnesses.installed()
    assert not found.ok and not found.essential and found.fix.count("npm install -g") == 3
    assert [check() for check in coding_harnesses.each()] == [None, None, None]


def test_trust_of_the_folder_is_read_from_claude(tmp_path, monkeypatch):
    program(tmp_path, "claude", "echo 2.1.329")
    monkeypatch.setenv("PATH", f"{tmp_path}:/usr/bin:/bin")
    monkeypatch.setenv("CLAUDE_CONFIG_DIR", str(tmp_path))
    for name in ("bwrap", "socat"):
        program(tmp_path, name, "true")
    assert not harnesses.find("claude_code").diagnose(project()).ok
    settings = tmp_path / ".claude.json"
    settings.write_text(json.dumps({"projects": {str(project()): {"hasTrustDialogAccepted": True}}}))
    assert harnesses.find("claude_code").diagnose(project()).ok
    settings.write_text("{broken")
    assert not harnesses.find("claude_code").diagnose(project()).ok


def test_a_sandbox_that_claude_cannot_start_is_named(tmp_path, monkeypatch):
    program(tmp_path, "claude", "echo 2.1.329")
    program(tmp_path, "bwrap", "true")
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setenv("CLAUDE_CONFIG_DIR", str(tmp_path))
    settings = {"projects": {str(tmp_path): {"hasTrustDialogAccepted": True}}}
    (tmp_path / ".claude.json").write_text(json.dumps(settings))
    found = harnesses.find("claude_code").diagnose(tmp_path)
    assert not found.ok and "finds no socat" in found.found and "socat" in found.fix


def test_a_shell_that_is_not_kept_from_the_runs_is_found(checkout):
    assert coding_harnesses.shells().ok
    path = checkout / coding_harnesses.SHELL
    path.write_text(path.read_text().replace("        confine(project)\n", "        pass\n"))
    assert not coding_harnesses.shells().ok
    path.write_text("raise OSError('no Landlock')\n")
    found = coding_harnesses.shells()
    assert not found.ok and "no Landlock" in found.found


@pytest.mark.parametrize(("essential", "code", "mark"), [(True, 1, "FAIL"), (False, 0, "weak")])
def test_what_a_build_needs_decides_the_exit_code(monkeypatch, essential, code, mark):
    def crash() -> Diagnosis:
        raise OSError("gone")

    checks = [lambda: Diagnosis("thing", False, "not here", "get one", essential), lambda: None]
    monkeypatch.setattr(doctor, "CHECKS", tuple(checks if not essential else [*checks, crash]))
    done = CliRunner().invoke(cli.main, ["doctor"])
    assert done.exit_code == code
    assert f"{mark} thing" in done.output and "fix: get one" in done.output
    assert not essential or "FAIL crash" in done.output


def test_this_machine_can_build():
    call = [sys.executable, "-m", "worldwright.cli", "doctor"]
    done = subprocess.run(call, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout
    for name in ("python", "mujoco", "wheels", "opengl", "sandbox", "servers", "contract", "guard", "harnesses"):
        assert f" {name}" in done.stdout
