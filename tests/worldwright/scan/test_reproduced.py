"""A report of an audit that its kept repetitions do not show is named, whoever vouches for its bytes."""

from pathlib import Path

import mujoco
import pytest
from staged import Here, World

from worldwright.model.evidence.run import Run
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.audits import acting, reproduced, robustness
from worldwright.scan.audits.causes import Causes
from worldwright.stage import tools as stage


def dropped() -> mujoco.MjSpec:
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="ball", pos=(0, 0, 1))
    ball.add_freejoint(name="ball")
    ball.add_geom(name="ball", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.05, 0, 0))
    return spec


CLAIM = {"claim": "it moves", "cause": ["gravity"], "expect": [{"moves": {"body": "ball", "min_m": 0.1}}]}


def test_a_report_is_what_its_kept_repetitions_show(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world = World(dropped, None, 0.2, ("ball",), objectives=(CLAIM,))
    planned, run = world.run(tmp_path / "planned"), Run(tmp_path)
    trials = Here(run, world=world, folder=tmp_path)
    causal = Causes(planned, world.plan, acting.report(planned, Context.of(world.plan)).acting, trials)
    causal.plan_trials()
    robustness.ask(trials)
    trials.collect()
    robust, causes = robustness.report(planned, world.plan, trials), causal.report()
    causes = causes.model_copy(update={"trials": tuple(t for t in causes.trials if "gravity" in t.label)})

    def kept(run: Run, variant: str) -> Path | None:
        return folder if (folder := tmp_path / variant).is_dir() else None

    monkeypatch.setattr(stage, "variant_folder", kept)

    def told(**said: reproduced.Report) -> list[str]:
        return list(reproduced.unlike(run, world.plan, planned, said))

    assert told(robust=robust, causes=causes) == []
    (row,) = robust.claims
    lies = {
        "causes.json says causes[0].outcome is timed, and its repetitions show caused": causes.model_copy(
            update={"causes": (causes.causes[0].model_copy(update={"outcome": "timed"}),)}
        ),
        "robust.json says claims[0].holds is 6, and its": robust.model_copy(
            update={"claims": (row.model_copy(update={"holds": 6}),)}
        ),
        "causes.json says trials[0].trajectory_sha256 is 0000": causes.model_copy(
            update={"trials": (causes.trials[0].model_copy(update={"trajectory_sha256": "0" * 64}), *causes.trials[1:])}
        ),
        "causes.json says causes[0].message is it does not move at all": causes.model_copy(
            update={"causes": (causes.causes[0].model_copy(update={"message": "it does not move at all"}),)}
        ),
        "robust.json is of another recording": robust.model_copy(update={"trajectory_sha256": "0" * 64}),
    }
    for sentence, report in lies.items():
        (found,) = told(**{sentence.partition(".")[0]: report})
        assert found.startswith(sentence), found
    monkeypatch.setattr(stage, "variant_folder", lambda run, variant: None)
    (found,) = told(causes=causes)
    assert found == (
        "causes.json is told, not shown: of the repetition `without gravity` there is no recording of this key"
    )


def test_a_cause_whose_weaker_repetitions_a_limit_stopped_is_unclear_and_its_report_is_kept(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What nobody saw follow from a weaker cause is no proof; told `caused`, the report is not what its repetitions show."""
    world = World(dropped, None, 0.2, ("ball",), objectives=(CLAIM,))
    planned, run = world.run(tmp_path / "planned"), Run(tmp_path)
    trials = Here(run, world=world, folder=tmp_path)
    causal = Causes(planned, world.plan, acting.report(planned, Context.of(world.plan)).acting, trials)
    causal.ask("gravity")
    weaker = [label for label in trials.words if label.startswith("weaken")]
    trials.failed = dict.fromkeys(weaker, "out_of_cpu_time: it used 60 s")
    trials.limited = set(weaker)
    trials.collect()
    report = causal.report()
    (cause,) = report.causes
    assert cause.outcome == "unclear" and "out_of_cpu_time" in cause.message
    assert [(one.code, one.severity) for one in report.anomalies] == [("WS324", "blocking")]

    def kept(run: Run, variant: str) -> Path | None:
        return folder if (folder := tmp_path / variant).is_dir() else None

    monkeypatch.setattr(stage, "variant_folder", kept)
    assert list(reproduced.unlike(run, world.plan, planned, {"causes": report})) == []
    lie = report.model_copy(update={"causes": (cause.model_copy(update={"outcome": "caused"}),)})
    (found,) = reproduced.unlike(run, world.plan, planned, {"causes": lie})
    assert "outcome is caused, and its repetitions show unclear" in found
