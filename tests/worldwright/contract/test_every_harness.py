"""What every harness's file must give, whichever it is."""

import re

import pytest

from worldwright.contract import generated, harnesses
from worldwright.contract.roles import ROLES, SUITE

NAMES = sorted(harnesses.known())


@pytest.mark.parametrize("name", NAMES)
def test_it_says_what_its_tools_are_to_the_guard(name: str) -> None:
    tools = harnesses.find(name).TOOLS
    kinds = (tools.writers, tools.readers, tools.shells, tools.harmless)
    assert tools.writers and tools.shells and tools.agents
    assert sum(map(len, kinds)) == len(frozenset().union(*kinds)), "a tool is one thing to the guard"
    assert all(word == word.lower() for kind in kinds for word in kind)


@pytest.mark.parametrize("name", NAMES)
def test_its_files_ask_the_guard_and_start_our_servers(name: str) -> None:
    harness = harnesses.find(name)
    files = harness.files()
    assert any("contract/guard.py" in text and "AUTHOR" not in text for text in files.values())
    assert re.fullmatch(r"\d+(\.\d+)+", harness.TESTED) and harness.PROGRAM and harness.PACKAGE and harness.NAME


@pytest.mark.parametrize("name", NAMES)
def test_no_shell_of_an_agent_may_write_its_files(name: str) -> None:
    harness = harnesses.find(name)
    paths = [*harness.files(), *(harness.agent(role)[0] for role in ROLES), *map(str, harness.LINKS)]
    open_ones = sorted({path.split("/")[0] for path in paths} - set(SUITE))
    assert not open_ones, f"add to SUITE in contract/roles.py, which shells may not write: {', '.join(open_ones)}"


@pytest.mark.parametrize("name", NAMES)
def test_every_role_has_a_file_of_its_own_with_what_it_is_told(name: str) -> None:
    harness = harnesses.find(name)
    agents = dict(harness.agent(role) for role in ROLES)
    assert len(agents) == len(ROLES) and not set(agents) & set(harness.files())
    for role in ROLES:
        path, text = harness.agent(role)
        assert role.agent in path and generated.GENERATED in text
        assert generated.instructions(role).splitlines()[0] in text
