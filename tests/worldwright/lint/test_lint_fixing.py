"""Safe fixes: every FIXED case comes about, is clean, and nothing else is touched."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.lint import engine, fixing, source, tools
from worldwright.lint.case import Case, plan_with
from worldwright.lint.problem import Edit
from worldwright.lint.program_view import Program

FIXABLE = [rule for rule in engine.program_rules() if rule.FIXED]


def cases():
    for rule in FIXABLE:
        for index, fixed in enumerate(rule.FIXED):
            if fixed is not None:
                bad = rule.BAD[index]
                yield pytest.param(rule, bad if isinstance(bad, Case) else Case(bad), fixed, id=f"{rule.code}-{index}")


@pytest.mark.parametrize(("rule", "bad", "fixed"), [*cases()])
def test_fixes_come_out_as_shown_and_clean(rule, bad, fixed):
    plan = plan_with(bad.plan or {}) if rule.SCOPE == "plan" else None
    text, codes = fixing.fixed(source.parse(bad.source, bad.path), plan, True)
    assert text == (fixed.source if isinstance(fixed, Case) else fixed)
    assert rule.code in codes
    assert list(rule.check(Program(source.parse(text, bad.path), plan, True))) == []


def test_rules_that_propose_edits_show_them():
    """A rule that can fix has a FIXED case: it is where the fix is proven."""
    for rule in engine.program_rules():
        plan = plan_with({})
        for case in rule.BAD:
            case = case if isinstance(case, Case) else Case(case)
            program = Program(source.parse(case.source, case.path), plan if rule.SCOPE == "plan" else None, True)
            if any(problem.edit for problem in rule.check(program)):
                assert rule in FIXABLE, f"{rule.name} proposes an edit, but shows none in FIXED"


def test_files_keep_their_line_ends_and_mark(tmp_path):
    path = tmp_path / "a.py"
    path.write_bytes("\ufeffimport mujoco  # Größe\r\nspec = mujoco.MjSpec()\r\nspec.option.time_step = 1\r\n".encode())
    report = tools.check_program([path], fix=True)
    assert report.ok and "1 safe fix (WL101)" in report.fixed[0] and report.fixed[0] in report.text()
    assert (
        path.read_bytes()
        == "\ufeffimport mujoco  # Größe\r\nspec = mujoco.MjSpec()\r\nspec.option.timestep = 1\r\n".encode()
    )


def test_characters_beyond_ascii_do_not_shift_an_edit():
    text = "import mujoco\nspec = mujoco.MjSpec(); größe = 'äöü'; spec.option.time_step = 1\n"
    assert fixing.fixed(source.parse(text))[0] == text.replace("time_step", "timestep")


def test_without_fix_and_when_answered_for_nothing_is_written(tmp_path):
    text = "import mujoco\nspec = mujoco.MjSpec()\nspec.option.time_step = 1"
    path = tmp_path / "a.py"
    path.write_text(text + "\n")
    tools.check_program([path])
    assert path.read_text() == text + "\n"
    path.write_text(text + "  # worldwright: ignore[WL101] of another build\n")
    assert tools.check_program([path], fix=True).fixed == ()
    assert path.read_text().startswith(text)


@settings(max_examples=100, deadline=None)
@given(st.text(alphabet="ab\n é", min_size=1, max_size=40), st.data())
def test_edits_replace_exactly_their_stretch(text, data):
    lines = text.splitlines(keepends=True)
    line = data.draw(st.integers(1, len(lines)))
    length = len(lines[line - 1].rstrip("\n"))
    start = data.draw(st.integers(0, length))
    end = data.draw(st.integers(start, length))
    result = fixing.applied(text, [Edit(line, start + 1, line, end + 1, "X")])
    before = "".join(lines[: line - 1]) + lines[line - 1][:start]
    assert result == before + "X" + text[len(before) + end - start :]
