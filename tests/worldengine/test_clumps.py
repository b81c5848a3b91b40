"""What hangs together is found the same as by asking every pair, and at a cost that grows with the count of particles."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from worldengine.film import clumps


def of_all_pairs(places, wide):
    """The clumps, plainly."""
    one, other = cKDTree(places).query_pairs(clumps.REACH * wide.max() * (1 + 1e-9), output_type="ndarray").T
    near = np.linalg.norm(places[one] - places[other], axis=1) <= clumps.REACH * (wide[one] + wide[other]) / 2
    links = coo_array((np.ones(near.sum()), (one[near], other[near])), shape=(len(places),) * 2)
    return connected_components(links, directed=False)[1]


@pytest.mark.parametrize("apart", [0.5, 1.0, 2.0, 2.39, 2.6])
@pytest.mark.parametrize("widest", [1.0, 4.0])
def test_clumps_are_those_of_all_pairs(apart, widest):
    rng = np.random.default_rng(3)
    grid = np.stack(np.meshgrid(*[np.arange(8.0)] * 3), axis=-1).reshape(-1, 3) * apart
    sides = [grid + np.array([n * (8 * apart + gap), 0, 0]) for n, gap in enumerate((0.0, 1.2, 1.5, 2.5))]
    places = np.concatenate([*sides, rng.uniform(-30, 60, (300, 3))]) + rng.normal(0, 0.02, (4 * 512 + 300, 3))
    wide = rng.uniform(1, widest, len(places))
    found, plain = clumps.linked(places, wide), of_all_pairs(places, wide)
    pairs = np.unique(np.stack([found, plain], axis=1), axis=0)
    assert len(pairs) == len(np.unique(found)) == len(np.unique(plain))


def test_no_pair_is_listed_within_a_clump(monkeypatch):
    listed = []
    real = clumps._joined
    monkeypatch.setattr(clumps, "_joined", lambda pairs, *more: (listed.append(len(pairs)), real(pairs, *more))[1])
    grid = np.stack(np.meshgrid(*[np.arange(16.0)] * 3), axis=-1).reshape(-1, 3) * 0.5
    both = np.concatenate([grid, grid + np.array([13.5, 0, 0])])  # two clumps that do not touch
    assert len(np.unique(clumps.linked(both, np.ones(len(both))))) == 2
    assert sum(listed) <= clumps.NEAREST * len(both)


def test_one_alone_and_many_in_one_place_hang_together():
    assert list(clumps.linked(np.zeros((1, 3)), np.ones(1))) == [0]
    arrays = {"ways": np.zeros((2, 3, 3)), "sizes": np.ones((2, 3))}
    (found,) = clumps.sizes(({"name": "dust", "ways": "ways", "sizes": "sizes"},), arrays).values()
    assert found == pytest.approx([1.0, 1.0])
