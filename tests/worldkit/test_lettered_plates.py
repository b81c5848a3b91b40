"""Plates with words in the world: as wide as their words, upright, and turned to the camera."""

import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded


def film() -> Film:
    t = np.linspace(0.0, 1.0, 30)[:, None]
    return Film(Recorded.rehearsal({"ball": np.hstack([t, 0 * t, 0.1 + 0 * t])}, duration=1.0))


def test_a_plate_is_as_wide_as_its_words_and_faces_the_camera():
    one = film()
    one.label("I", (0.0, 0.0, 0.5), height=0.1, facing_deg=-90.0)
    one.label("POTENTIAL", (1.0, 0.0, 0.5), height=0.1, facing_deg=0.0)
    facts, arrays = one.description()
    plates = {thing["name"]: thing for thing in facts["things"]}
    assert list(plates) == ["I plate", "I", "POTENTIAL plate", "POTENTIAL"]
    wide = [plates[f"{name} plate"]["size"][0] for name in ("I", "POTENTIAL")]
    assert 0.1 < wide[0] < 0.2 < 0.3 < wide[1] < 0.8
    for name in ("I", "POTENTIAL"):
        points, corners = arrays[plates[name]["vertices"]], arrays[plates[name]["uv"]]
        high = points[:, 2] > 0
        assert (corners[high, 1] == 0).all() and (corners[~high, 1] == 1).all(), "row 0, the top, is at v = 0"
        assert points[:, 1].max() < -plates[f"{name} plate"]["size"][1] / 2, "before its plate, on the camera's side"
        picture = arrays[plates[name]["look"]["picture"]]
        assert 0.02 < (picture.mean(axis=2) > 128).mean() < 0.3
    assert plates["I"]["quat"] == pytest.approx((1, 0, 0, 0))
    assert plates["POTENTIAL"]["quat"] == pytest.approx((np.sqrt(0.5), 0, 0, np.sqrt(0.5)))


@pytest.mark.parametrize("words", [{"text": " "}, {"text": "x" * 41}, {"text": "a\nb"}, {"text": "a", "height": 0.0}])
def test_what_no_plate_can_say_is_refused(words):
    with pytest.raises(ProgramError, match="a label has"):
        film().label(**({"pos": (0, 0, 0)} | words))
