"""A model with the files beside it: its includes written into one text, and each mesh and picture found and named from one root.

    made = model_files.whole(Path("run/arm/arm.urdf"), Path("run"))
    made.text                     # without includes; files are named as `arm/meshes/base.stl`
    made.files                    # ("arm/meshes/base.stl", …): what a program that holds the text reads besides

A URDF names files by `package://`: what follows the package's name is looked for beside the model and above it, up to the root.
Nothing outside of the root is read, and no address of another machine.
"""

import os
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path, PurePosixPath
from urllib.parse import unquote

from .model_references import NAMED

NATIVE = (".obj", ".stl", ".msh")
"""Meshes that the engine reads itself."""
READ_FOR_IT = (".dae", ".ply", ".off", ".glb")
"""Meshes that are read by `worldkit.intake`, and given to the engine as vertices and faces."""
PICTURES = (".png",)
KINDS = {"mesh": NATIVE + READ_FOR_IT, "texture": PICTURES, "hfield": PICTURES}
FOLDERS = {"mesh": "meshdir", "texture": "texturedir", "hfield": "meshdir"}
MOST_BYTES, MOST_FILES, MOST_INCLUDES = 2_000_000, 500, 200
DRAWN = '<mujoco><compiler discardvisual="false" strippath="false"/></mujoco>'
"""What a URDF with meshes is given that says nothing to the engine: else what is seen of it would be left out."""


class ModelFileError(ValueError):
    """A file of a model that is not there, lies elsewhere, is none, or includes itself; `code` says which."""

    def __init__(self, code: str, cause: str, place: str, next_move: str) -> None:
        super().__init__(f"{place}: {cause}; {next_move}")
        self.code, self.cause, self.place, self.next_move = code, cause, place, next_move


@dataclass
class Whole:
    """A model's text with its includes in it, the files that it reads from the root, and those that its text came from."""

    text: str
    files: tuple[str, ...] = ()
    sources: tuple[Path, ...] = ()


@dataclass
class _Walk:
    main: Path
    root: Path
    sources: list[Path] = field(default_factory=list)
    files: dict[str, None] = field(default_factory=dict)
    missing: list[str] = field(default_factory=list)


def whole(path: Path, root: Path) -> Whole:
    """The model in a file.

    Args:
        path: URDF or MJCF, below the root.
        root: the folder that its files are named from, and outside of which nothing is read.

    Raises:
        ModelFileError: with the codes `missing`, `absolute`, `climbs_out`, `cyclic`, `unknown_format`, `too_large`, `unreadable`.
    """
    walk = _Walk(path, root.resolve())
    tree = _tree(path, walk)
    if tree.tag == "mujoco":
        _write_in(tree, path, [path.resolve()], walk)
    if tree.tag == "robot":  # whose textures the engine leaves alone
        for material in tree.iter("material"):
            for node in material.findall("texture"):
                material.remove(node)
    named = [
        (node, key)
        for node in tree.iter()
        for key in ("file", "filename")
        if (node.tag, key) in NAMED and key in node.attrib
    ]
    if not named and len(walk.sources) == 1:
        with suppress(UnicodeDecodeError):  # what is declared in another encoding is written anew, below
            return Whole(path.read_text(encoding="utf-8"), (), tuple(walk.sources))
    folders = _folders(tree)
    for node, key in named:
        if found := _found(node.attrib[key], node.tag, folders.get(FOLDERS[node.tag], ""), walk):
            node.set(key, found)
            walk.files[found] = None
    if walk.missing:
        told = ", ".join(walk.missing[:5]) + (f" and {len(walk.missing) - 5} more" if len(walk.missing) > 5 else "")
        raise ModelFileError(
            "missing", f"it reads files that are not there: {told}", path.name,
            f"put them where the model names them, below {root.name}/, or correct the names in {path.name}",
        )  # fmt: skip
    if len(walk.files) > MOST_FILES:
        raise ModelFileError(
            "too_large", f"it reads more than {MOST_FILES} files", path.name, "leave out what is not seen or touched"
        )
    if tree.tag == "robot" and walk.files and tree.find("mujoco") is None:
        tree.insert(0, ElementTree.fromstring(DRAWN))
    text = ElementTree.tostring(tree, encoding="unicode")
    return Whole(text, tuple(walk.files), tuple(walk.sources))


def models_in(folder: Path) -> list[Path]:
    """The URDF and MJCF files below a folder that no other of them includes, sorted."""
    found: dict[Path, str] = {}
    included: set[Path] = set()
    for path in sorted(folder.rglob("*"))[: 20 * MOST_FILES]:
        if path.suffix.lower() not in (".urdf", ".xml", ".mjcf") or not path.is_file() or path.is_symlink():
            continue
        try:
            tree = ElementTree.parse(path).getroot()
        except (ElementTree.ParseError, OSError, ValueError, RecursionError):
            continue
        if tree.tag in ("robot", "mujoco"):
            found[path] = tree.tag
            included |= {
                (path.parent / name).resolve() for name in (node.get("file") for node in tree.iter("include")) if name
            }
    return [path for path in found if path.resolve() not in included]


def _tree(path: Path, walk: _Walk) -> ElementTree.Element:
    place = _from(path, walk.root)
    real = path.resolve()
    if not real.is_relative_to(walk.root):
        raise ModelFileError("climbs_out", "it lies outside of the model's folder", place, "put a copy of it there")
    try:
        data = path.read_bytes()
    except OSError as error:
        raise ModelFileError("missing", f"it cannot be read ({error.strerror})", place, "put it there") from error
    if len(data) > MOST_BYTES:
        raise ModelFileError(
            "too_large",
            f"it is larger than {MOST_BYTES // 1_000_000} MB",
            place,
            "put its meshes into files of their own",
        )
    if b"<!DOCTYPE" in data or b"<!ENTITY" in data:
        raise ModelFileError("unreadable", "it declares a document type or entities", place, "remove the declaration")
    try:
        tree = ElementTree.fromstring(data)
    except (ElementTree.ParseError, ValueError, RecursionError) as error:
        line = getattr(error, "position", (0, 0))[0]
        raise ModelFileError("unreadable", f"it is not XML: {error}", f"{place}:{line}", "correct it there") from error
    walk.sources.append(path)
    return tree


def _write_in(tree: ElementTree.Element, path: Path, chain: list[Path], walk: _Walk) -> None:
    """Put what each `<include>` names in its place; names are seen from the main model, else from the file they stand in."""
    for parent in list(tree.iter()):
        for number, node in reversed(list(enumerate(parent))):
            if node.tag != "include":
                continue
            name = node.get("file", "")
            _no_address(name, path, walk)
            places = [base / name for base in (walk.main.parent, path.parent)]
            found = next((place for place in places if name and place.is_file()), None)
            if found is None:
                raise ModelFileError(
                    "missing", f"it includes {name!r}, which is not there", _from(path, walk.root), "put it there"
                )
            if found.resolve() in chain:
                told = " -> ".join(one.name for one in (*chain, found))
                raise ModelFileError(
                    "cyclic", f"it includes itself: {told}", _from(path, walk.root), "take one of these includes out"
                )
            if len(walk.sources) > MOST_INCLUDES:
                raise ModelFileError(
                    "too_large", f"it includes more than {MOST_INCLUDES} files", _from(path, walk.root), "join them"
                )
            part = _tree(found, walk)
            _write_in(part, found, [*chain, found.resolve()], walk)
            parent[number : number + 1] = list(part)


def _folders(tree: ElementTree.Element) -> dict[str, str]:
    """The folders that the model's compilers name, taken out of them: files are named from the root from here on."""
    found: dict[str, str] = {}
    both = ("meshdir", "texturedir")  # which `assetdir` stands for
    for node in tree.iter("compiler"):
        said = {str(key): node.attrib.pop(key) for key in ("assetdir", *both) if key in node.attrib}
        found.update(dict.fromkeys(both, said.pop("assetdir")) if "assetdir" in said else {})
        found.update(said)
        node.attrib.pop("strippath", None)
    return found


def _found(name: str, tag: str, folder: str, walk: _Walk) -> str | None:
    """The file that a model names, from the root; None after noting that it is not there."""
    _no_address(name, walk.main, walk)
    for place in _places(name, folder, walk):
        real = Path(os.path.normpath(place.absolute()))
        if not real.is_file():
            continue
        if not real.resolve().is_relative_to(walk.root):
            raise ModelFileError(
                "climbs_out",
                f"{name!r} lies outside of {walk.root.name}/",
                walk.main.name,
                "put a copy of it beside the model",
            )
        if real.suffix.lower() not in KINDS[tag]:
            raise ModelFileError(
                "unknown_format", f"{name!r} is no {' or '.join(KINDS[tag])}, which are all that a {tag} may be", walk.main.name,
                "convert it, and correct the name",
            )  # fmt: skip
        return real.resolve().relative_to(walk.root).as_posix()
    walk.missing.append(name)
    return None


def _places(name: str, folder: str, walk: _Walk) -> Iterator[Path]:
    plain = unquote(name.removeprefix("file://")) if name.startswith("file://") else name
    if plain.startswith("package://"):
        inside = PurePosixPath(plain.removeprefix("package://"))
        rest = PurePosixPath(*inside.parts[1:])
        for base in (walk.main.parent, *walk.main.parent.parents):
            yield from (base / inside, base / rest)
            if base.resolve() == walk.root:
                return
    bare = PurePosixPath(plain).name  # what is left of a name where a compiler strips paths
    yield from (walk.main.parent / folder / plain, walk.main.parent / plain, walk.main.parent / folder / bare)


def _no_address(name: str, path: Path, walk: _Walk) -> None:
    """Refuse what names a place on one machine."""
    plain = name.removeprefix("file://")
    if PurePosixPath(plain).is_absolute() or plain[1:2] == ":":
        bare = plain.replace("\\", "/").rpartition("/")[2]
        beside = islice(walk.main.parent.rglob("*"), 5_000)
        near = next((found for found in beside if found.name == bare and found.is_file()), None)
        raise ModelFileError(
            "absolute", f"{name!r} is a place on one machine", _from(path, walk.root),
            f"name it from the model's folder{f': {os.path.relpath(near, walk.main.parent)}' if near else ', and put it there'}",
        )  # fmt: skip


def _from(path: Path, root: Path) -> str:
    try:
        return path.resolve().relative_to(root).as_posix()
    except ValueError:
        return path.name
