"""Numbers copied by a view are those that an index finds, whatever way they lie."""

import numpy as np
import pytest

from worldengine.inputs.even_copies import reader

BODIES = np.arange(1, 6)


@pytest.mark.parametrize(
    ("index", "evenly"),
    [
        (np.array([7]), True), (np.arange(3, 9), True), (np.arange(9, 3, -2), True),
        ((6 * BODIES + np.arange(3)[:, None]).reshape(-1), True), ((6 * BODIES + np.array([2, 0, 1])[:, None]).reshape(-1), False),
        ((6 * np.array([1, 2, 4]) + np.arange(3)[:, None]).reshape(-1), False), (np.array([5, 5, 5]), True),
        (np.array([1, 2, 4, 5, 8, 9]), False), (np.array([], np.intp), False), (np.array([1, 2, 4]), False),
    ],
)  # fmt: skip
def test_a_copy_is_what_the_index_finds_now(index, evenly):
    numbers = np.arange(40.0)
    shape, copy = reader(numbers, index)
    out = np.full(shape, -1.0)
    numbers *= 3.0  # after the view was made
    copy(out)
    assert out.reshape(-1).tolist() == (3.0 * index).tolist()
    assert (len(shape) == 2) == evenly
    assert reader(numbers, index)[0] == shape
