"""A campaign's file says one thing, or is refused as a whole, with the word that is wrong and those that are known."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.campaign.campaign_file import MOST_BYTES, Axis, CampaignError, parse, read

GOOD = """
name: balls
plan: ball/plan.md
sweep:
  seed: 7
  draws: 3
  fields:
    simulation_parameters.masses.ball: {values: [0.1, 0.2]}
    simulation_parameters.gravity: {from: -10, to: -2, steps: 5}
    topology.scene_predicates[0].params.bottom: {uniform: [0.2, 0.6]}
workers: 2
budget: {seconds: 60, runs: 100}
per_world: {seconds: 10, begun: 2}
"""


def test_a_campaign_says_how_many_worlds_it_is():
    campaign = parse(GOOD)
    assert campaign.size == 2 * 5 * 3
    assert campaign.until == "expect" and not campaign.pictures
    assert parse("plans: [a/plan.md, {plan: b, category: fluids}]").size == 2


BAD = {
    "": "empty",
    "[1, 2]": "mapping",
    "plan: a\nsweeep: {}": "sweeep",
    "prompts: [x]\nplan: a": "prompts",
    "plan: a\nplan: b": "twice",
    "plan: &x a\nname: *x": "alias",
    "plan: a: b": "not YAML",
    "plan: a\nplans: [b]": "one `plan`",
    "name: x": "one `plan`",
    "plans: []": "at least 1 item",
    "plans: [a]\nsweep: {fields: {x: {values: [1]}}}": "over one `plan`",
    "plan: a\nsweep: {fields: {}}": "at least 1 item",
    "plan: a\nsweep: {fields: {x: {}}}": "in one way",
    "plan: a\nsweep: {fields: {x: {values: [1], uniform: [0, 1]}}}": "in one way",
    "plan: a\nsweep: {fields: {x: {values: []}}}": "at least 1 item",
    "plan: a\nsweep: {fields: {x: {values: [1, 1.0]}}}": "twice",
    "plan: a\nsweep: {fields: {x: {values: [true]}}}": "no numbers",
    "plan: a\nsweep: {fields: {x: {values: [.nan]}}}": "finite",
    "plan: a\nsweep: {fields: {x: {from: 1, to: 2}}}": "`from`, `to` and `steps`",
    "plan: a\nsweep: {fields: {x: {from: 1, to: 1, steps: 2}}}": "two ends",
    "plan: a\nsweep: {fields: {x: {from: 0, to: 1, steps: 2, spacing: log}}}": "above 0",
    "plan: a\nsweep: {fields: {x: {uniform: [1, 0]}}}": "low < high",
    "plan: a\nsweep: {fields: {x: {log_uniform: [0, 1]}}}": "above 0",
    "plan: a\nsweep: {fields: {x: {normal: [0, 0]}}}": "above 0",
    "plan: a\nsweep: {fields: {x: {normal: [0, 1], within: [9, 10]}}}": "four standard deviations",
    "plan: a\nsweep: {fields: {x: {values: [1]}}, draws: 5}": "no field is drawn",
    "plan: a\nsweep: {fields: {x: {from: 0, to: 1, steps: 1000000000}}}": "1,000,000,000 worlds",
    "plan: a\nsweep: {fields: {x: {uniform: [0, 1]}}, draws: 1000001}": "1,000,001 worlds",
    "plan: a\nsweep: {fields: {x: {uniform: [-1.7e+308, 1.7e+308]}}}": "from -1.7e+308 to 1.7e+308",
    "plan: a\nsweep: {fields: {x: {from: -1.7e+308, to: 1.7e+308, steps: 2}}}": "from -1.7e+308 to 1.7e+308",
    "plan: a\nsweep: {fields: {x: {from: 1.0e-300, to: 1.0e+300, steps: 2, spacing: log}}}": "from 1e-300 to 1e+300",
    "plan: a\nsweep: {fields: {x: {normal: [0, 1.0e+308]}}}": "deviation 1e+308",
    f"plan: a\nsweep: {{fields: {{x: {{integers: [0, {'9' * 400}]}}}}}}": "about 10^400",
    f"plan: a\nsweep: {{fields: {{x: {{integers: [-{'9' * 400}, 0]}}}}}}": "about -10^400",
    f"plan: a\nsweep: {{fields: {{x: {{integers: [0, 0x{'f' * 5000}]}}}}}}": "about 10^6021",
    f"plan: a\nsweep: {{fields: {{x: {{values: [{'9' * 400}]}}}}}}": "about 10^400",
    f"plan: a\nsweep: {{fields: {{x: {{from: 0, to: 1, steps: 0x{'f' * 5000}}}}}}}": "about 10^6021",
    f"plan: a\nsweep: {{seed: 0x{'f' * 5000}, fields: {{x: {{uniform: [0, 1]}}}}}}": "about 10^6021",
    f"plan: a\nbudget: {{runs: 0x{'f' * 5000}}}": "about 10^6021",
    f"plan: a\nbudget: [0x{'f' * 5000}]": "`budget`",
    "plan: a\nsweep: {fields: {"
    + ", ".join(f"x{n}: {{from: 0, to: 1, steps: {10**15}}}" for n in range(300))
    + "}}": "about 10^4500 worlds",
    "plan: a\nworkers: 0": "greater than or equal to 1",
    "plan: a\nuntil: friday": "'check'",
    "plan: a\nname: ../x": "match pattern",
    "plan: a\nbudget: {hours: 1}": "hours",
    "plan: a\naddress: host:1\nhands: processes": "Ray's",
    "plan: a\nbudget: {seconds: 0}": "greater than 0",
}


@pytest.mark.parametrize("text", BAD)
def test_what_cannot_be_run_is_refused_with_its_cause(text):
    with pytest.raises(CampaignError) as refused:
        parse(text, "c.yaml")
    assert BAD[text] in refused.value.cause, refused.value.cause
    assert refused.value.place.startswith("c.yaml") and refused.value.next_move


@pytest.mark.parametrize(
    ("text", "known"),
    [
        ("plan: a\nsweeep: {}", "sweep"),
        ("plan: a\nbudget: {hours: 1}", "seconds, runs"),
        ("plan: a\nper_world: {x: 1}", "begun"),
        ("plan: a\nsweep: {fields: {x: {value: [1]}}}", "values, from, to"),
        ("plans: [{plam: x}]", "plan, category, prompt"),
    ],
)
def test_an_unknown_word_is_answered_with_the_known_ones(text, known):
    with pytest.raises(CampaignError) as refused:
        parse(text)
    assert known in refused.value.next_move


def test_a_file_that_is_missing_large_or_no_text_is_told(tmp_path):
    for name, content in {"none": None, "large": b"#" * (MOST_BYTES + 1), "binary": b"\xff\xfe\0"}.items():
        path = tmp_path / name
        if content is not None:
            path.write_bytes(content)
        with pytest.raises(CampaignError, match=str(path)):
            read(path)


def test_a_campaign_without_a_name_has_its_files(tmp_path):
    path = tmp_path / "My Balls!.yaml"
    path.write_text("plan: a")
    assert read(path).name == "my-balls"


@given(st.text(max_size=60))
def test_no_text_ends_in_anything_but_a_campaign_or_its_refusal(text):
    try:
        parse(text)
    except CampaignError as refused:
        assert refused.cause and refused.next_move


@given(
    st.dictionaries(st.sampled_from([*Axis.model_fields, "from"]), st.lists(st.floats() | st.booleans(), max_size=3))
)
def test_no_axis_ends_in_anything_but_an_axis_or_a_refusal(words):
    import yaml

    text = yaml.safe_dump({"plan": "a", "sweep": {"fields": {"x": words}}})
    try:
        assert parse(text).size >= 1
    except CampaignError as refused:
        assert refused.cause
