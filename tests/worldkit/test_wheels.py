"""Versions of installed packages, read without parsing all that the packages say about themselves."""

from importlib import metadata

import pytest

from worldkit import lock, wheels


@pytest.mark.parametrize("name", ["mujoco", "numpy", "av", "pydantic"])
def test_it_is_what_the_installer_says(name):
    assert wheels.version(name) == metadata.version(name)


def test_what_is_not_installed_has_none():
    assert wheels.version("no-such-package") == ""


def test_a_package_with_other_metadata_is_asked_as_usual(tmp_path):
    (tmp_path / "old-1.2.egg-info").mkdir()
    (tmp_path / "old-1.2.egg-info" / "PKG-INFO").write_text("Metadata-Version: 1.0\nName: old\nVersion: 1.2\n")
    (found,) = metadata.distributions(path=[str(tmp_path)])
    assert wheels.version_of(found) == "1.2"


def test_the_lock_has_them_too():
    assert lock.observe()["wheel numpy"].split()[0] == metadata.version("numpy")
