"""What a plan brings in with parts of its own: asset rows of type `mjcf`, `urdf` and `sculpt`, read from beside the plan or the
catalog, and vehicles, which their numbers make.

A model is metric: it owns its size, its masses and its joints. The text goes into the program, so that evidence covers it.
What a file sculpts has the size that the plan says; the file runs in the sandbox alone, so here nothing is known of it but its text.
"""

import json
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from worldkit import model_files

from .. import companions, syntax
from ..errors import PlanError, WorldwrightError
from .committed import Plan
from .plan_references import WITH_PARTS
from .scene_objects import AssetRow, Vec3
from .walking_rows import policy_of

SUFFIXES = {"mjcf": (".xml", ".mjcf"), "urdf": (".urdf", ".xml")}
ARCHIVES = (".zip", ".tgz", ".gz", ".tar", ".xz", ".bz2")
LIMIT_S = 120.0
_OPTION = re.compile(r"[ \t]*<option\b[^>]*?/>\n?|[ \t]*<option\b[^>]*>.*?</option>\n?", re.DOTALL)
"""Time step, gravity and solver of an MJCF: the plan owns them, so they do not stand a second time in the program."""


@dataclass(frozen=True)
class Imported:
    """A model that a row names."""

    text: str
    folder: str | None
    """The catalog's folder with its meshes; None for a model beside the plan."""
    files: tuple[str, ...]
    """Of a model beside the plan, the meshes and pictures that it reads, relative to the plan's folder."""
    extents: Vec3
    """Extents of the box around its rest pose, m."""
    mass_kg: float
    bodies: tuple[str, ...]
    """Names that its bodies get in the world, for the row's first instance; the root comes first."""
    joints: dict[str, str]
    """Names that its joints get in the world, each with its kind: hinge, slide, ball or free."""
    actuators: tuple[str, ...]

    def names(self) -> set[str]:
        """All names that expectations, motions and joints may use."""
        return {*self.bodies, *self.joints, *self.actuators}


def is_model(row: Any) -> bool:
    """Whether a row brings in a model with bodies and joints of its own."""
    return isinstance(row, AssetRow) and row.type in SUFFIXES


def is_sculpt(row: Any) -> bool:
    """Whether a row is made by a file of Python beside the plan."""
    return isinstance(row, AssetRow) and row.type == "sculpt"


def is_vehicle(row: Any) -> bool:
    """Whether a row is made by `worldkit.vehicles`."""
    return isinstance(row, AssetRow) and row.vehicle is not None


def is_plant(row: Any) -> bool:
    """Whether a row is made by `worldkit.plants`."""
    return isinstance(row, AssetRow) and row.plant is not None


def inner(plan: Plan) -> tuple[str, ...]:
    """What the names of parts and joints begin with that models, sculptures and vehicles bring in."""
    return tuple(f"{name}_" for row in plan.assets if row.type in WITH_PARTS for name in row.instances)


def is_road(row: Any) -> bool:
    """Whether a row brings in a surveyed road."""
    return isinstance(row, AssetRow) and row.type == "road"


def road_box(row: AssetRow, folder: Path | None) -> tuple[Vec3, Vec3]:
    """The lowest and the highest corner of the box around a road, in the frame of its file, m.

    Raises:
        PlanError: the file is not there, or is no OpenCRG file; the message says what is wrong in it.
    """
    from worldkit import roads  # it computes with numpy, which no server loads before it must

    path = _inside(row.filename, folder)
    if path is None or path.suffix != ".crg" or not row.filename.endswith(".crg"):
        raise PlanError(
            f"asset `{row.name}` of type road: there is no file {row.filename} beside the plan",
            next_move="put the OpenCRG file there and name it `roads/NAME.crg`; paths stay inside the folder",
        )
    try:
        status = path.stat()
        return _road_box(str(path), status.st_mtime_ns, status.st_size)
    except (roads.RoadFileError, ValueError) as error:
        raise PlanError(
            f"asset `{row.name}`: {error}",
            place=str(path),
            next_move="take a sound copy of it, or write the road anew (skill vehicles)",
        ) from error


@lru_cache(maxsize=16)
def _road_box(path: str, _changed: int, _size: int) -> tuple[Vec3, Vec3]:
    from worldkit import roads

    return roads.box(roads.read(path))


def made_here(row: AssetRow, instance: str) -> Imported:
    """A vehicle or a plant with the names that its parts have in the world."""
    told = row.vehicle or row.plant
    assert told is not None
    made = told.made()
    x, y, z = made.extents
    return Imported(
        text="",
        folder=None,
        files=(),
        extents=(x, y, z),
        mass_kg=made.mass_kg,
        bodies=made.bodies(instance),
        joints=made.joints(instance),
        actuators=made.actuators(instance),
    )


def sculpture(row: AssetRow, folder: Path | None) -> Path:
    """The file that sculpts a row.

    Raises:
        PlanError: it is not there, or is no Python.
    """
    file, _ = row.sculpted
    home = Path() if folder is None else folder
    path = home / file
    good = file.endswith(".py") and not Path(file).is_absolute() and ".." not in Path(file).parts
    if folder is None or not good or not path.is_file() or not path.resolve().is_relative_to(home.resolve()):
        raise PlanError(
            f"asset `{row.name}` of type sculpt: there is no file {file} beside the plan that could make it",
            next_move="write it there (skill sculpting), and name it `sculpt/NAME.py`; paths stay inside the folder",
        )
    try:
        syntax.module(path.read_bytes())
    except (SyntaxError, ValueError, RecursionError) as cause:
        line = getattr(cause, "lineno", None)
        raise PlanError(
            f"asset `{row.name}`: {file} is not Python: {cause}",
            place=f"{path}:{line}" if line else str(path),
            next_move=f"correct it, then `worldwright sculpt sheet {file}`",
        ) from cause
    return path


def load(row: AssetRow, folder: Path | None, instance: str | None = None) -> Imported:
    """The model of a row, with names as one instance has them (default: the first).

    Args:
        row: of type mjcf or urdf.
        folder: the plan's; files are looked for there, then in the catalog.
        instance: name of an instance.

    Raises:
        PlanError: the file is missing or is no such model; the message names it, and what is wrong in it.
    """
    policy_of(row, folder)
    path, home = _file(row, folder)
    text, files = _text(row, path, folder if home is None else None)
    wanted = {"urdf": "<robot", "mjcf": "<mujoco"}[row.type]
    if wanted not in text and ("<robot" in text or "<mujoco" in text):
        other = "urdf" if row.type == "mjcf" else "mjcf"
        raise PlanError(
            f"asset `{row.name}`: {row.filename} is not of type {row.type}", next_move=f"write `type: {other}`"
        )
    text = _OPTION.sub("", text)
    first = row.instances[0]
    root = folder.absolute() if folder and files else Path()
    try:
        stats = tuple((status.st_mtime_ns, status.st_size) for file in files for status in ((root / file).stat(),))
        known = _facts(text, first, home, files, str(root) if files else "", stats)
    except ValueError as error:
        raise PlanError(
            f"asset `{row.name}`: {row.filename} does not load: {error}",
            next_move=f"correct {row.filename} (skill importing-models); `worldwright stage start RUN --model FILE` shows a file as it is",
        ) from error
    x, y, z = known["extents"]

    def called(own: str) -> str:  # the copies of a row are alike but for their name, with which all in them begins
        return f"{instance or first}{own.removeprefix(first)}"

    return Imported(
        text=text,
        folder=home,
        files=files,
        extents=(x, y, z),
        mass_kg=known["mass"],
        bodies=tuple(map(called, known["bodies"])),
        joints={called(name): kind for name, kind in known["joints"].items()},
        actuators=tuple(map(called, known["actuators"])),
    )


def files(plan: Plan) -> Iterator[Path]:
    """The files beside a plan, relative to it, that its rows name, and what those read; a copy of the plan needs them too."""
    for row in plan.assets:
        if is_model(row) and plan.folder is not None:
            with suppress(PlanError):
                if (
                    policy_of(row, plan.folder) is not None
                    and row.walks is not None
                    and _inside(row.walks.policy, plan.folder)
                ):
                    yield Path(row.walks.policy)
            if _inside(row.filename, plan.folder) is not None:
                yield Path(row.filename)
                with suppress(model_files.ModelFileError, UnicodeDecodeError):
                    made = model_files.whole(plan.folder / row.filename, plan.folder)
                    yield from map(Path, made.files)
                    home = plan.folder.resolve()
                    yield from (source.resolve().relative_to(home) for source in made.sources[1:])
        elif is_road(row) and plan.folder is not None:
            if row.filename.endswith(".crg") and _inside(row.filename, plan.folder) is not None:
                yield Path(row.filename)
        elif is_sculpt(row) and plan.folder is not None:
            with suppress(PlanError):
                path = sculpture(row, plan.folder)
                yield from map(Path, (row.sculpted[0], *companions.of(path, plan.folder)))


def beside(folder: Path) -> dict[str, bytes]:
    """The files that the plan of a run folder names, by path relative to it; nothing when it cannot be read."""
    from .plan_text import read_plan

    with suppress(WorldwrightError, OSError):
        return contents(read_plan(folder / "plan.md").plan)
    return {}


def contents(plan: Plan) -> dict[str, bytes]:
    """The files that a plan names, by path relative to its folder."""
    return {path.as_posix(): (plan.folder / path).read_bytes() for path in files(plan) if plan.folder is not None}


def all_of(plan: Plan) -> Iterator[tuple[str, AssetRow, Imported]]:
    """Every instance of every model of a plan that loads, and of every vehicle and plant, with its row and the names it has in the world."""
    for row in plan.assets:
        if is_vehicle(row) or is_plant(row):
            yield from ((instance, row, made_here(row, instance)) for instance in row.instances)
        elif is_model(row):
            for instance in row.instances:
                with suppress(PlanError):
                    yield instance, row, load(row, plan.folder, instance)


def _inside(name: str, folder: Path | None) -> Path | None:
    """The file of that name below a folder, or None; no name that leads out and back, since others write by it too."""
    if folder is None or Path(name).is_absolute() or ".." in Path(name).parts:
        return None
    path = (folder / name).resolve()
    return path if path.is_file() and path.is_relative_to(folder.resolve()) else None


def _file(row: AssetRow, folder: Path | None) -> tuple[Path, str | None]:
    """Where a row's file is, and its folder if that is in the catalog."""
    from worldkit import assets

    beside = None if folder is None else (folder / row.filename)
    if beside is not None and (beside.is_dir() or beside.suffix.lower() in ARCHIVES):
        models = [path.relative_to(folder or Path()).as_posix() for path in model_files.models_in(beside)[:8]]
        raise PlanError(
            f"asset `{row.name}` of type {row.type}: {row.filename} is no model, but holds some",
            next_move=f"name the model's file: {', '.join(models)}" if models else f"worldwright asset unpack {beside}",
        )
    if not row.filename.endswith(SUFFIXES[row.type]):
        endings = " or ".join(SUFFIXES[row.type])
        raise PlanError(
            f"asset `{row.name}` of type {row.type}: `{row.filename}` is not the name of such a file",
            next_move=f"name a file ending in {endings}, relative to the plan's folder or to the catalog",
        )
    places: list[tuple[Path, str | None]] = [] if folder is None else [(folder, None)]
    with suppress(FileNotFoundError):
        places += [(root, str(Path(row.filename).parent)) for root in (assets.catalog_root(), assets.own_root())]
    for root, home in places:
        if (path := _inside(row.filename, root)) is not None:
            return path, home
    raise PlanError(
        f"asset `{row.name}`: there is no file {row.filename} beside the plan or in the catalog",
        next_move="put the file beside plan.md, or correct `filename`; paths are relative and stay inside the folder",
    )


def _text(row: AssetRow, path: Path, beside: Path | None) -> tuple[str, tuple[str, ...]]:
    """A model's text and, of one that lies beside the plan, the files that it reads."""
    try:
        if beside is not None:
            made = model_files.whole(path, beside)
            return made.text.strip(), made.files
        return path.read_text(encoding="utf-8").strip(), ()
    except (OSError, UnicodeDecodeError) as cause:
        raise PlanError(
            f"asset `{row.name}`: {row.filename} cannot be read: {cause}", next_move="save it as UTF-8 text"
        ) from cause
    except model_files.ModelFileError as error:
        raise PlanError(
            f"asset `{row.name}`: {row.filename} does not load: {error.place}: {error.cause}", next_move=error.next_move
        ) from error


@lru_cache(maxsize=256)
def _facts(
    text: str,
    name: str,
    folder: str | None,
    files: tuple[str, ...] = (),
    root: str = "",
    _stats: tuple[tuple[int, int], ...] = (),
) -> dict[str, Any]:
    """See `worldkit.models.facts`; in a process of its own, for an engine error may end the process it happens in."""
    servers = Path(__file__).parents[3]
    request = json.dumps({"text": text, "name": name, "folder": folder, "files": files, "root": root})
    try:
        done = subprocess.run(
            [sys.executable, "-P", "-m", "worldkit.models"],
            input=request.encode(),
            capture_output=True,
            cwd=servers,
            timeout=LIMIT_S,
            check=False,
        )
    except subprocess.TimeoutExpired as cause:
        raise ValueError(f"it took longer than {LIMIT_S:g} s to read") from cause
    try:
        answer: dict[str, Any] = json.loads(done.stdout)
    except ValueError as cause:
        last = done.stderr.decode(errors="replace").strip().splitlines()
        raise ValueError(f"the engine gave up on it: {last[-1] if last else f'status {done.returncode}'}") from cause
    if "error" in answer:
        raise ValueError(answer["error"])
    return answer
