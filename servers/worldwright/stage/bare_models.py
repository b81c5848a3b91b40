"""Record any MJCF or URDF file: a model without a plan gets a folder of its own, and the same jobs, sandbox and evidence.

The folder holds `model.json` (which file, for how long, and the SHA-256 of everything the model is made of) and a
program of a few lines that hands the model to worldkit. Nothing is proved, because nothing is claimed; the
recording can be scanned, queried, filmed and compared like any other.
"""

import hashlib
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

from worldkit.files import write_atomic, write_json

from ..model.errors import GateError, JobError, NotFoundError
from ..model.evidence.run import Run, sha256_file
from . import given_models

MOST_FILES = 5_000
PROGRAM = '''"""Records {told} as it is, for {duration:g} s. Made by `worldwright stage start --model`."""

import mujoco

from worldkit import {modules}

MODEL = {path!r}


def build() -> mujoco.MjSpec:
    """The model as its file describes it, with a camera when it has none."""
    spec = {read}
    if not spec.cameras:
        cameras.add(spec, "overview", view="perspective")
    return spec


if __name__ == "__main__":
    program.main(build, duration={duration!r})
'''


def prepare(model: Path, duration: float | None, folder: Path | None) -> Run:
    """The run-like folder of one model, written anew when the model or the duration changed.

    Args:
        model: an MJCF or URDF file; a folder or an archive with one, which is unpacked into the run's folder.
        duration: simulated time, s; 5 when None.
        folder: its folder; `runs/<name of the file, less its endings>` when None.

    Raises:
        NotFoundError: there is no such file, or no model in it.
        JobError: it cannot be read as XML, or names files that are not there.
        GateError: the folder is a run with a plan.
    """
    model = model.absolute()
    if not model.exists():
        raise NotFoundError(
            "there is no such model", place=str(model), next_move="give the path of an MJCF or URDF file"
        )
    run = Run(folder or Path("runs") / given_models.name_of(model))
    if run.plan.exists():
        raise GateError(
            "this folder is a run with a plan, which says what its model is",
            place=str(run.folder),
            next_move="name another folder: `worldwright stage start FOLDER --model FILE`",
        )
    model, root = given_models.the_model(model, run.folder)
    files = {str(path): sha256_file(path) for path in made_of(model, root)}
    facts = {"model": str(model), "duration": duration or 5.0, "files": files}
    if _facts(run) != facts:
        urdf = _is_urdf(model)
        read = f"models.standing(MODEL, {str(root)!r})" if urdf else "mujoco.MjSpec.from_file(MODEL)"
        modules = "cameras, models, program" if urdf else "cameras, program"
        told = {
            "told": _told(model.name),
            "path": str(model),
            "duration": facts["duration"],
            "read": read,
            "modules": modules,
        }
        write_atomic(run.program, PROGRAM.format(**told))
        write_json(run.model, facts)
    return run


def files(run: Run) -> tuple[Path, ...]:
    """The files that a model's program may read besides itself; none for a run with a plan.

    Raises:
        JobError: the model has changed since its folder was made.
    """
    facts = _facts(run)
    changed = [path for path, sha256 in facts.get("files", {}).items() if _sha256(Path(path)) != sha256]
    if changed:
        raise JobError(
            f"the model has changed since its folder was made: {', '.join(changed[:3])}",
            code="refused",
            place=str(run.model),
            next_move=f"worldwright stage start {run.folder} --model {facts.get('model')}",
        )
    return tuple(Path(path) for path in facts.get("files", {}))


def made_of(model: Path, root: Path) -> list[Path]:
    """The file and every file that it names: includes, meshes, textures, height fields, skins, other models.

    Args:
        model: MJCF or URDF.
        root: the folder below which a URDF's files lie.

    Raises:
        JobError: a file cannot be read as XML, includes itself, or names one that is not there.
    """
    if _is_urdf(model):
        return given_models.files_of_urdf(model, root)
    found: dict[Path, None] = {model: None}
    folders = [model.parent]
    named: list[tuple[Path, str]] = []
    queue = [model]
    before: dict[Path, frozenset[Path]] = {model: frozenset()}
    while queue:
        path = queue.pop()
        for tag, attributes in _elements(path):
            if tag == "compiler":
                given = [attributes[name] for name in ("assetdir", "meshdir", "texturedir") if name in attributes]
                folders += [base / name for base in (model.parent, path.parent) for name in given]
            for attribute, value in attributes.items():
                if not attribute.startswith("file") or not value:
                    continue  # an empty name is none: MuJoCo reads `<texture builtin="flat" file=""/>`
                named.append((path, value))
                if tag in ("include", "model"):
                    near = _candidates(path, value, folders[:1])
                    if tag == "include" and any(path.samefile(p) or p in before[path] for p in near):
                        raise _refused(f"it includes itself: {value}", path, "take one of these includes out")
                    before |= {p: before[path] | {path} for p in near if p not in before}
                    queue += [p for p in near if p not in found]
                    found |= dict.fromkeys(near)
        if len(found) + len(named) > MOST_FILES:
            raise JobError(f"the model names more than {MOST_FILES} files", code="refused", place=str(model))
    missing = []
    for path, value in named:
        near = _candidates(path, value, folders)
        found |= dict.fromkeys(near)
        missing += [] if near else [value]
    if missing:
        told = ", ".join(missing[:5]) + (f" and {len(missing) - 5} more" if len(missing) > 5 else "")
        raise _refused(f"the model names files that are not there: {told}", model, "put them where it names them")
    return list(found)


def _told(name: str) -> str:
    """A file's name as it may stand in a program's docstring: another's archive may call a file anything."""
    return re.sub(r"[^\w .-]", "_", name)


def _refused(cause: str, place: Path, next_move: str) -> JobError:
    return JobError(cause, code="refused", place=str(place), next_move=next_move)


def _is_urdf(model: Path) -> bool:
    return next(_elements(model), ("", {}))[0] == "robot"


def _candidates(path: Path, value: str, folders: list[Path]) -> list[Path]:
    """The places to which a name in a model may lead: beside the file, or in the folders of its `compiler`."""
    name = value.removeprefix("package://").removeprefix("file://")
    places = [base / word for base in (path.parent, *folders) for word in (name, Path(name).name)]
    return [place.absolute() for place in dict.fromkeys(places) if place.is_file()]


def _elements(path: Path) -> Iterator[tuple[str, dict[str, str]]]:
    try:
        for element in ElementTree.parse(path).iter():
            yield element.tag, element.attrib
    except (ElementTree.ParseError, OSError, ValueError, RecursionError) as cause:
        line = getattr(cause, "position", (0, 0))[0]
        raise JobError(
            f"the model cannot be read as XML: {cause}",
            code="refused",
            place=f"{path}:{line}" if line else str(path),
            next_move="correct it there: a model is an MJCF file",
        ) from cause


def _facts(run: Run) -> dict[str, Any]:
    try:
        value = json.loads(run.model.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def _sha256(path: Path) -> str:
    try:
        return sha256_file(path)
    except OSError:
        return hashlib.sha256().hexdigest()
