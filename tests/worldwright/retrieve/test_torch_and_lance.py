"""What the `semantic` extra brings gives the same: vectors by torch, kept by LanceDB (`make test-semantic`)."""

import numpy as np

from worldwright.retrieve.semantic import lance_store, model


def test_numpy_and_torch_give_the_same_vectors():
    sentences = [f"sliding friction of geom {n}, {'and its margin ' * n}" for n in range(9)]
    assert np.abs(model.encode(sentences) - model._with_torch(sentences)).max() < 1e-4


def test_lance_keeps_what_it_was_given(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    rows = np.random.default_rng(0).normal(size=(3, model.DIMENSIONS)).astype(np.float32)
    lance_store.append(["a", "b"], rows[:2])
    lance_store.append(["c"], rows[2:])
    digests, vectors = lance_store.everything()
    assert digests == ["a", "b", "c"] and np.array_equal(vectors, rows) and lance_store.known() == {"a", "b", "c"}
