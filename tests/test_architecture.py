"""The page of the house is fresh, short, and names only what is there."""

import re

from worldwright import architecture
from worldwright.scaffolds.kinds import KINDS
from worldwright.scaffolds.seam_kinds import SEAMS

TEXT = architecture.PAGE.read_text(encoding="utf-8")


def test_the_picture_is_what_the_imports_are():
    assert architecture.page(TEXT) == TEXT, "run: python -m worldwright.architecture"


def test_the_picture_shows_a_new_arrow(monkeypatch):
    graph = architecture.rooms()
    assert graph["worldkit"] <= {"worldengine"}
    assert "model" in graph["stamp"]
    monkeypatch.setattr(architecture, "rooms", lambda: graph | {"attic": {"worldkit"}})
    assert "attic --> worldkit" in architecture.picture()


def test_every_file_and_folder_that_it_names_is_there():
    told = set(
        re.findall(
            r"`((?:model|report|contract|stage|stamp|draft|worldengine|worldkit|catalog|tests|skills)/[\w./]*)`", TEXT
        )
    )
    roots = (architecture.SERVERS.parent, architecture.SERVERS, architecture.SERVERS / "worldwright")
    assert told
    assert {name for name in told if not any((root / name).exists() for root in roots)} == set()


def test_it_is_two_screens_and_its_verbs_exist():
    written = TEXT.partition(architecture.BEGIN)[0] + TEXT.partition(architecture.END)[2]
    assert len(written.splitlines()) < 60
    assert set(re.findall(r"new ([a-z-]+) NAME", TEXT)) <= {*KINDS, *SEAMS}
