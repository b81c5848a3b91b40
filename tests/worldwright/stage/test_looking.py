"""Looking at a recording: any moment, any camera, small pictures, and an instrument's reading beside each."""

import cv2
import numpy as np
import pytest

from worldwright.model.errors import GateError, JobError, NotFoundError
from worldwright.stage.tools import look

pytestmark = pytest.mark.gl


def decoded(picture):
    return cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_COLOR)


def test_without_arguments_it_is_a_storyboard_of_every_camera(reviewed):
    found = look(str(reviewed))
    assert [p.caption for p in found.pictures] == ["overview: storyboard, row by row", "side: storyboard, row by row"]
    assert all(len(p.data) <= 100_000 and decoded(p).shape[1] <= 1300 for p in found.pictures)
    sides = [glance for glance in found.data.glances if glance.camera == "side"]
    assert len(sides) == len(found.data.glances) / 2 and sides[0].word == "setup"
    assert all(glance.reading.subjects["ball"] > 0 and 0.1 < glance.reading.luma < 0.9 for glance in sides)
    assert "ball" in found.data.text() and "luma" in found.data.text()


def test_a_moment_is_seen_from_where_no_camera_was_planned(reviewed):
    near = look(str(reviewed), at=0.0, eye="1.0,0,1", target="0,0,1", fov=60)
    away = look(str(reviewed), at=0.0, eye="1.0,0,1", target="2,0,1")
    assert near.data.glances[0].camera == "free" and near.data.renderer == "preview"
    assert near.data.glances[0].reading.subjects["ball"] > 0 == away.data.glances[0].reading.subjects["ball"]
    assert decoded(near.pictures[0]).shape[1] <= 1000 and near.pictures[0].format == "jpeg"


def test_without_a_film_of_its_own_the_houses_film_is_seen(reviewed):
    (glance,) = look(str(reviewed), at=0.1, camera="film").data.glances
    assert glance.camera == "film" and 0.05 < glance.reading.luma < 0.95


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ({"eye": "1,2,3"}, "needs the place where it stands and the one that it looks at"),
        ({"eye": "1,2,3", "target": "0,0,0", "camera": "side"}, "and no name"),
        ({"eye": "1,2", "target": "0,0,0"}, "'1,2' is no place"),
        ({"eye": "nan,0,0", "target": "0,0,0"}, "is no place"),
    ],
)
def test_a_place_that_is_none_is_refused(reviewed, words, said):
    with pytest.raises(NotFoundError, match=said):
        look(str(reviewed), at=0.0, **words)


def test_an_unknown_camera_is_answered_with_the_known_ones(reviewed):
    with pytest.raises(JobError, match="no camera above") as refused:
        look(str(reviewed), at=0.0, camera="above")
    assert "overview, side" in refused.value.next_move


def test_nothing_recorded_is_nothing_to_see(planned):
    with pytest.raises(GateError, match="no recording"):
        look(str(planned))


def test_a_moment_is_seen_in_the_light_of_the_final_pass(reviewed):
    pytest.importorskip("mitsuba")
    found = look(str(reviewed), at=0.1, camera="film", traced=True)
    assert found.data.renderer == "traced" and decoded(found.pictures[0]).shape[1] <= 640
    assert 0.05 < found.data.glances[0].reading.luma < 0.95
