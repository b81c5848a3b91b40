"""What tests of sculptures share."""

import pytest

from worldkit.sculpt import minting


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """The folder in which this test's shapes are kept; none of an earlier test is known."""
    monkeypatch.setenv("WORLDKIT_SCULPT_CACHE", str(tmp_path / "kept"))
    minting._memory.clear()
    return tmp_path / "kept"
