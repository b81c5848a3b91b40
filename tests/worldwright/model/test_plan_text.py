"""Reading plans: every accepted way of writing a section, strictness, and where things stand."""

from pathlib import Path

import pytest

from worldwright.model.errors import PlanError
from worldwright.model.plan.declared_inputs import Intervention, two_ways
from worldwright.model.plan.plan_text import parse_plan, read_plan
from worldwright.model.plan.plan_write import write_plan

GOOD = (Path(__file__).parent / "good_plan.md").read_text(encoding="utf-8")
EXAMPLES = sorted((Path(__file__).parents[3] / "examples").glob("*/plan.md"))


def test_there_are_examples():
    assert len(EXAMPLES) >= 3


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda p: p.parent.name)
def test_examples_read_and_their_canonical_form_means_the_same(path):
    document = read_plan(path)
    assert document.text.encode() == path.read_bytes()
    canonical = write_plan(document.plan)
    assert parse_plan(canonical).plan == document.plan
    assert write_plan(parse_plan(canonical).plan) == canonical


@pytest.mark.parametrize(
    "change",
    [
        lambda t: t.replace("\n", "\r\n"),
        lambda t: "\ufeff" + t,
        lambda t: t.replace("## plan_type", "## 1. Plan Type"),
        lambda t: t.replace("\nmbs\n", "\n`mbs`\n"),
        lambda t: t.replace("\nmbs\n", "\n```yaml\nplan_type: mbs\n```\n"),
        lambda t: t.replace("\nheadless\n", "\n```yaml\nmode: headless\n```\n"),
        lambda t: t.replace("```yaml\ntime_step", "~~~~ yaml\ntime_step").replace("handbook}\n```", "handbook}\n~~~~"),
        lambda t: t.replace("- The ball stays on the box.", "```yaml\n- claim: The ball stays on the box.\n```"),
        lambda t: t.replace("- The ball stays on the box.", "- The ball stays\n  on the box."),
        lambda t: t.replace("## assets\n", "## assets\n\nNone: just primitives.\n"),
        lambda t: t.replace("## assets\n", "<!-- ## objectives\n- name: x -->\n## assets\n"),
        lambda t: t.replace("## assets\n", "### A remark\n\n```python\n# title\n## plan_type\n```\n\n## assets\n"),
        lambda t: t.replace("time_step: 0.002", "time_step: 2e-3"),
        lambda t: t.replace("scene_predicates:\n", "topology:\n  scene_predicates:\n").replace(
            "  - {sub", "    - {sub"
        ),
    ],
)
def test_other_ways_to_write_the_same_plan(change):
    text = change(GOOD)
    assert text != GOOD
    assert parse_plan(text).plan == parse_plan(GOOD).plan


def test_dimensions_as_bullets_a_list_or_a_mapping():
    assets = "## assets\n\n```yaml\n- {name: table, filename: table}\n- {name: lamp, filename: lamp}\n```\n"
    base = GOOD.replace("## assets\n", assets)
    for written in (
        "- table: 0.75   # metres\n- lamp: 0.5\n",
        "```yaml\n- table: 0.75\n- lamp: 0.5\n```\n",
        "```yaml\ntable: 0.75\nlamp: 0.5\n```\n",
    ):
        document = parse_plan(base.replace("## asset_dimensions\n", f"## asset_dimensions\n\n{written}"))
        assert document.plan.asset_dimensions == {"table": 0.75, "lamp": 0.5}
        line = document.line_of("asset_dimensions", "lamp")
        assert "lamp: 0.5" in document.text.splitlines()[line - 1]


@pytest.mark.parametrize("written", ["none", "None.", "`none`", "- none", "n/a"])
def test_a_bare_none_means_that_nothing_is_filmed(written):
    head, rest = GOOD.split("## recording_mode\n")
    base = head + f"## recording_mode\n\n{written}\n\n## " + rest.split("## ", 1)[1]
    assert parse_plan(base).plan.recording_mode.mode == "none"
    assert parse_plan(base.replace(written, "cameras")).plan.recording_mode.mode == "cameras"


def test_whatever_is_marked_to_clarify_is_unresolved():
    marked = GOOD.replace("source: handbook", "source: TO_CLARIFY ask whose table")
    assert list(parse_plan(GOOD).plan.unresolved()) == []
    (path,) = parse_plan(marked).plan.unresolved()
    assert path.startswith("simulation_parameters.materials.") and path.endswith(".source")


UNREAD = {
    "under the title": ("## plan_type", "TO_CLARIFY whether the ball is hollow.\n\n## plan_type"),
    "unfenced, in layout_density": ("## layout_density\n", "## layout_density\n\n- fill TO_CLARIFY\n"),
    "prose, in assets": ("## assets\n", "## assets\n\nA lamp, TO_CLARIFY which one.\n"),
    "a bullet, in assets": ("## assets\n", "## assets\n\n- TO_CLARIFY which lamp\n"),
    "a comment of the YAML": ("time_step:", "# TO_CLARIFY with the user\ntime_step:"),
    "a comment of the markdown": ("## assets\n", "## assets\n\n<!-- TO_CLARIFY which lamp -->\n"),
    "behind a bare word": ("## plan_type\n\nmbs\n", "## plan_type\n\nmbs\n\nTO_CLARIFY or scene?\n"),
}


@pytest.mark.parametrize("where", UNREAD)
def test_what_is_marked_where_no_section_reads_it_is_unresolved(where):
    old, new = UNREAD[where]
    assert GOOD.count(old) == 1
    document = parse_plan(GOOD.replace(old, new))
    ((section, line, text),) = document.plan.open_lines
    assert "TO_CLARIFY" in text and text in document.text.splitlines()[line - 1]
    assert section == ("title" if where == "under the title" else section) and list(document.plan.unresolved())
    assert not list(document.plan.open_values())


def test_a_mark_in_a_value_or_the_title_is_told_once():
    marked = GOOD.replace("source: handbook", "source: TO_CLARIFY ask whose table").replace("# ", "# TO_CLARIFY ", 1)
    assert [place for place in parse_plan(marked).plan.unresolved() if place != "title"] != []
    assert parse_plan(marked).plan.open_lines == () and len(list(parse_plan(marked).plan.unresolved())) == 2


def test_yaml_1_2_scalars():
    text = GOOD.replace("source: handbook", 'source: "no"').replace("name: ball", "name: no").replace("ball", "no")
    assert parse_plan(text).plan.object_names() == ("box", "no")


def test_line_of_points_at_values_and_falls_back_to_what_is_around_them():
    document = parse_plan(GOOD)
    lines = GOOD.splitlines()
    at = document.line_of("topology", "scene_predicates", 1, "params", "offset")
    assert "subject: ball" in lines[at - 1]
    assert document.line_of("topology", "scene_predicates", 1, "position") == at
    assert lines[document.line_of("simulation_parameters", "time_step") - 1].startswith("time_step")
    assert lines[document.line_of("assets", 3, "name") - 1] == "## assets"
    assert document.line_of("nonsense") is None


def test_lines_are_counted_the_same_with_any_line_end():
    for end in ("\n", "\r\n", "\r"):
        broken = GOOD.replace("time_step: 0.002", "time_step: fast").replace("\n", end)
        with pytest.raises(PlanError) as refusal:
            parse_plan(broken)
        assert [f.line for f in refusal.value.findings] == [10]


def test_the_error_shows_the_first_problem_and_holds_all(tmp_path):
    broken = GOOD.replace("time_step: 0.002", "time_step: fast").replace("size: [1, 1, 0.5]", "size: 3")
    with pytest.raises(PlanError) as refusal:
        parse_plan(broken, "somewhere/plan.md")
    assert len(refusal.value.findings) == 2
    assert "2 problems" in str(refusal.value)
    assert "somewhere/plan.md" in str(refusal.value)


def test_an_intervention_may_name_what_only_the_program_has():
    row = "interventions: [{kind: control, bodies: [NAME], law: 60 N, source: its data sheet}]"
    text = GOOD.replace("time_step: 0.002", f"time_step: 0.002\n{row}")
    for name in ("winch", "ball_motor", "ball"):  # an actuator of the program; the plan's own
        assert parse_plan(text.replace("NAME", name)).plan.simulation_parameters.interventions[0].bodies == (name,)
    with pytest.raises(PlanError, match="did you mean `ball`"):  # all but the plan's own name: a slip
        parse_plan(text.replace("NAME", "balls"))


@pytest.mark.parametrize(
    ("law", "refused"),
    [
        ("at most 1,011 N along +X", "1,011 N"),
        ("1,03e1 N", "1,03e1 N"),
        ("1/11 N", "1/11 N"),
        ("10⁻² kN·s, 1 N", "0⁻² kN"),
        ("0.01 × 10^1 N", "10^1 N"),
        ("0.01 x 10 N", "0.01 x 10 N"),
        ("1/2 * 40 N per wheel", "2 * 40 N"),
        ("0.5 * 1.2 kg/m^3 * c A v^2, at most 40 N", ""),
        ("1/2 * 40 N/m, 0.5 * 3 N s/m of it", ""),
        ("1,2 kg/m^3", "1,2 kg/m"),
        ("draws_at, 0.06 m/s", ""),
        ("998 kg/m3 x 9.81 m/s2 x wet volume, and 60 N·s/m of drag", ""),
        ("from 2-5 N to 1e-2 kN, 9.81 m/s^2", ""),
    ],
)
def test_a_number_of_a_law_that_reads_in_two_ways_is_refused(law, refused):
    assert two_ways(law, "force") == refused
    row = {"kind": "force", "bodies": ("ball",), "law": law, "source": "a table"}
    if refused:
        with pytest.raises(ValueError, match="reads in two ways"):
            Intervention.model_validate(row)
    else:
        Intervention.model_validate(row)


def test_a_product_of_densities_is_refused_where_the_density_is_what_the_law_sets():
    assert two_ways("0.5 * 1.2 kg/m^3", "parameter") == "0.5 * 1.2 kg/m"


def test_a_plan_is_parsed_once_for_each_content(planned, tmp_path):
    from worldwright.lint.tools import check_plan
    from worldwright.model.plan import plan_text
    from worldwright.place import tools as place
    from worldwright.stamp import tools as stamp

    plan_text._parsed.cache_clear()
    for _ in range(2):
        check_plan(planned / "plan.md")
        place.resolve(planned / "plan.md", write=False)
        place.check(planned / "plan.md")
        stamp.status(str(planned))
    assert plan_text._parsed.cache_info().misses == 1


def test_each_reader_has_a_plan_that_knows_its_own_folder(planned):
    text = (planned / "plan.md").read_text(encoding="utf-8")
    here, nowhere = read_plan(planned / "plan.md").plan, parse_plan(text, str(planned / "plan.md")).plan
    assert here.folder == planned
    assert nowhere.folder != planned
    assert here == nowhere


@pytest.mark.parametrize("mark", ["\u2028", "\u2029", "\x85", "\x0b", "\x0c", "\u202e"])
def test_a_line_end_that_no_editor_shows_is_refused(small_plan: str, mark: str) -> None:
    """YAML ends a line at some of them, so that a comment would hold a value."""
    with pytest.raises(PlanError, match="control character"):
        parse_plan(small_plan.replace("## ", f"<!-- a remark{mark}gravity: -4.7 -->\n\n## ", 1))


@pytest.mark.parametrize(
    "of_step", [("[box, ball]", "[box, ball, lamp]"), ("[box, ball]", "[ball]\n  assets: [lamp, box]")]
)
def test_a_name_in_the_other_list_of_a_step_is_sent_there(of_step):
    lamp = "## assets\n\n```yaml\n- {name: lamp, type: mesh, filename: lamp.glb}\n```\n"
    with pytest.raises(PlanError) as refusal:
        parse_plan(GOOD.replace(*of_step, 1).replace("## assets\n", lamp, 1))
    (fix,) = [found.fix for found in refusal.value.findings if found.code == "WP013"]
    wanted = "`assets: [lamp]`" if "[box, ball, lamp]" in of_step[1] else "`scene_objects: [box]`"
    assert f"name it in this step's {wanted}" in fix and "add it" not in fix


@pytest.mark.parametrize(("word", "setting"), [("park", "outdoor"), ("still_life", "room")])
def test_a_set_of_a_film_is_no_setting_and_the_remedy_says_where_it_belongs(word, setting):
    with pytest.raises(PlanError) as refusal:
        parse_plan(GOOD.replace("headless", f"```yaml\nsetting: {word}\n```"))
    (found,) = refusal.value.findings
    assert found.code == "WP010" and "did you mean" not in found.fix
    for said in ("settings are studio, room, outdoor, dark", f'film.set("{word}")', f"setting: {setting}"):
        assert said in found.fix


def test_a_number_out_of_bounds_is_told_both_of_them():
    with pytest.raises(PlanError) as refusal:
        parse_plan(
            GOOD.replace(
                "cameras: [perspective]", "cameras: [{name: one, view: perspective, subjects: [box], fovy: 200}]", 1
            )
        )
    (found,) = [one for one in refusal.value.findings if one.code == "WP010"]
    assert "more than 1 and less than 170" in found.fix
