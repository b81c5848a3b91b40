"""What any job may read holds no signing key."""

from pathlib import Path

import pytest

from worldwright.intake import registering
from worldwright.stage.sandbox import confinement
from worldwright.stamp import keyring


@pytest.mark.parametrize(
    ("assets", "read"), [("data/assets", True), ("elsewhere", True), ("data", False), (".", False)]
)
def test_own_assets_are_read_where_no_key_lies_among_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, assets: str, read: bool
) -> None:
    own = tmp_path / assets
    own.mkdir(parents=True, exist_ok=True)
    (tmp_path / "link").symlink_to(tmp_path)
    monkeypatch.setenv("WORLDWRIGHT_DATA", str(tmp_path / "link" / "data"))
    monkeypatch.setenv("WORLDWRIGHT_ASSETS", str(own))
    paths = confinement.runtime_paths()
    assert (own in paths) is read
    key = (keyring.folder() / keyring.OWN).resolve()
    if read:
        registering.free("cup", own, replace=False)
    else:
        with pytest.raises(registering.RegisterError, match="holds your signing key"):
            registering.free("cup", own, replace=False)
    assert not any(key.is_relative_to(path.resolve()) for path in paths)
