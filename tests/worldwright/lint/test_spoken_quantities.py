"""Quantities are read out of plain words, however they are spelled, and nothing else is taken for one."""

import pytest

from worldwright.lint.spoken_quantities import quantities


@pytest.mark.parametrize(
    ("words", "value"),
    [
        ("slides 0.6 m.", 0.6), ("slides 0,6 m", 0.6), ("6e-1 m", 0.6), ("6 × 10⁻¹ m", 0.6), ("**0.6**&nbsp;m", 0.6), ("0.6\u200bm", 0.6),
        ("600 millimetres", 0.6), ("60 CM", 0.6), ("two thirds of a metre", 2 / 3), ("zero point six metres", 0.6), ("half a metre", 0.5),
        ("1½ m", 1.5), ("2/3 m", 2 / 3), ("1 000 m", 1000.0), ("two hundred and fifty metres", 250.0), ("a kilometre", 1000.0),
        ("60 feet", 18.288), ("a 60-foot drop", 18.288), ("2 miles", 3218.688),
    ],
)  # fmt: skip
def test_a_length_however_it_is_spelled(words, value):
    (one,) = quantities(words)
    assert one.meant[0] == (pytest.approx(value), (0, 1, 0, 0, 0))


@pytest.mark.parametrize(
    ("words", "value", "dimension"),
    [
        ("2 metres per second", 2.0, (0, 1, -1, 0, 0)),
        ("72 km/h", 20.0, (0, 1, -1, 0, 0)),
        ("0.6 m/s² far", 0.6, (0, 1, -2, 0, 0)),
        ("50 N m", 50.0, (1, 2, -2, 0, 0)),
        ("3 cubic centimetres", 3e-6, (0, 3, 0, 0, 0)),
        ("after one second", 1.0, (0, 0, 1, 0, 0)),
        ("half a second", 0.5, (0, 0, 1, 0, 0)),
    ],
)
def test_other_dimensions(words, value, dimension):
    (one,) = quantities(words)
    assert one.meant[0] == (pytest.approx(value), dimension)


def test_a_comma_and_a_temperature_may_mean_two_things():
    assert {value for one in quantities("1,000 m") for value, _ in one.meant} == {1.0, 1000.0}
    assert [value for one in quantities("900 °C") for value, _ in one.meant] == [900.0, 1173.15]


@pytest.mark.parametrize(
    "words",
    [
        "a second crate",
        "on its two feet",
        "5 in a row",
        "case 3 a ball",
        "six tenths of it",
        "45 degrees",
        "lemon_1 m",
        "a power meter",
    ],
)
def test_no_quantity(words):
    assert not [*quantities(words)]
