"""A mesh file is copied into a folder of its own, taken in by a confined process, drawn by another, and registered.

Nothing of a stranger's file is parsed in this process: what comes back is an `asset.yaml`, meshes and pictures of bounded size.
"""

import re
import shutil
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from worldkit.files import write_json
from worldkit.intake import unpacked
from worldkit.intake.declared_sizes import MOST_BYTES, PICTURES, USD

from ..model.errors import JobError, NotFoundError
from ..model.frozen import Frozen
from ..model.picture import Illustrated, Picture
from ..model.progress import Progress, silent
from ..place import categories
from ..stage import confined, plain, short_runs
from . import libraries, registering, substances
from .refusing import IntakeFailedError

if TYPE_CHECKING:
    from ..stage.kept_sculpts import Given

Destination = Literal["own", "catalog"]
MEMORY_MB = 6144
LEAST_S, MOST_S, S_A_MB = 120.0, 900.0, 20.0
MOST_BESIDE, BESIDE_BYTES = 200, 256 << 20
KEY = re.compile(r"[a-z][a-z0-9_]{0,59}")
ENTRY = "asset.yaml"
"""What a library lays out under this name is whole."""
FILES = (ENTRY, "look_*.obj", "hull_*.obj", "picture_*.png", "moving.xml", "part_*.obj")
WORLD = ("world.mjz", "program.json")
PASSED = ("height", "units", "up", "front", "mass", "extents", "rotation", "built_up")
"""What the confined process is asked as it stands."""
BELONGING = {
    ".obj": (".mtl", *PICTURES),
    ".dae": PICTURES,
    ".gltf": (".bin", *PICTURES),
    **dict.fromkeys(USD, (*USD, *PICTURES)),
}
"""What a file of a format may read of what lies beside it: materials, pictures, other layers."""
AGAIN = "worldwright asset add FILE"


class Added(Frozen):
    """An asset that was taken in."""

    key: str
    folder: str
    extents_m: tuple[float, float, float]
    mass_kg: float
    collides_as: str
    stands: bool
    holds: bool | None = None
    """Whether a ball dropped into its cavity rests inside; None without a cavity."""
    licence: str
    creator: str = ""
    mended: tuple[str, ...] = ()
    """What was mended, and what was assumed."""
    moving: dict[str, tuple[float, float]] = {}
    """The joints of its parts in `moving.xml`, each with its range, degrees or m; empty where none moves."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Whether it stands still as it is."""
        return self.stands

    def text(self) -> str:
        """What it is, what was done for it, and how a plan names it."""
        size = " x ".join(f"{side:g}" for side in self.extents_m)
        touching = f", collides as {self.collides_as}" if self.collides_as else ""
        lines = [f"{self.key}: {size} m, {self.mass_kg:.3g} kg{touching}"]
        lines.append(f"  {'stands still on a floor for 5 s' if self.stands else 'does not stand still on a floor'}")
        if self.holds is not None:
            lines.append(f"  a ball dropped into it {'rests inside' if self.holds else 'does not stay inside'}")
        lines += [f"  {line}" for line in self.mended]
        if self.moving:
            told = ", ".join(f"{name} {low:g} to {high:g}" for name, (low, high) in self.moving.items())
            row = f"{{name: {self.key}, type: mjcf, filename: {self.key}/moving.xml, fixed: true}}"
            lines.append(f"  its parts move ({told}) where a plan names it as {row}")
        lines.append(f"  licence: {self.licence}" + (f", by {self.creator}" if self.creator else ""))
        return "\n".join([*lines, f"  {self.folder}", f"  next: {self.next_move}"])


def add(
    file: Path, asked: dict[str, Any], to: Destination = "own", *, replace: bool = False, progress: Progress = silent
) -> Illustrated:
    """Take in a mesh file as an asset.

    Args:
        file: GLB, glTF, OBJ, STL, PLY, OFF, COLLADA, 3MF or USD; materials, pictures and layers are looked for beside it. Or a folder
            or a .zip with one such mesh, or the key of an offer of a packaged library.
        asked: any of `key`, `category`, `description`, `licence`, `creator`, `source`, `material`, `height`, `units`, `up`,
            `front`, `mass`.
        to: whose folder it goes into.
        replace: whether it may take the place of an asset of the same key there.
        progress: hears how far it is.

    Raises:
        NotFoundError: there is no such file, or no such material.
        IntakeFailedError: the file cannot become an asset; its `code` says why.
        RegisterError: the key is taken.
        StorageError: the destination cannot be written.
    """
    offer = libraries.offers().get(str(file)) if not file.exists() else None
    if offer is not None:
        if offer.whole:
            _unasked(offer.key, asked)  # before it is made, which takes seconds
        with tempfile.TemporaryDirectory(prefix="worldwright-offer-") as folder:
            laid, told = libraries.SEAM.find(offer.library).lay(offer.key, Path(folder))
            if laid.name == ENTRY:
                return _whole(laid.parent, asked, to, replace, progress)
            called = {"description": offer.described(), "category": offer.name.lower()}
            return _added(laid, {**told, **called, **asked}, to, replace, progress)
    file = file.absolute()
    if not file.is_file() and not file.is_dir():
        raise NotFoundError(
            f"there is no file {file.name}, and no library offers it", place=str(file),
            next_move=f"name one of {', '.join(unpacked.MESHES)}, or a key that `worldwright retrieve find-asset WORDS` tells",
        )  # fmt: skip
    return _added(file, asked, to, replace, progress)


def _unasked(key: str, asked: dict[str, Any]) -> None:
    """Refuse what is asked of an asset that is whole."""
    if asked:
        raise IntakeFailedError(
            f"{key} is an asset as it is, with its own {', '.join(sorted(asked))}", code="decided", place=key,
            next_move=f"worldwright asset add {key}; a plan's `asset_dimensions` gives it another height",
        )  # fmt: skip


def _whole(laid: Path, asked: dict[str, Any], to: Destination, replace: bool, progress: Progress) -> Illustrated:
    """What a library lays out as an asset is registered as it is.

    Raises:
        IntakeFailedError: something is asked that its maker has decided.
        RegisterError: the key is taken.
    """
    _unasked(laid.name, asked)
    root = registering.root_of(to)
    registering.free(laid.name, root, replace)
    files = {path.name: path.read_bytes() for path in laid.iterdir() if path.is_file()}
    picture = files.get("thumbnail.png", b"")
    placed = registering.register(laid.name, files, root, replace=replace)
    progress(3, 3, "registered")
    return added_of(placed, picture, "" if picture else "it could not be drawn")


def _added(file: Path, asked: dict[str, Any], to: Destination, replace: bool, progress: Progress) -> Illustrated:
    request = _request(file, asked)
    root = registering.root_of(to)
    registering.free(request["key"], root, replace)
    progress(0, 3, "reading and mending")
    with tempfile.TemporaryDirectory(prefix="worldwright-intake-") as folder:
        given = Path(folder) / "given"
        request["assumed"] += _lay(file, given)
        write_json(given / "request.json", request)
        ended = confined_files(file, given)
        progress(1, 3, "drawing")
        files = {name: data for name, data in ended.items() if name not in WORLD}
        picture, why = drawn(ended, Path(folder) / "laid")
    progress(2, 3, "registering")
    if picture:
        files["thumbnail.png"] = picture
    placed = registering.register(request["key"], files, root, replace=replace)
    progress(3, 3, "registered")
    return added_of(placed, picture, why)


def _request(file: Path, asked: dict[str, Any]) -> dict[str, Any]:
    key = asked.get("key") or re.sub(r"[^a-z0-9]+", "_", file.stem.lower()).strip("_")[:60]
    if not KEY.fullmatch(key):
        raise IntakeFailedError(
            f"{key!r} is no key of an asset: lower-case letters, digits and _, a letter first", code="no_key", place=file.name,
            next_move="give it a --key, such as garden_chair",
        )  # fmt: skip
    unknown = [name for name in ("height", "mass") if asked.get(name) is not None and not 0 < float(asked[name]) < 1e6]
    if unknown:
        raise IntakeFailedError(
            f"{unknown[0]} is {asked[unknown[0]]!r}",
            code="no_number",
            place=unknown[0],
            next_move="give a positive number of m or kg",
        )
    if asked.get("units") and asked["units"] not in ("m", "cm", "mm", "in", "ft"):
        raise IntakeFailedError(
            f"{asked['units']!r} is no unit of length",
            code="no_unit",
            place="units",
            next_move="give m, cm, mm, in or ft",
        )
    material = asked.get("material") or ""
    found = categories.named((asked.get("category") or key).replace("_", " "))
    assumed = (
        []
        if material or asked.get("mass")
        else [f"it is of {substances.UNSTATED}: give its --material, or its --mass in kg"]
    )
    if asked.get("mass") and not material:
        assumed.append(f"it rubs and bounces as {substances.UNSTATED} does: give its --material")
    if not asked.get("licence"):
        assumed.append("its licence is not stated: give it as --licence")
    return {
        "file": file.name,
        "key": key,
        "category": asked.get("category") or (found.name if found else "thing"),
        "description": asked.get("description") or key.replace("_", " "),
        "licence": asked.get("licence") or "not stated",
        "creator": asked.get("creator") or "",
        "source": asked.get("source") or f"the file {file.name}",
        "material": substances.named(material or substances.UNSTATED),
        "reference": {"name": found.name, "low": found.low_m, "high": found.high_m} if found else None,
        "assumed": assumed,
        **{name: asked[name] for name in PASSED if asked.get(name)},
    }


def _lay(file: Path, given: Path) -> list[str]:
    """Copy the mesh, and what may belong to it beside it and one folder deeper, as far as that is bounded.

    Returns what was left out, to be said.
    """
    given.mkdir()
    if file.is_dir():
        beside = [path for path in file.rglob("*") if path.suffix.lower() in unpacked.WANTED]
        return _copied(beside, file, given / file.name, MOST_BYTES)
    size = file.stat().st_size
    if size > MOST_BYTES:
        raise IntakeFailedError(
            f"it is larger than {MOST_BYTES >> 20} MB", code="too_large", place=str(file),
            next_move="reduce it to fewer faces in a modelling program, then add it again",
        )  # fmt: skip
    shutil.copyfile(file, given / file.name)
    wanted = BELONGING.get(file.suffix.lower(), ())
    if not wanted:
        return []
    folder = file.parent
    beside = sorted(path for pattern in ("*", "*/*") for path in folder.glob(pattern) if path.suffix.lower() in wanted)
    return _copied(beside, folder, given, BESIDE_BYTES)


def _copied(paths: list[Path], folder: Path, given: Path, left: int) -> list[str]:
    """Copy files to where they lie below a folder, meshes and materials first, as far as they are bounded; no links.

    Returns what was left out, to be said.
    """
    given.mkdir(exist_ok=True)
    real = folder.resolve()
    # A folder that is a link may lead anywhere, and what lies there is not what was given.
    own = [path for path in paths if path.resolve().is_relative_to(real) and not path.is_symlink() and path.is_file()]
    own.sort(key=lambda path: (path.suffix.lower() in PICTURES, path))
    lost = own[MOST_BESIDE:]
    for path in own[:MOST_BESIDE]:
        size = path.stat().st_size
        if size > left:
            lost.append(path)
            continue
        left -= size
        target = given / path.relative_to(folder)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, target)
    return (
        [f"{len(lost)} files beside it were left out, such as {lost[0].name[:80]}: too many or too large"]
        if lost
        else []
    )


def confined_files(file: Path, given: Path, sculpts: "Given | None" = None) -> dict[str, bytes]:
    """What the confined process leaves, by name."""
    size = sum(path.stat().st_size for path in given.rglob("*") if path.is_file())
    own = min(MOST_S, LEAST_S + S_A_MB * size / (1 << 20))
    call = [sys.executable, "-s", "-P", "-m", "worldkit.intake.confined_intake", str(given / "request.json"), "{out}"]
    ended = confined.run(
        call, reads=(given,), wanted=(*FILES, *WORLD, "error.json"), wall_s=own, memory_mb=MEMORY_MB, file_mb=256,
        sculpts=sculpts,
    )  # fmt: skip
    if ended.status == "ended" and ended.exit_code == 0 and "asset.yaml" in ended.files:
        return ended.files
    told = plain.as_object(ended.files.get("error.json", b""))
    if told.get("code"):
        raise IntakeFailedError(
            str(told.get("cause", ""))[:500], code=str(told["code"])[:40], place=str(told.get("place") or file.name)[:200],
            next_move=str(told.get("next") or AGAIN)[:300],
        )  # fmt: skip
    why = {
        "timed_out": f"it took more than {own:g} s of processor time",
        "out_of_memory": f"it took more than {MEMORY_MB / 1024:g} GB of memory",
        "refused": "this machine has no sandbox in which a stranger's file may be read",
    }
    code = ended.status if ended.status != "ended" else "crashed"
    last = (ended.log.strip().splitlines() or [f"it ended with status {ended.exit_code}"])[-1][:300]
    raise IntakeFailedError(
        why.get(ended.status, f"its reader ended within it: {last}"), code=code, place=str(file),
        next_move="worldwright doctor" if code == "refused" else "open it in a modelling program, reduce it, and export it anew as GLB",
    )  # fmt: skip


def drawn(ended: dict[str, bytes], laid: Path) -> tuple[bytes, str]:
    """The thumbnail, drawn by the engine in the sandbox of the world among these files; without one, why."""
    world = {name: ended[name] for name in WORLD if name in ended}
    if len(world) < len(WORLD):
        return b"", "there was no world to draw"
    laid.mkdir()
    for name, content in world.items():
        (laid / name).write_bytes(content)
    words = [
        "sheet",
        "--plain",
        f"--world={laid / WORLD[0]}",
        f"--program={laid / WORLD[1]}",
        "--camera=thumbnail",
        "--size=512x512",
    ]
    try:
        made: bytes = short_runs.engine(words, (laid,), ("thumbnail.png",), again=AGAIN)["thumbnail.png"]
    except JobError as error:
        return b"", error.cause
    return made, ""


def added_of(
    folder: Path, picture: bytes, why: str, again: str = "add it again with --replace and another --up"
) -> Illustrated:
    """What is told of an asset that was registered, with its picture or why it has none; `again` is what may make it stand."""
    import yaml

    from worldkit.assets.reading import read_asset

    asset = read_asset(folder)
    facts = yaml.safe_load((folder / "asset.yaml").read_text(encoding="utf-8"))
    measured = facts.get("measured") or {}
    cavity = measured.get("cavity") or {}
    mended = (*asset.mended, *([f"it has no thumbnail: {why}"] if why else []))
    size = asset.extents()
    stands = bool(measured.get("stands"))
    row = f"{{name: {asset.key}, filename: {asset.key}}}"
    told = Added(
        key=asset.key,
        folder=str(folder),
        extents_m=(round(size[0], 4), round(size[1], 4), round(size[2], 4)),
        mass_kg=round(asset.mass_at(), 5),
        collides_as=str(measured.get("collides_as", "")),
        stands=stands,
        holds=cavity.get("holds"),
        moving={name: (float(low), float(high)) for name, (low, high) in (measured.get("moving") or {}).items()},
        licence=asset.licence,
        creator=asset.creator,
        mended=mended,
        next_move=f"a plan names it in `assets`: {row}, and its height, {size[2]:g}, in `asset_dimensions`"
        if stands
        else f"{again}, or place it so that it lies: `worldwright asset show {asset.key}`",
    )
    return Illustrated(told, (Picture(picture, f"{asset.key}: seen from three quarters"),) if picture else ())
