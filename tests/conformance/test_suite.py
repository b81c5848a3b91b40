"""The official MCP conformance suite over HTTP: all six servers and the code that exposes them, two protocol revisions."""

import contextlib
import re
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from worldwright import expose

HERE = Path(__file__).parent
BASELINE = HERE / "expected-failures.yml"
REVISIONS = ("2025-11-25", "2026-07-28")
TRIED_APART = ("tools-call-image", "tools-call-with-progress")
"""What only the subject can pass, for it has the tools that the suite looks for."""


@contextlib.contextmanager
def listening(command: list[str], port: int) -> Iterator[str]:
    """A server on loopback, until the block ends."""
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as server:
        try:
            deadline = time.monotonic() + 60
            while True:
                try:
                    socket.create_connection(("127.0.0.1", port), 1).close()
                    break
                except OSError:
                    assert server.poll() is None and time.monotonic() < deadline, "the server does not listen"
                    time.sleep(0.1)
            yield f"http://127.0.0.1:{port}/mcp"
        finally:
            server.terminate()


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def judge(node: dict[str, str], url: str, revision: str, baseline: Path, folder: Path) -> dict[str, str]:
    """Run what the revision requires; returns the summary's mark for each scenario."""
    call = ["conformance", "server", "--url", url, "--requirements", revision]
    call += ["--expected-failures", str(baseline), "-o", str(folder)]
    done = subprocess.run(call, env=node, capture_output=True, text=True, timeout=240)
    summary = done.stdout[done.stdout.find("=== SUMMARY") :]
    assert done.returncode == 0, summary + done.stderr[-2000:]
    return {name: mark for mark, name in re.findall(r"^(.) ([\w-]+): ", summary, re.MULTILINE)}


@pytest.mark.parametrize("revision", REVISIONS)
@pytest.mark.parametrize("server", expose.SERVERS)
def test_server(node, tmp_path, server, revision):
    port = free_port()
    program = str(Path(sys.executable).with_name("worldwright"))
    with listening([program, "serve", server, "--transport", "http", "--port", str(port)], port) as url:
        marks = judge(node, url, revision, BASELINE, tmp_path)
    assert marks["tools-list"] == marks["tools-call-error"] == marks["dns-rebinding-protection"] == "✓"
    assert len(marks) > 25


@pytest.mark.parametrize("revision", REVISIONS)
def test_what_exposes_them(node, tmp_path, revision):
    port, baseline = free_port(), tmp_path / "baseline.yml"
    kept = [line for line in BASELINE.read_text().splitlines() if not any(f"- {name} " in line for name in TRIED_APART)]
    baseline.write_text("\n".join(kept))
    with listening([sys.executable, str(HERE / "subject.py"), str(port)], port) as url:
        marks = judge(node, url, revision, baseline, tmp_path / "out")
    for name in ("tools-call-simple-text", "tools-call-error", *TRIED_APART):
        assert marks[name] == "✓"


def test_every_expected_failure_has_a_reason():
    entries = [line for line in BASELINE.read_text().splitlines() if line.startswith("  - ")]
    assert len(entries) > 20 and all(re.fullmatch(r"  - [\w-]+  # .{8,}", line) for line in entries)
