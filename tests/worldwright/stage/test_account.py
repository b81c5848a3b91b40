"""What a finished physics pass tells at a glance."""

from dataclasses import replace

import numpy as np
import pytest

from worldwright.model.plan.committed import Intervention
from worldwright.model.plan.plan_text import parse_plan
from worldwright.model.plan.plan_write import write_plan
from worldwright.scan.known import analytic
from worldwright.stage.account import MOST, account
from worldwright.stage.tools import start, status, wait

PUSHED = """
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 0.1])
    for name, x in (("ball", 0.0), ("stone", 1.0)):
        body = spec.worldbody.add_body(name=name, pos=[x, 0, 0.1])
        body.add_freejoint()
        body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.1, 0.1, 0.1], mass=1)
    return spec

def control(model, data):
    data.body("ball").xfrc_applied[0] = 12.0 if 0.1 <= data.time < 0.3 else 0.0

if __name__ == "__main__":
    program.main(build, duration=0.5, control=control, movers=["ball", "stone"])
"""


def test_what_the_plan_does_not_declare_is_not_asked_for(make, finish):
    job = finish(make(PUSHED))
    assert job.state == "succeeded", job.text()
    assert "control was not asked: the plan declares no input that it may write" in job.account
    assert not any("force" in line for line in job.account)


def test_what_goes_nowhere_is_told_with_its_line_at_every_level(make, level, finish, small_plan):
    source = PUSHED.replace("    data.body", "    data.qvel[6] = 1.0\n    data.body")
    declared = write_plan(declaring(parse_plan(small_plan, file="plan.md").plan, row("force", "ball")))
    job = finish(make(source, plan=declared))
    assert job.state == "succeeded", job.text()
    line = next(n for n, text in enumerate(source.splitlines(), 1) if "data.qvel" in text)
    told = f"control writes what is no declared input, to no effect: data.qvel (simulation.py:{line})"
    assert told in job.account
    assert any(said.startswith("acted besides the engine's step: force on ball") for said in job.account)


def test_wait_and_status_tell_what_the_recording_shows(make, finish, small_plan, snapshot):
    run = make(PUSHED, plan=write_plan(declaring(parse_plan(small_plan, file="plan.md").plan, row("force", "ball"))))
    job = finish(run)
    assert job.state == "succeeded", job.text()
    speed, *rest = job.account
    assert speed.startswith("0.5 s simulated in ")
    assert speed.endswith(" times real time")
    assert rest == snapshot
    assert [*job.account] == [line.removeprefix("- ") for line in job.text().splitlines() if line.startswith("- ")]
    assert status(str(run.folder)).jobs[0].account == job.account
    assert start(str(run.folder)).account == wait(str(run.folder)).account == job.account


def test_a_blow_up_tells_what_was_recorded_until_then(make, finish, small_plan):
    run = make(
        PUSHED.replace("12.0", "1e15"),
        plan=write_plan(declaring(parse_plan(small_plan, file="plan.md").plan, row("force", "ball"))),
    )
    job = finish(run)
    assert job.state == "failed"
    assert any("bad" in line and line.startswith("engine warnings") for line in job.account), job.text()
    assert not any("never moved" in line for line in job.account)


@pytest.fixture
def plan(small_plan):
    plan = parse_plan(small_plan, file="plan.md").plan
    steps = tuple(s.model_copy(update={"motion_expectations": ("body",)}) for s in plan.implementation_steps)
    return plan.model_copy(update={"implementation_steps": steps})


def declaring(plan, *rows):
    parameters = plan.simulation_parameters.model_copy(update={"interventions": rows})
    return plan.model_copy(update={"simulation_parameters": parameters})


def row(kind="force", *bodies, trigger="always"):
    return Intervention(kind=kind, bodies=bodies or ("body",), law="5 N", trigger=trigger, source="test")


def test_what_acted_is_told_with_whether_it_was_meant(plan):
    moved = replace(analytic.falling(), interventions=analytic.pushed())
    assert list(account(moved, declaring(plan, row()), {})) == [
        "acted besides the engine's step: force on body 0.1-0.109 s, up to 5 N (declared)"
    ]
    meant = declaring(plan, row("torque", trigger="once it stands"))
    assert list(account(moved, meant, {})) == [
        "acted besides the engine's step: force on body 0.1-0.109 s, up to 5 N (UNDECLARED)",
        "declared, but never acted: torque on body (trigger: once it stands)",
    ]
    assert list(account(moved, None, {})) == ["acted besides the engine's step: force on body 0.1-0.109 s, up to 5 N"]
    cut = replace(moved, complete=False)
    assert not any("never acted" in line for line in account(cut, meant, {}))


def test_a_gust_with_a_moment_of_its_own_is_no_wind_that_blows_anyway(plan):
    moved = replace(analytic.falling(), interventions=analytic.pushed())
    blown = replace(moved, meta={**moved.meta, "option": {"wind": [2.0, 0.0, 0.0]}})
    for trigger in ("always", "from the start"):
        meant = declaring(plan, row("force", "wind", trigger=trigger))
        assert not any("never acted" in line for line in account(blown, meant, {}))
    told = list(account(blown, declaring(plan, row("force", "wind", trigger="at 0.5 s")), {}))
    assert "declared, but never acted: force on wind (trigger: at 0.5 s)" in told


def test_a_declared_belt_runs_though_the_ledger_has_nothing_of_it(plan):
    moved = replace(analytic.falling(), interventions=analytic.pushed(count=0))
    belt = {"name": "lane", "body": "world", "surfacevel": True}
    running = replace(moved, meta={**moved.meta, "geoms": [belt]})
    for still, name, idle in ((running, "lane", False), (moved, "lane", True), (running, "other", True)):
        told = list(account(still, declaring(plan, row("force", name)), {}))
        assert any("never acted" in line for line in told) == idle


def test_a_mover_that_stays_and_many_warnings_are_told_shortly(plan):
    warned = tuple((0.1 * n, f"warning_{n % (MOST + 2)}", 1) for n in range(2 * (MOST + 2)))
    lines = list(account(replace(analytic.resting(), warnings=warned), plan, {"duration_s": 2.0, "wall_s": 0.5}))
    assert lines[0] == "2 s simulated in 0.5 s: 4 times real time"
    assert lines[1].startswith("engine warnings: warning_0 x2 from 0 s, ")
    assert lines[1].endswith(" and 2 more")
    assert lines[-1] == "never moved, though expected to: body"
    assert not any("never moved" in line for line in account(analytic.falling(), plan, {}))


def test_the_deepest_contact_is_named_with_its_pair_and_moment(plan):
    still = analytic.resting()
    depth = np.where(still.contacts.row == 70, 0.004, 0.0001)
    told = list(account(replace(still, contacts=replace(still.contacts, depth_m=depth)), None, {}))
    assert told == [f"deepest penetration: body and world, 4 mm at {still.t[70]:.4g} s"]
