"""A leaf is one closed thin sheet of the size that was asked for."""

import numpy as np
import pytest

from worldkit import sculpt
from worldkit.errors import ProgramError


@pytest.mark.parametrize(("curl_deg", "veins"), [(40.0, 7), (0.0, 7), (-120.0, 3), (40.0, 0)])
def test_it_is_closed_turned_outward_thin_and_centred(curl_deg, veins) -> None:
    leaf = sculpt.leaf(0.08, 0.045, curl_deg=curl_deg, veins=veins)
    directed = np.concatenate([leaf.faces[:, [0, 1]], leaf.faces[:, [1, 2]], leaf.faces[:, [2, 0]]])
    assert len(np.unique(directed, axis=0)) == len(directed)  # each edge once in each direction
    assert set(map(tuple, directed)) == set(map(tuple, directed[:, ::-1]))
    corners = leaf.vertices[leaf.faces]
    volume = np.einsum("fk,fk->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert 0.5 < volume / (0.6 * 0.08 * 0.045 * 0.004 * 0.08) < 1.5
    assert np.ptp(leaf.vertices[:, 1]) == pytest.approx(0.045, rel=0.05)
    assert np.allclose(leaf.vertices.min(axis=0), -leaf.vertices.max(axis=0))
    assert leaf.uv.shape == (len(leaf.vertices), 2) and leaf.uv.min() == 0 and leaf.uv.max() == 1


def test_it_curls_and_many_at_once_are_coarse() -> None:
    flat, bent = (np.ptp(sculpt.leaf(curl_deg=turn).vertices, axis=0) for turn in (0.0, 160.0))
    assert flat[0] == pytest.approx(0.08, rel=1e-3) and bent[0] < 0.065 and bent[2] > 2 * flat[2]
    assert len(sculpt.leaf(veins=0).faces) == 216 < len(sculpt.leaf().faces)


@pytest.mark.parametrize(
    "wrong", [{"length": 0.0}, {"width": -1.0}, {"curl_deg": 400.0}, {"veins": 21}, {"length": np.nan}]
)
def test_what_is_no_leaf_is_refused(wrong) -> None:
    with pytest.raises(ProgramError, match="no leaf"):
        sculpt.leaf(**wrong)
