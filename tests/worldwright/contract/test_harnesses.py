"""The generated files are fresh, name only tools that exist, and cost little context."""

import json
import re
import tomllib
from pathlib import Path

import anyio
import pytest
import yaml
from click.testing import CliRunner

from worldwright import cli, expose
from worldwright.contract import command, generated, guard, harnesses
from worldwright.contract.roles import COMMANDS, MAIN_TOOLS, ON_REQUEST, RESERVED, ROLES, SERVERS, SKILLS_ON_REQUEST

REPO = Path(__file__).parents[3]
TOOLS = {f"{server}.{function.__name__}" for server in expose.SERVERS for function in expose.tools(server)}
BUDGET_TOKENS = 6000
BYTES_A_TOKEN = 4
"""English prose and code have about four; none of the three harnesses' tokenizers is public."""


def test_the_files_are_as_the_roles_say():
    assert command.stale(REPO) == {}
    assert CliRunner().invoke(cli.main, ["contract", "check"]).exit_code == 0


def test_drift_is_named(tmp_path):
    for name, text in generated.files().items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    (tmp_path / ".mcp.json").write_text("{}")
    (tmp_path / ".codex/hooks.json").unlink()
    assert command.stale(tmp_path) == {".mcp.json": "differs from the roles", ".codex/hooks.json": "missing"}


@pytest.mark.parametrize("tools", [MAIN_TOOLS, *(role.tools for role in ROLES)])
def test_every_tool_exists(tools):
    assert set(tools) <= TOOLS and len(set(tools)) == len(tools)


def test_every_tool_has_somebody():
    used = {tool for role in ROLES for tool in role.tools} | set(MAIN_TOOLS) | set(ON_REQUEST)
    assert used == TOOLS


def test_who_reports_and_who_decides_are_apart():
    tools = {role.name: set(role.tools) for role in ROLES}
    assert "stamp.describe" in tools["visual"] and "stamp.review" in tools["review"]
    decisive = {"stamp.approve", "stamp.accept", "stamp.block"}
    assert decisive <= set(MAIN_TOOLS) and not any(decisive & own for own in tools.values())
    assert {"stamp.describe", "stamp.review"} <= set(RESERVED) <= TOOLS and not set(RESERVED) & set(MAIN_TOOLS)
    assert [role.writes for role in ROLES] == [
        ("plan.md", "prompt.md", "sculpt/", "laws/"),
        ("simulation.py", "film.py", "*.py", "sculpt/", "laws/", "data/"),
        (),
        (),
    ]


def test_every_file_is_well_formed():
    files = generated.files()
    for name, text in files.items():
        if name.endswith(".json"):
            json.loads(text)
        elif name.endswith(".toml"):
            tomllib.loads(text)
        elif name.endswith(".js"):
            assert "tool.execute.before" in text and generated.GUARD in text
        else:
            header = yaml.safe_load(text.split("---\n")[1])
            assert header["description"]
    assert len(files) == 6 + 3 * len(ROLES)


FOURTH = '''"""A harness of a test: one file, nothing else."""

from pathlib import Path

from worldwright.contract.tool_names import ToolNames

NAME, SHELL_SETS = "Fourth", ("FOURTH_SHELL",)
PROGRAM, PACKAGE, TESTED, LINKS = "fourth", "fourth-coder", "1.2.3", ()
TOOLS = ToolNames(
    writers=frozenset({"put"}), readers=frozenset({"look"}), shells=frozenset({"run"}), agents=("fork",),
    harmless=frozenset({"think"}), confined_by_guard=True,
)


def files():
    return {".fourth/settings": "guarded\\n"}


def agent(role):
    return f".fourth/{role.agent}", role.purpose


def diagnose(root: Path):
    from worldwright.doctor.diagnosis import Diagnosis

    return Diagnosis("fourth", False, f"is not set up in {root}", "set it up", essential=False)
'''


def test_a_fourth_harness_is_one_new_file(tmp_path, monkeypatch):
    (tmp_path / "fourth.py").write_text(FOURTH)
    monkeypatch.setattr(harnesses, "__path__", [*harnesses.__path__, str(tmp_path)])
    assert "fourth" in harnesses.known()
    monkeypatch.setenv("FOURTH_SHELL", "1")
    for harness in list(harnesses.known().values()):
        for name in () if harness.NAME == "Fourth" else harness.SHELL_SETS:
            monkeypatch.delenv(name, raising=False)
    assert harnesses.around() == "Fourth"
    made = generated.files()
    assert made[".fourth/settings"] == "guarded\n" and made[".fourth/world-plan"]
    names = harnesses.find("fourth").TOOLS
    put = {"tool_name": "Put", "tool_input": {"path": "runs/ball/plan.md"}, "agent_type": "world-code"}
    with pytest.raises(guard.DeniedError, match="outside the write scope"):
        guard.judge(put, tmp_path, names)
    with pytest.raises(guard.DeniedError, match="is no tool of"):
        guard.judge({"tool_name": "throw", "agent_type": "world-code"}, tmp_path, names)
    assert guard.confined({"tool_name": "run", "tool_input": {"command": "ls"}}, tmp_path, names)
    from worldwright.doctor import coding_harnesses

    checks = {check.__name__: check for check in coding_harnesses.each()}
    assert "is not set up" in checks["fourth"]().found
    monkeypatch.setenv("PATH", str(tmp_path))
    assert "fourth-coder" in coding_harnesses.installed().fix


def test_the_guard_knows_the_servers():
    assert tuple(expose.SERVERS) == SERVERS


def test_a_claude_agent_lists_its_tools_only():
    for role in ROLES:
        header = yaml.safe_load(generated.files()[f".claude/agents/{role.agent}.md"].split("---\n")[1])
        listed = set(header["tools"].split(", "))
        assert {t for t in listed if t.startswith("mcp__")} == {f"mcp__{t.replace('.', '__')}" for t in role.tools}
        assert ("Write" in listed) == bool(role.writes) and "Bash" not in listed
        assert ("Read" in listed) == role.reads_files


def test_opencode_permissions_end_with_what_is_allowed():
    for role in ROLES:
        text = generated.files()[f".opencode/agents/{role.agent}.md"]
        permission = yaml.safe_load(text.split("---\n")[1])["permission"]
        assert next(iter(permission["edit"])) == "*" and permission["edit"]["*"] == "deny"
        assert permission["bash"] == permission["task"] == permission["external_directory"] == "deny"
        allowed = {k for k, v in permission.items() if v == "allow" and "_" in k}
        assert allowed == {t.replace(".", "_") for t in role.tools}


def test_opencode_lends_what_runs_many_worlds_to_an_agent_of_its_own():
    """Its patterns deny what they do not name, skills included; what is allowed is loaded, so one world's threads have none of it."""
    config = json.loads(generated.files()[".opencode/opencode.json"])
    asked, lent = {tool.replace(".", "_") for tool in ON_REQUEST}, config["agent"]["campaign"]
    assert lent["permission"] == dict.fromkeys(asked, "allow") and lent["mode"] == "primary"
    assert not asked & set(config["permission"]) and config["permission"]["stage_*"] == "deny"
    assert config["permission"]["skill"]["campaign"] == "allow" and (REPO / "skills/campaign/SKILL.md").is_file()
    assert not any(set(ON_REQUEST) & set(role.tools) for role in ROLES)


def test_the_contract_costs_little_context():
    """In the harness that loads most, OpenCode: every tool of the main thread in full (`make test-harness` measures all)."""
    loaded = [(REPO / "AGENTS.md").read_text()]
    for name in (*COMMANDS, *SKILLS_ON_REQUEST):
        header = yaml.safe_load((REPO / "skills" / name / "SKILL.md").read_text().split("---\n")[1])
        loaded.append(f"{header['name']}: {header['description']}" + 200 * " ")  # what lists it, and its path
    loaded += [f"{role.agent}: {role.purpose}" for role in ROLES]
    loaded += [json.dumps(tool) for tool in anyio.run(schemas, MAIN_TOOLS)]
    total = sum(len(text.encode()) for text in loaded) / BYTES_A_TOKEN
    assert total < 0.9 * BUDGET_TOKENS, f"about {total:.0f} tokens before the first word"


def test_every_skill_costs_little_context():
    """Claude Code and Codex list every skill, and tools by name only."""
    loaded = [(REPO / "AGENTS.md").read_text()]
    for path in sorted((REPO / "skills").glob("*/SKILL.md")):
        header = yaml.safe_load(path.read_text().split("---\n")[1])
        loaded.append(f"{header['name']}: {header['description']}" + 60 * " ")
    loaded += [f"{role.agent}: {role.purpose} {', '.join(role.tools)}" for role in ROLES]
    loaded += [f"mcp__{tool}" for tool in TOOLS]
    total = sum(len(text.encode()) for text in loaded) / BYTES_A_TOKEN
    assert total < 0.9 * BUDGET_TOKENS, f"about {total:.0f} tokens before the first word"


async def schemas(names):
    """What a client is told about these tools, without their answers' form."""
    found = []
    for server in expose.SERVERS:
        for tool in await expose.build_server(server).list_tools():
            if f"{server}.{tool.name}" in names:
                found.append({"name": tool.name, "description": tool.description, "parameters": tool.input_schema})
    return found


@pytest.mark.parametrize("server", expose.SERVERS)
def test_tool_descriptions_are_short(server):
    for function in expose.tools(server):
        assert len(expose.description(function).split()) < 120, function.__name__


def test_every_command_is_a_link_to_its_skill():
    for name in COMMANDS:
        link = REPO / "commands" / f"{name}.md"
        assert link.is_symlink() and link.resolve() == REPO / "skills" / name / "SKILL.md"


def test_skills_name_only_tools_that_exist():
    for path in (REPO / "skills").glob("*/SKILL.md"):
        for server, tool in re.findall(rf"`({'|'.join(expose.SERVERS)})\.(\w+)`", path.read_text()):
            assert f"{server}.{tool}" in TOOLS, f"{path.parent.name}: {server}.{tool}"


def test_claude_code_is_not_told_what_the_projects_around_an_authors_folder_say(monkeypatch):
    monkeypatch.setattr(Path, "home", lambda: Path("/home/me"))
    harness, room = harnesses.find("claude_code"), Path("/home/me/a (b)[c]/runs/project")
    settings = json.loads(
        harness.unattended({".claude/settings.json": '{"permissions": {}}'}, room)[".claude/settings.json"]
    )
    left_out = settings["claudeMdExcludes"]
    assert {"/home/me/a ?b??c?/CLAUDE.md", "/home/me/a ?b??c?/runs/.claude/rules/**", "/CLAUDE.md"} <= set(left_out)
    assert not [one for one in left_out if one.startswith(("/home/me/CLAUDE", "/home/me/.claude", str(room)))]
    words = harness.headless("a ball", "", room, None)
    assert "--strict-mcp-config" in words and str(room / ".mcp.json") in words, "nor gets it their servers"
