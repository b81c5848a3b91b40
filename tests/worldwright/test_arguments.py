"""Whatever arguments a tool is called with, the answer says what was wrong with them and what there is."""

import anyio
import mcp
import pytest
from click.testing import CliRunner

from worldwright import expose
from worldwright.cli import main

LONG = "x" * 300


def refused(server, tool, arguments):
    async def run():
        async with mcp.Client(expose.build_server(server)) as client:
            return await client.call_tool(tool, arguments)

    result = anyio.run(run)
    assert result.is_error
    assert result.structured_content["error"] == "arguments"
    assert len(str(result.structured_content)) < 2000
    return result.structured_content["cause"] + " | " + result.structured_content["next"]


@pytest.mark.parametrize(
    ("server", "tool", "arguments", "said"),
    [
        (
            "retrieve",
            "search",
            {},
            "`question` is missing | search takes question (a text), k (a whole number",
        ),
        ("retrieve", "search", {"question": ["a"]}, "`question` must be a text, not ['a']"),
        ("retrieve", "search", {"question": "a", "ranks": 1}, "there is no argument `ranks` (is `ranking` meant?)"),
        ("retrieve", "search", {"question": "a", "ranking": "best"}, "must be one of auto, hybrid, full_text, vectors"),
        ("retrieve", "find", {}, "there is no tool `find` | "),
        ("stamp", "status", {"run": "a\0b"}, "`run` holds a NUL character"),
        ("stamp", "status", {"run": LONG}, "`run` has 300 characters, which is too long for a file's name"),
        ("stamp", "status", {"run": "a" * 2_000_000}, "`run` has 2000000 characters"),
        ("lint", "check_program", {"files": ["a\0"]}, "`files` holds a NUL character"),
        ("stage", "wait", {"run": "a", "timeout_s": "soon"}, "`timeout_s` must be a number above 0 and at most 40"),
        ("stage", "wait", {"run": "a", "timeout_s": 50}, "and at most 40, not 50"),
    ],
)
def test_wrong_arguments_are_named(server, tool, arguments, said):
    assert said in refused(server, tool, arguments)


def test_a_name_too_long_for_a_file_is_named_on_the_command_line_too():
    done = CliRunner().invoke(main, ["stamp", "status", LONG])
    assert done.exit_code == 2
    assert "too long for a file's name" in done.output


@pytest.mark.parametrize("words", [["retrieve", "find_asset"], ["retrieve.find_asset"], ["retrieve", "find-asset"]])
def test_a_verb_is_called_as_its_tool_is(words):
    done = CliRunner().invoke(main, [*words, "--help"])
    assert done.exit_code == 0 and "Usage" in done.output and "QUERY" in done.output.upper()


def test_a_verb_that_there_is_not_is_refused():
    done = CliRunner().invoke(main, ["retrieve", "find_nothing"])
    assert done.exit_code == 2 and "find-nothing" in done.output
