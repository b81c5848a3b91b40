"""Stripping takes out exactly what is marked and keeps every other byte."""

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.stamp.strip import BEGIN, END, LINE, InstrumentationError, strip


def test_unmarked_source_is_returned_unchanged() -> None:
    source = 'x = 1  # a comment\r\ny = "# worldwright: instrumentation"\n\n\n'
    assert strip(source).source == source
    assert strip(source).removed == ()


def test_block_and_line_marks_are_taken_out_and_formatting_survives() -> None:
    source = f'''"""Doc."""
import mujoco   # odd  spacing stays

TIME_STEP = 0.001  # s
{BEGIN}
import sys
trace = []

def probe(model, data):
    trace.append(data.time)
{END}


def control(model, data):
    probe(model, data)  {LINE}
    data.ctrl[0] = 1.0   # drive
'''
    result = strip(source)
    assert (
        result.source
        == '''"""Doc."""
import mujoco   # odd  spacing stays

TIME_STEP = 0.001  # s


def control(model, data):
    data.ctrl[0] = 1.0   # drive
'''
    )
    assert result.removed == (5, 6, 7, 8, 9, 10, 11, 15)


@pytest.mark.parametrize(
    ("source", "expected"),
    [
        (f"def f():\n    print(1)  {LINE}\n", "def f():\n    pass\n"),
        (f"def f():\r\n    {BEGIN}\r\n    print(1)\r\n    {END}\r\n", "def f():\r\n    pass\r\n"),
        (f"if a:\n    b()\nelse:\n    c()  {LINE}\n", "if a:\n    b()\nelse:\n    pass\n"),
        (f"if a:\n    b()\n{BEGIN}\nelse:\n    c()\n{END}\n", "if a:\n    b()\n"),
        (f"if a:\n    b()\nelif d:  {LINE}\n    c()\n", "if a:\n    b()\n"),
        (f"for i in r:  {LINE}\n    print(i)\n    print(2)\nx = 1\n", "x = 1\n"),
        (f"@d  {LINE}\ndef f():\n    return 1\nx = 1\n", "x = 1\n"),
        (f"@d\ndef f():  {LINE}\n    return 1\nx = 1\n", "x = 1\n"),
        (f"x = [\n    1,\n    2,  {LINE}\n    3,\n]\n", "x = [\n    1,\n    3,\n]\n"),
        (f"y = 1\nx = [\n    1,\n]  {LINE}\n", "y = 1\n"),
        (f"try:\n    a()\nfinally:\n    b()  {LINE}\n", "try:\n    a()\nfinally:\n    pass\n"),
        (f"match v:\n    case 1:\n        print(v)  {LINE}\n", "match v:\n    case 1:\n        pass\n"),
        (f"a()\nprint(1)  {LINE}", "a()\n"),
        (f's = "\x1c\u2028"\nprint(s)  {LINE}\nb = 1\n', 's = "\x1c\u2028"\nb = 1\n'),
    ],
)
def test_shapes(source: str, expected: str) -> None:
    assert strip(source).source == expected
    ast.parse(expected)


@pytest.mark.parametrize(
    ("source", "says", "line"),
    [
        (f"{BEGIN}\nx = 1\n", "never closed", 1),
        (f"x = 1\n{END}\n", "closes nothing", 2),
        (f"{BEGIN}\n{BEGIN}\n{END}\n", "inside an open block", 2),
        (f"x = [\n{BEGIN}\n    1,\n]\n{END}\n", "in half", 1),
        (f"{BEGIN}\nif a:\n{END}\n    b()\n", "in half", 2),
        (f"if a:\n    b()\nelse:  {LINE}\n    c()\n", "not valid Python|around it", 3),
        ("x = (\n", "does not parse", 1),
    ],
)
def test_bad_marks_are_refused_with_their_place(source: str, says: str, line: int) -> None:
    with pytest.raises(InstrumentationError, match=says) as caught:
        strip(source)
    assert caught.value.place == f"simulation.py:{line}"
    assert caught.value.next_move


simple = st.sampled_from(
    ["x = 1", "f(2)  # keep", 's = """a\n# worldwright: instrumentation\n"""', "y = [1,\n     2]", "# lone"]
)
marked = simple.filter(lambda s: not s.startswith("#")).map(lambda s: f"{BEGIN}\n{s}\n{END}")


@given(st.lists(st.tuples(st.booleans(), simple, marked), min_size=1, max_size=8))
def test_what_is_kept_is_exactly_what_was_not_marked(parts: list[tuple[bool, str, str]]) -> None:
    source = "".join((mark if is_marked else plain) + "\n" for is_marked, plain, mark in parts)
    expected = "".join(plain + "\n" for is_marked, plain, _ in parts if not is_marked)
    assert strip(source).source == expected


@given(st.text(max_size=200))
def test_any_text_is_stripped_or_refused(text: str) -> None:
    try:
        assert strip(text).source == text
    except InstrumentationError as error:
        assert error.cause
