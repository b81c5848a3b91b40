"""A stamped film has the frames that it says and the recording has, each at its time; otherwise nobody looks at one."""

from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace

import av
import numpy as np
import pytest

from worldengine.recording import stored
from worldwright.stamp import redrawn


@pytest.fixture
def proved(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SimpleNamespace:
    """A recording of two seconds, of which 12 frames a second are drawn."""
    (tmp_path / "program.json").write_text('{"fps": 12}')
    monkeypatch.setattr(stored, "open", lambda _: SimpleNamespace(time=np.linspace(0.0, 2.0, 201)))
    return SimpleNamespace(recording=tmp_path / "trajectory", run=None)


def film(path: Path, times: list[int], rate: int = 12) -> Path:
    """A film with frames at some times, in frames of its rate."""
    with av.open(str(path), "w", format="mp4") as out:
        stream = out.add_stream("libx264", rate=rate)
        stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
        stream.codec_context.time_base = Fraction(1, rate)
        for time in times:
            frame = av.VideoFrame.from_ndarray(np.full((48, 64, 3), 8 * time % 256, np.uint8), format="rgb24")
            frame.pts, frame.time_base = time, Fraction(1, rate)
            out.mux(stream.encode(frame))
        out.mux(stream.encode())
    return path


@pytest.mark.parametrize(
    ("times", "rate", "cause"),
    [
        (range(24), 12, ""),
        (range(12), 6, ""),
        (range(1), 12, "says 1 frames, and the recording has 24"),
        (range(48), 12, "says 48 frames"),
        (range(24), 24, "24 frames a second, the program asks for 12"),
        ([0, *range(25, 48)], 12, "not as it was drawn"),
    ],
)
def test_a_film_has_as_many_frames_as_the_recording(
    proved: SimpleNamespace, tmp_path: Path, times: list[int], rate: int, cause: str
) -> None:
    found = list(redrawn._film(film(tmp_path / "side.mp4", list(times), rate), proved))
    said = [one for one in found if isinstance(one, str)]
    assert (not said) == (not cause) and all(cause in one for one in said), said
    shown = [one for one in found if isinstance(one, redrawn.Shown)]
    assert bool(shown) != bool(said) and all(one.size == (64, 48) for one in shown)


def test_what_is_no_mp4_is_named_and_nothing_of_it_is_drawn(proved: SimpleNamespace, tmp_path: Path) -> None:
    path = tmp_path / "side.mp4"
    path.write_text("ffconcat version 1.0\nfile outside.mp4\n")
    (said,) = map(str, redrawn._film(path, proved))
    assert "no film side.mp4" in said and "first bytes" in said
