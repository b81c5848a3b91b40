"""Claims that the time step decides are reported; claims that physics decides are not."""

import pytest
from staged import World, box, empty

from worldwright.scan.audits.refine import refine

FALLS = {"claim": "it drops soon", "expect": [{"falls": {"body": "brick", "min_m": 0.6, "window_s": [0, 0.6]}}]}


def both(world, tmp_path):
    one = world.run(tmp_path / "a")
    two = world.run(tmp_path / "b", "--time-step-factor", "0.5")
    return refine(one, two, world.plan)


def dropped():
    spec = empty()
    box(spec, "brick", (0, 0, 1.0))
    return spec


def test_a_fall_is_the_same_at_half_the_step(tmp_path):
    report = both(World(dropped, None, 0.6, ("brick",), objectives=(FALLS,)), tmp_path)
    assert report.ok and report.refined_time_step == pytest.approx(report.time_step / 2)
    (claim,) = report.claims
    assert (claim.at_step, claim.at_finer) == ("holds", "holds")
    position = next(d for d in report.drift if d.quantity == "position")
    assert 0 < position.value < 0.01 and position.body == "brick"


def test_a_program_that_counts_steps_is_an_artefact(tmp_path):
    counted = []

    def hold(model, data):
        counted.append(1)
        data.xfrc_applied[1, 2] = 9.81 * model.body_mass[1] if len(counted) > 150 else 0.0
        if len(counted) > 150:
            data.qvel[:] = 0

    world = World(dropped, hold, 0.6, ("brick",), before=counted.clear)
    world.objectives = ({"claim": "it sinks", "expect": [{"falls": {"body": "brick", "min_m": 0.3}}]},)
    report = both(world, tmp_path)
    assert not report.ok
    (found,) = [a for a in report.anomalies if a.severity == "blocking"]
    assert found.code == "WS311" and "holds at 0.002 s, fails at 0.001 s" in found.message


def test_a_world_that_cannot_be_repeated_says_why(tmp_path):
    world = World(dropped, None, 0.3, ("brick",))
    report = refine(world.run(tmp_path / "a"), None, world.plan, "diverged: brick")
    assert not report.ok and "diverged" in report.anomalies[0].message
