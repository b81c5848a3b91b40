"""The confined process of an intake: `python -m worldkit.intake.confined_intake REQUEST.json OUT`.

It leaves in OUT the files of the asset's folder, and of a world to draw it in (`world.mjz`, `program.json`); or `error.json`
and status 1. REQUEST has the keys of `taken_in.take_in`, and `file`; of a sculpted thing those of `kept_sculpt.taken`.
"""

import json
import os
import shutil
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..errors import IntakeError
from ..files import write_json
from . import as_glb, kept_sculpt, moving_parts, stillness, taken_in, unpacked

ON = "name another --up if it is another side that is down"


def main(argv: Sequence[str] | None = None) -> int:
    """Take in one file; returns the exit status."""
    request, out = (Path(word) for word in (sys.argv[1:] if argv is None else argv))
    asked: dict[str, Any] = json.loads(request.read_text(encoding="utf-8"))
    file = request.parent / asked["file"]
    try:
        with tempfile.TemporaryDirectory() as scratch:
            _take_in(request.parent, asked, Path(scratch), out)
        write_json(out / "result.json", {"ok": True, "pass": "intake"})
    except IntakeError as error:
        told = {"code": error.code, "cause": error.cause, "place": error.place, "next": error.next_move}
        write_json(out / "error.json", told)
        return 1
    except MemoryError:
        cause = "it needs more memory than an intake may use"
        write_json(
            out / "error.json", {"code": "out_of_memory", "cause": cause, "place": file.name, "next": "reduce it first"}
        )
        return 1
    return 0


def _take_in(given: Path, asked: dict[str, Any], scratch: Path, out: Path) -> None:
    file = given / asked["file"]
    if "of" in asked:
        finish(*kept_sculpt.taken(given, asked), scratch, out, kept_sculpt.HEADER, kept_sculpt.ON)
        return
    if file.is_dir():
        file = unpacked.the_mesh(file, file.name)
    elif file.suffix.lower() in unpacked.ARCHIVES:
        file = unpacked.unpack(file, scratch / "unpacked")
    glb, said = as_glb.written(file, scratch / "as_glb")
    files, facts = taken_in.take_in(glb, as_glb.axes(file, asked))
    facts["mended"] += said
    finish(files, facts, scratch, out)


def finish(
    files: dict[str, bytes],
    facts: dict[str, Any],
    scratch: Path,
    out: Path,
    header: str = taken_in.HEADER,
    on: str = ON,
) -> None:
    """Stand an asset on a floor, look for a cavity, and leave in `out` its folder's files and a world to draw it in."""
    key = facts["key"]
    # What is measured from here on is measured of the files as they will lie in the catalog.
    os.environ["WORLDWRIGHT_CATALOG"], os.environ["WORLDWRIGHT_ASSETS"] = (
        str(scratch / "catalog"),
        str(scratch / "none"),
    )
    catalog = scratch / "catalog"
    taken_in.write(catalog / key, files, facts, header)
    facts["measured"] |= stillness.stood(key)
    if moving_parts.FILE in files:
        facts["measured"]["moving_stands"] = stillness.stood(key, moving=True)["stands"]
    if not facts["measured"]["stands"]:
        facts.setdefault("mended", []).append(f"it does not stand still as it is: {on}")
    if (found := stillness.cavity(key)) is not None:
        facts["measured"]["cavity"] = found
        if found["holds"]:  # what is put upon a thing would else be put where nothing stays
            facts["supports"] = [_inside(found, facts["metric_height"])]
    taken_in.write(catalog / key, files, facts, header)
    stillness.picture(key, out)
    for path in sorted((catalog / key).iterdir()):
        shutil.copyfile(path, out / path.name)


def _inside(found: dict[str, Any], height: float) -> dict[str, Any]:
    """The support that is the floor of a cavity."""
    side = round(0.5 * found["width"], 6)
    share = round(found["z"] / height, 6)
    return {"name": "inside", "default": True, "z_fraction": share, "extents": [side, side], "shape": "ellipse"}


if __name__ == "__main__":
    sys.exit(main())
