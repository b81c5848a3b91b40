"""An audit takes each thing away once: by whatever names a cause and a declared intervention go, and a law from all its bodies."""

from dataclasses import replace
from pathlib import Path

import mujoco
import pytest
from staged import Here, World, declare

from worldwright.model.evidence.audits import Acting
from worldwright.model.evidence.run import Run
from worldwright.model.recording.trajectory import Trajectory
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.audits import acting, repeated
from worldwright.scan.audits.causes import Causes

HONEY = declare("solver", "pole", "cup", law="a liquid that draws threads") | {
    "solver": {"name": "honey", "file": "laws/honey.py", "shown_by": "honey"}
}
SERVO = declare("control", "servo", law="PD, 400 N m/rad")
TURNS = {"claim": "the pole turns", "expect": [{"joint_moves": {"joint": "pin", "min_deg": 5}}]}


def turned() -> mujoco.MjSpec:
    """A pole that a servo turns, without gravity."""
    spec = mujoco.MjSpec()
    spec.option.timestep, spec.option.gravity = 0.002, (0, 0, 0)
    pole = spec.worldbody.add_body(name="pole")
    pole.add_joint(name="pin", axis=(0, 1, 0), damping=0.5)
    pole.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=(0.02, 0.2, 0), pos=(0, 0, 0.2), mass=1.0)
    servo = spec.add_actuator(name="servo", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="pin")
    servo.gainprm[0] = 4.0
    return spec


def push(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    data.ctrl[0] = 1.0


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Trajectory:
    return world().run(tmp_path_factory.mktemp("turned") / "planned")


def world(*causes: str, declared: tuple = (SERVO, HONEY)) -> World:
    return World(turned, push, 0.2, ("pole",), interventions=declared, objectives=(TURNS | {"cause": [*causes]},))


def by_law(kind: str, target: str) -> Acting:
    """What a law did to a body, as the ledger's table tells it."""
    return Acting(
        kind=kind, target=target, body=target, count=5, stretches=1, first_s=0.1, last_s=0.2, peak=1.0, unit="N",
        work_j=0.0, impulse_n_s=0.1, declared=True, when="always",
    )  # fmt: skip


def asked(recorded: Trajectory, *causes: str, singly: bool = False) -> list[str]:
    plan = world(*causes).plan
    rows = acting.report(recorded, Context.of(plan)).acting
    pushes = [by_law(kind, target) for target in ("pole", "cup") for kind in ("force", "torque")]
    causal = Causes(recorded, plan, (*rows, *pushes), Here(Run(Path("nowhere"))), singly)
    causal.plan_trials()
    return list(causal.trials.words)


def test_one_thing_under_two_names_is_taken_away_once_and_a_law_from_all_its_bodies(recorded: Trajectory) -> None:
    weaker = ["weaken servo=0.8", "weaken servo=0.5"]
    law = "without solver:pole without solver:cup"
    assert asked(recorded, "servo") == ["without servo", *weaker, law]
    assert asked(recorded, "servo", "actuator:servo") == ["without servo", *weaker, law]
    assert asked(recorded) == ["without actuator:servo", law]
    assert len(asked(recorded, "servo", singly=True)) == 3 + 1 + 4  # as accepted worlds have it
    assert asked(recorded, "solver:pole+solver:cup", "pole")[0] == law


def test_a_name_that_means_more_than_one_thing_is_not_taken_for_one_of_them(recorded: Trajectory) -> None:
    both = {**recorded.meta, "tendons": [{"name": "servo", "bodies": []}]}
    assert "without actuator:servo" in asked(replace(recorded, meta=both), "servo")


def test_what_was_told_of_each_row_by_itself_is_proved_as_it_was_told(tmp_path: Path) -> None:
    staged = world("servo", declared=(SERVO,))
    planned, run = staged.run(tmp_path / "planned"), Run(tmp_path)
    rows = acting.report(planned, Context.of(staged.plan)).acting
    made = {}
    for singly in (True, False):
        causal = Causes(planned, staged.plan, rows, Here(run, world=staged, folder=tmp_path, made=dict(made)), singly)
        causal.plan_trials()
        causal.trials.collect(0)
        made |= causal.trials.made
        report = causal.report()
        assert len(report.trials) == 3 + singly and report.helpers[0].needed_by == (0,)
        for whole in (False, True):
            for part in repeated.parts(run, staged.plan, planned, {"causes": report}, whole=whole):
                part.trials.made |= {label: made[label] for label in part.trials.words}
                assert repeated.unlike(part, exact=True) == "", part.name
