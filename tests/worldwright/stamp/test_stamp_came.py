"""How a word came: what the receiver saw of its way stands in the journal, the stamp, the status and the report."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import anyio
import pytest

from worldwright import expose
from worldwright.contract import guard, harnesses
from worldwright.model.evidence import came
from worldwright.model.evidence.run import Run
from worldwright.report import write
from worldwright.stamp import by_measurement
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement

Copy = Callable[[Path], Path]
INSIDE = tuple(name for harness in harnesses.known().values() for name in harness.SHELL_SETS)


def last(folder: Path, action: str) -> str:
    return came.of([e for e in Run(folder).entries() if e["action"] == action][-1])


@pytest.fixture
def nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    """No harness opened this shell."""
    for name in INSIDE:
        monkeypatch.delenv(name, raising=False)


def test_code_that_calls_by_itself_is_automation(planned: Path, copy: Copy) -> None:
    folder = copy(planned)
    stamp.approve(str(folder), by="user")
    assert last(folder, "approve") == "automation"
    assert "in the name of user (automation)" in stamp.status(str(folder)).text()


def typed(folder: Path, terminal: bool, **environment: str) -> str:
    """What the journal says of an approval that was typed, with or without a terminal."""
    import pty

    words = [sys.executable, "-m", "worldwright.cli", "stamp", "approve", str(folder)]
    env = {k: v for k, v in os.environ.items() if k not in INSIDE} | environment
    if terminal:
        master, slave = pty.openpty()
        done = subprocess.run(words, stdin=slave, stdout=slave, stderr=slave, env=env, check=False)
        os.close(slave)
        os.close(master)
    else:
        done = subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, env=env, check=False)
    assert done.returncode == 0
    return last(folder, "approve")


def test_who_sits_at_a_terminal_is_not_known_unless_a_harness_opened_it(planned: Path, copy: Copy) -> None:
    """This test opens one itself, as any program can."""
    folder = copy(planned)
    assert typed(folder, True) == "confirmed at a terminal"
    assert "in the name of user (confirmed at a terminal)" in stamp.status(str(folder)).text()
    assert typed(folder, False) == "a command line without a terminal"
    assert typed(folder, True, CLAUDECODE="1") == "a command line without a terminal, inside Claude Code"


def test_a_harness_is_known_by_the_shell_above_whatever_a_program_takes_from_its_own_variables() -> None:
    """`env -u CLAUDECODE` in an agent's shell, which began with it, makes no terminal of a person's."""
    ask = "from worldwright.contract import harnesses; print(harnesses.around())"
    shell = ["sh", "-c", 'env -u CLAUDECODE "$0" -c "$1"; true', sys.executable, ask]
    clean = {name: value for name, value in os.environ.items() if name not in INSIDE}
    said = [
        subprocess.run(shell, env=clean | more, capture_output=True, text=True, check=True).stdout.strip()
        for more in ({"CLAUDECODE": "1"}, {})
    ]
    assert said == ["Claude Code", harnesses.around()]


def test_a_client_is_named_and_its_role_by_the_hooks_word(
    planned: Path, copy: Copy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from mcp.client import Client

    folder, spoken = copy(planned), tmp_path / "spoken"
    monkeypatch.setattr(came, "SPOKEN", spoken)

    async def call() -> None:
        async with Client(expose.build_server("stamp")) as client:
            await client.call_tool("approve", {"run": str(folder)})

    event = {"tool_name": "mcp__stamp__approve", "tool_input": {"run": str(folder)}, "agent_type": "world-plan"}
    guard._leave_word(event, spoken)
    anyio.run(call)
    assert last(folder, "approve").endswith("its hook says world-plan")
    assert list(spoken.iterdir()) == []  # a word counts once
    anyio.run(call)
    assert last(folder, "approve").endswith("no hook said which role")


def test_a_word_about_another_run_another_tool_or_an_older_call_does_not_count(tmp_path: Path) -> None:
    guard._leave_word({"tool_name": "stamp_describe", "tool_input": {"run": "ball"}, "agent_type": "a"}, tmp_path)
    guard._leave_word({"tool_name": "Write", "tool_input": {"run": "ball"}, "agent_type": "b"}, tmp_path)
    assert len(list(tmp_path.iterdir())) == 1
    assert came.by_client("x", "describe", {"run": "cube"}, tmp_path).role is None
    assert came.by_client("x", "review", {"run": "ball"}, tmp_path).role is None
    (path,) = tmp_path.iterdir()
    os.utime(path, (time.time() - 2 * came.FRESH_S,) * 2)
    assert came.by_client("x", "describe", {"run": "ball"}, tmp_path).role is None
    assert not path.exists()
    (tmp_path / "describe-1.json").write_text("[]")
    assert came.by_client("x", "describe", {"run": "ball"}, tmp_path).role is None


def test_a_client_without_a_name_is_said_to_have_none() -> None:
    assert expose._client(SimpleNamespace(session=SimpleNamespace(client_params=None))) == ""
    assert came.Came(how="client").text() == "an MCP client without a name, no hook said which role"
    assert came.of({"action": "approve"}) == ""


def test_the_stamp_and_the_report_say_how_and_what_nobody_looked_at(accepted: Path, copy: Copy) -> None:
    statement = Statement.model_validate_json((accepted / "accepted" / "stamp.json").read_bytes())
    predicate = statement.predicate
    assert (predicate.approval.by, predicate.approval.came) == ("tester", "automation")
    assert (predicate.described_by, predicate.description_came) == ("measured", "automation")
    assert predicate.review_came == "automation"
    assert statement.not_looked_at == (1,)
    assert "NOT LOOKED AT: objective 1" in stamp.status(str(accepted)).text()
    assert "NOT LOOKED AT" in stamp.accept(str(accepted)).text()
    page = write(Run(copy(accepted))).read_text()
    assert "1 not looked at" in page and "objective 1" in page
    assert "tester (automation)" in page


def test_a_description_made_by_looking_is_not_called_unseen(reviewed: Path, copy: Copy) -> None:
    folder = copy(reviewed)
    counted = by_measurement.describe(Run(folder))
    stamp.describe(str(folder), counted.model_copy(update={"author": "a person"}))
    assert "NOT LOOKED AT" not in stamp.status(str(folder)).text()
    assert json.loads(next(folder.glob("evidence/*/visual.json")).read_text())["author"] == "a person"
