"""The protocol's own two judges from npm, at pinned versions, with the Node they run on."""

import os
import platform
import shutil
import subprocess
from pathlib import Path

import pytest

REPO = Path(__file__).parents[2]
FOLDER = REPO / ".venv" / "conformance"
NODE = f"node-linux-{'x64' if platform.machine() == 'x86_64' else 'arm64'}"
PINNED = (
    f"{NODE}@22.23.3",
    "@modelcontextprotocol/conformance@0.2.0-alpha.12",
    "@modelcontextprotocol/inspector@2.12.0",
)

# Their own target (`make test-conformance`): they come from npm.
collect_ignore_glob = [] if os.environ.get("WORLDWRIGHT_CONFORMANCE") else ["test_*.py"]


@pytest.fixture(scope="session")
def node() -> dict[str, str]:
    """The environment in which the judges run; their programs are first on its path."""
    stamp = FOLDER / "installed"
    if not stamp.is_file() or stamp.read_text() != "\n".join(PINNED):
        if shutil.which("npm") is None:
            pytest.fail(
                "the protocol's judges come from npm: run `bash .ci/system.sh suites`, or leave this target out"
            )
        FOLDER.mkdir(parents=True, exist_ok=True)
        (FOLDER / "package.json").write_text("{}")
        install = ["npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", *PINNED]
        subprocess.run(install, cwd=FOLDER, check=True, capture_output=True, timeout=600)
        stamp.write_text("\n".join(PINNED))
    paths = (FOLDER / "node_modules" / NODE / "bin", FOLDER / "node_modules/.bin")
    return {**os.environ, "PATH": ":".join([*map(str, paths), os.environ["PATH"]]), "HOME": str(FOLDER)}
