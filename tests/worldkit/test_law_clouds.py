"""A film shows the points of a law as a cloud: it says how a puff looks by its age, and nothing of where it is."""

import numpy as np
import pytest

from shown_laws import STILL
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, still


def film() -> Film:
    found = Film(Recorded(STILL))
    found.shot(still((0, -3, 1), (0, 0, 1)), until=4.0)
    return found


@pytest.mark.parametrize("of", ["steam", "vapour"])
def test_a_puff_grows_and_fades_by_its_age_alone(of: str) -> None:
    told = film()
    told.cloud("steam", of=of, diameter=(0.1, 0.3), opacity=0.5, life=2.0)
    facts, arrays = told.description()
    (one,) = facts["clouds"]
    ages, wide, opaque = arrays[one["ages"]]
    assert one["of"] == "vapour" and "puffs" not in facts
    assert (ages[0], ages[-1]) == (0.0, 4.0) and (np.diff(wide) >= 0).all()
    assert (wide[0], wide[-1]) == pytest.approx((0.1, 0.3))
    assert 0.4 < opaque.max() <= 0.5 and (opaque[ages >= 2.0] == 0).all() and (np.diff(opaque[ages > 0.1]) <= 0).all()


def test_functions_of_age_say_both_otherwise() -> None:
    told = film()
    told.cloud("fog", of="steam", diameter=lambda age: 0.2 + age, opacity=lambda age: 0.1)
    _, arrays = told.description()
    assert arrays["cloud0"][1, -1] == pytest.approx(4.2) and (arrays["cloud0"][2] == np.float32(0.1)).all()


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"of": "kettle"}, "name one of: steam"),
        ({"of": "soak"}, "no law that a body of balls shows"),
        ({"of": "steam", "diameter": (0.0, 0.1)}, "diameters"),
        ({"of": "steam", "opacity": 1.5}, "hides 1.5"),
        ({"of": "steam", "life": 0.0}, "life above 0"),
        ({"of": "steam", "opacity": lambda age: 2.0 + age}, "none of 0 to 1, at some age"),
    ],
)
def test_what_no_cloud_is_is_refused(given, says: str) -> None:
    told = film()

    def tell() -> None:
        told.cloud("steam", **given)
        told.description()

    with pytest.raises(ProgramError, match=says):
        tell()


def test_one_law_is_one_cloud() -> None:
    told = film()
    told.cloud("steam", of="steam")
    with pytest.raises(ProgramError, match="is another's"):
        told.cloud("more steam", of="vapour")


@pytest.mark.parametrize("of", ["steam", "vapour", ["vap*"]])
def test_a_surface_is_of_a_law_as_a_cloud_is(of) -> None:
    told = film()
    told.surface("paint", of=of)
    assert told.description()[0]["surfaces"][0]["of"] == ["vapour"]
