"""Criteria are read from a data set's own files as they lie, and every file that is none is named; the prompts carry none."""

import json

import pytest

from worldwright.judge import eighty, published_set
from worldwright.model.errors import NotFoundError

RECORD = {
    "Prompt": "A ball falls.",
    "Physics": "A ball is dropped and bounces.",
    "Prompt_index": "039-1",
    "Physics_index": "039-2",
    "Basic_Standards": {"Objects": ["a ball", "the ground"], "Event": "the ball bounces"},
    "Key_Standards": ["each bounce is lower", "it comes to rest"],
}


def changed(**more):
    return {key: value for key, value in {**RECORD, **more}.items() if value is not None}


def written(folder, **files):
    for name, value in files.items():
        (folder / f"{name}.json").write_text(value if isinstance(value, str) else json.dumps(value))
    return folder


def test_the_published_layout_is_read_with_its_categories(tmp_path):
    other = changed(Prompt_index="040-1", Physics_index="040-2", Key_Standards="it floats")
    whole = {"Interaction Dynamics": {"Collisions": [RECORD], "Buoyancy": [other]}}
    prompts = {"039-1": "A ball falls."}
    found, errors = published_set.read(written(tmp_path, standards=whole, prompt_index_to_prompt=prompts))
    assert errors == () and list(found.scenarios) == ["039", "040"]
    one = found.scenarios["039"]
    assert (one.category, one.subcategory) == ("Interaction Dynamics", "Collisions")
    assert one.prompts == ("A ball falls.", "A ball is dropped and bounces.")
    assert one.criteria.fields == ("Objects", "Event", "Standard_1", "Standard_2")
    assert found.scenarios["040"].criteria.standards == ("it floats",)
    assert found.passed_over == ("prompt_index_to_prompt.json",)


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("039", {k: v for k, v in RECORD.items() if "index" not in k}),
        ("any", [changed(Prompt_index=None, Physics_index=None, id=39)]),
        ("deep", {"a": {"b": {"c": {"d": RECORD}}}}),
        ("cased", {"key-standards": RECORD["Key_Standards"], "basic standards": {"OBJECTS": ["a ball", "the ground"], "event": ["the ball bounces"]}, "Index": "39-2"}),
        ("result", {"data": RECORD, "response": {"Objects": "Yes"}}),
    ],
)  # fmt: skip
def test_other_layouts_of_the_same_criteria_are_read_alike(tmp_path, name, value):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
    known, _ = published_set.read(written(tmp_path / "a", x=RECORD))
    found, errors = published_set.read(written(tmp_path / "b", **{name: value}))
    assert errors == () and found.scenarios["039"].criteria == known.scenarios["039"].criteria


@pytest.mark.parametrize(
    ("value", "code", "said"),
    [
        ("{", "not_json", "no JSON"),
        ("[" * 100_000, "not_json", "deeply"),
        (changed(Key_Standards=[]), "incomplete", "Key_Standards"),
        (changed(Key_Standards=None), "incomplete", "Key_Standards"),
        (changed(Key_Standards=["a", 3]), "incomplete", "Key_Standards"),
        (changed(Basic_Standards={"Objects": ["x"]}), "incomplete", "Event"),
        (changed(Key_Standards=["it falls \ud83d"]), "incomplete", "half of a character"),
        (changed(Basic_Standards="Objects"), "incomplete", "Objects"),
        ([changed(Prompt_index=None, Physics_index=None)] * 2, "incomplete", "no index"),
        (changed(Key_Standards=["x" * 3000]), "too_large", "3000"),
        (changed(Key_Standards=["x"] * 41), "too_large", "41"),
        ([RECORD, changed(Key_Standards=["another"])], "twice", "039"),
    ],
)
def test_a_malformed_file_is_one_typed_error_and_the_others_are_read(tmp_path, value, code, said):
    good = changed(Prompt_index="001-1", Physics_index="001-2")
    value = value if isinstance(value, str) else json.dumps(value)
    found, errors = published_set.read(written(tmp_path, bad=value, good=good))
    if code == "twice":
        value = json.loads(value)
        found, errors = published_set.read(written(tmp_path, bad=value[0], cc=value[1]))
    assert [error.code for error in errors] == [code] and said in str(errors[0]) and errors[0].next_move
    assert "001" in found.scenarios


def test_nothing_there_is_said(tmp_path):
    for folder in (tmp_path, tmp_path / "none"):
        with pytest.raises(NotFoundError) as told:
            published_set.read(folder)
        assert told.value.next_move
    (tmp_path / "x.json").write_bytes(b"\xff\xfe")
    assert [e.code for e in published_set.read(tmp_path)[1]] == ["not_json"]


def test_the_eighty_prompts_are_ten_of_eight_categories_and_carry_no_criteria():
    found = eighty.prompts()
    assert len({one.id for one in found}) == 80 and all(len(one.id) == 3 for one in found)
    by_category = [one.category for one in found]
    assert {by_category.count(name) for name in by_category} == {10} and len(set(by_category)) == 8
    subcategories = [(one.category, one.subcategory) for one in found]
    assert {subcategories.count(pair) for pair in subcategories} == {2}
    assert set(eighty.Prompt.model_fields) == {"id", "category", "subcategory", "prompt"}
