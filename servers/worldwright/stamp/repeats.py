"""What must repeat before a world is accepted: what its program builds, the inputs and the motion.

The program is run once more from nothing: it must build the same world (`rebuilt.compare` held its content against the kept
one) and give the same answers to the same questions. The claims are measured again on that run, because reports in the run folder are files that anybody can write.
Then the world is driven again by the inputs that were recorded, without the program, and must move as it did.
"""

import shutil
from pathlib import Path

from ..model.errors import GateError
from ..model.evidence.reports import PassResult
from ..model.progress import Progress, silent
from . import agreement, digest
from .kept import Kept
from .proof import FACTS, WORLD, Proved, lay_out, measure, replay
from .state import State
from .strip import Stripped

SHARE = 0.02
"""Share of the planned time by which the simulated time may differ."""
REMEDY = "instrumentation must only watch; seed every random draw and read no clock, then run again"


def laid_out(state: State, folder: Path) -> Path | None:
    """The world of the run's physics pass, which is what is accepted, laid out for the proof; None in older evidence."""
    physics = state.folder / "physics"
    if not all((physics / name).is_file() for name in (WORLD, *FACTS)):
        return None
    return lay_out(folder, physics / WORLD, physics)


def same(state: State, stripped: Stripped, proved: Proved) -> None:
    """Refuse a program whose proof run builds another world, answers otherwise or moves differently (`GateError`)."""
    from worldengine.recording import stored

    recording = state.folder / "physics" / "trajectory"
    result = Kept.read(state.folder / "physics" / "result.json", PassResult).value
    world = result.files.get(WORLD, "") if result else ""
    before = (
        f"without its {len(stripped.removed)} lines of instrumentation the program"
        if stripped.removed
        else "run a second time, the program"
    )
    cause = ""
    if not proved.trajectory_sha256 or proved.trajectory_sha256 != state.trajectory_sha256:
        changed = digest.compare(digest.motion(recording), digest.motion(proved.recording)).message
        cause = (
            f"{before} moves differently: trajectory {proved.trajectory_sha256[:16]} instead of "
            f"{state.trajectory_sha256[:16]}; {changed}"
        )
    elif not proved.rebuilt and proved.world_sha256 != world:  # no world was kept to compare contents with
        cause = f"{before} builds another world: {WORLD} {proved.world_sha256[:16]} instead of {world[:16]}"
    elif proved.inputs_sha256 != stored.inputs_digest(recording):
        cause = f"{before} answers otherwise: what it sent to the world is not what was recorded"
    if cause:
        shutil.rmtree(proved.run.folder, ignore_errors=True)  # or the next call would take its result from it
        raise GateError(cause, place=f"{state.place}/simulation.py", next_move=REMEDY)


def whole(state: State, proved: Proved) -> None:
    """Refuse a world that was not simulated for the time that its plan states (`GateError`)."""
    planned = state.plan.simulation_parameters.simulation_duration if state.plan else None
    ran = proved.physics.summary.get("final_time")
    if not isinstance(planned, int | float) or not isinstance(ran, int | float):
        return
    if abs(ran - planned) > SHARE * planned:
        raise GateError(
            f"{ran:.4g} s were simulated, the plan says {planned:.4g} s",
            place=f"{state.place}/simulation.py",
            next_move="let `program.main` run for the plan's simulation_duration, or change the plan and have it approved",
        )


def measured(state: State, proved: Proved) -> None:
    """Measure the proof run, and refuse what it does not show (`GateError`): a claim, a sound motion, or a full ledger."""
    from ..scan import tools as scan
    from . import interventions

    run = str(proved.run.folder)
    report, scanned = measure(proved), scan.scan(run)
    said = state.expect.value
    other = list(
        agreement.other_statuses(agreement.statuses(said) if said else {}, agreement.statuses(report), "reported")
    )
    if said is not None:
        other += agreement.other_numbers(agreement.numbers(said), agreement.numbers(report), 0.0, "reported")
    causes = [f"in the proof run {text}" for text in other]
    causes += [f"the proof run shows {a}" for a in scanned.anomalies if a.severity == "blocking"]
    declared = state.plan.declared() if state.plan else ()
    acted = interventions.acted(proved.recording, declared)
    causes += [f"undeclared intervention in the proof run: {entry}" for entry in acted if not entry.declared]
    if causes:
        more = f" (and {len(causes) - 1} more)" if len(causes) > 1 else ""
        raise GateError(
            f"{causes[0]}{more}",
            place=f"{state.place}/evidence",
            next_move=f"measure it again: worldwright scan expect {state.place}, worldwright scan scan {state.place}",
        )


def driven_again(
    folder: Path, program: bytes, plan: bytes, proved: Proved, *, timeout_s: float, progress: Progress = silent
) -> bool | None:
    """Drive the world by its recorded inputs alone; None when that needs longer, False when nothing drives it.

    Raises:
        GateError: it moves differently.
    """
    if not proved.inputs_sha256 or proved.world is None:
        return False
    given = lay_out(folder / "given", proved.world, proved.world.parent, proved.recording)
    again = replay(folder / "replay", program, plan, given, timeout_s=timeout_s, progress=progress)
    if again is None:
        return None
    if again.trajectory_sha256 != proved.trajectory_sha256:
        shutil.rmtree(folder, ignore_errors=True)
        raise GateError(
            f"driven again by its recorded inputs, the world moves differently: {again.trajectory_sha256[:16]} instead of "
            f"{proved.trajectory_sha256[:16]}",
            place=str(given),
            next_move="this is a defect of the engine's process: report it with the run folder",
        )
    return True
