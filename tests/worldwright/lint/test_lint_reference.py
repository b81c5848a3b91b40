"""The page of rules is fresh, and its skill is about what there is."""

from worldwright.lint import engine, reference


def test_the_page_is_what_the_modules_say():
    assert reference.PAGE.read_text(encoding="utf-8") == reference.page(), (
        "run: .venv/bin/python -m worldwright.lint.reference"
    )


def test_every_rule_is_in_one_group_and_on_the_page():
    page = reference.page()
    groups = {name: [r for r in engine.all_rules() if engine.group(r) == name] for name in engine.GROUPS}
    assert all(len(rules) >= 10 for rules in groups.values())
    assert sum(map(len, groups.values())) == len(engine.all_rules())
    for rule in engine.all_rules():
        assert f"\n### {rule.code} {rule.name}\n" in page
        assert f"(#{rule.code.lower()}-{rule.name})" in page
    assert "AUTHOR:" not in page


def test_the_names_that_keep_a_world_from_being_built_are_rules():
    names = {rule.code for rule in engine.program_rules() if rule.ABOUT == "names"}
    assert {rule.code for rule in engine.program_rules() if engine.to_look_up(rule.code)} < names
    assert all(engine.about_names(code) for code in names)
    assert not engine.about_names("WL126")
    assert {rule.ABOUT for rule in engine.program_rules()} == {"names", "signatures", "mistakes"}
