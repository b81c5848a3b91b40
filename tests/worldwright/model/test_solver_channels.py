"""What solvers recorded of themselves is found by name and body, and asked in vain with what would do."""

from types import SimpleNamespace

import numpy as np
import pytest

from worldwright.model.errors import NotFoundError, RecordingError
from worldwright.model.recording.solver_channels import SolverChannels

ROW = {"kind": "solver", "bodies": ["cup", "tea"], "solver": {"name": "heat", "constants": {"warm": [290, 350]}}}
TOLD = {"temperature": np.array([[290.0, 350.0], [291.0, 349.0]]), "lost": np.array([0.0, 5.0])}


def recording(*rows: object) -> SimpleNamespace:
    columns = [{"name": "heat.temperature", "unit": "K"}, {"name": "heat.lost", "unit": "J"}]
    meta = {"solvers": list(rows), "columns": {"state": columns}}
    return SimpleNamespace(meta=meta, folder="run", channels=lambda name: TOLD)


def test_a_channel_of_each_body_is_found_by_its_name() -> None:
    found = SolverChannels.of(recording(ROW))
    values, unit = found.one("heat.temperature", "tea")
    assert values.tolist() == [350.0, 349.0] and unit == "K"
    assert found.one("heat.lost", None)[1] == "J"
    assert found.before(1).one("heat.temperature", "cup")[0].tolist() == [290.0]


@pytest.mark.parametrize(
    ("name", "body", "said"),
    [
        ("heat.warmth", None, "heat.temperature, heat.lost"),
        ("heat.temperature", None, "cup, tea"),
        ("heat.temperature", "jug", "cup, tea"),
        ("heat.lost", "tea", "leave `body` out"),
    ],
)
def test_what_is_not_there_is_answered_by_what_is(name: str, body: str | None, said: str) -> None:
    with pytest.raises(NotFoundError) as refused:
        SolverChannels.of(recording(ROW)).one(name, body)
    assert said in refused.value.next_move


def test_a_recording_whose_solvers_make_no_sense_is_damaged() -> None:
    with pytest.raises(RecordingError, match="makes no sense"):
        SolverChannels.of(recording({"bodies": ["tea"]}))
    assert SolverChannels.of(recording()).values == {}
