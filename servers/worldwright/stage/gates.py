"""Decide from the run's files whether a pass may start.

The bundle, the world as one file, needs this exact plan approved, with the model files that it names. Physics also needs this
exact program linted clean against it; a name that the simulator did not know must have been looked up. Storyboard, stills and
final film need physics on this key, video needs stills. A rehearsal, which nothing rests on, needs neither approval nor lint.
"""

import json
from pathlib import Path
from typing import Any

from worldkit import lock

from ..model import json_object
from ..model.errors import GateError
from ..model.evidence import approval, environment, lookups, pictures_of, rehearsed
from ..model.evidence.reports import EvidenceKey, PassName
from ..model.evidence.run import Run
from .sandbox.confinement import gl_backend

PINNED = "environment.lock"
"""A run that holds this file runs in the environment it names, or not at all."""
BEFORE: dict[PassName, PassName] = {"storyboard": "physics", "stills": "physics", "video": "stills", "final": "physics"}


def folder_name(stage: PassName, variant: str = "") -> str:
    """Name of a pass's folder under `evidence/<key>/`."""
    return f"{stage}@{variant}" if variant else stage


def passed(run: Run, key: EvidenceKey, stage: PassName, variant: str = "") -> dict[str, Any] | None:
    """The result of a pass that succeeded on this key; None if it would come out differently now.

    Physics without its recording (a fresh clone) does not count, nor do pictures of another film: by another renderer,
    other code, or another `film.py`.
    """
    name = folder_name(stage, variant)
    result = _read(run, key, f"{name}/result.json")
    ending = "trajectory/complete.json"
    recorded = stage == "physics" and (not variant or ending in (result.get("files") or {}))
    if recorded and not (run.evidence(key) / name / ending).is_file():
        return None
    if not result.get("ok") or (result.get("film_sha256") or "") != pictures_of.identity(run, stage):
        return None
    return result


def of_another_film(run: Run, key: EvidenceKey) -> list[PassName]:
    """The passes whose pictures exist, but from another renderer or other code than would make them now."""
    stages: tuple[PassName, ...] = ("stills", "video")
    results = {stage: _read(run, key, f"{stage}/result.json") for stage in stages}
    made = [stage for stage, result in results.items() if result.get("ok")]
    return [stage for stage in made if results[stage].get("film_sha256") != pictures_of.identity(run, stage)]


def earlier(run: Run, key: EvidenceKey, variant: str = "") -> list[Path]:
    """At most eight physics passes of other programs or plans in this environment, newest first, one for each motion."""
    name = folder_name("physics", variant)
    found: dict[str, tuple[str, Path]] = {}
    for folder in run.folder.glob(f"evidence/*/{name}"):
        other = json_object.read(folder.parent / "key.json") or {}
        if folder.parent.name == key.key or other.get("environment_sha256") != key.environment_sha256:
            continue
        result = json_object.read(folder / "result.json") or {}
        motion, started = str((result.get("summary") or {}).get("motion_key", "")), str(result.get("started", ""))
        if motion and result.get("ok") and (folder / "trajectory" / "complete.json").is_file():
            found[motion] = max(found.get(motion, ("", folder)), (started, folder))
    return [folder for _, folder in sorted(found.values(), reverse=True)[:8]]


def earlier_pictures(run: Run, stage: PassName) -> list[Path]:
    """At most eight passes that drew pictures of this kind by the renderer and code of now, newest first."""
    drawn = environment.film().sha256
    found: list[tuple[str, Path]] = []
    for folder in run.folder.glob(f"evidence/*/{stage}"):
        result = json_object.read(folder / "result.json") or {}
        summary = result.get("summary") or {}
        if (
            result.get("ok")
            and summary.get("pictures")
            and drawn in (summary.get("drawn_by"), result.get("film_sha256"))
        ):
            found.append((str(result.get("started", "")), folder))
    return [folder for _, folder in sorted(found, reverse=True)[:8]]


def require_environment(run: Run) -> None:
    """Raise a `GateError` with the differences if the run is pinned to another environment."""
    pinned = run.folder / PINNED
    if not pinned.is_file():
        return
    try:
        locked = json.loads(pinned.read_text(encoding="utf-8"))
        found = lock.differences({str(k): str(v) for k, v in locked.items()}, lock.observe(gl_backend()))
    except (OSError, ValueError, AttributeError) as cause:
        found = [f"the lock cannot be read: {cause}"]
    if found:
        raise GateError(
            "this is not the environment the run is pinned to: " + "; ".join(found),
            place=str(pinned),
            next_move=f"install what it names, or pin anew: `worldwright doctor --lock {pinned}`",
        )


def require(run: Run, key: EvidenceKey, stage: PassName, variant: str = "") -> None:
    """Raise a `GateError` with the next command when the pass may not start; a variant needs the pass it varies."""
    before = stage if variant else BEFORE.get(stage)
    if before:
        if passed(run, key, before) is None:
            raise GateError(
                f"the {before} pass has not succeeded for this program and plan",
                place=str(run.evidence(key)),
                next_move=f"worldwright stage start {run.folder} --stage {before}",
            )
        return
    if run.source == run.model:  # a bare model makes no claim that a person would have to approve
        return
    approval.require(run, f"the {stage} pass needs an approval")
    if stage == "bundle" or rehearsed.is_one(run.entries()):  # a rehearsal measures what lint would not let pass, too
        return
    lint = _read(run, key, "lint.json")
    if not lint or any(f.get("severity") == "error" for f in lint.get("findings", ())):
        raise GateError(
            "the program has lint errors" if lint else "the program is not linted against this plan",
            place=str(run.program),
            next_move=f"worldwright lint check-program {run.program} --plan {run.plan}",
        )
    if unknown := lookups.owed(run.entries()):
        raise GateError(
            f"the simulator did not know a name of an earlier program ({unknown}), and nothing was looked up since",
            place=str(run.program),
            next_move=f"worldwright retrieve symbol NAME --run {run.folder}",
        )


def _read(run: Run, key: EvidenceKey, name: str) -> dict[str, Any]:
    return json_object.read(run.evidence(key) / name) or {}
