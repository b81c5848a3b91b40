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
    """Say hello in a folder; returns what the harness had loaded by then, in bytes, less the folder's own path."""
    script = Script({})
    if harness == "claude":
        claude(harnesses, folder, clean, script, "hello")
    elif harness == "opencode":
        opencode(harnesses, folder, clean, script, "hello")
    else:
        codex(harnesses, folder, clean, script, "hello", "--dangerously-bypass-hook-trust", model=harness)
    return len(script.first["main"].replace(str(folder), "").encode())  # where it lies is no word of ours


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
