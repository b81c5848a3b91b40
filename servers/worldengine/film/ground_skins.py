"""How far a drawn ground is from the simulated one: a film may draw a hill anew, and says how true that is."""

from typing import TYPE_CHECKING, Any

from worldkit.filming import ground
from worldkit.turning import turned

from ..recording import still_surfaces

if TYPE_CHECKING:
    import numpy as np

    from ..recording.stored import Recording


def off(thing: dict[str, Any], arrays: "dict[str, np.ndarray]", recording: "Recording") -> dict[str, float]:
    """`off_m` of a skin over what stands still: the greatest difference of height, m, at its upper side; else nothing.

    Both surfaces are compared at each other's corners, so that a flat sheet over a rough hill is no true picture of it.
    """
    import numpy as np

    if not thing["instead"] or "vertices" not in thing:
        return {}
    known = still_surfaces.read(recording.folder)
    names = known["names"].tolist()
    if thing["to"] not in names:
        return {}
    body = recording.names.index(thing["to"])
    points = turned(np.array(thing["quat"])[None], arrays[thing["vertices"]] * np.array(thing["size"])) + thing["pos"]
    points = turned(np.asarray(recording.quat[0, body])[None], points) + np.asarray(recording.pos[0, body])
    faces = known["faces"][known["owner"] == names.index(thing["to"])]
    drawn = ground.over(points, arrays[thing["faces"]])
    simulated = ground.over(known["vertices"], faces)
    corners = np.concatenate([points, known["vertices"][np.unique(faces)]])[:, :2]
    apart = np.abs(drawn(corners[:, 0], corners[:, 1]) - simulated(corners[:, 0], corners[:, 1]))
    apart = apart[np.isfinite(apart)]
    return {"off_m": float(apart.max())} if len(apart) else {}
