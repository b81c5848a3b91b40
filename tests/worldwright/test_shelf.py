import importlib
import sys
import textwrap
from importlib.metadata import EntryPoint

import pytest

from worldwright import shelf as shelves
from worldwright.model.errors import NotFoundError
from worldwright.shelf import Attribute, MalformedEntryError, Shelf


@pytest.fixture
def shelf(tmp_path, monkeypatch):
    """Write entries into a throw-away package and open it as a shelf."""
    package = tmp_path / "shelf_under_test"
    package.mkdir()
    (package / "__init__.py").write_text("")
    monkeypatch.syspath_prepend(str(tmp_path))

    def write(**entries: str) -> Shelf:
        for name, source in entries.items():
            (package / f"{name}.py").write_text(textwrap.dedent(source))
        return Shelf(
            "shelf_under_test",
            {"GOOD": Attribute(tuple, "cases"), "LASTS": Attribute(bool, "it lasts", False)},
        )

    yield write
    for name in [n for n in sys.modules if n.startswith("shelf_under_test")]:
        del sys.modules[name]


ENTRY = '''
"""A rule that is here.

More about it.
"""
CODE = "T{}"
GOOD = ()
'''


def test_the_folder_is_the_registry_in_order_of_codes(shelf):
    found = shelf(zebra=ENTRY.format(1), ant=ENTRY.format(2), _private="raise RuntimeError")
    assert list(found) == ["T1", "T2"]
    assert found["T1"].name == "zebra"
    assert found["ant"].code == "T2"
    assert found["ant"].summary == "A rule that is here."


@pytest.mark.parametrize(
    ("source", "complaint"),
    [
        ('CODE = "T1"\nGOOD = ()', "needs a docstring"),
        ('"""Doc."""\nGOOD = ()', "must define CODE"),
        ('"""Doc."""\nCODE = "T1"\n', "must define GOOD"),
        ('"""Doc."""\nCODE = "T1"\nGOOD = []', r"bad\.py:3: GOOD must be"),
    ],
)
def test_a_malformed_entry_fails_naming_file_and_line(shelf, source, complaint):
    with pytest.raises(MalformedEntryError, match=complaint):
        len(shelf(bad=source))


def test_a_code_is_never_used_twice(shelf):
    with pytest.raises(MalformedEntryError, match="already taken"):
        len(shelf(one=ENTRY.format(1), two=ENTRY.format(1)))


def test_an_unknown_entry_names_the_nearest_and_the_known(shelf):
    with pytest.raises(NotFoundError) as caught:
        shelf(zebra=ENTRY.format(1)).find("zerba")
    assert "zebra" in str(caught.value)
    assert "T1" in str(caught.value)


def test_an_entry_answers_for_what_its_protocol_names_and_nothing_else(shelf):
    found = shelf(ant=ENTRY.format(1) + "SECRET = 1\n", bee=ENTRY.format(2) + "LASTS = True\n")
    assert [entry.LASTS for entry in found.values()] == [False, True]
    with pytest.raises(AttributeError, match="SECRET is not in the protocol"):
        _ = found["T1"].SECRET
    assert "| `LASTS` | no: False | it lasts |" in found.explained()
    assert "| `GOOD` | yes | cases |" in found.explained()


def test_an_attribute_of_the_wrong_kind_is_malformed_though_it_may_be_left_out(shelf):
    with pytest.raises(MalformedEntryError, match=r"bad\.py:8: LASTS must be"):
        len(shelf(bad=ENTRY.format(1) + "LASTS = 'yes'\n"))


def test_a_module_may_carry_several_faces_of_one_idea(shelf):
    found = shelf(
        faces='''
"""Two faces."""
from types import SimpleNamespace
GOOD = (1,)
ENTRIES = tuple(SimpleNamespace(name=n, CODE=n.upper(), doc=f"The {n} one.", LASTS=n == "left") for n in ("left", "right"))
'''
    )
    assert [(e.code, e.name, e.summary, e.LASTS, e.GOOD) for e in found.values()] == [
        ("LEFT", "left", "The left one.", True, (1,)),
        ("RIGHT", "right", "The right one.", False, (1,)),
    ]


def test_a_plug_in_that_cannot_be_loaded_takes_nothing_down(shelf, monkeypatch, tmp_path):
    (tmp_path / "broken_plug_in.py").write_text("raise RuntimeError('no such luck')")
    (tmp_path / "sound_plug_in.py").write_text(ENTRY.format(3))
    points = [EntryPoint("broken", "broken_plug_in", "g"), EntryPoint("sound", "sound_plug_in", "g")]
    importlib.invalidate_caches()
    monkeypatch.setattr(shelves, "entry_points", lambda group: points)
    found = shelf(zebra=ENTRY.format(1))
    assert list(found) == ["T1", "T3"]
    assert found.unusable == {"broken": "broken_plug_in cannot be loaded: RuntimeError: no such luck"}
