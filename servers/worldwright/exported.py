"""`worldwright export RUN --format gltf|usd|mcap|rosbag2|csv`: the recorded motion for other programs and for the report."""

import json
from pathlib import Path

import click

from worldkit.files import write_atomic

from . import made_scenes
from .cli import report_errors
from .model.errors import GateError, NotFoundError
from .model.evidence.reports import EvidenceKey
from .model.evidence.run import Run
from .model.storage import writing

FORMATS = {
    "gltf": "scene.glb", "usd": "scene.usda", "mcap": "recording.mcap", "rosbag2": "recording.bag", "csv": "recording.zip",
}  # fmt: skip
MESSAGES = ("mcap", "rosbag2", "csv")
"""Of these formats, which tell rows."""
PICTURED = ("mcap", "rosbag2")
"""And which can tell a film, too."""
RATE_HZ = 25.0


def write(
    run: Run, kind: str = "gltf", path: Path | None = None, *, rate_hz: float | None = None, camera: str = ""
) -> Path:
    """Write a run's scene, or its recording as messages, beside its report unless a `path` is given; returns where.

    `rate_hz` (`RATE_HZ` without it) and `camera`, whose film is told, too, are for messages alone; see `ends.ros_rows`.

    Raises:
        GateError: nothing is recorded of this program and plan, or what was filmed is of another.
        JobError: the engine could not write it.
        StorageError: it cannot be written there.
        NotFoundError: the extra (`mcap`, `ros`) is not installed, no such camera was filmed, or the format has none of what is asked.
    """
    if (kind not in MESSAGES and rate_hz is not None) or (kind not in PICTURED and camera):
        asked = "--pictures" if camera else "--rate"
        raise NotFoundError(
            f"{asked} does nothing to {kind}",
            next_move="leave it out, or take --format mcap or rosbag2, which tell rows and pictures (csv tells rows)",
        )
    from .model.evidence import environment
    from .stage.one_frame import given_words, recorded
    from .stage.short_runs import engine

    key = run.evidence_key(environment.current().sha256())
    physics = recorded(run, key)
    name = FORMATS[kind]
    target = path or run.folder / name
    if kind in MESSAGES:
        from worldengine.recording import stored

        from .ends import mcap_file, rosbag_file, tables

        writer = {"mcap": mcap_file, "rosbag2": rosbag_file, "csv": tables}[kind]
        film = _film(run, key, camera) if camera else None
        rate = RATE_HZ if rate_hz is None else rate_hz
        told = stored.open(physics / "trajectory")
        with writing("what is exported", target):
            writer.write(told, target, rate_hz=rate, plan=run.source.read_bytes(), film=film)
        return target
    recording_sha256 = _sha256(physics / "trajectory")
    words = ["scene", *given_words(physics), "--format", kind]
    found = engine(words, (physics,), (name,), again=f"worldwright export RUN --format {kind}")
    with writing("what is exported", target):
        write_atomic(target, found[name])
    if target == run.folder / FORMATS["gltf"]:
        made_scenes.note(run.folder, found[name], recording_sha256)
    return target


def _sha256(recording: Path) -> str:
    """The hash of what is recorded, computed here; a `GateError` where it is another than the recording says."""
    from worldengine.recording import stored

    opened = stored.open(recording)
    found = stored.digest(opened)
    if found != opened.sha256:
        raise GateError(
            f"the recording says it is {opened.sha256[:16]}, and what it holds is {found[:16]}",
            place=str(recording),
            next_move="run the physics pass again: worldwright stage start RUN --stage physics --force",
        )
    return found


def _film(run: Run, key: EvidenceKey, camera: str) -> Path:
    """The film of a camera, which shows the recording frame by frame; the run's own film cuts and slows, and is none."""
    from .stage import gates

    result = gates.passed(run, key, "video")
    if result is None:
        raise GateError(
            "there are no films of this program and plan as they would be drawn now",
            place=str(run.evidence(key) / "video"),
            next_move=f"worldwright stage start {run.folder} --stage video",
        )
    known = [str(name) for name in (result.get("summary") or {}).get("cameras") or ()]
    if camera not in known:
        raise NotFoundError(
            f"no camera {camera!r} was filmed", next_move=f"name one of: {', '.join(known) or '(none)'}"
        )
    return run.evidence(key) / "video" / f"{camera}.mp4"


def scene(run: Run, accepted_sha256: str = "") -> tuple[bytes | None, str]:
    """The scene that lies beside a run's report, as it was written here, and else why it is not shown; both empty where none
    lies there.

    Args:
        run: its folder.
        accepted_sha256: of an accepted run, the hash of the accepted recording, which the scene must be of; else of the present.
    """
    path = run.folder / FORMATS["gltf"]
    try:
        data = path.read_bytes()
    except OSError:
        return None, ""
    of = made_scenes.recording_of(run.folder, data)
    if not of:
        return (
            None,
            f"{path.name} was not written here by `worldwright report`, so nothing says what it shows: left out",
        )
    if accepted_sha256:
        return (
            (data, "")
            if of == accepted_sha256
            else (None, f"{path.name} is of another recording than the accepted one")
        )
    from .model.evidence import environment

    recording = run.evidence(run.evidence_key(environment.current().sha256())) / "physics" / "trajectory"
    try:
        ended = json.loads((recording / "complete.json").read_bytes())
    except (OSError, ValueError):
        return None, ""
    return (
        (data, "") if ended.get("sha256") == of else (None, f"{path.name} is of another recording than the present one")
    )


@click.command("export")
@click.argument("run")
@click.option("--format", "kind", type=click.Choice(tuple(FORMATS)), default="gltf", show_default=True)
@click.option("--out", type=click.Path(path_type=Path), help="The file; beside the report without it.")
@click.option(
    "--rate",
    type=click.FloatRange(min=0),
    help=f"Of messages and tables: rows a simulated second, {RATE_HZ:g} without it; 0: all.",
)
@click.option("--pictures", default="", metavar="CAMERA", help="Of messages: the film of this camera of the plan, too.")
def command(run: str, kind: str, out: Path | None, rate: float | None, pictures: str) -> None:
    """Write the recorded motion: the drawn world as glTF or USD, in ROS 2's messages, as MCAP or a bag (extras `mcap`, `ros`),
    or as a zip of tables (csv), one for each body that moves, with its joints and controls: one a robot.

    A skin over several bodies is carried out as one rigid piece for each of them.
    """
    report_errors(lambda: click.echo(str(write(Run.find(run), kind, out, rate_hz=rate, camera=pictures))))
