"""Write the part of a recording that a film's author gets: poses, sizes and touches, as one small file of arrays.

The author's process reads this and nothing else of the recording; see `worldkit.filming.recorded`.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..recording import law_channels, still_surfaces

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np

    from ..recording.stored import Recording

RATE_HZ = 250.0
"""The author gets so many rows per second: cameras are no faster."""


def write(recording: "Recording", path: Path, facts: dict[str, Any], told: "Mapping[str, Any] | None" = None) -> None:
    """Write the facts of a recording to `path` (.npz).

    Args:
        recording: the recording to film.
        path: the file.
        facts: `fps`, `size` and `movers` of the program, as `program.json` has them.
        told: what the plan tells of the place: `setting`, `floor`, `light` (JSON), `wind` (m/s), `words`, and `looks`, pairs of a name and a look.
    """
    import numpy as np

    time = np.asarray(recording.time, dtype=float)
    length = max(float(time[-1] - time[0]), 1e-9)
    wanted = time[0] + np.arange(int(length * RATE_HZ) + 1) / RATE_HZ
    rows = np.unique(np.concatenate([[0], np.clip(np.searchsorted(time, wanted), 0, len(time) - 1), [len(time) - 1]]))
    middle, half = boxes(recording)
    ground = {f"ground_{name}": value for name, value in still_surfaces.read(recording.folder).items()}
    touch = _touches(recording, time)
    cameras = list(map(str, recording.meta.get("cameras", ())))
    place = {name: np.array(value, dtype=str) for name, value in (told or {}).items()}
    laws = law_channels.read(recording)
    np.savez(
        path,
        time=time[rows] - time[0], pos=recording.pos[rows], quat=recording.quat[rows], middle=middle, half=half,
        bodies=np.array(recording.names, dtype=str), cameras=np.array(cameras, dtype=str),
        movers=np.array([name for name in facts.get("movers", ()) if name in recording.names], dtype=str),
        fps=int(facts["fps"]), size=np.array(facts["size"], dtype=int), floor_z=_floor(recording), **{**touch, **ground, **place, **laws},
    )  # fmt: skip


def boxes(recording: "Recording") -> "tuple[np.ndarray, np.ndarray]":
    """Middle and half extents (B, 3), m, of the box around the shapes of each body, in the body's frame."""
    import numpy as np

    from worldkit.turning import turned

    low = np.full((len(recording.names), 3), np.inf)
    high = -low
    index = {name: number for number, name in enumerate(recording.names)}
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    for geom in recording.meta["geoms"]:
        number = index.get(geom["body"])
        if number is None or geom["type"] == "plane":
            continue
        aabb = np.array(geom["aabb"])
        corners = np.array(geom["pos"]) + turned(np.array(geom["quat"])[None], aabb[:3] + signs * aabb[3:])
        low[number], high[number] = np.minimum(low[number], corners.min(0)), np.maximum(high[number], corners.max(0))
    bare = ~np.isfinite(low).all(axis=1)
    low[bare], high[bare] = -0.01, 0.01
    return 0.5 * (low + high), 0.5 * (high - low)


def _floor(recording: "Recording") -> float:
    planes = [geom["pos"][2] for geom in recording.meta["geoms"] if geom["type"] == "plane" and geom["body"] == "world"]
    if planes:
        return float(max(planes))
    return float(recording.pos[0, :, 2].min()) if len(recording.names) else 0.0


def _touches(recording: "Recording", time: "np.ndarray") -> dict[str, Any]:
    """Beginnings of contacts: the time (s), the two bodies (-1 is the world), the largest force until they part (N)."""
    import numpy as np

    contacts = recording.contacts
    index = {name: number for number, name in enumerate(recording.names)}
    owner = np.array([index.get(geom["body"], -1) for geom in recording.meta["geoms"]], dtype=int)
    found: list[tuple[float, int, int, float]] = []
    if len(contacts) and len(owner):
        one, other = owner[contacts.geom1], owner[contacts.geom2]
        low, high, force = np.minimum(one, other), np.maximum(one, other), np.asarray(contacts.normal_force)
        row = np.asarray(contacts.row)
        for pair in np.unique(np.stack([low, high], 1), axis=0):
            mine = (low == pair[0]) & (high == pair[1]) if pair[0] != pair[1] else np.zeros(len(low), bool)
            rows, strength = row[mine], force[mine]
            if not len(rows):
                continue
            starts = np.flatnonzero(np.diff(rows, prepend=rows[0] - 9) > 2)
            peaks = np.maximum.reduceat(strength, starts)
            found += [
                (float(time[rows[s]] - time[0]), int(pair[0]), int(pair[1]), float(p))
                for s, p in zip(starts, peaks, strict=True)
            ]
    found.sort()
    columns = list(zip(*found, strict=True)) if found else [(), (), (), ()]
    kinds = (("touch_time", float), ("touch_a", int), ("touch_b", int), ("touch_force", float))
    return {name: np.array(column, dtype=kind) for (name, kind), column in zip(kinds, columns, strict=True)}
