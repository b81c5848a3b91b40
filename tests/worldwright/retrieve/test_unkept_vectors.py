"""Assets are found by meaning, too, where nothing can be kept of what was embedded."""

import sqlite3

import numpy as np
import pytest

from worldwright.retrieve import assets
from worldwright.retrieve.semantic import file_store, model, store


@pytest.mark.parametrize("refusal", [sqlite3.OperationalError("attempt to write a readonly database"), OSError(30, "")])
def test_vectors_are_made_where_none_can_be_kept(monkeypatch: pytest.MonkeyPatch, refusal: Exception) -> None:
    def append(digests: list[str], vectors: np.ndarray) -> None:
        raise refusal

    monkeypatch.setattr(store, "everything", lambda: ([], np.zeros((0, 384), np.float32)))
    monkeypatch.setattr(store, "append", append)
    monkeypatch.setattr(model, "encode_plainly", lambda texts: np.ones((len(texts), 384), np.float32))
    assert assets._vectors.__wrapped__(("a ball", "a box")).tolist() == np.ones((2, 384)).tolist()


@pytest.fixture
def kept(tmp_path, monkeypatch: pytest.MonkeyPatch):
    """A file with one vector."""
    monkeypatch.setattr(file_store, "path", lambda: tmp_path / "vectors.sqlite")
    file_store.append(["a"], np.ones((1, 384), np.float32))
    return file_store.path()


def test_a_file_that_another_holds_counts_as_none_and_is_left(kept, monkeypatch: pytest.MonkeyPatch) -> None:
    real = sqlite3.connect
    monkeypatch.setattr(sqlite3, "connect", lambda path, timeout: real(path, timeout=0.0))
    holder = real(kept)
    holder.execute("BEGIN EXCLUSIVE")
    assert file_store.known() == set() and file_store.everything()[1].shape == (0, 384)
    holder.close()
    assert file_store.known() == {"a"}


def test_a_damaged_file_counts_as_none_and_is_made_anew_where_it_can_be(kept, monkeypatch: pytest.MonkeyPatch) -> None:
    kept.write_bytes(b"no database at all, of any kind\n" * 100)
    with monkeypatch.context() as there:
        there.setattr(type(kept), "unlink", _refuse)
        assert file_store.known() == set() and kept.exists()
    assert file_store.known() == set() and not kept.exists()
    file_store.append(["b"], np.ones((1, 384), np.float32))
    assert file_store.known() == {"b"}


def _refuse(path, missing_ok: bool = False) -> None:
    raise PermissionError(13, "read-only")
