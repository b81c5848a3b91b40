"""What is kept of a sculpted thing rubs as its plan says it, else as its parts do, else by a number that is called assumed."""

from pathlib import Path

import pytest

from worldkit.intake import kept_sculpt

SAID = {"category": "thing", "description": "a block", "assumed": [], "contact_source": "not stated"}
SOURCE = """\
from worldkit import contacts
from worldkit.sculpt import Part, crisp

RUBBER = contacts.surface(friction=0.9, torsional=0.01, rolling=0.002)
FELT = contacts.surface(friction=0.6, torsional=0.03, rolling=0.001)
BARE = Part("block", crisp.box((0.1, 0.1, 0.1)))
SHOD = (
    Part("block", crisp.box((0.1, 0.1, 0.1)), surface=RUBBER),
    Part("cap", crisp.box((0.1, 0.1, 0.02)).translate(z=0.06), "block", surface=FELT),
)
"""


@pytest.mark.parametrize(
    ("of", "surface", "rubs", "assumed"),
    [
        ("SHOD", None, {"friction": 0.9, "torsional": 0.03, "rolling": 0.002}, 0),
        ("BARE", None, {"friction": 0.5}, 1),
        ("SHOD", {"friction": 0.2}, {}, 0),
    ],
    ids=["its parts", "nobody", "its plan"],
)
def test_how_it_rubs_is_said_by_whoever_knows(tmp_path: Path, monkeypatch, of, surface, rubs, assumed):
    monkeypatch.syspath_prepend(str(tmp_path))
    (tmp_path / "block.py").write_text(SOURCE, encoding="utf-8")
    asked = {"key": "block", "file": "block.py", "of": of, "said": SAID, "surface": surface}
    facts = kept_sculpt.taken(tmp_path, asked)[1]
    assert {word: facts[word] for word in ("friction", "torsional", "rolling") if word in facts} == rubs
    assert len(facts["assumed"]) == assumed
