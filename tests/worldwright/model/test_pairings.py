"""Frictions that a plan leaves unsaid do not overrule those that it says."""

from worldwright.model.plan.committed import SimulationParameters

SAID = {"friction": 0.3, "torsional_friction": 0.0015, "source": "a table"}


def parameters(used=("peg", "ground", "rubber", "wood", "ice", "tyre"), **more):
    return SimulationParameters(time_step=0.001, simulation_duration=1.0, **more).yielding(used)


def test_an_unsaid_friction_is_no_larger_than_the_smallest_that_is_said():
    made = parameters(
        materials={"peg": SAID, "ground": {"friction": 0.4}, "rubber": {"torsional_friction": 0.01, "friction": 0.9}},
        pairs=({"between": ("top", "ground"), "friction": 0.2},),
    )
    assert made.materials["ground"].torsional_friction == made.pairs[0].torsional_friction == 0.0015
    assert made.materials["ground"].friction == 0.4 and made.materials["rubber"].torsional_friction == 0.01
    assert made.materials["peg"].rolling_friction == 0.0001, "nobody says one"
    assert "torsional_friction" not in made.materials["ground"].model_fields_set


def test_sliding_friction_and_pairs_decide_nothing_of_other_materials():
    ice = {"between": ("puck", "rink"), "friction": 0.02, "torsional_friction": 0.0, "source": "a table"}
    made = parameters(materials={"wood": {"density": 700}, "ice": {"friction": 0.03}}, pairs=(ice,))
    assert made.materials["wood"].friction == 0.5 and made.materials["wood"].torsional_friction == 0.005


def test_an_unsaid_friction_is_not_raised():
    made = parameters(materials={"tyre": {"rolling_friction": 0.02}, "ground": {"friction": 0.4}})
    assert made.materials["ground"].rolling_friction == 0.0001


def test_a_material_that_nothing_is_made_of_decides_nothing():
    """Else a row about no thing of the plan takes a marble's rolling friction away, and no row about it says so."""
    soap = {"rolling_friction": 0.0, "friction": 0.1}
    materials = {"glass": {"friction": 0.4}, "soap": soap}
    assert parameters(used=("glass",), materials=materials).materials["glass"].rolling_friction == 0.0001
    assert parameters(used=("glass", "soap"), materials=materials).materials["glass"].rolling_friction == 0.0
