"""Small worlds whose outcomes are staged, and honest twins of them, run in this process for the audits' tests."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco

from forked_engine import forked_engine
from worldkit import program
from worldwright.model.evidence.audits import CausesReport, InterventionReport
from worldwright.model.evidence.reports import ScanReport
from worldwright.model.evidence.run import Run
from worldwright.model.plan.committed import Plan
from worldwright.model.recording.trajectory import Trajectory
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.scan.anomalies import engine
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.audits import acting
from worldwright.scan.audits.causes import Causes
from worldwright.scan.audits.trials import Trials, variant_name


@dataclass
class World:
    """A program and its plan."""

    build: Callable[[], mujoco.MjSpec]
    control: Callable[..., Any] | None = None
    duration: float = 1.0
    movers: tuple[str, ...] = ()
    interventions: tuple[dict[str, Any], ...] = ()
    objectives: tuple[dict[str, Any], ...] = ({"claim": "it moves", "visual_only": "a test"},)
    motion: dict[str, Any] = field(default_factory=dict)
    before: Callable[[], None] | None = None
    """Called before each run: resets what the program remembers."""

    @property
    def plan(self) -> Plan:
        return Plan.model_validate(
            {
                "plan_type": "mbs",
                "simulation_parameters": {
                    "time_step": 0.002,
                    "simulation_duration": self.duration,
                    "interventions": self.interventions,
                    "initial_motion": self.motion,
                },
                "objectives": self.objectives,
                "implementation_steps": [{"description": "all", "motion_expectations": self.movers}],
            }
        )

    def run(self, folder: Path, *words: str) -> Trajectory:
        """Simulate it with these options."""
        if self.before:
            self.before()
        argv = ["--pass", "physics", "--out", str(folder), *words]
        with forked_engine():
            status = program.main(self.build, self.control, duration=self.duration, argv=argv)
        assert status == 0, (folder / "error.json").read_text()
        return read_trajectory(folder / "trajectory")


@dataclass
class Here(Trials):
    """Repetitions made in this process, without the sandbox."""

    world: World | None = None
    folder: Path = Path()

    def collect(self, timeout_s: float = 0, progress: Any = None) -> bool:
        for label in self.pending:
            try:
                self.made[label] = self.world.run(self.folder / variant_name(label), *self.words[label])
            except AssertionError as failure:
                self.failed[label] = str(failure)
        return True


@dataclass
class Audit:
    """Everything the audits say of a world."""

    scan: ScanReport
    ledger: InterventionReport
    causes: CausesReport
    trajectory: Trajectory

    def codes(self, severity: str = "blocking") -> set[str]:
        """Codes of the findings of one severity, of the scan and of the causal audit."""
        return {a.code for a in (*self.scan.anomalies, *self.causes.anomalies) if a.severity == severity}


def audit(world: World, tmp_path: Path) -> Audit:
    """Run a world, scan it, list its interventions and audit its causes."""
    trajectory = world.run(tmp_path / "planned")
    context = Context.of(world.plan)
    report = engine.scan(trajectory, context)
    listed = acting.report(trajectory, context, report.anomalies)
    trials = Here(Run(tmp_path), world=world, folder=tmp_path)
    causes = Causes(trajectory, world.plan, listed.acting, trials)
    causes.plan_trials()
    trials.collect()
    return Audit(report, listed, causes.report(), trajectory)


def empty(gravity: float = -9.81, floor: bool = True) -> mujoco.MjSpec:
    """A spec with a clock and a floor."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.002
    spec.option.gravity = (0, 0, gravity)
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    if floor:
        spec.worldbody.add_geom(name="ground", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1))
    return spec


def box(spec: mujoco.MjSpec, name: str, pos: Any, size: Any = (0.1, 0.1, 0.1), mass: float = 1.0, **more: Any) -> Any:
    """A loose box (half sizes)."""
    body = spec.worldbody.add_body(name=name, pos=pos)
    body.add_freejoint()
    body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=size, mass=mass, **more)
    return body


def weld(spec: mujoco.MjSpec, name: str, body: str) -> None:
    """Hold a body where it is."""
    held = spec.add_equality(name=name, type=mujoco.mjtEq.mjEQ_WELD, name1=body)
    held.objtype, held.data[:3] = mujoco.mjtObj.mjOBJ_BODY, 0


def declare(
    kind: str, *bodies: str, trigger: str = "always", law: str = "as stated", source: str = "data sheet"
) -> Any:
    """A row of the plan's interventions."""
    return {"kind": kind, "bodies": bodies, "law": law, "trigger": trigger, "source": source}
