"""The world that a bundle pass made is looked at in place of another build; what lies beside it is read within limits."""

import json
from pathlib import Path

import pytest

from worldwright.lint.compiled import fetch
from worldwright.model.evidence.run import Run, sha256_file


def bundle(folder: Path, facts: bytes) -> Path:
    """A bundle pass of the key `k`, whose result vouches for these facts."""
    there = folder / "evidence/k/bundle"
    there.mkdir(parents=True)
    (there / fetch.BUNDLE).write_bytes(b"a world")
    (there / fetch.FACTS).write_bytes(facts)
    files = {name: sha256_file(there / name) for name in (fetch.BUNDLE, fetch.FACTS)}
    (there / "result.json").write_text(json.dumps({"ok": True, "files": files}))
    return there


def test_it_is_taken_with_its_duration(tmp_path: Path) -> None:
    there = bundle(tmp_path, b'{"duration": 2.5}')
    assert fetch.bundled(Run(tmp_path), "k") == (there / fetch.BUNDLE, 2.5)


@pytest.mark.parametrize("facts", [b'{"duration": 2.5}' + b" " * (2 << 20), b"[" * 100_000, b"", b"7"])
def test_facts_of_another_size_or_kind_are_not(tmp_path: Path, facts: bytes) -> None:
    bundle(tmp_path, facts)
    assert fetch.bundled(Run(tmp_path), "k") is None


@pytest.mark.parametrize("name", ["result.json", "program.json"])
def test_nor_is_what_only_a_link_leads_to(tmp_path: Path, name: str) -> None:
    there = bundle(tmp_path, b'{"duration": 2.5}')
    (there / name).rename(tmp_path / "elsewhere")
    (there / name).symlink_to(tmp_path / "elsewhere")
    assert fetch.bundled(Run(tmp_path), "k") is None
