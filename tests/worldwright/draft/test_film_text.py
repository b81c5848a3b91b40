"""The first film of a run: there from the draft on, for any plan, and nobody's own is written over."""

from pathlib import Path

import numpy as np
import pytest

from worldkit.filming import Film, Recorded
from worldwright.draft.film_text import film_text
from worldwright.draft.writing import film_as_drafted, write_film
from worldwright.model.errors import WorldwrightError
from worldwright.model.evidence.run import Run
from worldwright.model.plan.plan_text import read_plan

CHECKOUT = Path(__file__).parents[3]
PLANS = sorted([*CHECKOUT.glob("examples/*/plan.md"), *CHECKOUT.glob("skills/*/references/*/plan.md")])


def described(text: str, ways: dict[str, np.ndarray], setting: str, duration: float = 3.0) -> dict:
    recorded = Recorded.rehearsal(ways, duration)
    recorded.setting = setting
    space: dict = {}
    exec(compile(text, "film.py", "exec"), space)
    told = Film(recorded)
    space["film"](told)
    return told.description()[0]


def test_the_film_of_every_plan_reads_and_is_shown_whole() -> None:
    assert len(PLANS) > 20
    t = np.linspace(0, 1, 30)[:, None]
    fall, rest = np.hstack([t, 0 * t, 1 - t * t + 0.1]), np.hstack([0 * t, 0 * t, 0 * t + 0.1])
    for path in PLANS:
        plan = read_plan(path).plan
        text = film_text(plan)
        assert max(map(len, text.splitlines())) <= 140, path
        for ways in ({"a": fall, "b": rest}, {"a": rest}):
            facts = described(text, ways, plan.visualization.setting)
            assert facts["shots"] and not facts["captions"], path


def test_a_title_cannot_end_the_docstring(small_plan: str, tmp_path: Path) -> None:
    path = tmp_path / "plan.md"
    path.write_text(small_plan.replace("# A dropped ball", '# A "ball" """ \\ that\'s {dropped}'), encoding="utf-8")
    compile(film_text(read_plan(path).plan), "film.py", "exec")


def test_it_cuts_only_where_either_shot_lasts(small_plan: str, tmp_path: Path) -> None:
    path = tmp_path / "plan.md"
    path.write_text(small_plan, encoding="utf-8")
    text = film_text(read_plan(path).plan)
    t = np.linspace(0, 8, 400)[:, None]
    late = np.hstack([0.2 * np.minimum(t, 4.5), 0 * t, 0.1 + np.clip(t - 4, 0, 0.5)])  # it leaps after four seconds
    assert len(described(text, {"a": late}, "room", 8.0)["shots"]) == 2
    assert len(described(text, {"a": late}, "room", 2.0)["shots"]) == 1


def test_nobodys_film_is_written_over_and_none_after_one_was_taken_away(fresh: Path) -> None:
    run = Run(fresh)
    assert write_film(run) and film_as_drafted(run) and not write_film(run)
    film = fresh / "film.py"
    film.write_text(film.read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
    assert not film_as_drafted(run) and not write_film(run) and film.read_text(encoding="utf-8").endswith("# mine\n")
    film.unlink()
    assert not write_film(run) and not film.exists()


@pytest.mark.parametrize("before", ["accepted", "filmed"])
def test_what_was_filmed_or_accepted_without_one_gets_none(fresh: Path, before: str) -> None:
    run = Run(fresh)
    if before == "accepted":
        run.accepted.mkdir()
    else:
        run.log("stage", "stage", stage="video")
    assert not write_film(run) and not (fresh / "film.py").exists()


def test_a_plan_that_cannot_be_read_is_told(fresh: Path) -> None:
    (fresh / "plan.md").write_text("# nothing\n", encoding="utf-8")
    with pytest.raises(WorldwrightError):
        write_film(Run(fresh))
