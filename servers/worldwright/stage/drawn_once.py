"""Pictures that were drawn because somebody asked to see them lie in the run's `out`, and are not drawn again for the same question.

`out` is no evidence, enters no hash and is freed with no loss. What a picture shows is decided by the recording, the film, the code
that draws, the renderer, and what was asked (moments, camera, size): one hash of all of it names its folder.
"""

import hashlib
import json
import shutil
from collections.abc import Callable
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic, write_json

from ..model.evidence import pictures_of
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.picture import FILM_NAME, Illustrated, Picture, file_name
from . import plain
from .pictures import Shown

OUT, TOLD = "out", "told.json"
MOST_KEPT = 20
"""Older answers are freed: together they take at most 20 MB."""


def drawn(run: Run, key: EvidenceKey, name: str, asked: dict[str, Any], draw: Callable[[], Illustrated]) -> Illustrated:
    """What `draw` draws, from an earlier call if that was asked the same of the same; the result says where its pictures lie.

    Args:
        run: the run.
        key: the hashes of its recording.
        name: what the folder is called, before its hash.
        asked: moments, camera, sizes …; must be JSON.
        draw: draws it, and may refuse.
    """
    recorded = plain.read(run.evidence(key) / "physics" / "result.json", 1 << 24)
    if recorded is None:  # `draw` says what is lacking
        return draw()
    about = [key.key, hashlib.sha256(recorded).hexdigest(), pictures_of.identity(run, "video"), asked]
    digest = hashlib.sha256(json.dumps(about, sort_keys=True).encode()).hexdigest()[:12]
    folder = run.folder / OUT / "frames" / f"{name}-{digest}"
    if (known := _read(folder)) is not None:
        return known
    found = draw()
    try:
        return _kept(folder, found)
    except OSError:  # a folder of somebody else, or a full disk: it is shown all the same
        return found


def _kept(folder: Path, found: Illustrated) -> Illustrated:
    shown = found.data
    assert isinstance(shown, Shown)
    rows = []
    for number, picture in enumerate(found.pictures, 1):
        rows.append({"file": file_name(number, picture), "caption": picture.caption, "format": picture.format})
        write_atomic(folder / rows[-1]["file"], picture.data)
        rows[-1]["sha256"] = hashlib.sha256(picture.data).hexdigest()
    told: dict[str, Any] = {"cameras": shown.cameras, "captions": shown.captions, "pictures": rows}
    if found.film:
        write_atomic(folder / FILM_NAME, found.film)
        told["film"] = hashlib.sha256(found.film).hexdigest()
    write_json(folder / TOLD, told)
    others = sorted((one for one in folder.parent.iterdir() if one != folder), key=lambda one: -one.stat().st_mtime)
    for old in others[MOST_KEPT - 1 :]:
        shutil.rmtree(old, ignore_errors=True)
    return _where(found, folder)


def _read(folder: Path) -> Illustrated | None:
    with suppress(OSError, ValueError, KeyError, TypeError):
        told = json.loads((folder / TOLD).read_text(encoding="utf-8"))
        pictures = []
        for row in told["pictures"]:
            data = (folder / Path(row["file"]).name).read_bytes()
            if hashlib.sha256(data).hexdigest() != row["sha256"]:
                return None
            pictures.append(Picture(data, row["caption"], row["format"]))
        film = (folder / FILM_NAME).read_bytes() if "film" in told else b""
        if film and hashlib.sha256(film).hexdigest() != told["film"]:
            return None
        shown = Shown(cameras=tuple(told["cameras"]), captions=tuple(told["captions"]))
        return _where(Illustrated(shown, tuple(pictures), film=film), folder)
    return None


def _where(found: Illustrated, folder: Path) -> Illustrated:
    shown = found.data
    assert isinstance(shown, Shown)
    said = (
        *shown.captions,
        *([f"it moves in {folder / FILM_NAME}"] if found.film else ()),
        f"kept in {folder}, and not drawn again while recording, film and renderer stay as they are",
    )
    return replace(found, data=shown.model_copy(update={"captions": said}), folder=folder)
