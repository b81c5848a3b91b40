"""Storyboards: what they show, that it is there, and that it is of the recording."""

import shutil
from types import SimpleNamespace

import cv2
import numpy as np
import pytest

from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.evidence.run import Run
from worldwright.scan.tools import moments as claimed
from worldwright.stage.moments import Moments, of_recording, storyboard
from worldwright.stage.tools import frames, start, start_storyboard, wait

FOUND = Moments(setup=0.0, event=1.0, aftermath=3.0, end=4.0, source="recording")


def test_with_no_claims_it_shows_the_event_and_the_middle_of_the_ways_to_and_from_it():
    shown = [(0.0, "setup"), (0.5, ""), (1.0, "event"), (2.0, ""), (3.0, "aftermath")]
    assert storyboard(FOUND, ()) == shown


def test_claimed_moments_come_first_and_those_far_from_what_is_shown_before_others():
    shown = storyboard(FOUND, [(0.99, "touches"), (0.3, "leaves"), (2.5, "comes to rest"), (0.35, "falls")])
    assert [word for _, word in shown] == ["setup", "falls", "event", "comes to rest", "aftermath"]


def test_a_claim_that_is_the_event_leaves_room_for_the_ways():
    assert [at for at, _ in storyboard(FOUND, [(1.01, "touches")])] == [0.0, 0.5, 1.0, 2.0, 3.0]


def test_what_never_calms_down_ends_and_what_does_not_move_at_all_is_shown_once_or_twice():
    assert storyboard(Moments(0.0, 1.0, 4.0, 4.0, "recording"), ())[-1] == (4.0, "end")
    assert storyboard(Moments(0.0, 0.0, 0.0, 0.0, "recording"), ()) == [(0.0, "event")]


@pytest.fixture(scope="module")
def boarded(reviewed, tmp_path_factory):
    """A run with a storyboard, and its folder."""
    folder = tmp_path_factory.mktemp("boarded") / reviewed.name
    shutil.copytree(reviewed, folder)
    job = start_storyboard(Run(folder), claimed(Run(folder)))
    job = wait(str(folder), job=job.job, timeout_s=40)
    assert job.state == "succeeded", job.text()
    return folder, Run(folder).folder / job.result


@pytest.mark.gl
def test_a_sheet_a_camera_shows_the_ball_where_it_was(boarded):
    _, board = boarded
    sheets = {path.stem: cv2.imread(str(path)) for path in board.glob("*.jpg")}
    assert set(sheets) == {"overview", "side"}
    height = 480 * 90 // 160
    page = sheets["side"]
    assert page.shape == (2 * (height + 4) + 4, 3 * 484 + 4, 3)
    cells = [page[4 + r * (height + 4) :, 4 + c * 484 :][:height, :480] for r, c in ((0, 0), (0, 1), (0, 2), (1, 0))]
    heights = []
    for cell in cells:  # the ball is red: its pixels' middle sinks from the setup to the blow
        blue, green, red = (cell[40:, :, i].astype(int) for i in range(3))
        rows, _ = np.nonzero(red - np.maximum(blue, green) > 40)
        assert len(rows) > 20
        heights.append(rows.mean())
    assert heights[0] < heights[1] < max(heights[2:]) and np.ptp(heights) > 30


@pytest.mark.gl
def test_it_is_shown_by_frames_and_never_made_twice(boarded):
    folder, _ = boarded
    both = frames(str(folder), show="storyboard")
    assert both.data.cameras == ("overview", "side")
    assert all(picture.data.startswith(b"\xff\xd8") for picture in both.pictures)
    assert frames(str(folder), camera="side", show="storyboard").data.cameras == ("side",)
    assert start(str(folder), stage="storyboard").cached
    with pytest.raises(NotFoundError, match="cameras: overview, side"):
        frames(str(folder), camera="rear", show="storyboard")


def test_there_is_none_before_the_physics(planned):
    with pytest.raises(GateError, match="physics"):
        start(str(planned), stage="storyboard")
    with pytest.raises(NotFoundError, match="run the storyboard pass"):
        frames(str(planned), show="storyboard")


class Sums(SimpleNamespace):
    """The sums of a law, every tenth of a second."""

    def __len__(self):
        return len(self.step)


@pytest.mark.parametrize("runs", [True, False])
def test_what_still_flows_has_not_calmed_down(runs, monkeypatch, tmp_path):
    """A spoon is turned for 0.2 s and stands soon; from 0.5 s on the honey of a law runs, and at 1.5 s it lies."""
    from worldengine.recording import stored

    t = np.linspace(0.0, 3.0, 301)
    turning = np.exp(-20 * np.maximum(t - 0.2, 0.0))
    step = np.arange(0, 301, 10)
    motion = np.where((step > 50) & (step < 150), 5.0 * runs, 0.0)
    sums = Sums(step=step, medium=0 * step, energy=7.0 + motion, weight=6.0 + 0.0 * step, stored=1.0 + 0.0 * step)
    recording = SimpleNamespace(
        time=t, time_step=0.01, meta={"bodies": [{"mass": 1.0}]}, comvel=turning[:, None, None] * [[[1.0, 0.0, 0.0]]],
        energy=np.stack([0 * t, turning], axis=1), balances=sums,
    )  # fmt: skip
    monkeypatch.setattr(stored, "open", lambda folder: recording)
    found = of_recording(tmp_path)
    assert found.event < 0.3 and found.aftermath == pytest.approx(1.5 if runs else 0.35, abs=0.15)
