"""Take over the shots of a film that an earlier pass drew alike, as they are encoded: a changed shot costs its own frames alone.

What a shot shows is decided by the recorded motion, the world as the film dresses it, renderer, size and frame rate, all that
`film.py` says of the whole film, and of what it says frame by frame that of the shot's own: camera, moment, particles, words,
light. One hash says all of it. Where it stands in the film decides nothing but what its picture says of that.
"""

import hashlib
import json
import shutil
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.film_files import ARRAYS, DESCRIPTION

from .described import CAMERA
from .encode import packets, part
from .known_pictures import drawn, of_camera, results

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .described import Described
    from .directed import Screening
    from .encode import Packet

BY_SHOT = ("shots", "captions", "air")
"""What the description says of moments of the film."""
BY_FRAME = ("ways", "sizes", "turns")
"""What it says of a thing frame by frame, by the names of arrays."""
BY_FRAME_PUFFS = ("places", "wide", "opaque")
"""The same of puffs."""


@dataclass(frozen=True)
class Shot:
    """One shot of a film that is to be written."""

    first: int
    frames: int
    key: str
    """The hash of all that decides what it shows."""
    packets: "list[Packet] | None" = None
    """Its frames as an earlier pass encoded them; None: they are drawn."""
    hidden: dict[str, int] = field(default_factory=dict)
    """In how many frames what covers which body, for one that is taken over."""

    def told(self, hidden: dict[str, int]) -> dict[str, Any]:
        """Its entry in the result, from which a later pass takes it."""
        return {"key": self.key, "first": self.first, "frames": self.frames, "hidden": hidden}


def of(
    screening: "Screening",
    plain: "mujoco.MjModel",
    common: str,
    description: Path,
    name: str,
    out: Path,
    earlier: Sequence[Path],
) -> list[Shot]:
    """The shots of a film, in their order, those that stand in an earlier pass with their packets.

    Args:
        screening: the film, ready to be drawn.
        plain: the world without what the film adds, its cameras aimed.
        common: a hash of recording, renderer, size and frame rate.
        description: the folder of what `film.py` described.
        name: of the file of a film.
        out: where an earlier film is copied to, while it is read.
        earlier: folders of passes, each with `result.json`.
    """
    shots = [
        Shot(shot["first"], shot["frames"], key)
        for shot, key in zip(screening.film.shots, keys(screening, plain, common, description), strict=True)
    ]
    if screening.frames.renderer != screening.frames.wanted:  # what the wanted one drew would not go with it
        return shots
    for folder, result in results(earlier):
        shots = _taken(shots, folder / name, result, out / f".earlier-{name}", screening)
    return shots


def _taken(shots: list[Shot], film: Path, result: dict[str, Any], copy: Path, screening: "Screening") -> list[Shot]:
    """The shots, with the packets of those that are still without and stand in this film."""
    told = (result.get("summary") or {}).get("parts") or {}
    parts = {str(row["key"]): row for row in told.values()}
    if not any(shot.packets is None and shot.key in parts for shot in shots):
        return shots
    try:
        shutil.copyfile(film, copy)  # what is read is what was hashed
        with copy.open("rb") as stream:
            same = hashlib.file_digest(stream, "sha256").hexdigest() == (result.get("files") or {}).get(film.name)
        frames = screening.frames
        film_packets = packets(copy, (frames.width, frames.height), screening.fps) if same else []
    except OSError:  # it is gone, or there is no room to read it: all of it is drawn
        return shots
    finally:
        copy.unlink(missing_ok=True)
    found = []
    for shot in shots:
        row = parts.get(shot.key) if shot.packets is None else None
        taken = row and part(film_packets, int(row["first"]), shot.frames)
        hidden = {str(what): int(count) for what, count in row["hidden"].items()} if row else {}
        found.append(Shot(shot.first, shot.frames, shot.key, taken, hidden) if taken else shot)
    return found


def keys(screening: "Screening", plain: "mujoco.MjModel", common: str, description: Path) -> Iterator[str]:
    """A hash for each shot of a film."""
    import numpy as np

    told = json.loads((description / DESCRIPTION).read_bytes())
    with np.load(description / ARRAYS, allow_pickle=False) as found:
        arrays = {name: np.asarray(found[name]) for name in sorted(found.files)}
    film = screening.film
    own = {str(thing[name]) for thing in film.things for name in BY_FRAME if thing.get(name)}
    own |= {str(row[name]) for row in film.puffs for name in BY_FRAME_PUFFS}
    own = {name for name in arrays if name in own or name in CAMERA}
    whole = hashlib.sha256(common.encode() + drawn(screening.model) + screening.frames.shared())
    whole.update(_text({name: value for name, value in told.items() if name not in BY_SHOT}))
    for name in arrays:
        if name not in own:
            whole.update(_array(name, arrays[name]))
    for shot in film.shots:
        digest, frames = whole.copy(), slice(shot["first"], shot["first"] + shot["frames"])
        for name in sorted(own):
            digest.update(_array(name, arrays[name][frames]))
        if shot["planned"]:
            digest.update(of_camera(plain, shot["planned"]))
        digest.update(_text([*_timed(film, told, shot, screening.fps)]))
        digest.update(_text([screening.words(frame) for frame in range(frames.start, frames.stop)]))
        yield digest.hexdigest()


def _timed(film: "Described", told: dict[str, Any], shot: dict[str, Any], fps: int) -> Iterator[Any]:
    """What is said of the time in which a shot is shown, by its own clock: captions, and light where it changes."""
    begin, end = shot["first"] / fps, (shot["first"] + shot["frames"]) / fps
    for caption in film.captions:
        if caption["start_s"] < end and caption["end_s"] > begin:
            since, until = (round(caption[name] - begin, 9) for name in ("start_s", "end_s"))
            yield {**caption, "start_s": since, "end_s": until}
    names = [name for row in told["air"] for name in row if name != "at_s"]
    changes = len(names) > len(set(names))
    for row in told["air"]:
        yield {**row, "at_s": round(float(row["at_s"]) - begin, 9) if changes else 0.0}


def _text(told: Any) -> bytes:
    return json.dumps(told, sort_keys=True).encode() + b"\n"


def _array(name: str, values: "np.ndarray") -> bytes:
    return f"{name}{values.dtype}{values.shape}".encode() + values.tobytes()
