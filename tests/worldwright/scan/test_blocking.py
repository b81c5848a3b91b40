"""Claims of sight and of shadow hold of the picture, the end of the window, and of shapes that are known."""

from dataclasses import replace

import numpy as np
import pytest

from worldwright.scan.known.analytic import clock, motion
from worldwright.scan.known.covered import looking, passing, trembling
from worldwright.scan.measuring.blocking import chosen, times
from worldwright.scan.objectives.expecting import measure

PLACE = {"place": [-2, 0, 1]}
HIDES = {**PLACE, "body": "leaf", "other": "lamp"}
LIGHT = {**PLACE, "lamp": "lamp"}


def shaped(kind):
    """The leaf and the lamp, with the leaf of this kind of shape."""
    made = passing()
    rows = [
        {"name": name, "body": name, "type": what, "size": [half] * 3, "aabb": [0, 0, 0, half, half, half]}
        for name, what, half in (("leaf", kind, 0.1), ("lamp", "box", 0.05))
    ]
    return replace(made, meta={**made.meta, "geoms": rows})


@pytest.mark.parametrize("kind", ["mesh", "hfield"])
def test_what_hangs_on_how_much_of_its_box_a_shape_fills_is_not_answered(kind):
    told = shaped(kind)
    for name, given in (("hides", {**HIDES, "min_share": 0.9}), ("receives_light", {**LIGHT, "max_share": 0.1})):
        assert measure(shaped("box"), name, given).status == "holds"
        said = measure(told, name, given)
        assert said.status == "unknown" and "by its box" in said.message
        assert (
            measure(told, name, {**given, "of": "final"}).status
            == measure(passing(), name, {**given, "of": "final"}).status
        )
    assert measure(told, "hides", {**HIDES, "min_times": 3}).status == "unknown"
    assert measure(told, "receives_light", {**LIGHT, "of": "max", "min_share": 0.9}).status == "holds"


def test_what_a_camera_does_not_show_is_hidden_there_by_nothing():
    given = {"body": "leaf", "other": "lamp", "camera": "camera"}
    assert measure(looking(), "hides", {**given, "min_share": 0.9}).status == "holds"
    for claim in ({"min_share": 0.1}, {"max_share": 0.9}, {"max_times": 9}, {"min_share": 0.1, "of": "final"}):
        said = measure(looking(away=True), "hides", {**given, **claim})
        assert said.status == "fails" and "not in the picture" in said.message


def test_the_end_is_the_last_row_even_between_two_lines():
    t = clock(0.1)
    leaf = np.stack([0 * t, np.where(np.arange(len(t)) == len(t) - 1, 0.0, 3.0), 0 * t + 1.0], axis=1)
    pos = np.stack([leaf, np.tile((2.0, 0.0, 1.0), (len(t), 1))], axis=1)
    made = motion(t, pos, 0 * pos, names=("leaf", "lamp"), size_m=(0.2, 0.1))
    assert chosen(made, slice(0, len(t)))[-1] < len(t) - 1
    assert measure(made, "hides", {**HIDES, "of": "final", "min_share": 0.9}).status == "holds"
    assert measure(made, "receives_light", {**LIGHT, "of": "final", "max_share": 0.1}).status == "holds"


def test_what_trembles_at_the_edge_comes_once():
    assert times(np.array([0.0, 0.51, 0.49, 0.52, 0.3, 0.6, 0.0]), 0.5) == 2
    assert times(np.array([0.06, 0.04, 0.06, 0.02, 0.06]), 0.05) == 2
    assert measure(trembling(), "receives_light", {**LIGHT, "min_times": 2}).status == "fails"
