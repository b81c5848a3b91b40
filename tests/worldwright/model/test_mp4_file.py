"""A film is opened as MP4 or not at all, from its own bytes alone."""

from pathlib import Path

import av
import numpy as np
import pytest

from worldwright.model import mp4_file
from worldwright.model.mp4_file import NoFilmError


def drawn(path: Path, kind: str = "mp4", streams: int = 1) -> Path:
    """A film of four frames, in some container whatever its name."""
    with av.open(str(path), "w", format=kind) as film:
        made = [film.add_stream("libx264", rate=12) for _ in range(streams)]
        for stream in made:
            stream.width, stream.height, stream.pix_fmt = 64, 48, "yuv420p"
        for stream in made:
            for _ in range(4):
                film.mux(stream.encode(av.VideoFrame.from_ndarray(np.zeros((48, 64, 3), np.uint8), format="rgb24")))
            film.mux(stream.encode())
    return path


def test_a_film_of_ours_is_opened(tmp_path: Path) -> None:
    with mp4_file.opened(drawn(tmp_path / "side.mp4")) as film:
        assert len(list(film.decode(video=0))) == film.streams.video[0].frames == 4


@pytest.mark.parametrize("kind", ["matroska", "mpegts", "avi", "list", "link", "two", "nothing"])
def test_what_only_calls_itself_a_film_is_refused(tmp_path: Path, kind: str) -> None:
    path, honest = tmp_path / "side.mp4", drawn(tmp_path / "outside.mp4")
    if kind == "list":
        path.write_text("ffconcat version 1.0\nfile outside.mp4\n")
    elif kind == "link":
        path.symlink_to(honest)
    elif kind == "two":
        drawn(path, streams=2)
    elif kind != "nothing":
        drawn(path, kind)
    with pytest.raises(NoFilmError, match=r"no film side\.mp4") as refused, mp4_file.opened(path):
        pass
    assert refused.value.place == str(path) and refused.value.next_move
