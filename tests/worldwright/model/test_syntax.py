"""Whatever runs in a server's threads reads Python through one place, one text at a time."""

import ast
from pathlib import Path

import pytest

import worldwright
from worldwright.model import syntax

SERVERS = Path(worldwright.__file__).parent
ALONE = ("architecture.py", "inventory.py", "new_rule.py", "scaffolds", "inside", "rules")
"""These run in a process of their own, or quote it."""


def test_nothing_else_that_threads_run_parses():
    found = [path.relative_to(SERVERS) for path in SERVERS.rglob("*.py") if "ast.parse(" in path.read_text("utf-8")]
    assert [str(path) for path in found if not {*path.parts} & {*ALONE}] == ["model/syntax.py"]


def test_it_gives_and_raises_what_python_does():
    assert ast.dump(syntax.module("a = 1")) == ast.dump(ast.parse("a = 1"))
    assert ast.dump(syntax.expression("a + 1")) == ast.dump(ast.parse("a + 1", mode="eval").body)
    with pytest.raises(SyntaxError) as failure:
        syntax.module("a = = 1", "here.py")
    assert failure.value.filename == "here.py"
