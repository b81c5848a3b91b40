"""A part of an audit whose repetitions are simulated again must be what they show, whatever recordings lie beside the report."""

from pathlib import Path

import mujoco
from staged import Here, World

from worldwright.model.evidence.audits import CausesReport, RobustReport
from worldwright.model.evidence.run import Run
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.audits import acting, repeated, robustness
from worldwright.scan.audits.causes import Causes
from worldwright.scan.audits.refine import refine

CLAIM = {"claim": "it moves", "cause": ["gravity"], "expect": [{"moves": {"body": "ball", "min_m": 0.1}}]}


def dropped() -> mujoco.MjSpec:
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="ball", pos=(0, 0, 1))
    ball.add_freejoint(name="ball")
    ball.add_geom(name="ball", type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.05, 0, 0))
    return spec


def changed(report: CausesReport | RobustReport, trial: str, **facts: str) -> tuple:
    """The repetitions that a report tells of, one of them with other facts."""
    told = report.trials if isinstance(report, CausesReport) else report.worlds
    return tuple(row.model_copy(update=facts) if row.label == trial else row for row in told)


def test_each_part_is_what_its_repetitions_show(tmp_path: Path) -> None:
    world = World(dropped, None, 0.2, ("ball",), objectives=(CLAIM,))
    planned, run = world.run(tmp_path / "planned"), Run(tmp_path)
    now = Here(run, world=world, folder=tmp_path)
    causal = Causes(planned, world.plan, acting.report(planned, Context.of(world.plan)).acting, now)
    causal.plan_trials()
    robustness.ask(now)
    now.collect()
    finer = now.made["time-step-factor 0.5"]
    honest = {
        "causes": causal.report(),
        "robust": robustness.report(planned, world.plan, now),
        "refine": refine(planned, finer, world.plan),
    }

    def wrong(*, exact: bool = True, whole: bool = False, **said: object) -> dict[str, str]:
        found = repeated.parts(run, world.plan, planned, honest | said, whole=whole)  # type: ignore[arg-type]
        for part in found:
            part.trials.made |= {label: now.made[label] for label in part.trials.words}
        return {part.name: why for part in found if (why := repeated.unlike(part, exact=exact))}

    assert len(repeated.parts(run, world.plan, planned, honest)) == 1 + len(robustness.WORLDS) + 1
    assert wrong() == wrong(whole=True) == wrong(exact=False) == {}
    cause, robust, finer_said = honest["causes"], honest["robust"], honest["refine"]
    survives = cause.model_copy(update={"causes": (cause.causes[0].model_copy(update={"outcome": "survives"}),)})
    for exact in (True, False):
        assert "outcome is survives" in wrong(causes=survives, exact=exact)["causes: gravity of objective 0"]
    assert "is None" in wrong(causes=cause.model_copy(update={"causes": ()}))["causes: gravity of objective 0"]
    forged = cause.model_copy(update={"trials": changed(cause, "without gravity", trajectory_sha256="0" * 64)})
    assert "`without gravity` moved as 0000" in wrong(causes=forged)["causes: gravity of objective 0"]
    assert "moved as 0000" in wrong(causes=forged, whole=True)["causes"]
    assert wrong(causes=forged, exact=False) == {}  # elsewhere nothing moves bit for bit
    silent = cause.model_copy(update={"trials": changed(cause, "without gravity", failed="crashed: it did not run")})
    assert (
        "says of `without gravity`: crashed, and here: it ran" in wrong(causes=silent)["causes: gravity of objective 0"]
    )
    limited = cause.model_copy(update={"trials": changed(cause, "without gravity", failed="out_of_memory: too large")})
    gone = cause.model_copy(update={"causes": (), "trials": limited.trials})
    for whole in (False, True):  # a larger machine shows what that one could not, which must then say so
        assert "outcome is caused" in "".join(wrong(causes=limited, exact=whole).values())
        assert [*wrong(causes=gone, whole=whole)] == ["causes" if whole else "causes: gravity of objective 0"]
        room = Here(run, world=world, folder=tmp_path)
        room.made |= now.made
        room.failed["without gravity"] = "out_of_memory: too large"
        del room.made["without gravity"]
        untested = Causes(planned, world.plan, causal.acting, room)
        untested.plan_trials()
        assert untested.report().causes[0].outcome == "unclear"
        assert wrong(causes=untested.report(), whole=whole) == {}
    (held,) = robust.claims
    assert held.holds == held.of == len(robustness.WORLDS) and not held.not_in

    def claimed(**facts: object) -> set[str]:
        """The parts that do not bear out a report whose one claim has other facts; all of it must refuse it, too."""
        told = robust.model_copy(update={"claims": (held.model_copy(update=facts),)})
        assert [*wrong(robust=told, whole=True)] == ["robust"], facts
        return {*wrong(robust=told)}

    every = {part.name for part in repeated.parts(run, world.plan, planned, {"robust": robust})}
    blamed = "vary masses=1.01"
    assert claimed(holds=6, not_in=(blamed,), message=f"{blamed}: it moved nowhere") == {f"robust: {blamed}"}
    assert claimed(holds=99, of=99) == claimed(holds=6) == claimed(message="it never moved") == every
    assert claimed(holds=6, not_in=("vary luck=2",)) == every
    assert {*wrong(robust=robust.model_copy(update={"claims": ()}))} == every
    twice = robust.model_copy(update={"worlds": robust.worlds * 2, "claims": (held.model_copy(update={"of": 14}),)})
    assert {*wrong(robust=twice)} == every
    small = changed(robust, blamed, failed="disk_full: no room", trajectory_sha256="")
    without_it = robust.model_copy(update={"worlds": small, "claims": (held.model_copy(update={"of": 6, "holds": 6}),)})
    assert wrong(robust=without_it) == wrong(robust=without_it, whole=True) == {}
    assert {*wrong(robust=robust.model_copy(update={"worlds": small}))} == every  # it holds in a world that nobody saw
    fewer = finer_said.model_copy(update={"claims": ()})
    assert [*wrong(refine=fewer)] == [*wrong(refine=fewer, exact=False)] == ["refine"]


def test_a_repetition_that_the_machine_had_no_room_for_tells_nothing(tmp_path: Path) -> None:
    world = World(dropped, None, 0.02, ("ball",), objectives=(CLAIM,))
    planned, run = world.run(tmp_path / "planned"), Run(tmp_path)
    said = RobustReport(trajectory_sha256=planned.sha256)
    part = repeated.parts(run, world.plan, planned, {"robust": said})[0]
    (label,) = part.trials.words
    part.trials.failed[label] = "out_of_memory: it was killed"
    assert repeated.unmade(part) == ""
    part.trials.limited.add(label)
    assert repeated.unmade(part) == f"`{label}`: out_of_memory: it was killed"
