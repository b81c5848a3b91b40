"""What the installed build says of a name, and what the changelog says of the past."""

import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.model.errors import NotFoundError
from worldwright.retrieve import tools


@pytest.mark.parametrize(
    ("name", "kind", "says"),
    [
        ("mujoco.mj_ray", "function", "normal"),
        ("mj.mj_ray", "function", "normal"),
        ("mj_ray(m, d)", "function", "normal"),
        ("MjSpec.add_flex", "method", "stressyield"),
        ("mjsGeom.surfacevel", "field", "float64[6, 1]"),
        ("mjModel.geom_size", "field", "geom-specific size parameters"),
        ("MjSpec.worldbody.add_geom", "method", "MjsGeom"),
        ("mjtGeom.mjGEOM_BOX", "enum value", "6"),
        ("mjGEOM_BOX", "enum value", "6"),
        ("xfrc_applied", "field", "nbody x 6"),
        ("<geom surfacevel>", "attribute", "Velocity of the geom's surface"),
        ('<option integrator="discrete"/>', "attribute", "implicitfast"),
        ("geom/surfacevel", "attribute", "Velocity"),
        ("<flexcomp>", "element", "inside <body>"),
        ("mujoco.viewer.launch_passive", "name", ""),
    ],
)
def test_what_exists(name, kind, says):
    answer = tools.symbol(name)
    assert answer.exists and answer.definitions[0].kind == kind
    assert says in answer.text()


@pytest.mark.parametrize("name", ["mj_ray", "<geom surfacevel>", "MjData", "<body>", "mjtGeom", "<option timestep>"])
def test_documented_names_are_cited(name):
    citations = tools.symbol(name).definitions[0].citations
    assert citations
    assert tools.read(citations[0]).content


@pytest.mark.parametrize(
    ("name", "nearest", "version"),
    [
        ("mujoco.mju_rayFlex", "mujoco.mj_rayFlex", "3.5.0"),
        ("<composite>", None, "4.0.0"),
        ("MjOption.time_step", "MjOption.timestep", None),
        ("<geom frction>", "<geom friction>", None),
        ("mjGEOM_CUBE", None, None),
        ("mjData.qM", None, "3.11.0"),
    ],
)
def test_what_does_not_exist(name, nearest, version):
    answer = tools.symbol(name)
    assert not answer.exists and not answer.ok
    if nearest:
        assert nearest in answer.nearest
    if version:
        assert answer.changes[0].version == version


@pytest.mark.parametrize("name", ["", " ", "<", "<>", "...", "a" * 5000, "mujoco.", "<geom", "é.ü", "mj_ray(", "%s"])
def test_odd_names_are_answered(name):
    assert tools.symbol(name).text()


def test_breaking_changes_by_name_and_version():
    table = tools.breaking_changes("flexvert")
    assert table.changes[0].version == "4.0.0" and "discrete" in table.changes[0].migration
    assert tools.read(table.changes[0].cited).content.lstrip().startswith("15.")
    rows = tools.breaking_changes("all", version="4.0.0", k=30)
    assert rows.total >= 12 and all(row.version == "4.0.0" for row in rows.changes)
    assert tools.breaking_changes("no_such_name").text().startswith("the changelog does not mention")


def test_the_command_line_answers_no_with_one():
    run = lambda name: CliRunner().invoke(cli.main, ["retrieve", "symbol", name]).exit_code  # noqa: E731
    assert run("mj_step") == 0 and run("mj_stepp") == 1


def test_assets_are_found_by_what_they_are():
    found = tools.find_asset("a coffee mug")
    assert found.assets[0].key == "mug" and 0.05 < found.assets[0].height_m < 0.2
    none = tools.find_asset("zeppelin")
    assert not none.ok and "mug" in none.known
    assert tools.find_asset("wooden tables").assets[0].key == "table"


@pytest.mark.parametrize(
    ("asked", "key"), [("novel", "book"), ("something to sit on", "chair"), ("notebook computer", "laptop")]
)
def test_assets_are_found_by_what_they_mean(asked, key):
    assert tools.find_asset(asked).assets[0].key == key


def test_of_assets_that_fit_alike_the_one_of_the_size_comes_first():
    small, large = (tools.find_asset("ball", height_m=height).assets for height in (0.057, 0.22))
    assert (small[0].key, large[0].key) == ("billiard_ball", "bowling_ball")
    assert small[0].source == "recipes" and small[0].licence


@pytest.mark.parametrize("asked", ["stone pebble rock", "fist hand paddle", "bowls player's hat"])
def test_a_word_that_only_begins_alike_finds_nothing(asked):
    found = tools.find_asset(asked)
    assert [asset.key for asset in found.assets] == (["bowl"] if "bowls" in asked else [])
    assert found.ok or "build it of primitives" in found.text()


@pytest.mark.parametrize(
    ("asked", "look"),
    [("soccer ball", "football"), ("two tennis balls", "tennis_ball"), ("pebbles", "stone"), ("brass weight", "brass")],
)
def test_looks_that_fit_come_along(asked, look):
    found = tools.find_asset(asked)
    assert found.looks[0].name == look and look in found.text()


def test_a_body_says_what_its_common_arguments_are():
    (box,) = tools.symbol("worldkit.bodies.box").definitions
    assert "yaw_deg: rotation" in box.documentation and "hollow:" in box.documentation
    assert "yaw_deg" not in tools.symbol("worldkit.contacts.surface").text()


def test_a_citation_of_a_function_opens_all_of_it():
    (one,) = tools.symbol("worldkit.tendons.rope").definitions
    assert tools.read(one.citations[0]).content.rstrip().endswith("return made")


def test_a_module_that_is_a_package_now_is_found():
    with pytest.raises(NotFoundError) as told:
        tools.read("worldkit/cameras.py")
    assert "worldkit/cameras/__init__.py" in str(told.value.next_move)


@pytest.mark.parametrize(
    "asked", ["worldkit.contacts.surface", "contacts.surface", "worldkit.joints.Slide", "worldkit.actuators"]
)
def test_names_of_the_runtime_are_known_too(asked):
    answer = tools.symbol(asked)
    assert answer.exists and answer.definitions[0].name == "worldkit." + asked.removeprefix("worldkit.")
    assert "in worldkit" in answer.text() and answer.definitions[0].citations


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ("worldkit.filming.Film", "A film in the making"),
        ("worldkit.filming.Film.mesh", "Draw a mesh that is not simulated"),
        ("Film.grass", "Blades of grass"),
        ("film.light", ""),
        ("worldkit.filming.Film.light", "sun"),
        ("worldkit.filming.follow", "goes along with a body"),
        ("worldkit.filming.Recorded.box", "half extents"),
        ("worldkit.filming.Recorded.floor_z", "Height of the ground"),
        ("worldkit.filming", "follow"),
    ],
)
def test_names_that_a_film_uses_are_found_where_it_imports_them(asked, says):
    answer = tools.symbol(asked)
    if asked == "film.light":  # the variable of a program is no name of the runtime
        assert not answer.exists
        return
    assert answer.exists and says.lower() in answer.text().lower()
    assert tools.read(answer.definitions[0].citations[0]).content


def test_every_public_name_of_the_films_is_found():
    from worldkit import filming

    asked = [*filming.__all__, *(f"Film.{name}" for name in dir(filming.Film) if not name.startswith("_"))]
    asked += [f"Recorded.{name}" for name in dir(filming.Recorded) if not name.startswith("_")]
    assert not [name for name in asked if not tools.symbol(f"worldkit.filming.{name}").exists]


def test_what_neither_has_is_said_of_both():
    assert "nor in worldkit" in tools.symbol("worldkit.levers.Lever").text()


def test_a_name_is_not_explained_by_its_namesake():
    assert not any("renderer" in c for d in tools.symbol("MjsActuator.target").definitions for c in d.citations)
