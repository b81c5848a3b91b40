"""Every line that a client writes is answered, whatever it holds."""

import json
import subprocess
import sys

import pytest

from worldwright.wire import problem

HELLO = {
    "jsonrpc": "2.0", "id": 1, "method": "initialize",
    "params": {"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "x", "version": "1"}},
}  # fmt: skip


@pytest.mark.parametrize(
    ("line", "code", "said", "number"),
    [
        ("no json", -32700, "not JSON", None),
        ("[" * 100_000, -32700, "not JSON", None),
        ("[1, 2]", -32600, "an object, not a list", None),
        ('{"id": 7}', -32600, '`jsonrpc` must be "2.0"', 7),
        ('{"jsonrpc": "2.0", "id": [1], "method": "tools/list"}', -32600, "`id` is a text", None),
        ('{"jsonrpc": "2.0", "id": "a"}', -32600, "`method` is a text, not nothing", "a"),
        ('{"jsonrpc": "2.0", "id": 2, "method": "tools/list", "params": [1]}', -32602, "`params` is an object", 2),
        ('{"jsonrpc": "2.0", "id": 3, "method": "tools/call", "params": {"name": 5}}', -32602, "not a number", 3),
        ('{"jsonrpc": "2.0", "id": 4, "method": "tools/call"}', -32602, "`params.name`", 4),
        ('{"jsonrpc": "2.0", "id": 5, "method": "tools/call", "params": {"name": "a", "arguments": "b"}}', -32602, "`params.arguments` is an object, not a text", 5),
    ],
)  # fmt: skip
def test_what_is_no_message_is_said(line, code, said, number):
    found = problem(line)
    assert found is not None
    assert (found[0], found[2]) == (code, number)
    assert said in found[1]


@pytest.mark.parametrize(
    "message",
    [HELLO, {"jsonrpc": "2.0", "method": "notifications/initialized"}, {"jsonrpc": "2.0", "id": 1, "result": {}}],
)
def test_messages_pass(message):
    assert problem(json.dumps(message)) is None


def test_a_server_answers_every_line_and_goes_on():
    call = [sys.executable, "-c", "from worldwright.expose import serve; serve('retrieve')"]
    asked = {"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": [1]}
    last = {"jsonrpc": "2.0", "id": 3, "method": "tools/list"}
    lines = [json.dumps(HELLO), "what?", "", json.dumps(asked), json.dumps(last)]
    with subprocess.Popen(call, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdin and server.stdout
        server.stdin.write("\n".join(lines) + "\n")
        server.stdin.flush()
        answers = [json.loads(server.stdout.readline()) for _ in range(4)]
        server.stdin.close()
        assert server.wait(20) == 0
    by_id = {answer["id"]: answer for answer in answers}
    assert by_id[None]["error"]["code"] == -32700
    assert by_id[2]["error"]["code"] == -32602
    assert "tools" in by_id[3]["result"]
