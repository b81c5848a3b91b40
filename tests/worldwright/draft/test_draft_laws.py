"""Laws of the author's own in a draft: the class is found in its file, given what the plan knows, and no body stands for what it moves."""

import ast
import builtins
from pathlib import Path

import pytest

from worldwright.draft import assembly
from worldwright.lint.compiled import planned
from worldwright.model.plan.layout import Scene
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.tools import resolve

CORD = Path(__file__).parents[1] / "world" / "rubber-cord.md"
RUBBER = """\
class Rubber:
    name, bodies, shown_by = "rubber", ("weight", "beam"), "cord"
    def __init__(self, shear, density, finer=12):
        pass
"""
SKIN = """\
from worldkit.skins import Gas, Skin, Wall, ball
class Other:
    pass
class Cord(Skin):
    name, bodies, shown_by = "rubber", ("weight", "beam", "world"), "cord"
"""


MATTER = """\
from worldkit.matter import Liquid, Matter
class Honey(Matter):
    name, bodies, shown_by = "rubber", ("weight", "beam"), "cord"
    def __init__(self, density):
        pass
"""


@pytest.fixture
def drafted(tmp_path):
    (tmp_path / "plan.md").write_text(CORD.read_text())

    def draft(law):
        (tmp_path / "laws").mkdir(exist_ok=True)
        if law is not None:
            (tmp_path / "laws/rubber.py").write_text(law)
        layout = Scene(objects=resolve(tmp_path / "plan.md", write=False).objects)
        return assembly.draft(read_plan(tmp_path / "plan.md").plan, layout)

    return draft


def test_a_law_is_made_of_the_plans_constants_and_handed_over(drafted):
    made = drafted(RUBBER)
    assert "from laws.rubber import Rubber\n" in made.source
    assert "RUBBER_LAW = Rubber(shear=SHEAR, density=RUBBER_DENSITY)\n" in made.source
    assert "laws=[RUBBER_LAW]" in made.source
    assert not made.unread
    # Its surface is its author's: nothing rigid stands in for it.
    assert 'bodies.box(spec, "cord"' not in made.source.replace("\n        ", "")
    assert len(made.open_places) == 1 and "moved_shapes.surface" in made.open_places[0]
    assert "# AUTHOR: the law rubber: add what it moves" in made.source


CHECKOUT = Path(__file__).parents[3]
PLANS = [*CHECKOUT.glob("examples/*/plan.md"), *CHECKOUT.glob("skills/[!r]*/references/*/plan.md")]
"""Robots are drafted from models that lie elsewhere: see `tests/skills/test_robot_cases.py`."""


@pytest.mark.parametrize("path", sorted(PLANS), ids=lambda path: path.parent.name)
def test_every_name_that_a_draft_uses_is_one_that_it_defines(path):
    layout = resolve(path, write=False)
    assert layout.ok
    source = assembly.draft(read_plan(path).plan, Scene(objects=layout.objects)).source
    parts = [*ast.walk(ast.parse(source))]
    names = [part for part in parts if isinstance(part, ast.Name)]
    bound = {name.id for name in names if isinstance(name.ctx, ast.Store)} | {*dir(builtins)}
    bound |= {part.name for part in parts if isinstance(part, ast.FunctionDef)}
    bound |= {part.arg for part in parts if isinstance(part, ast.arg)}
    bound |= {(part.asname or part.name).split(".")[0] for part in parts if isinstance(part, ast.alias)}
    assert {name.id for name in names} <= bound


def test_a_constant_that_a_solver_reads_too_is_defined_for_the_law_that_takes_it(drafted, tmp_path):
    plan = tmp_path / "plan.md"
    heat = """\
  warm: {value: [800, 333], unit: K, source: "a hot plate; hot water"}
  heat_capacity: {value: 460, unit: J/(kg K), source: "steel"}
interventions:
  - kind: solver
    bodies: [weight, beam]
    law: "each begins at constants.warm"
    source: constants.warm, constants.heat_capacity
    solver: {name: heat, constants: {warm: warm, specific_heat: heat_capacity}}
"""
    plan.write_text(plan.read_text().replace("interventions:\n", heat))
    made = drafted(RUBBER.replace("shear, density", "warm, shear"))
    assert "RUBBER_LAW = Rubber(warm=WARM, shear=SHEAR)\n" in made.source
    assert "\nWARM = (800.0, 333.0)  # K" in made.source
    assert "HEAT_CAPACITY" not in made.source, "only the solver reads it"


def test_what_no_constant_is_called_is_left_open(drafted):
    made = drafted(RUBBER.replace("density, finer", "stiff, *, tied, finer"))
    assert "RUBBER_LAW = Rubber(shear=SHEAR)\n" in made.source
    assert any("give Rubber its stiff, tied" in place for place in made.open_places)


def test_a_skin_made_in_its_file_is_drafted_whole(drafted):
    made = drafted(SKIN + "CORD = Cord(ball(0.1), Wall(1e6, 1e-3, 950.0), Gas(293.0, 255.0))\n")
    assert made.complete
    assert "from laws.rubber import CORD\n" in made.source and "laws=[CORD]" in made.source
    assert 'moved_shapes.surface(spec, "cord", CORD.points, CORD.triangles, look="rubber_red")' in made.source


def test_matter_is_drafted_whole_as_grains(drafted):
    made = drafted(MATTER)
    assert made.complete
    assert "RUBBER_LAW = Honey(density=RUBBER_DENSITY)\n" in made.source and "laws=[RUBBER_LAW]" in made.source
    grains = 'moved_shapes.grains(spec, "cord", RUBBER_LAW.points, RUBBER_LAW.radius, look="rubber_red")'
    assert grains in made.source


def test_a_law_that_knows_its_surface_is_drafted_whole(drafted):
    made = drafted(RUBBER.replace("pass", "self.points, self.triangles = (), ()"))
    assert made.complete
    assert (
        'moved_shapes.surface(spec, "cord", RUBBER_LAW.points, RUBBER_LAW.triangles, look="rubber_red")' in made.source
    )


def test_a_skin_without_its_shape_is_left_open(drafted):
    assert any("give Cord its shape, wall, gas" in place for place in drafted(SKIN).open_places)


@pytest.mark.parametrize("law", [None, "def (", "LIMIT = 3.0\n"])
def test_a_file_without_a_law_leaves_it_open_and_imports_nothing(drafted, law):
    made = drafted(law)
    assert "from laws" not in made.source and "laws=[" not in made.source
    assert any("hand it over" in place for place in made.open_places)


def test_the_world_that_a_program_is_held_against_runs_nothing_of_a_law(drafted, tmp_path):
    drafted("raise SystemExit\n" + RUBBER)
    own = planned.world(read_plan(tmp_path / "plan.md").plan)
    assert own.status == "compiled", own.message
