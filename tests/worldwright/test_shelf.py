import sys
import textwrap

import pytest

from worldwright.model.errors import NotFoundError
from worldwright.shelf import MalformedEntryError, Shelf


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
        return Shelf("shelf_under_test", {"GOOD": tuple})

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
