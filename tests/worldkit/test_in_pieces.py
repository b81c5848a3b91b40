"""What hangs together has one number, as scipy counts it."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from worldkit.in_pieces import pieces


@given(st.integers(1, 30).flatmap(lambda n: st.tuples(st.just(n), st.lists(st.tuples(*[st.integers(0, n - 1)] * 2)))))
def test_links_make_the_pieces_that_scipy_finds(drawn: tuple[int, list[tuple[int, int]]]) -> None:
    count, links = drawn[0], np.array(drawn[1], dtype=int).reshape(-1, 2)
    graph = coo_array((np.ones(len(links)), links.T), shape=(count, count))
    assert pieces(links, count).tolist() == connected_components(graph, directed=False)[1].tolist()


def test_a_long_chain_in_any_order_is_one_piece() -> None:
    chain = np.random.default_rng(7).permutation(10_000)
    assert not pieces(np.stack([chain[:-1], chain[1:]], axis=1), len(chain)).any()
