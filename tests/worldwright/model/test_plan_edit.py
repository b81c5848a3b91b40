"""Edits change the values they set and nothing else; fuzzed text is refused or read, never a traceback."""

import math
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from worldwright.model.errors import PlanError
from worldwright.model.plan.committed import TO_CLARIFY, Plan
from worldwright.model.plan.plan_edit import _same, edit
from worldwright.model.plan.plan_text import parse_plan
from worldwright.model.plan.plan_write import write_plan
from worldwright.model.plan.plan_yaml import Node, compose, inline, resolve

GOOD = (Path(__file__).parent / "good_plan.md").read_text(encoding="utf-8")
STYLES = {
    "flow": "  - {subject: ball, predicate: PLACE-ON, object: box, params: {offset: [0, 0]}}",
    "flow with a trailing comma and a comment": "  - {subject: ball, predicate: PLACE-ON, object: box,\n"
    "     params: {offset: [0, 0]}, # the middle\n    }",
    "block": "  - subject: ball   # a comment\n    predicate: PLACE-ON\n    object: box\n\n"
    "    params: {offset: [0, 0]}   # the last",
    "block with nested blocks": "  -\n    subject: ball\n    params:\n      offset:\n      - 0\n      - 0\n"
    "    predicate: PLACE-ON\n    object: box",
    "block with text at the end": "  - subject: ball\n    predicate: PLACE-ON\n    object: box\n"
    "    params: {offset: [0, 0]}\n    description: |\n      It stands\n      on the box.",
    "quoted": '  - {"subject": \'ball\', "predicate": "PLACE-ON", "object": box, "params": {"offset": [0, 0]}}',
}
ROW = ("topology", "scene_predicates", 1)
PIECES = list("{}[]\"'|>#%@\\é~ \n\t\r\u2028\x85\x00\ufeff")
PIECES += ["", "```", "```yaml", "---", "!!x", "1e400", "<!--", "-->", "## ", "# ", "- ", ": ", "&a ", "*a "]
number = st.floats(-1e3, 1e3).map(lambda v: round(v, 6) + 0.0)
text_line = st.text(st.characters(exclude_categories=("Cs", "Cc", "Co", "Cn", "Cf", "Zl", "Zp")), max_size=40)


def styled(style: str, end: str = "\n") -> str:
    return GOOD.replace(STYLES["flow"], STYLES[style]).replace("\n", end)


@pytest.mark.parametrize("end", ["\n", "\r\n"])
@pytest.mark.parametrize("style", STYLES)
@given(x=number, y=number, z=number, deg=number, why=text_line)
@settings(max_examples=20, deadline=None, suppress_health_check=[HealthCheck.too_slow])
def test_a_row_takes_its_pose_in_every_style(style, end, x, y, z, deg, why):
    document = parse_plan(styled(style, end))
    position = {"x": x, "y": y, "z": z}
    edits = [((*ROW, "position"), position), ((*ROW, "orientation"), {"deg_z": deg}), ((*ROW, "provenance"), why)]
    text = edit(document, edits)
    after = parse_plan(text)
    row = after.plan.topology.scene_predicates[1]
    assert row.position.vector == (x, y, z)
    assert (row.orientation.deg_z, row.provenance) == (deg, why)
    assert removed(text, document.text)  # the old text survives as a subsequence: nothing was taken away
    assert edit(after, edits) == text  # again: nothing to do
    moved = edit(after, [((*ROW, "position"), {"x": x, "y": y, "z": z + 1})])
    assert len(changed_lines(text, moved)) == 1
    if end == "\r\n":
        assert moved.count("\n") == moved.count("\r\n")


def removed(longer: str, shorter: str) -> bool:
    rest = iter(longer)
    return all(character in rest for character in shorter)


def changed_lines(before: str, after: str) -> list[int]:
    left, right = before.splitlines(), after.splitlines()
    assert len(left) == len(right)
    return [i for i, (a, b) in enumerate(zip(left, right, strict=True)) if a != b]


@pytest.mark.parametrize(
    ("path", "value"),
    [
        (("simulation_parameters", "time_step"), 0.001),
        (("simulation_parameters", "time_step"), TO_CLARIFY),
        (("simulation_parameters", "seed"), 7),
        (("simulation_parameters", "materials", "steel", "friction"), 0.7),
        (("simulation_parameters", "materials", "steel", "restitution"), 0.5),
        (("plan_type",), "scene"),
        (("visualization", "mode"), "viewer"),
        (("visualization", "floor"), "wood_oak"),
        (("recording_mode", "size"), [640, 480]),
        (("objectives", 0), "It really stays: for good."),
        (("scene_objects", 0, "size"), [2, 1.5, 0.5]),
        (("scene_objects", 0, "look"), "#ffffff"),
        (("implementation_steps", 0, "description"), "Two\nlines: # and more"),
        (("layout_density", "box"), {"min_objects": 1}),
        (("topology", "reference_heights"), {"top": 0.5}),
    ],
    ids=lambda v: ".".join(map(str, v)) if isinstance(v, tuple) else None,
)
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_any_value_can_be_set(path, value, end):
    document = parse_plan(GOOD.replace("\n", end))
    text = edit(document, [(path, value)])
    node = parse_plan(text).node(path[0]) if path[0] in parse_plan(text).nodes else None
    found = node.data() if isinstance(node, Node) else None
    for part in path[1:]:
        found = found if isinstance(found, str) else found[part]
    assert _same(found, value)
    others = [s for s in document.sections if s != path[0]]
    for name in others:
        assert section_text(document, name).strip() == section_text(parse_plan(text), name).strip()


def section_text(document, name: str) -> str:
    section = document.sections[name]
    return document.text[section.heading : section.end]


def test_setting_what_is_there_changes_nothing():
    document = parse_plan(GOOD)
    assert edit(document, [(("scene_objects", 0, "size"), (1.0, 1.0, 0.5)), (("plan_type",), "mbs")]) is document.text


@pytest.mark.parametrize("path", [("nonsense", "x"), ("scene_objects", 7, "size"), ("plan_type", "x", "y")])
def test_a_path_to_nowhere_is_refused(path):
    with pytest.raises(PlanError):
        edit(parse_plan(GOOD), [(path, 1)])


def test_an_edit_that_breaks_the_plan_is_refused_with_findings():
    with pytest.raises(PlanError) as refusal:
        edit(parse_plan(GOOD), [(("simulation_parameters", "time_step"), -1)])
    assert refusal.value.findings
    with pytest.raises(ValueError, match="finite"):
        edit(parse_plan(GOOD), [(("simulation_parameters", "time_step"), math.inf)])


scalars = st.none() | st.booleans() | st.integers(-(10**12), 10**12) | st.floats(allow_nan=False, allow_infinity=False)
scalars |= st.text(st.characters(exclude_categories=("Cs",)), max_size=12)
values = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(st.text(st.characters(exclude_categories=("Cs",)), max_size=8), inner, max_size=4)
    ),
    max_leaves=12,
)


@given(values)
@settings(max_examples=200, deadline=None)
def test_what_is_written_inline_reads_back_the_same(value):
    problems: list = []
    text = f"key: {inline(value)}\n"
    node = compose(text, 0, len(text), lambda *problem: problems.append(problem))
    assert not problems
    assert _same(node["key"].data(), value)


@given(st.text("0123456789+-._eExonulltrfasTFN~ ", max_size=8))
def test_scalars_never_surprise(text):
    value = resolve(text)
    assert value is None or isinstance(value, str | bool | int | float)
    if isinstance(value, float):
        assert math.isfinite(value)


def test_scalars_of_the_core_schema():
    for text in ("no", "yes", "on", "12:30", "1_000", "2026-01-01", "=", "<<", "0x", "1e999", ".nan", ".inf", "+"):
        assert resolve(text) == text
    assert [resolve(t) for t in ("1e-3", ".5", "-2.", "0x10", "0o17", "007", "TRUE", "~", "")] == [
        0.001, 0.5, -2.0, 16, 15, 7, True, None, None,
    ]  # fmt: skip


@given(
    st.lists(
        st.tuples(
            st.integers(0, len(GOOD)),
            st.integers(0, 12),
            st.sampled_from(PIECES),
        ),
        min_size=1,
        max_size=6,
    )
)
@settings(max_examples=400, deadline=None)
def test_a_damaged_plan_is_refused_or_read_but_never_a_traceback(damage):
    text = GOOD
    for at, length, piece in damage:
        text = text[:at] + piece + text[at + length :]
    read_or_refused(text)


@given(st.text(max_size=200))
@settings(max_examples=150, deadline=None)
def test_any_text_is_refused_or_read(text):
    read_or_refused(text)
    read_or_refused(GOOD.replace("time_step: 0.002", text))


def read_or_refused(text: str) -> None:
    try:
        document = parse_plan(text)
    except PlanError as error:
        assert error.findings
        assert all(f.message and f.fix for f in error.findings)
        return
    assert isinstance(document.plan, Plan)
    assert document.text == text
    canonical = write_plan(document.plan)
    assert parse_plan(canonical).plan == document.plan
