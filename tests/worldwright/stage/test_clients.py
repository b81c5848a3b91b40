"""Jobs seen by real clients, over stdio and streamable HTTP: progress, cancelled calls, restarts, many at once."""

import json
import os
import signal
import socket
import subprocess
import sys
import time

import anyio
import mcp
import pytest
from mcp import StdioServerParameters

SLOW = """
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="NAME", pos=(0, 0, 1))
    ball.add_freejoint()
    ball.add_geom(size=(0.1, 0, 0))
    return spec

program.main(build, duration=SECONDS, fps=1)
"""
"""A ball that falls for a while: some seconds of simulating."""
STDIO = StdioServerParameters(
    command=sys.executable, args=["-m", "worldwright.cli", "serve", "stage"], env=dict(os.environ)
)


@pytest.fixture
def http():
    """A server over streamable HTTP; yields its address, and a function that kills and restarts it."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    call = [sys.executable, "-m", "worldwright.cli", "serve", "stage", "--transport", "http", "--port", str(port)]
    running: list[subprocess.Popen] = []

    def begin() -> None:
        for server in running:
            server.send_signal(signal.SIGKILL)
            server.wait()
        running[:] = [subprocess.Popen(call, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)]
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            with socket.socket() as knock:
                if knock.connect_ex(("127.0.0.1", port)) == 0:
                    return
            time.sleep(0.05)
        raise AssertionError("the server did not start")

    begin()
    yield f"http://127.0.0.1:{port}/mcp", begin
    for server in running:
        server.kill()
        server.wait()


def facts(result) -> dict:
    assert not result.is_error, result.content
    return result.structured_content


def test_http_lists_and_runs_and_tells_its_progress(http, make):
    address, _ = http
    run = make(SLOW.replace("NAME", "one").replace("SECONDS", "400.0"))
    told = []

    async def hear(done: float, total: float | None, message: str | None) -> None:
        told.append((done, total, message))

    async def talk():
        async with mcp.Client(address) as client:
            names = {tool.name for tool in (await client.list_tools()).tools}
            job = facts(await client.call_tool("start", {"run": str(run.folder)}))
            arguments = {"run": str(run.folder), "job": job["job"], "timeout_s": 40}
            ended = facts(await client.call_tool("wait", arguments, progress_callback=hear))
            wrong = await client.call_tool("status", {"run": "no-such-run"})
            return names, ended, wrong

    names, ended, wrong = anyio.run(talk)
    campaigns = {f"campaign_{verb}" for verb in ("start", "wait", "status", "cancel", "results")}
    own = {"draft", "start", "wait", "status", "cancel", "look", "frames", "sheet", "log"}
    assert names == own | campaigns | {"rehearse"}
    assert ended["state"] == "succeeded"
    assert wrong.is_error
    assert json.loads(wrong.content[0].text)["next"]
    assert len(told) > 1, "how often it tells depends on the machine's speed; that it goes on telling does not"
    assert [done for done, _, _ in told] == sorted(done for done, _, _ in told)
    assert any("left" in message for _, _, message in told)


def test_a_server_killed_and_restarted_goes_on_with_the_same_job(http, make):
    address, restart = http
    run = make(SLOW.replace("NAME", "one").replace("SECONDS", "200.0"))

    async def begin():
        async with mcp.Client(address) as client:
            return facts(await client.call_tool("start", {"run": str(run.folder)}))

    async def end(job):
        async with mcp.Client(address) as client:
            same = facts(await client.call_tool("start", {"run": str(run.folder)}))
            arguments = {"run": str(run.folder), "job": job["job"], "timeout_s": 40}
            return same, facts(await client.call_tool("wait", arguments))

    job = anyio.run(begin)
    restart()
    same, ended = anyio.run(end, job)
    assert same["job"] == ended["job"] == job["job"]
    assert ended["state"] == "succeeded"


@pytest.mark.parametrize("transport", ["stdio", "http"])
def test_a_cancelled_call_kills_neither_the_job_nor_the_server(transport, http, make):
    run = make(SLOW.replace("NAME", "one").replace("SECONDS", "200.0"))

    async def talk():
        async with mcp.Client(http[0] if transport == "http" else STDIO) as client:
            job = facts(await client.call_tool("start", {"run": str(run.folder)}))
            arguments = {"run": str(run.folder), "job": job["job"], "timeout_s": 30}
            with anyio.move_on_after(0.6) as impatient:
                await client.call_tool("wait", arguments)
            assert impatient.cancelled_caught
            now = facts(await client.call_tool("status", {"run": str(run.folder)}))
            return now, facts(await client.call_tool("wait", arguments))

    now, ended = anyio.run(talk)
    assert now["jobs"][0]["state"] in ("queued", "running")
    assert ended["state"] == "succeeded"


def test_several_runs_at_once_do_not_mix(make, evidence):
    runs = [make(SLOW.replace("NAME", f"world-{n}").replace("SECONDS", "2.0"), f"world-{n}") for n in range(4)]

    async def one(client, run, jobs):
        job = facts(await client.call_tool("start", {"run": str(run.folder)}))
        arguments = {"run": str(run.folder), "job": job["job"], "timeout_s": 30}
        jobs[run.name] = facts(await client.call_tool("wait", arguments))

    async def talk():
        jobs: dict[str, dict] = {}
        async with mcp.Client(STDIO) as client, anyio.create_task_group() as group:
            for run in runs:
                group.start_soon(one, client, run, jobs)
        return jobs

    jobs = anyio.run(talk)
    for run in runs:
        assert jobs[run.name]["state"] == "succeeded"
        meta = json.loads((evidence(run) / "physics/trajectory/meta.json").read_text())
        assert [body["name"] for body in meta["bodies"]] == [run.name]


def test_two_who_ask_at_once_get_one_job(make):
    run = make(SLOW.replace("NAME", "one").replace("SECONDS", "200.0"))
    code = f"from worldwright.stage.tools import start; print(start({str(run.folder)!r}).job)"
    both = [subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) for _ in range(3)]
    assert len({asker.communicate()[0] for asker in both}) == 1
    (next(run.jobs.iterdir()) / "cancel").touch()
