"""How long a cold stdio server takes to answer `initialize`, for each of the six. Goal: under 1.5 s on two cores."""

import json
import os
import subprocess
import sys
import time

from figures import Figure, report

from worldwright import expose

GOAL_S = 1.5
REQUEST = {
    "jsonrpc": "2.0",
    "id": 1,
    "method": "initialize",
    "params": {
        "protocolVersion": "2025-06-18",
        "capabilities": {},
        "clientInfo": {"name": "bench", "version": "0"},
    },
}


def first_answer(server: str) -> float:
    """Seconds from starting the process to reading its answer to `initialize`."""
    began = time.perf_counter()
    call = [sys.executable, "-m", "worldwright.cli", "serve", server]
    with subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        process.stdin.write((json.dumps(REQUEST) + "\n").encode())
        process.stdin.flush()
        answer = json.loads(process.stdout.readline())
        elapsed = time.perf_counter() - began
        process.stdin.close()
    assert answer["result"]["serverInfo"]["name"] == f"worldwright-{server}"
    return elapsed


def main() -> int:
    """Print the median of five starts of each server; fail when one misses the goal."""
    if hasattr(os, "sched_setaffinity"):
        os.sched_setaffinity(0, set(sorted(os.sched_getaffinity(0))[:2]))
    figures = []
    for server in expose.SERVERS:
        first_answer(server)  # bytecode caches are written once per installation
        median = sorted(first_answer(server) for _ in range(5))[2]
        figures.append(Figure(f"{server} answers initialize", median, GOAL_S, "s"))
    return report(*figures)


if __name__ == "__main__":
    sys.exit(main())
