"""A plan begun from an accepted world is a whole plan that names, in one finding, what is still as it was copied."""

import re
from pathlib import Path

import pytest

from worldwright.lint import tools
from worldwright.model.plan.begun import begun
from worldwright.model.plan.committed import SECTIONS, TO_CHANGE
from worldwright.model.plan.plan_text import parse_plan
from worldwright.place.engine import resolve

REPO = Path(__file__).parents[3]
WORLDS = sorted(REPO.glob("examples/*/plan.md"))
SENTENCE = "a stone is rolled down a slope."


def made(path: Path) -> str:
    return begun(path.read_text(encoding="utf-8"), SENTENCE, path.parent.name)


@pytest.mark.parametrize("world", WORLDS, ids=lambda path: path.parent.name)
def test_the_plan_of_every_world_is_one_to_begin_with(world, tmp_path):
    path = tmp_path / "plan.md"
    path.write_text(made(world), encoding="utf-8")
    (finding,) = tools.check_plan(path).findings
    assert (finding.code, finding.severity) == ("WP133", "error")
    document = parse_plan(path.read_text(encoding="utf-8"))
    assert set(document.sections) == set(SECTIONS)
    assert document.plan.title == "A stone is rolled down a slope"
    scene = resolve(document.plan).scene
    assert scene.ok, scene.findings
    rows = document.plan.topology.scene_predicates
    assert all(row.position is None and row.provenance is None for row in rows)  # the resolver's, not the sentence's
    assert not document.plan.simulation_parameters.inferred


@pytest.mark.parametrize("world", WORLDS, ids=lambda path: path.parent.name)
def test_without_its_marks_it_is_a_plan_without_faults(world, tmp_path):
    path = tmp_path / "plan.md"
    kept = [line for line in made(world).splitlines() if TO_CHANGE not in line]
    path.write_text("\n".join(kept) + "\n", encoding="utf-8")
    assert tools.check_plan(path).findings == ()


def test_scenery_that_nothing_needs_is_left_out_with_its_rows():
    world = REPO / "examples/tetherball-swings/plan.md"
    before, after = (parse_plan(text).plan for text in (world.read_text(encoding="utf-8"), made(world)))
    gone = set(before.object_names()) - set(after.object_names())
    assert gone == {"bench_leg_1", "bench_leg_2", "bench_seat"}
    assert not gone & {row.subject for row in after.topology.scene_predicates}
    assert not gone & set(after.implementation_steps[0].scene_objects)
    assert after.topology.joints == before.topology.joints and after.topology.tendons == before.topology.tendons


def test_the_sums_beside_the_numbers_stay():
    text = made(REPO / "examples/slack-rope-pulls-box/plan.md")
    assert "(4.0 - 1.052) x (0.25 - 29.4 / 800) = 0.63 m" in text


def test_a_mark_in_a_comment_counts_and_a_plan_without_marks_has_none():
    text = (REPO / "examples/rolling-marble/plan.md").read_text(encoding="utf-8")
    assert parse_plan(text).plan.copied == ()
    marked = text.replace("gravity: -9.81", "gravity: -9.81  # TO_CHANGE")
    (line,) = parse_plan(marked).plan.copied
    assert "TO_CHANGE" in marked.splitlines()[line - 1]


COMMON = ("bouncing-basketball", "bowling-pin-tips", "box-slides-to-rest", "breakfast-table", "pendulum-dies-out",
          "rolling-marble", "slack-rope-pulls-box", "two-billiard-balls")  # fmt: skip
PIECES = re.compile(r"[A-Za-z]{1,7}|\d{1,3}|[^\w\s]+|_|\n")
"""About what a language model counts: words in parts of seven letters, numbers in threes, signs that stand together."""


@pytest.mark.parametrize("world", COMMON)
def test_what_a_role_writes_for_a_common_world_is_at_most_2500_tokens(world):
    pieces = len(PIECES.findall(made(REPO / "examples" / world / "plan.md")))
    assert pieces <= 2500, f"{pieces}: what the resolver or `plan complete` writes is no text of a role"


@pytest.mark.parametrize(
    "world", [REPO / "examples/spring-toy-launches/plan.md", REPO / "skills/media/references/two-paints/plan.md"]
)
def test_a_film_is_as_large_as_films_are_and_not_as_small_as_an_example_s(world):
    assert "\nsize: [" in world.read_text(encoding="utf-8")
    recorded = parse_plan(made(world)).plan.recording_mode
    assert (recorded.size, recorded.fps) == ((1280, 720), 24)
