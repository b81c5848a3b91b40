"""Assets are found by meaning, too, where nothing can be kept of what was embedded."""

import sqlite3

import numpy as np
import pytest

from worldwright.retrieve import assets
from worldwright.retrieve.semantic import model, store


@pytest.mark.parametrize("refusal", [sqlite3.OperationalError("attempt to write a readonly database"), OSError(30, "")])
def test_vectors_are_made_where_none_can_be_kept(monkeypatch: pytest.MonkeyPatch, refusal: Exception) -> None:
    def append(digests: list[str], vectors: np.ndarray) -> None:
        raise refusal

    monkeypatch.setattr(store, "everything", lambda: ([], np.zeros((0, 384), np.float32)))
    monkeypatch.setattr(store, "append", append)
    monkeypatch.setattr(model, "encode_plainly", lambda texts: np.ones((len(texts), 384), np.float32))
    assert assets._vectors.__wrapped__(("a ball", "a box")).tolist() == np.ones((2, 384)).tolist()
