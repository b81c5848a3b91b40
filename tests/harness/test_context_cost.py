"""What the contract costs: all that stands before the person's first word here, less what stands there in an empty folder.

Counted on the real request of each harness: instructions, tool definitions, listed skills and agents. A token is taken as
four bytes of UTF-8, as for English prose and code; none of the three tokenizers is public.
"""

import json
import subprocess

import pytest
from script import Script
from test_claude_code import claude
from test_codex import CODE_MODE, DIRECT, codex
from test_opencode import opencode

BUDGET_TOKENS = 6000
BYTES_A_TOKEN = 4


def begin(harness, harnesses, folder, clean):
    """Say hello in a folder; returns what the harness had loaded by then, in bytes, less where the folder and the home lie."""
    script = Script({})
    if harness == "claude":
        claude(harnesses, folder, clean, script, "hello")
    elif harness == "opencode":
        opencode(harnesses, folder, clean, script, "hello")
    else:
        codex(harnesses, folder, clean, script, "hello", "--dangerously-bypass-hook-trust", model=harness)
    said = script.first["main"]
    for path in (folder, folder.parent):  # with the home beside it; where they lie is no word of ours
        said = said.replace(str(path), "")
    return len(said.encode())


@pytest.mark.parametrize("harness", ["claude", CODE_MODE, DIRECT, "opencode"])
def test_the_contract_costs_little_context(harness, harnesses, project, clean, tmp_path, record_property):
    empty = tmp_path / "empty"
    (empty / ".opencode").mkdir(parents=True)
    (empty / ".opencode/opencode.json").write_text(json.dumps({"permission": {}}))
    subprocess.run(["git", "init", "-q"], cwd=empty, check=True)
    with_contract, without = (begin(harness, harnesses, folder, clean) for folder in (project, empty))
    tokens = (with_contract - without) / BYTES_A_TOKEN
    record_property("tokens", tokens)
    print(f"{harness}: {tokens:.0f} tokens of the contract, {without / BYTES_A_TOKEN:.0f} of the harness itself")
    assert 500 < tokens < BUDGET_TOKENS
