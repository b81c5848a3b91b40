"""The ledger of a real recording against what a plan declares."""

from pathlib import Path

import mujoco
import pytest

from small_worlds import ball, empty, record
from worldwright.model.errors import RecordingError
from worldwright.model.plan.committed import Intervention
from worldwright.stamp.interventions import acted, declaration

WIND = Intervention(kind="force", bodies=("kite",), law="0.5 N along +x", source="the plan")
FOAM = Intervention(kind="solver", bodies=("kite",), law="foam", source="the plan")


@pytest.fixture(scope="module")
def pushed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A recording of a body that its program pushes for half of the time."""
    spec = empty(gravity=0.0)
    ball(spec, "kite", (0, 0, 1), mass=1.0)

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        data.xfrc_applied[1, 0] = 0.5 if data.time < 0.05 else 0.0

    folder = tmp_path_factory.mktemp("pushed") / "trajectory"
    record(spec, folder, 50, control)
    return folder


def test_an_undeclared_push_is_named_with_its_body_time_and_work(pushed: Path) -> None:
    (entry,) = acted(pushed, ())
    assert (entry.kind, entry.target, entry.declared) == ("force", "kite", False)
    assert entry.first_s == 0.0
    assert 0.04 < entry.last_s < 0.06
    assert entry.work_j > 0
    assert "force on kite" in str(entry)


def test_a_declared_push_carries_its_law(pushed: Path) -> None:
    (entry,) = acted(pushed, (WIND,))
    assert (entry.declared, entry.law) == (True, "0.5 N along +x")


@pytest.mark.parametrize(
    ("kind", "target", "rows", "expected"),
    [
        ("force", "kite", (WIND,), WIND),
        ("force", "kite/tail", (WIND,), WIND),
        ("force", "kite.pos[2]", (WIND,), WIND),
        ("torque", "kite", (WIND,), None),
        ("force", "kite2", (WIND,), None),
        ("parameter", "kite", (FOAM,), None),
        ("force", "kite", (FOAM,), FOAM),
        ("force", "kite", (), None),
    ],
)
def test_kind_and_body_must_both_match(
    kind: str, target: str, rows: tuple[Intervention, ...], expected: Intervention | None
) -> None:
    assert declaration(kind, target, rows) == expected


def test_a_recording_that_is_none_is_a_typed_error(tmp_path: Path) -> None:
    with pytest.raises(RecordingError):
        acted(tmp_path / "nothing", ())
