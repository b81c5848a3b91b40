"""What a judge is shown: frames from the first to the last, on a sheet or alone, or the film without its tags."""

import io

import av
import cv2
import numpy as np
import pytest

from worldwright.judge.exhibit import ExhibitError, exhibit


def brightness(data):
    return float(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR).mean())


def test_frames_are_spread_from_the_first_to_the_last(film):
    found = exhibit(film(frames=13), "frames", 4)
    levels = [brightness(piece.data) for piece in found.pieces]
    assert levels == pytest.approx([20, 20 + 200 * 4 / 12, 20 + 200 * 8 / 12, 220], abs=6)
    assert found.frames == 4 and "4 pictures" in found.told and {p.media_type for p in found.pieces} == {"image/jpeg"}


def test_a_sheet_is_one_picture_of_them_all(film):
    found = exhibit(film(frames=13), "sheet", 8)
    (piece,) = found.pieces
    sheet = cv2.imdecode(np.frombuffer(piece.data, np.uint8), cv2.IMREAD_COLOR)
    assert sheet.shape[:2] == (2 * 48 + 3 * 4, 4 * 64 + 5 * 4) and "8 numbered pictures" in found.told
    assert exhibit(film(frames=13), "sheet", 8).sha256 == found.sha256 != exhibit(film(frames=12), "sheet", 8).sha256


def test_a_short_film_is_shown_whole_and_a_wide_one_narrower(film):
    assert exhibit(film(frames=3), "frames", 8).frames == 3
    wide = exhibit(film(frames=2, size=(1024, 512)), "frames", 2).pieces[0].data
    assert cv2.imdecode(np.frombuffer(wide, np.uint8), cv2.IMREAD_COLOR).shape == (256, 512, 3)


def test_a_film_goes_out_without_its_tags(film, tmp_path):
    plain, tagged = film(), tmp_path / "tagged.mp4"
    with av.open(str(plain)) as source, av.open(str(tagged), "w") as target:
        target.metadata["title"] = "the plan says it bounces"
        stream = target.add_stream_from_template(source.streams.video[0])
        for packet in source.demux(video=0):
            if packet.dts is not None:
                packet.stream = stream
                target.mux(packet)
    assert b"the plan says" in tagged.read_bytes()
    found = exhibit(tagged, "film")
    (piece,) = found.pieces
    assert b"the plan says" not in piece.data and piece.media_type == "video/mp4" and found.frames == 12
    with av.open(io.BytesIO(piece.data)) as container:
        assert len(list(container.decode(video=0))) == 12


@pytest.mark.parametrize("form", ["frames", "sheet", "film"])
def test_what_is_no_film_is_named(film, tmp_path, form):
    good = film().read_bytes()
    for name, content, code in (
        ("text.mp4", b"no film", "no_film"),
        ("empty.mp4", b"", "no_film"),
        ("cut.mp4", good[: len(good) // 3], "no_film"),
        ("short.mp4", good[:-40], "no_film"),
        ("one.mp4", film("one", frames=1).read_bytes(), "too_short"),
    ):
        path = tmp_path / name
        path.write_bytes(content)
        with pytest.raises(ExhibitError) as raised:
            exhibit(path, form)
        assert raised.value.code == code and raised.value.place == str(path)
    with pytest.raises(ExhibitError):
        exhibit(tmp_path / "none.mp4", form)
    if form != "film":
        with pytest.raises(ExhibitError, match="65 frames"):
            exhibit(film(), form, 65)
