"""Everything a report shows, gathered from the run folder; what is not there is named, never fatal.

What is shown of an accepted run is what was accepted, wherever the accepted folder has it: what lies beside it may have been
changed since. The rest is the evidence of the current program, plan and environment.
"""

from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeVar

from pydantic import BaseModel

from ..model.errors import RecordingError, WorldwrightError
from ..model.evidence.audits import Acting, CausesReport, InterventionReport, RefineReport, RobustReport
from ..model.evidence.handed_in import HandedIn, HandedInError
from ..model.evidence.handed_in import of as film_handed_in
from ..model.evidence.reports import ExpectReport, LintReport, PassResult, ScanReport, VisualDescription
from ..model.evidence.run import Run
from ..model.evidence.verdict import Verdict
from ..model.plan.committed import Plan
from ..model.recording.law_balances import LawBalance
from ..model.recording.trajectory_files import read_trajectory
from ..stamp import signing
from ..stamp.interventions import Acted, acted
from ..stamp.kept import Kept
from ..stamp.state import State
from ..stamp.statement import Statement
from ..stamp.status import Status, status
from . import series

T = TypeVar("T", bound=BaseModel)


@dataclass
class Material:
    """The pieces of one report; None or empty where a piece is missing."""

    run: Run
    status: Status
    origin: str
    """Where the evidence comes from: `current`, `accepted`, `earlier` (it does not count any more) or `none`."""
    plan: Plan | None = None
    prompt: str = ""
    plan_text: str = ""
    program: str = ""
    lint: LintReport | None = None
    physics: PassResult | None = None
    stills: dict[str, Path] = field(default_factory=dict)
    videos: dict[str, Path] = field(default_factory=dict)
    film: dict[str, Any] = field(default_factory=dict)
    """What the video pass says of the author's film: what is drawn only, looks of its own, shots; empty without one."""
    handed_in: HandedIn | None = None
    """A film that the author drew with a renderer of their own: of an accepted run the listed one."""
    handed_in_path: Path | None = None
    """Where it lies."""
    scene: bytes | None = None
    """The recorded motion to be turned by hand, glTF, as it was written here."""
    scan: ScanReport | None = None
    expect: ExpectReport | None = None
    interventions: InterventionReport | None = None
    causes: CausesReport | None = None
    refine: RefineReport | None = None
    robust: RobustReport | None = None
    visual: VisualDescription | None = None
    review: Verdict | None = None
    stamp: Statement | None = None
    stamp_sha256: str = ""
    signer: str = ""
    """The signer of the stamp, or that nobody signed it; empty without a stamp."""
    motion: series.Motion | None = None
    ledger: tuple[Acted, ...] | None = None
    """What acted according to the recording itself; used until a scan has written its report."""
    laws: tuple[LawBalance, ...] = ()
    """What the author's own laws give and take."""
    layout: bytes | None = None
    """Top-down drawing, PNG."""
    journal: tuple[dict[str, Any], ...] = ()
    environment: dict[str, Any] = field(default_factory=dict)
    shown_key: str = ""
    """Key of the evidence that is shown."""
    missing: dict[str, str] = field(default_factory=dict)
    """Why a piece is not here, by the piece's name."""


def gather(run: Run) -> Material:
    """Read what is there."""
    state = State(run)
    accepted = state.stamp.value
    found = Material(run=run, status=status(state), origin="none")
    found.plan, found.journal = state.plan, state.journal
    found.prompt, found.plan_text, found.program = _text(run.prompt), _text(run.plan), _text(run.program)
    if state.plan_problem:
        found.missing["plan"] = state.plan_problem
    if accepted and found.status.state == "accepted":
        from ..stamp.bundle import STAMP, sha256_file

        found.stamp, found.stamp_sha256 = accepted, sha256_file(run.stamped / STAMP)
        found.signer = signing.check(run.stamped, STAMP).text()
        if prompt := _accepted(found, run.prompt.name):
            found.prompt = _text(prompt)
    if state.key and state.folder.is_dir():
        found.origin = "current"
        _evidence(found, state.folder)
        found.shown_key = state.key.key
    elif found.stamp:
        found.origin = "accepted"
        found.shown_key = found.stamp.predicate.source.key
        _evidence(found, None)
    elif earlier := _newest(state):
        found.origin = "earlier"
        found.shown_key = earlier.name
        _evidence(found, earlier)
    environment = found.stamp.predicate.environment if found.stamp else state.environment
    if environment:
        found.environment = environment.model_dump()
        if found.stamp:
            found.environment["cpu"] = found.stamp.predicate.cpu
    _motion(found, state)
    _layout(found)
    _handed_in(found)
    _scene(found)
    return found


def _handed_in(found: Material) -> None:
    """Fill in the film that was handed in; of an accepted run no other than its stamp lists."""
    listed = found.stamp.predicate.handed_in if found.stamp else None
    try:
        beside = film_handed_in(found.run.folder)
    except HandedInError as error:
        beside = None
        found.missing["handed-in film"] = error.cause
    if found.stamp is None:
        found.handed_in, found.handed_in_path = beside, found.run.folder / beside.name if beside else None
    elif listed is not None:
        found.handed_in = listed
        found.handed_in_path = _accepted(found, listed.name) or found.run.folder / listed.name
    if found.stamp and beside and (listed is None or beside.sha256 != listed.sha256):
        found.missing["handed-in film"] = f"the {beside.name} in the run is none that its stamp lists: left out"


def _scene(found: Material) -> None:
    """Fill in the scene beside the report: no other than was written here, of the accepted or else the present recording."""
    from .. import exported

    accepted = found.stamp.predicate.proof.trajectory_sha256 if found.stamp else ""
    with suppress(WorldwrightError):  # without a program there is no recording to be of
        found.scene, why = exported.scene(found.run, accepted)
        if why:
            found.missing["scene to be turned by hand"] = why


def _newest(state: State) -> Path | None:
    """The evidence folder of the earlier key that was worked on last."""
    folders = [state.run.evidence(key) for key in state.other_keys]
    results = [folder / "physics" / "result.json" for folder in folders]
    kept = [path for path in results if path.is_file()]
    return max(kept, key=lambda path: path.stat().st_mtime).parents[1] if kept else None


def _accepted(found: Material, name: str) -> Path | None:
    """A file of the accepted folder, which its stamp lists; None where there is none."""
    path = found.run.stamped / name
    return path if found.stamp and found.stamp.digest_of(name) and path.is_file() else None


def _pictures(found: Material, folder: Path | None, kind: str, ending: str) -> dict[str, Path]:
    """Pictures by name: the accepted ones, or else those of the evidence; none by a link."""
    names = [s.name for s in found.stamp.subject] if found.stamp else []
    listed = [name for name in names if name.startswith(f"{kind}/") and name.endswith(ending)]
    if accepted := [path for name in listed if (path := _accepted(found, name))]:
        return {path.stem: path for path in sorted(accepted)}
    drawn = sorted((folder / kind).glob(f"*{ending}")) if folder else []
    if found.stamp and drawn and not listed:
        found.missing[kind] = "drawn since it was accepted: its stamp says nothing of them"
    return {path.stem: path for path in drawn if path.resolve() == path}


def _evidence(found: Material, folder: Path | None) -> None:
    """Fill in the reports and the pictures: of an accepted run the accepted ones, the others from the evidence of a key."""

    def read(name: str, model: type[T]) -> T | None:
        path = _accepted(found, f"evidence/{name}.json")
        if path is None:
            if folder is None:
                return None
            path = folder / (f"{name}/result.json" if model is PassResult else f"{name}.json")
        kept = Kept.read(path, model)
        if kept.problem:
            found.missing[name] = kept.problem
        return kept.value

    found.lint = read("lint", LintReport)
    found.physics = read("physics", PassResult)
    found.scan = read("scan", ScanReport)
    found.expect = read("expect", ExpectReport)
    found.interventions = read("interventions", InterventionReport)
    found.causes = read("causes", CausesReport)
    found.refine = read("refine", RefineReport)
    found.robust = read("robust", RobustReport)
    found.visual = read("visual", VisualDescription)
    found.review = read("review", Verdict)
    found.stills = _pictures(found, folder, "stills", ".png")
    found.videos = _pictures(found, folder, "video", ".mp4")
    video = read("video", PassResult)
    found.film = dict(video.summary.get("film") or {}) if video else {}
    order = ["film"] if found.film else []
    order += [camera.name for camera in found.plan.cameras()] if found.plan else []
    for pictures in (found.stills, found.videos):
        ranked = sorted(pictures.items(), key=lambda item: order.index(item[0]) if item[0] in order else len(order))
        pictures.clear()
        pictures.update(ranked)


def _motion(found: Material, state: State) -> None:
    """Fill in the motion from the recording of the shown key, or else from the stamp's samples."""
    movers = found.plan.movers() if found.plan else ()
    declared = found.plan.declared() if found.plan else ()
    recording = state.run.evidence(found.shown_key or "none") / "physics" / "trajectory"
    if recording.is_dir():
        try:
            if found.stamp and _another(found, recording):
                raise RecordingError(
                    "the recording is another than the accepted one: drawn is what the stamp has of it"
                )
            found.motion = series.read(recording, movers)
            found.ledger = acted(recording, declared)
            if (recording / "balances.arrows").is_file():
                found.laws = read_trajectory(recording).balances
        except WorldwrightError as error:
            found.missing["motion"] = error.cause
        except Exception as cause:  # a report must come out whatever a recording holds
            found.missing["motion"] = f"the recording cannot be drawn: {type(cause).__name__}: {cause}"
    if found.motion is None and found.stamp:
        from ..stamp.digest import stamped_motion

        try:
            sampled = stamped_motion(state.run.stamped, found.stamp)
        except (OSError, ValueError):
            return
        if sampled:
            found.motion = series.from_samples(sampled, found.physics.summary if found.physics else {})


def _another(found: Material, recording: Path) -> bool:
    """Whether a recording is not the one that the accepted report of the physics pass is about."""
    from worldengine.recording import stored

    accepted = _accepted(found, "evidence/physics.json") and found.physics
    said = accepted.summary.get("trajectory_sha256") if accepted else None
    return said is not None and said != stored.digest(stored.open(recording))


def acting(material: Material) -> tuple[Acting, ...] | tuple[Acted, ...] | None:
    """What acted besides the engine's step, by the scan or else by the recording; None when unknown."""
    return material.ledger if material.interventions is None else material.interventions.acting


def _layout(found: Material) -> None:
    """Fill in the top-down drawing."""
    if found.plan is None:
        return
    try:
        from ..place import tools as place

        drawn = place.draw(found.run.plan)
        found.layout = drawn.pictures[0].data if drawn.pictures else None
    except WorldwrightError as error:
        found.missing["layout"] = error.cause
    except Exception as cause:  # a report must come out whatever a plan holds
        found.missing["layout"] = f"the layout cannot be drawn: {type(cause).__name__}: {cause}"


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
