"""What a recording says of an author's laws is read in one place, and refused where it makes no sense."""

from types import SimpleNamespace

import pytest

from worldwright.model.errors import RecordingError
from worldwright.model.recording import laws_told, trajectory_files
from worldwright.model.recording.mechanics import Mechanics, _only_drawn

LAW = {"kind": "solver", "bodies": ["weight"], "law": {"name": "rubber", "shown_by": "cord"}}


def test_the_laws_of_a_recording_are_told() -> None:
    (law,) = laws_told.of({"laws": [LAW]})
    assert (law.name, law.bodies, law.shown_by) == ("rubber", ("weight",), "cord")
    assert laws_told.of({}) == laws_told.of({"laws": []}) == ()
    assert _only_drawn({"laws": [LAW], "flexes": [{"name": "cord"}]})


@pytest.mark.parametrize(
    "laws",
    [
        5,
        {"law": LAW},
        ["rubber"],
        [{}],
        [{**LAW, "law": "rubber"}],
        [{**LAW, "bodies": "weight"}],
        [{**LAW, "law": {}}],
    ],
)
def test_laws_that_make_no_sense_are_refused(laws: object) -> None:
    for read in (laws_told.of, _only_drawn):
        with pytest.raises(RecordingError, match=r"`laws` in the recording's meta.json makes no sense"):
            read({"laws": laws})


def test_points_without_gravity_are_refused() -> None:
    recording = SimpleNamespace(meta={"laws": [LAW]}, folder="out")
    with pytest.raises(RecordingError, match="no gravity that weighs its points"):
        trajectory_files._gravity(recording, Mechanics())
    recording.meta = {}
    assert not trajectory_files._gravity(recording, Mechanics()).any()
