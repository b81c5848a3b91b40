"""What sets a coordinate is told by the entries themselves, with the parameters that it takes."""

import pytest

from worldwright.place.setters import setters
from worldwright.place.vocabulary import CAMERA_FAMILY, PREDICATES, RELATIONS


@pytest.mark.parametrize(
    ("dof", "names", "not_names"),
    [
        (
            "x",
            ("FRONT-OF with `gap`", "ALIGN-CENTER-FB", "PLACE-ON with `offset`", "adjacent_*"),
            ("LEFT-OF", "HEIGHT"),
        ),
        (
            "y",
            ("LEFT-OF with `gap`", "PLACE-ON-BASE with `y`", "SYMMETRY-ALONG"),
            ("FRONT-OF", "flush_with_platform_top"),
        ),
        (
            "z",
            ("HEIGHT with `bottom` or `center` or `top`", "PLACE-ON", "flush_with_platform_top"),
            ("LEFT-OF", "GROUP"),
        ),
    ],
)
def test_a_coordinate_is_set_by_these_and_not_by_those(dof: str, names: tuple[str, ...], not_names: tuple[str, ...]):
    told = setters(dof).split(", ")
    assert set(names) <= set(told)
    assert not {words.split(" with ")[0] for words in told} & set(not_names)


def test_no_camera_and_no_unknown_name():
    known = {e.code: e.FAMILY for e in (*PREDICATES.values(), *RELATIONS.values())}
    for dof in ("x", "y", "z"):
        for name in (words.split(" with ")[0] for words in setters(dof).split(", ")):
            assert name == "adjacent_*" or known[name] != CAMERA_FAMILY
