"""What measurement counts of the water in a glass: the glass's pixels, for its wall lies before all of it."""

from pathlib import Path

from worldwright.model.plan.plan_text import read_plan
from worldwright.stamp import by_measurement

CORK = Path(__file__).parents[3] / "skills/media/references/cork-in-a-glass/plan.md"


def test_the_water_of_a_clear_glass_is_seen_through_it_and_that_of_a_jug_of_clay_is_not(tmp_path: Path) -> None:
    assert by_measurement._seen_through(read_plan(CORK).plan) == {"water": "tumbler"}
    jug = tmp_path / "plan.md"
    jug.write_text(CORK.read_text(encoding="utf-8").replace("look: glass_clear", "look: clay"), encoding="utf-8")
    assert by_measurement._seen_through(read_plan(jug).plan) == {}
