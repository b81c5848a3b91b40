"""The MCP inspector's strict schema check on every server, over stdio."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from worldwright import expose


@pytest.mark.parametrize("server", expose.SERVERS)
def test_strict(node, server):
    target = [str(Path(sys.executable).with_name("worldwright")), "serve", server]
    call = ["mcp-inspector", "--cli", *target, "--method", "tools/list", "--strict", "--connect-timeout", "60000"]
    done = subprocess.run(call, env=node, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    names = {tool["name"] for tool in json.loads(done.stdout)["tools"]}
    assert names == {function.__name__ for function in expose.tools(server)}
