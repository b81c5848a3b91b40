"""`worldwright asset keep RUN NAME`: what a run sculpted becomes an asset that other plans name, with its source beside it.

The file runs confined, where it sees what lies beside it in the run and nothing else.
"""

import hashlib
import os
import re
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic, write_json

from ..model.errors import NotFoundError
from ..model.evidence.run import Run
from ..model.picture import Illustrated
from ..model.plan import imported
from ..model.plan.committed import Plan
from ..model.plan.pairings import said
from ..model.plan.plan_text import read_plan
from ..model.plan.scene_objects import AssetRow
from ..model.progress import Progress, silent
from ..stage import plain
from ..stage.kept_sculpts import given, needed
from . import registering
from .refusing import IntakeFailedError
from .taking_in import KEY, Destination, added_of, confined_files, drawn

SURFACE = {"torsional_friction": "torsional", "rolling_friction": "rolling"}
"""What a plan says of a surface, as an asset calls it; the other words are the same."""
SOURCE = "source"
"""The folder of an asset with the files that sculpt it, as they lay in the run."""


def keep(
    name: str, thing: str, asked: dict[str, Any], to: Destination, *, replace: bool = False, progress: Progress = silent
) -> Illustrated:
    """Keep what a run sculpted.

    Args:
        name: the run.
        thing: the name of its row of `assets`, or of one of its instances.
        asked: any of `key`, `category`, `description`, `licence`, `creator`.
        to: whose folder it goes into.
        replace: whether it may take the place of an asset of the same key there.
        progress: hears how far it is.

    Raises:
        NotFoundError: there is no such run, or nothing of that name that it sculpts.
        IntakeFailedError: the run is another user's, or its file fails; its `code` says why.
        RegisterError: the key is taken.
        StorageError: the destination cannot be written.
    """
    run = Run.find(name)
    _own(run)
    plan = read_plan(run.plan).plan
    row = _row(plan, thing, run)
    file = row.sculpted[0]
    imported.sculpture(row, run.folder)
    key = asked.get("key") or row.name
    if not KEY.fullmatch(key):
        raise IntakeFailedError(
            f"{key!r} is no key of an asset: lower-case letters, digits and _, a letter first", code="no_key", place=row.name,
            next_move="give it a --key, such as garden_chair",
        )  # fmt: skip
    root = registering.root_of(to)
    registering.free(key, root, replace)
    progress(0, 3, "making it")
    files = needed(run.folder, file)
    with tempfile.TemporaryDirectory(prefix="worldwright-keep-") as folder:
        laid = Path(folder) / "given"
        for path, content in files.items():
            write_atomic(laid / path, content)
        write_json(laid / "request.json", _request(run, plan, row, key, asked, _state(run, files)))
        ended = confined_files(run.folder / file, laid, sculpts=given(files))
        progress(1, 3, "drawing")
        made = {path: data for path, data in ended.items() if path not in ("world.mjz", "program.json")}
        picture, why = drawn(ended, Path(folder) / "laid")
    progress(2, 3, "registering")
    made |= {f"{SOURCE}/{path}": content for path, content in files.items()}
    if picture:
        made["thumbnail.png"] = picture
    placed = registering.register(key, made, root, replace=replace)
    progress(3, 3, "registered")
    return added_of(placed, picture, why, "give it more of a flat base in the run and keep it again with --replace")


def _own(run: Run) -> None:
    """Refuse a run whose plan belongs to another user of this machine: its maker decides what becomes of it."""
    try:
        owner = run.plan.stat().st_uid
    except OSError as error:
        raise NotFoundError(
            f"the run {run.name} has no plan", place=str(run.plan), next_move="name a run with a plan.md"
        ) from error
    if hasattr(os, "getuid") and owner != os.getuid():
        raise IntakeFailedError(
            f"the run {run.name} belongs to another user of this machine", code="not_yours", place=str(run.folder),
            next_move="ask its owner to keep it, or for a copy of the run that is yours",
        )  # fmt: skip


def _row(plan: Plan, thing: str, run: Run) -> AssetRow:
    known = [row for row in plan.assets if imported.is_sculpt(row)]
    found = next((row for row in known if thing in (row.name, *row.instances)), None)
    if found is None:
        names = ", ".join(row.name for row in known)
        raise NotFoundError(
            f"the run {run.name} sculpts nothing called {thing!r}", place=str(run.plan),
            next_move=f"name one of: {names}" if names else "name a run whose `assets` have a row of `type: sculpt`",
        )  # fmt: skip
    return found


def _state(run: Run, files: Mapping[str, bytes]) -> str:
    """Whether the run's stamp lists the plan and these files as they are now."""
    stamp = plain.read_json(run.stamped / "stamp.json")
    if not stamp:
        return "not accepted"
    rows = stamp.get("subject")
    digests = [row.get("digest") for row in rows if isinstance(row, dict)] if isinstance(rows, list) else []
    listed = {str(digest.get("sha256")) for digest in digests if isinstance(digest, dict)}
    now = {hashlib.sha256(content).hexdigest() for content in (run.plan.read_bytes(), *files.values())}
    return "accepted" if now <= listed else "changed since it was accepted"


def _request(run: Run, plan: Plan, row: AssetRow, key: str, asked: dict[str, Any], state: str) -> dict[str, Any]:
    """What the confined process is asked: what makes it, and what the plan says of it."""
    parameters = plan.simulation_parameters
    file, of = row.sculpted
    touch = parameters.materials.get(row.material or "")
    stated = () if touch is None else ("friction", "restitution", "density", *said(touch))
    surface = {SURFACE.get(word, word): value for word in stated if (value := getattr(touch, word)) is not None}
    masses = (parameters.masses.get(one) for one in (row.name, *row.instances))
    mass = next((value for value in masses if value is not None), None)
    told = row.material and f"{row.material}, as the run's plan says it"
    assumed = [] if asked.get("licence") else ["its licence is not stated: give it as --licence"]
    facts = {
        "category": asked.get("category") or "thing",
        "description": asked.get("description") or re.sub(r"[_\d]+", " ", row.name).strip() or row.name,
        "source": f"sculpted by the run {run.name} ({state}), {row.filename}",
        "licence": asked.get("licence") or "not stated",
        "creator": asked.get("creator") or "",
        "metric_height_source": "the run's plan",
        "mass_source": "stated by the run's plan" if mass is not None else "density times volume of its parts",
        **{word: value for word, value in surface.items() if word != "density"},
        "contact_source": told or "not stated",
        "assumed": assumed,
    }
    rest = {"mass": mass, "surface": surface, "look": row.look}
    return {"key": key, "file": file, "of": of, "said": facts, **{word: value for word, value in rest.items() if value}}
