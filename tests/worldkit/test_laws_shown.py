"""A film reads the points and sums of a law by name, between the instants at which they were recorded."""

import numpy as np
import pytest

from shown_laws import STILL
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, follow, lacking_motion, still
from worldkit.filming.laws_shown import Laws

LAWS = Laws(
    {
        "law_names": np.array(["balloon"]),
        "law0_time": np.array([0.0, 1.0]),
        "law0_points": np.array([[[0.0, 0.0, 0.0]], [[1.0, 0.0, 2.0]]]),
        "law0_at": np.array([0.0, 1.0]),
        **{f"law0_{name}": np.array([4.0, 2.0]) for name in ("mass", "energy", "stored", "volume")},
    }
)


def test_points_lie_between_where_they_were_recorded() -> None:
    assert LAWS.points("balloon", 0.5).tolist() == [[0.5, 0.0, 1.0]]
    assert LAWS.points("balloon", np.array([-1.0, 0.25, 9.0]))[:, 0, 2].tolist() == [0.0, 0.5, 2.0]
    assert LAWS.told("balloon", "volume", np.array([0.0, 0.5])).tolist() == [4.0, 3.0]


@pytest.mark.parametrize(("law", "what"), [("ballon", "volume"), ("balloon", "colour")])
def test_what_is_not_there_names_what_is(law: str, what: str) -> None:
    with pytest.raises(ProgramError, match=f"{law}|{what}"):
        LAWS.told(law, what, 0.0)


@pytest.mark.parametrize("name", ["soak", "sponge"])
def test_a_camera_focuses_on_what_shows_a_law_and_follows_it(name: str) -> None:
    told = Film(Recorded(STILL))
    told.shot(still((0.1, 0, 0), (0, 1, 0), focus=name, aperture=2), until=1.0)
    told.shot(follow(name, azimuth_deg=-90, elevation_deg=0), until=2.0)
    _, arrays = told.description()
    assert arrays["focus_m"][0] == pytest.approx(3.0)
    assert arrays["target"][-1] == pytest.approx([0.1, 3.0, 0.0]) and arrays["eye"][-1, 1] < 3.0


@pytest.mark.parametrize("name", ["steam", "vapour"])
def test_of_a_body_of_balls_that_shows_a_law_it_is_the_middle_of_the_points_and_not_where_the_body_stands(name) -> None:
    told = Film(Recorded(STILL))
    told.shot(follow(name), until=4.0)
    _, arrays = told.description()
    assert arrays["target"][-1] == pytest.approx([0.5, 0.0, 3.0], abs=0.1)
    assert told.recorded.radius("vapour") < 0.02 < told.recorded.reach(name) == pytest.approx(np.sqrt(5) / 2)


def test_a_camera_that_follows_points_which_wait_in_one_place_stands_before_them() -> None:
    """Before, it stood where it looked, and the film of a world that stands still was refused."""
    told = Film(Recorded(STILL | {"law0_points": np.zeros((2, 2, 3))}))
    told.shot(follow("steam", fill=0.25, lens_mm=50), until=4.0)
    _, arrays = told.description()
    assert np.linalg.norm(arrays["eye"], axis=1) == pytest.approx(np.full(len(arrays["eye"]), 0.395), abs=0.01)


def test_points_and_sums_are_known_by_what_shows_them_too() -> None:
    recorded = Recorded(STILL)
    assert (recorded.points("sponge", 1.0) == recorded.points("soak", 1.0)).all()
    assert recorded.told("sponge", "mass", 2.0) == 1.5
    assert recorded.position("sponge", 0.0).tolist() == pytest.approx([0.1, 3.0, 0.0])
    with pytest.raises(ProgramError, match="'sponge' is no body: it shows the points of a law"):
        recorded.origin("sponge", 0.0)
    with pytest.raises(ProgramError, match="no body is called 'spong'") as refused:
        recorded.position("spong", 0.0)
    assert "sponge" in refused.value.next_move


def test_a_world_that_is_stirred_keeps_the_names_of_its_laws() -> None:
    stirred = Recorded(lacking_motion.stirred(STILL))
    assert stirred.laws == ("steam", "soak") and stirred.grains == ("vapour",)
    assert stirred.points("sponge", 4.0).shape == (2, 3)


@pytest.mark.parametrize("name", ["steam", "vapour"])
def test_a_look_of_a_law_is_given_to_what_shows_it(name: str) -> None:
    told = Film(Recorded(STILL))
    told.look(name, "chrome")
    assert told.description()[0]["looks"] == {"vapour": "chrome"}
