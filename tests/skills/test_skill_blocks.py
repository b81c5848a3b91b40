"""Every code block of a skill runs: Python blocks are whole programs that prove what they show.

A block is told by the words after its fence: `python` runs by itself and asserts something; `python program` is a part of
a program and only has to be Python (another test runs it in its world); `yaml`, `markdown`, `sh`, `json` and `text` are read by other
tests or only by people.
"""

import re
from pathlib import Path

import pytest

REPO = Path(__file__).parents[2]
PAGES = sorted([*(REPO / "skills").glob("*/SKILL.md"), *(REPO / "skills").glob("*/references/*.md")])
KINDS = {"python", "python program", "yaml", "markdown", "sh", "json", "text"}


def blocks(page: Path) -> list[tuple[str, int, str]]:
    """Kind, line and text of each fenced block."""
    text = page.read_text(encoding="utf-8")
    found = re.finditer(
        r"^(?P<fence>```|~~~~~)(?P<kind>\w*(?: program)?)[^\n]*\n(?P<body>.*?)^(?P=fence)[ ]*$",
        text,
        re.MULTILINE | re.DOTALL,
    )
    return [(m["kind"], text[: m.start()].count("\n") + 2, m["body"]) for m in found]


ALL = [
    pytest.param(page, kind, line, body, id=f"{page.relative_to(REPO / 'skills')}:{line}")
    for page in PAGES
    for kind, line, body in blocks(page)
]
PROGRAMS = [case for case in ALL if case.values[1] == "python"]
PARTS = [case for case in ALL if case.values[1] == "python program"]


@pytest.mark.parametrize(("page", "kind", "line", "body"), ALL)
def test_a_block_says_what_it_is(page, kind, line, body):
    assert kind in KINDS, f"{page}:{line}: name one of {sorted(KINDS)} after the fence"


@pytest.mark.parametrize(("page", "kind", "line", "body"), PROGRAMS)
def test_a_program_runs_and_proves_itself(page, kind, line, body, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert re.search(r"^\s*assert ", body, re.MULTILINE), "a block that asserts nothing shows nothing"
    exec(compile("\n" * (line - 1) + body, str(page), "exec"), {"__name__": "__skill__"})


def test_parts_of_programs_are_python():
    for page, _, line, body in (case.values for case in PARTS):
        compile("\n" * (line - 1) + body, str(page), "exec")
