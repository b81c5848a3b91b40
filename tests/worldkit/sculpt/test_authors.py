"""What is an author's own is told apart from what is installed, through whatever links either is reached."""

import sysconfig
from pathlib import Path

import pytest

import worldkit
from worldkit.sculpt import authors


@pytest.fixture(autouse=True)
def forget():
    yield
    for kept in (authors._libraries, authors.in_a_library):
        kept.cache_clear()


def test_this_package_is_no_authors_through_a_link(tmp_path):
    (tmp_path / "checkout").symlink_to(Path(worldkit.__file__).parents[1])
    (tmp_path / "paints.py").touch()
    assert authors.in_a_library(tmp_path / "checkout/worldkit/scene.py")
    assert not authors.in_a_library(tmp_path / "paints.py")


def test_what_is_installed_in_a_folder_behind_a_link_is_no_authors(tmp_path, monkeypatch):
    (tmp_path / "real").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "real")
    monkeypatch.setattr(sysconfig, "get_path", lambda name: str(tmp_path / "link"))
    for kept in (authors._libraries, authors.in_a_library):
        kept.cache_clear()
    assert authors.in_a_library(tmp_path / "real/tool.py") and authors.in_a_library(tmp_path / "link/tool.py")


def test_what_a_function_writes_and_does_not_own_is_told():
    kept = {}

    def outer(thing):
        count = 0

        def inner():
            nonlocal count
            count += 1
            thing.tone = kept
            worldkit.tone = 1

        return inner

    reads = authors.reads_of(outer.__code__)
    assert reads.writes == {"tone"} and "count" in authors.reads_of(outer(None).__code__).writes
