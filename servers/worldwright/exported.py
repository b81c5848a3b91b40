"""`worldwright export RUN --format gltf|usd`: the drawn world with its recorded motion, for other programs and the report."""

import json
import struct
from pathlib import Path
from typing import Any

import click

from worldkit.files import write_atomic

from .cli import report_errors
from .model.evidence.run import Run

FORMATS = {"gltf": "scene.glb", "usd": "scene.usda"}
RECORDING = "recording_sha256"


def write(run: Run, kind: str = "gltf", path: Path | None = None) -> Path:
    """Write a run's scene, beside its report unless a `path` is given; returns where.

    Raises:
        GateError: nothing is recorded of this program and plan.
        JobError: the engine could not write it.
    """
    from .model.evidence import environment
    from .stage.one_frame import given_words, recorded
    from .stage.short_runs import engine

    physics = recorded(run, run.evidence_key(environment.current().sha256()))
    name = FORMATS[kind]
    words = ["scene", *given_words(physics), "--format", kind]
    found = engine(words, (physics,), (name,), again=f"worldwright export RUN --format {kind}")
    target = path or run.folder / name
    write_atomic(target, found[name])
    return target


def scene(run: Run) -> bytes | None:
    """The scene of the present recording that lies beside a run's report; None where there is none, or of another."""
    try:
        data = (run.folder / FORMATS["gltf"]).read_bytes()
        long = struct.unpack_from("<I", data, 12)[0]
        told: dict[str, Any] = json.loads(data[20 : 20 + long])["asset"]["extras"]
    except (OSError, struct.error, ValueError, KeyError, TypeError):
        return None
    from .model.evidence import environment

    recording = run.evidence(run.evidence_key(environment.current().sha256())) / "physics" / "trajectory"
    try:
        ended = json.loads((recording / "complete.json").read_bytes())
    except (OSError, ValueError):
        return None
    return data if ended.get("sha256") == told.get(RECORDING) else None


@click.command("export")
@click.argument("run")
@click.option("--format", "kind", type=click.Choice(tuple(FORMATS)), default="gltf", show_default=True)
@click.option("--out", type=click.Path(path_type=Path), help="The file; beside the report without it.")
def command(run: str, kind: str, out: Path | None) -> None:
    """Write the drawn world with its recorded motion: glTF for viewers and browsers, USD for tools of film and robots.

    A skin over several bodies is carried out as one rigid piece for each of them.
    """
    report_errors(lambda: click.echo(str(write(Run.find(run), kind, out))))
