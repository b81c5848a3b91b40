"""What `frames` shows: contact sheets, and the moments that matter."""

import base64
import json

import numpy as np
import pytest

from worldwright.model.errors import NotFoundError
from worldwright.stage import moments, one_frame
from worldwright.stage.pictures import contact, sheet
from worldwright.stage.tools import frames


@pytest.fixture(scope="module")
def filmed(reviewed):
    """The evidence of a run with stills, films and a recording."""
    return next(path.parent for path in reviewed.glob("evidence/*/video"))


def test_key_frames_of_a_dropped_ball_show_its_fall_and_its_bounce(filmed):
    three = moments.of_recording(filmed / "physics/trajectory")
    # dropped from a height of 0.45 m: it hits the floor after sqrt(2 h / g)
    impact_s = (2 * 0.45 / 9.81) ** 0.5
    assert three.setup == 0
    assert three.event == pytest.approx(impact_s, abs=2 * moments.WINDOW_S)
    assert three.event < three.aftermath <= 0.5 + 1e-9


def test_everything_is_shown_with_its_time_and_fits_the_wire(filmed):
    shown = contact(filmed, None, 6)
    kinds = [
        word
        for caption in shown.data.captions
        for word in ("still", "sheet", "setup", "event", "aftermath", "midway", "end")
        if word in caption
    ]
    assert kinds[:2] == ["still", "sheet"] and {"midway", "event"} < set(kinds) and "setup" not in kinds
    assert len(kinds) == 2 * 5 and kinds[:5] == kinds[5:]
    assert sum(len(base64.b64encode(picture.data)) for picture in shown.pictures) < 1_000_000
    assert shown.data.moments["event"] > 0
    assert all(picture.data.startswith(b"\xff\xd8") for picture in shown.pictures)


def test_one_kind_and_one_camera(filmed, reviewed):
    assert len(frames(str(reviewed), camera="side", show="sheet", count=24).pictures) == 1
    assert len(frames(str(reviewed), show="key").pictures) == 8
    with pytest.raises(NotFoundError, match="rear"):
        frames(str(reviewed), camera="rear")


def test_a_stretch_of_a_film_and_a_single_frame_of_it(filmed, reviewed):
    sheet_of = frames(str(reviewed), camera="side", show="sheet", count=24, start_s=0.1, end_s=0.2).data.captions[0]
    times = [float(word) for word in sheet_of.rpartition(" at ")[2].removesuffix(" s").split(", ")]
    assert (
        2 <= len(times) <= 24 and times[0] == pytest.approx(0.1, abs=0.03) and times[-1] == pytest.approx(0.2, abs=0.03)
    )
    assert len(set(times)) == len(times)
    alone = frames(str(reviewed), camera="side", show="sheet", count=1, start_s=0.2)
    assert alone.data.captions == (f"side: at {times[-1]:.2f} s",)
    with pytest.raises(NotFoundError, match="before it begins"):
        frames(str(reviewed), start_s=0.2, end_s=0.1)


def test_what_never_calms_down_is_shown_midway():
    restless = moments._choose(np.arange(5.0), np.ones(5), np.array([0, 1.0, 0, 0]), "film")
    assert restless.aftermath == restless.end == 4 and list(restless.named()) == ["setup", "midway", "event", "end"]
    assert sorted(restless.named().values()) == list(restless.named().values())


def test_a_film_alone_still_has_its_moments(filmed):
    film = next((filmed / "video").glob("*.mp4"))
    three = moments.of_film(film)
    assert three.source == "film"
    assert 0 <= three.setup < three.event <= three.aftermath


def test_a_sheet_holds_every_frame():
    cells = [(i / 10, np.full((90, 160, 3), 20 * i, np.uint8)) for i in range(7)]
    page = sheet(cells)
    assert page.shape == (2 * 184 + 4, 4 * 324 + 4, 3)
    for index, (_, cell) in enumerate(cells):
        assert (page[4 + index // 4 * 184 + 150, 4 + index % 4 * 324 + 300] == cell[0, 0]).all()


def test_nothing_that_moves_gives_the_middle():
    t = np.linspace(0, 1, 25)
    three = moments._choose(t, np.zeros(25), np.zeros(24), "recording")
    assert (three.setup, three.event, three.aftermath) == (0, 0.5, 1)
    broken = moments._choose(t, np.full(25, np.nan), np.ones(24), "recording")
    assert broken.aftermath == 1


def test_the_reference_image_stands_beside_the_first_cameras_still(reviewed, copy):
    import cv2

    folder = copy(reviewed)
    with pytest.raises(NotFoundError, match=r"no reference\.png"):
        frames(str(folder), show="reference")
    cv2.imwrite(str(folder / "reference.jpg"), np.full((300, 400, 3), (0, 0, 255), np.uint8))
    shown = frames(str(folder), show="reference")
    (picture,) = shown.pictures
    assert "reference.jpg" in picture.caption and "overview" in picture.caption
    image = cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_COLOR)
    left = image[:, : image.shape[1] // 4].reshape(-1, 3).mean(axis=0)
    assert left[2] > 240 and left[:2].max() < 20  # the given image, red, on the left
    assert image[:, -20:].std() > 1  # and a picture of the world on the right
    with pytest.raises(NotFoundError, match=r"no nowhere\.png"):
        frames(str(folder), camera="nowhere", show="reference")


@pytest.mark.parametrize(
    ("size", "drawn"), [((1280, 720), (640, 360)), ((640, 480), (554, 416)), ((720, 1280), (360, 640))]
)
def test_a_moment_is_drawn_in_the_shape_of_its_film(tmp_path, size, drawn) -> None:
    (tmp_path / "program.json").write_text(json.dumps({"size": size}))
    assert one_frame._shaped(tmp_path) == drawn
    assert abs(drawn[0] / drawn[1] - size[0] / size[1]) < 0.01 * size[0] / size[1]
