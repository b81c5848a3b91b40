"""A film that shows next to nothing for a while says when; a fade at its ends, and usual developing, need no word."""

from worldengine.film import blanked
from worldengine.film.treatment import Treatments


def said(*rows: dict, frames: int = 120) -> list[str]:
    return blanked.told(Treatments([{"at_s": 0.0, "grade_fade": 0.0}, *rows]), frames, 24)


def test_what_is_blanked_in_the_middle_is_told():
    blink = [{"at_s": at, "grade_fade": share} for at, share in ((1.99, 0.0), (2.0, 1.0), (2.1, 1.0), (2.11, 0.0))]
    assert said(*blink) == ["picture faded out from 2 to 2.12 s of the film"]
    assert said({"at_s": 0.0, "grade_contrast": 0.0}) == ["picture without contrast from 0 to 5 s of the film"]
    dark = [
        {"at_s": at, "grade_exposure_stops": stops}
        for at, stops in ((0.99, 0.0), (1.0, -8.0), (1.99, -8.0), (2.0, 0.0))
    ]
    assert said(*dark) == ["picture under exposed from 1 to 2 s of the film"]


def test_fades_at_its_ends_are_usual_and_long_ones_are_told():
    opens = [{"at_s": 0.0, "grade_fade": 1.0}, {"at_s": 0.8, "grade_fade": 0.0}]
    ends = [{"at_s": 4.0, "grade_fade": 0.0}, {"at_s": 4.9, "grade_fade": 1.0}]
    assert said(*opens, *ends) == []
    assert said({"at_s": 2.0, "grade_fade": 1.0}) == ["picture faded out from 1.83 to 5 s of the film"]
    assert said({"at_s": 0.0, "grade_exposure_stops": 0.3, "grade_contrast": 1.1}) == []
    assert blanked.told(Treatments([]), 120, 24) == []
