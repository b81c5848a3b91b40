"""What is listed is what lies there now, whatever was listed before."""

import os
from pathlib import Path

from worldkit import listings


def settled(*folders: Path) -> None:
    """As if they had changed a while ago, so that they are remembered."""
    for folder in folders:
        os.utime(folder, ns=(0, folder.stat().st_mtime_ns - 10 * listings.SETTLED_NS))


def names(root: Path, *patterns: str, **how: bool) -> set[str]:
    return {Path(path).relative_to(root).as_posix() for path in listings.files(str(root), patterns or ("*",), **how)}


def test_what_comes_and_goes_is_seen(tmp_path: Path) -> None:
    (tmp_path / "in/deep").mkdir(parents=True)
    (tmp_path / "__pycache__").mkdir()
    for name in ("a.py", "b.txt", "in/c.py", "in/deep/d.py", "__pycache__/e.py"):
        (tmp_path / name).touch()
    settled(tmp_path, tmp_path / "in", tmp_path / "in/deep")
    for _ in range(2):
        assert names(tmp_path) == {"a.py", "b.txt", "in/c.py", "in/deep/d.py"}
        assert names(tmp_path, "*.py") == {"a.py", "in/c.py", "in/deep/d.py"}
        assert names(tmp_path, "*.py", "*.txt", deep=False) == {"a.py", "b.txt"}
    assert str(tmp_path / "in/deep") in listings._seen
    (tmp_path / "in/deep/new.py").touch()
    (tmp_path / "a.py").unlink()
    assert names(tmp_path, "*.py") == {"in/c.py", "in/deep/d.py", "in/deep/new.py"}
    settled(tmp_path / "in/deep")
    names(tmp_path)
    (tmp_path / "in/deep/new.py").rename(tmp_path / "in/moved.py")
    assert names(tmp_path, "*.py") == {"in/c.py", "in/deep/d.py", "in/moved.py"}
    assert listings.files(str(tmp_path / "nowhere")) == []


def test_a_folder_that_just_changed_is_listed_each_time(tmp_path: Path) -> None:
    for number in range(20):
        (tmp_path / f"{number}.py").touch()
        assert len(names(tmp_path)) == number + 1


def test_a_link_counts_as_long_as_it_leads_to_a_file(tmp_path: Path) -> None:
    (tmp_path / "root").mkdir()
    (tmp_path / "other").mkdir()
    (tmp_path / "other/there.py").touch()
    (tmp_path / "root/link.py").symlink_to(tmp_path / "other/there.py")
    (tmp_path / "root/folder").symlink_to(tmp_path / "other")
    settled(tmp_path / "root")
    assert names(tmp_path / "root") == {"link.py"}
    (tmp_path / "other/there.py").unlink()
    assert names(tmp_path / "root") == set()
