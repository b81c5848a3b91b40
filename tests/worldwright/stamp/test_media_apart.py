"""Where a law is asked again in another environment, its points are held against those recorded, as bodies are."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pytest

from worldengine.recording.columns import TABLES, arrow_schema
from worldwright.stamp import law_check, media_apart


def told(folder: Path, places: np.ndarray, step: int = 5, colours: int | np.ndarray = -1) -> Path:
    """A recording of one law's points (instants, points, 3), and their colours."""
    folder.mkdir()
    schema, (count, points, _) = arrow_schema(TABLES["media"]), places.shape
    steps, point = np.repeat(np.arange(count) * step, points), np.tile(np.arange(points), count)
    flat = pa.FixedSizeListArray.from_arrays(pa.array(places.astype(np.float32).ravel()), type=schema.field(3).type)
    columns = [*(pa.array(c, pa.int32()) for c in (steps, 0 * steps, point)), flat]
    columns.append(pa.array(np.broadcast_to(colours, steps.shape), pa.int32()))
    with pa.ipc.new_stream(str(folder / "media.arrows"), schema) as stream:
        stream.write_batch(pa.RecordBatch.from_arrays(columns, schema=schema))
    return folder


PLACES = np.cumsum(np.full((6, 2, 3), 0.1), axis=0)
"""The first instant at 0.1 m on each axis; then 0.17 m from each to the next."""


@pytest.mark.parametrize(
    ("instant", "off", "why"),
    [
        (5, 0.009, ""),
        (5, 0.02, "point 1 of law 0 is 2.00e-02 m off at step 25"),
        (0, 0.009, "at step 0"),
        (3, np.nan, "nan"),
    ],
)
def test_a_point_may_stray_as_far_as_a_body_may(tmp_path: Path, instant: int, off: float, why: str) -> None:
    other = PLACES.copy()
    other[instant, 1, 2] += off
    said = media_apart.apart(told(tmp_path / "one", PLACES), told(tmp_path / "other", other))
    assert why in said and bool(said) == bool(why)


def test_points_that_are_written_to_tremble_earn_nothing_by_it(tmp_path: Path) -> None:
    rests, trembles = np.zeros((200, 1, 3)), np.zeros((200, 1, 3))
    trembles[::2, 0, 0], trembles[-1, 0, 0] = 9e-4, 2.5e-3
    for recorded, asked in ((trembles, rests), (rests, trembles)):
        folder = tmp_path / f"{asked.any()}"
        folder.mkdir()
        assert "2.50e-03 m off at step 995" in media_apart.apart(
            told(folder / "one", recorded), told(folder / "other", asked)
        )


def test_a_colour_may_be_a_little_off_and_no_more(tmp_path: Path) -> None:
    grey, near, other = (
        told(tmp_path / name, PLACES, colours=colour)
        for name, colour in (("grey", 0x808080), ("near", 0x82807E), ("other", 0x808095))
    )
    assert media_apart.apart(grey, near) == ""
    assert "21 of 255 off in colour at step 0" in media_apart.apart(grey, other)
    assert "off in colour" in media_apart.apart(grey, told(tmp_path / "none", PLACES))


def test_points_at_other_steps_are_not_alike_and_no_points_are(tmp_path: Path) -> None:
    one, none = told(tmp_path / "one", PLACES), tmp_path / "none"
    none.mkdir()
    assert "other steps" in media_apart.apart(one, told(tmp_path / "other", PLACES, step=4))
    assert "0 places" in media_apart.apart(one, none) and media_apart.apart(none, none) == ""


def test_a_claimed_other_environment_excuses_no_medium_that_goes_elsewhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folders = told(tmp_path / "one", PLACES), told(tmp_path / "other", PLACES + 0.3)
    one, other = (SimpleNamespace(recording=f, inputs_sha256=f.name, rebuilt="the same") for f in folders)
    alike = SimpleNamespace(within=True, message="bodies as stamped")
    monkeypatch.setattr(law_check.digest, "motion", lambda _: None)
    monkeypatch.setattr(law_check.digest, "compare", lambda *_: alike)
    monkeypatch.setattr(law_check.measured_again, "checks", lambda *_, **__: [])
    check = law_check.compared(tmp_path, None, one, other, ["another processor"]).check
    assert not check.ok and check.open and "of law 0" in check.detail
