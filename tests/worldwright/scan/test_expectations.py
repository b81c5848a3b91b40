import pytest

from worldwright.model.plan import Objective
from worldwright.scan.analytic import bouncing, falling, resting
from worldwright.scan.expecting import EXPECTATIONS, _objective, measure

GOOD = [(e.name, maker, args) for e in EXPECTATIONS.values() for maker, args in e.GOOD]
BAD = [(e.name, maker, args) for e in EXPECTATIONS.values() for maker, args in e.BAD]


@pytest.mark.parametrize(("name", "maker", "arguments"), GOOD, ids=lambda v: v if isinstance(v, str) else "")
def test_what_is_so_holds(name, maker, arguments):
    result = measure(maker(), name, arguments)
    assert result.status == "holds", result.message
    assert result.margin >= 0


@pytest.mark.parametrize(("name", "maker", "arguments"), BAD, ids=lambda v: v if isinstance(v, str) else "")
def test_what_is_not_so_fails(name, maker, arguments):
    result = measure(maker(), name, arguments)
    assert result.status == "fails", result.message
    assert result.margin < 0


def test_every_expectation_has_both_kinds_of_case_and_a_source():
    for entry in EXPECTATIONS.values():
        assert entry.GOOD
        assert entry.BAD
        assert "Source:" in entry.doc


def test_known_answers():
    assert measure(falling(seconds=0.5), "falls", {"body": "body", "min_m": 1}).measured == pytest.approx(
        9.81 / 8, rel=1e-3
    )
    assert measure(falling(seconds=0.5), "reaches_speed", {"body": "body", "min_m_s": 1}).measured == pytest.approx(
        4.905, rel=1e-3
    )
    weight = measure(resting(), "supported_by", {"body": "body", "support": "ground"})
    assert weight.measured == pytest.approx(1.0, rel=1e-2)


def test_a_bounce_is_as_high_as_the_restitution_says():
    result = measure(bouncing(1.0, 0.8), "bounces", {"body": "ball", "min_count": 3, "decays": True})
    assert "up to 0.639" in result.message  # e^2 = 0.64, sampled every millisecond


def test_unknown_names_and_arguments_list_the_known():
    unknown = measure(resting(), "jumps", {"body": "body"})
    assert unknown.status == "unknown"
    assert "stays" in unknown.message
    wrong = measure(resting(), "stays", {"body": "body", "max": 1})
    assert wrong.status == "unknown"
    assert "max_m" in wrong.message
    nobody = measure(resting(), "stays", {"body": "nobody", "max_m": 1})
    assert nobody.status == "unknown"
    assert "body" in nobody.message


@pytest.mark.parametrize(
    ("expect", "visual_only", "status"),
    [
        ([{"stays": {"body": "body", "max_m": 0.1}}], None, "proved"),
        ([{"stays": {"body": "body", "max_m": 0.1}}, {"moves": {"body": "body", "min_m": 1}}], None, "refuted"),
        ([{"stays": {"body": "body", "max_m": 0.1}}, {"jumps": {"body": "body"}}], None, "unproved"),
        ([], "it is a matter of taste", "visual_only"),
        ([], None, "unproved"),
    ],
)
def test_an_objective_ends_up_in_one_of_four_states(expect, visual_only, status):
    objective = Objective.model_validate({"claim": "c", "expect": expect, "visual_only": visual_only})
    assert _objective(resting(), 0, objective).status == status
