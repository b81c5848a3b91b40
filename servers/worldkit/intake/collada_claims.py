"""What a COLLADA file claims, read as a stream before a parser builds its tree: faces, pictures, unit and up axis."""

from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any
from urllib.parse import unquote
from xml.parsers import expat

from ..errors import IntakeError

FACES = ("triangles", "polylist", "polygons", "trifans", "tristrips")
MOST_DEPTH = 256
"""Of elements within elements; a file of a modelling program has some twenty."""
ENOUGH = 10**12
"""Faces up to which those of a scene are counted; nodes that draw each other twice make any number."""
MOST_TEXT = 4096
"""Characters kept of a text that is read here."""
UPS = ("X_UP", "Y_UP", "Z_UP")


@dataclass
class Claims:
    """faces: those that its libraries hold, or those that its scene draws of them, whichever are more. unit_m: metres in a
    unit, 0 where it is not told. up: of `UPS`. pictures: as the file names them."""

    faces: int = 0
    unit_m: float = 0.0
    up: str = "Y_UP"
    pictures: list[str] = field(default_factory=list)


class _Nodes:
    """What a scene draws: nodes hold nodes and geometries, or name others by their ids, as often as they like."""

    def __init__(self) -> None:
        self.faces: dict[str, int] = {}
        self.holds: list[list[int | str]] = []
        self.ids: dict[str, int] = {}
        self.scenes: list[int] = []
        self.open: list[int] = []
        self.geometry = ""

    def begin(self, tag: str, said: dict[str, str]) -> None:
        if tag == "geometry":
            self.geometry = f"#{said.get('id', '')}"
        elif tag in FACES:
            self.faces[self.geometry] = self.faces.get(self.geometry, 0) + _whole(said.get("count"))
        elif tag in ("visual_scene", "node"):
            number = len(self.holds)
            self.holds.append([])
            if tag == "visual_scene":
                self.scenes.append(number)
            elif self.open:
                self.holds[self.open[-1]].append(number)
            self.ids.setdefault(f"#{said.get('id', '')}", number)
            self.open.append(number)
        elif self.open and tag == "instance_geometry":
            self.holds[self.open[-1]].append(said.get("url", ""))
        elif self.open and tag == "instance_node":
            self.holds[self.open[-1]].append("node " + said.get("url", ""))

    def end(self, tag: str) -> None:
        if tag in ("visual_scene", "node"):
            self.open.pop()

    def drawn(self) -> int:
        """Faces of the scene that draws most; a node that holds itself ends there, and it never counts beyond `ENOUGH`."""
        counted: dict[int, int] = {}
        begun: set[int] = set()
        waiting = self.scenes.copy()
        while waiting:
            number = waiting[-1]
            below = [self._node(one) for one in self.holds[number]]
            left = [one for one in below if isinstance(one, int) and one not in counted and one not in begun]
            if number in counted or (number in begun or not left):
                waiting.pop()
                shares = (counted.get(o, 0) if isinstance(o, int) else self.faces.get(o, 0) for o in below)
                counted.setdefault(number, min(sum(shares), ENOUGH))
            else:
                waiting += left
            begun.add(number)
        return max((counted[number] for number in self.scenes), default=0)

    def _node(self, one: int | str) -> int | str:
        return self.ids.get(one[5:], "") if isinstance(one, str) and one.startswith("node ") else one


def scan(path: Path) -> Claims:
    """What the file claims.

    Raises:
        IntakeError: it is no COLLADA, is not whole, declares entities, or is nested without end.
    """
    status = path.stat()
    return _scan(path, status.st_mtime_ns, status.st_size)


@lru_cache(maxsize=4)
def _scan(path: Path, _changed: int, _size: int) -> Claims:
    found, open_tags, text = Claims(), [], []  # type: Claims, list[str], list[str]
    nodes = _Nodes()
    reader = expat.ParserCreate()

    def begin(tag: str, said: dict[str, str]) -> None:
        if not open_tags and tag.rpartition(":")[2] != "COLLADA":
            raise IntakeError("no_mesh", f"its root is <{tag[:40]}>, not <COLLADA>", path.name, "export it as COLLADA")
        open_tags.append(tag)
        text.clear()
        if len(open_tags) > MOST_DEPTH:
            raise _bad(f"its elements are nested more than {MOST_DEPTH} deep")
        nodes.begin(tag, said)
        if tag in FACES:
            found.faces += _whole(said.get("count"))
        elif open_tags == ["COLLADA", "asset", "unit"]:
            found.unit_m = _length(said.get("meter"))

    def end(tag: str) -> None:
        told = "".join(text).strip()
        if open_tags == ["COLLADA", "asset", "up_axis"] and told in UPS:
            found.up = told
        elif (tag == "init_from" and "image" in open_tags) or tag == "ref":
            found.pictures.append(told)
        nodes.end(tag)
        open_tags.pop()
        text.clear()

    def said(part: str) -> None:
        if sum(map(len, text)) < MOST_TEXT and open_tags and open_tags[-1] in ("up_axis", "init_from", "ref"):
            text.append(part)

    def entity(*_: Any) -> None:
        raise _bad("it declares entities, which no modelling program writes")

    def _bad(cause: str) -> IntakeError:
        place = f"{path.name}:{reader.CurrentLineNumber}"
        return IntakeError("unreadable", cause, place, "open it in a modelling program, and export it anew")

    reader.StartElementHandler, reader.EndElementHandler = begin, end
    reader.CharacterDataHandler, reader.EntityDeclHandler = said, entity
    try:
        with path.open("rb") as file:
            reader.ParseFile(file)
    except expat.ExpatError as error:
        raise IntakeError(
            "truncated", f"it is no whole XML: {error}", f"{path.name}:{error.lineno}",
            "get the file once more, or export it anew",
        ) from error  # fmt: skip
    found.faces = max(found.faces, nodes.drawn())
    return found


def below(folder: Path, named: str) -> Path | None:
    """The file that a scene names, as far as it lies below the scene's folder; else one of its bare name there.

    Scenes name pictures by addresses of the machine they were made on, of which the bare name is what is left.
    """
    plain = unquote(named.removeprefix("file://")).replace("\\", "/")
    root = folder.resolve()
    for name in (plain, plain.rpartition("/")[2]):
        if not name or "\0" in name:
            continue
        found = (root / name).resolve()
        if found.is_relative_to(root) and found.is_file():
            return found
    bare = plain.rpartition("/")[2]
    return next((path for path in sorted(root.rglob("*")) if bare and path.name == bare and path.is_file()), None)


def _whole(text: str | None) -> int:
    return int(text) if text and text.isascii() and text.isdigit() and len(text) < 12 else 0


def _length(text: str | None) -> float:
    try:
        value = float(text or 0)
    except ValueError:
        return 0.0
    return value if 1e-9 < value < 1e6 else 0.0
