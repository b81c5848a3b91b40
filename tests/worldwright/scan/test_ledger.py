"""The ledger's tables: impulse, load paths and carriers have the textbook's numbers; triggers are read as written."""

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from staged import World, box, declare, empty

from worldwright.scan.anomalies.checks.unearned_switch import threshold
from worldwright.scan.anomalies.declared import when
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.audits import acting
from worldwright.scan.audits.trials import variant_name
from worldwright.stage.variants import NAME


def listed(world, tmp_path):
    return acting.report(world.run(tmp_path / "t"), Context.of(world.plan))


def test_a_push_has_its_impulse_and_its_work(tmp_path):
    def push(model, data):
        data.xfrc_applied[1, 0] = 5.0 if 0.1 <= data.time < 0.2999 else 0.0

    def build():
        spec = empty(gravity=0.0, floor=False)
        box(spec, "puck", (0, 0, 0), mass=2.0)
        return spec

    world = World(build, push, 0.5, ("puck",), (declare("force", "puck", trigger="from 0.1 to 0.3 s"),))
    (row,) = listed(world, tmp_path).acting
    assert (row.count, row.stretches, row.when, row.declared) == (100, 1, "time", True)
    assert row.impulse_n_s == pytest.approx(1.0)
    assert row.work_j == pytest.approx(0.5 * 2.0 * 0.5**2, rel=1e-6)  # an impulse of 1 N·s on 2 kg
    assert row.airborne_s == pytest.approx(0.2)


def test_what_acts_from_inside_the_step_stands_in_the_ledger(tmp_path):
    def build():
        spec = empty()
        box(spec, "lane", (0, 0, 0.1), mass=2.0)
        spec.geom("lane").surfacevel = (0.3, 0.4, 0, 0, 0, 2.0)
        part = spec.body("lane").add_body(name="pad", pos=(0, 0, 0.12))  # the row names what it is fixed to
        part.add_geom(name="pad", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.05, 0.02), mass=0.1, adhesion=3.0)
        spec.option.wind, spec.option.density = (0, 3.0, 4.0), 1.2
        return spec

    world = World(build, None, 0.01, ("lane",), (declare("force", "lane"),))
    report = listed(world, tmp_path)
    told = {(row.kind, row.unit): (row.target, row.peak, row.declared) for row in report.standing}
    assert told == {
        ("wind", "m/s"): ("world", 5.0, False),
        ("running surface", "m/s"): ("lane", 0.5, True),
        ("running surface", "rad/s"): ("lane", 2.0, True),
        ("adhesion", "N"): ("pad", 3.0, True),
    }
    assert not report.acting and "UNDECLARED" in report.standing[0].text


def test_who_carries_a_stack(tmp_path):
    def build():
        spec = empty()
        box(spec, "lower", (0, 0, 0.1), mass=2.0)
        box(spec, "upper", (0, 0, 0.3), mass=1.0)
        return spec

    paths = {p.bodies: p for p in listed(World(build, None, 2.0), tmp_path).load_paths}
    weight = 9.81 * 2.0  # N times s
    assert paths["world", "lower"].impulse_n_s == pytest.approx(3 * weight, rel=0.05)
    assert paths["lower", "upper"].impulse_n_s == pytest.approx(weight, rel=0.05)
    assert paths["lower", "upper"].share == (pytest.approx(0.25, abs=0.02), pytest.approx(1.0))


def test_what_a_joint_carries(tmp_path):
    def build():
        spec = empty(floor=False)
        for name, x, hung in (("beam", 0, 4.0), ("idle", 3, 0.0)):
            body = spec.worldbody.add_body(name=name, pos=(x, 0, 1))
            body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0))
            body.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=(0.02, 0.2, 0), pos=(0, 0, -0.3), mass=hung or 1.0)
            body.gravcomp = 0.0 if hung else 1.0
        return spec

    found = {c.name: c for c in listed(World(build, None, 0.4), tmp_path).carriers}
    assert found["beam"].peak == pytest.approx(4 * 9.81, rel=0.01) and found["beam"].loaded_share == 1.0


@pytest.mark.parametrize(
    ("trigger", "meant"),
    [
        ("always", "always"), ("", "always"), ("at t = 2 s", "time"), ("t > 3", "time"), ("after 0.5 s", "time"),
        ("from 0.1 to 0.3 s", "time"), ("time >= 2 s", "time"), ("2 s", "time"), ("load > 400 N", "state"),
        ("tension of rope > 30 N", "state"), ("the stone's impact", "state"), ("touches the wall", "state"),
        ("after the impact", "state"), ("total load above 3 N", "state"),
    ],
)  # fmt: skip
def test_triggers_are_told_apart(trigger, meant):
    assert when(trigger) == meant


@pytest.mark.parametrize(
    ("trigger", "meant"),
    [
        ("load > 400 N", ("load", "", True, 400.0)),
        ("tension of rope > 30 N", ("tension", "rope", True, 30.0)),
        ("contact force on plate > 0.05 kN", ("contact force", "plate", True, 50.0)),
        ("speed of cart > 2 m/s", ("speed", "cart", True, 2.0)),
        ("height of ball < 10 cm", ("height", "ball", False, 0.1)),
        ("when it feels right", None),
    ],
)
def test_the_triggers_of_the_skill_can_be_checked(trigger, meant):
    found = threshold(trigger)
    assert (None if found is None else tuple(found)) == (None if meant is None else pytest.approx(meant))


@given(st.text(max_size=120), st.text(max_size=120))
def test_every_repetition_has_a_name_of_its_own(one, other):
    names = [variant_name(f"without {text}") for text in (one, other)]
    assert all(NAME.fullmatch(name) for name in names)
    assert (names[0] == names[1]) == (one == other)


def test_numbers_stay_finite_without_anything(tmp_path):
    report = listed(World(lambda: empty(), None, 0.1), tmp_path)
    assert report.ok and not report.acting and not report.load_paths and not report.carriers
    assert np.isfinite(len(report.model_dump_json()))
