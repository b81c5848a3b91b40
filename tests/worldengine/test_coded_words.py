"""Words of a column become Arrow's strings by themselves: every recording pays for what is loaded on the way."""

import sys

import numpy as np
import pyarrow as pa
import pytest

from worldengine.recording.coded_words import Words


@pytest.mark.parametrize("rows", [["ball", "wall", "ball", "", "Straße", "球"], [""], []], ids=len)
def test_they_are_the_same_strings_without_what_computes(rows, monkeypatch):
    monkeypatch.setitem(sys.modules, "pyarrow.compute", None)  # it cannot be imported
    made = Words.of(rows).arrow()
    made.validate(full=True)
    assert made.equals(pa.array(rows, pa.string())) and made.null_count == 0


def test_a_part_of_them_in_another_order_are_the_words_of_those_rows():
    joined = Words.joined([Words.of(["a", "bb"]), Words.of(["bb", "ccc"])])
    assert joined.taken(np.array([3, 1])).arrow().to_pylist() == ["ccc", "bb"]
    assert joined.counts() == {"a": 1, "bb": 2, "ccc": 1}
