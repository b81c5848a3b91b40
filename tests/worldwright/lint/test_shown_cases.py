"""A rule explained costs its reader little, whatever its cases are."""

from worldwright.lint import engine, shown_cases, tools

LONGEST = 8_000


def test_no_rule_takes_long_to_explain():
    """One took 67,000 characters: each of its cases was a whole program beside a whole plan."""
    lengths = {rule.code: len(tools.explain(rule.code).text()) for rule in engine.all_rules()}
    assert max(lengths.values()) < LONGEST, max(lengths, key=lengths.get)


def test_of_a_long_case_it_is_shown_where_it_differs():
    clean = "\n".join(f"line_{n} = {n}" for n in range(100))
    faulty = clean.replace("line_40 = 40", "line_40 = 41")
    (told,), good = shown_cases.shown([faulty], [clean])
    assert "+line_40 = 41" in told and "-line_40 = 40" in told and "line_60" not in told
    assert good == (), "a clean case that is long is left out"
    assert shown_cases.shown([faulty], [])[0][0].startswith("line_0 = 0"), "with none to compare it with, its beginning"


def test_few_cases_are_shown_and_it_is_said_how_many_more_there_are():
    bad, good = shown_cases.shown(["a" * n for n in range(1, 9)], [{"x": 1}])
    assert bad == ("a", "aa", "aaa", "(5 more)") and good == ('{\n "x": 1\n}',)
