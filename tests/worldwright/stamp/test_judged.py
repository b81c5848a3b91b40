"""What is published is what the gates judged: evidence that changes in between is refused, or left out if it is new."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence.run import Run
from worldwright.stamp import gates, judged
from worldwright.stamp.state import State


@pytest.fixture
def state(reviewed: Path, copy: Callable[[Path], Path]) -> State:
    return State(Run(copy(reviewed)))


@pytest.mark.parametrize("name", ["evidence/visual.json", "stills/overview.png", "video/side.mp4"])
def test_evidence_that_changed_after_the_gates_is_not_published(state: State, name: str) -> None:
    shown = judged.take(state)
    assert gates.refusals("accept", state) == []
    shown.still(state)
    assert shown.content(state, name)
    shown.files[name].write_bytes(shown.files[name].read_bytes() + b" ")
    with pytest.raises(GateError, match=rf"{shown.files[name].name} changed while the run was being accepted"):
        shown.content(state, name)


def test_what_was_another_while_the_gates_looked_is_not_published(state: State) -> None:
    """The file is what it was before and after; in between the gates read another one."""
    shown = judged.take(state)
    path = shown.files["evidence/visual.json"]
    mine = path.read_bytes()
    path.write_bytes(mine + b" ")
    assert state.visual.value
    path.write_bytes(mine)
    with pytest.raises(GateError, match=r"visual.json changed while"):
        shown.still(state)


def test_a_report_that_appears_after_the_gates_is_left_out(state: State) -> None:
    shown = judged.take(state)
    (state.folder / "robust.json").write_text("{}")
    assert "evidence/robust.json" in dict(judged.published(state))
    assert "evidence/robust.json" not in shown.files


def test_the_journal_may_go_on_and_may_not_be_another(state: State) -> None:
    shown = judged.take(state)
    head = shown.journal.head()
    state.run.log("scan", "robust", key=state.key.key if state.key else "")
    shown.still(state)
    assert shown.journal.head() == head
    lines = state.run.journal.read_text().splitlines(keepends=True)
    state.run.journal.write_text("".join(lines[1:]))
    with pytest.raises(GateError, match=r"journal.jsonl changed while"):
        shown.still(state)
