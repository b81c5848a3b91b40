"""Find visible geoms that overlap because the engine never lets them collide.

Contact masks, exclusions and disabled contacts can make a body sink through a floor or a wall that is plainly there.
No contact is recorded then, so the recording alone cannot tell; the geometry can. Some rows of a finished recording
are shown again, and the distances of the visible geoms that cannot collide are measured.

Left out: bodies of one kinematic tree, on a hinge of a fixed body or tied by an equality (joints may overlap), pairs
that touch in that row through other geoms, and a mesh whose body collides by hulls of its own (its convex hull is not
its shape).
"""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .columns import OVERLAPS_FILE
from .seen import visible

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .stored import Recording

ROWS = 24
"""So many evenly spaced rows are looked at."""
MOST_PAIRS = 4000
"""At most so many pairs are measured in a row, the nearest ones by their bounding spheres first."""
AT_ONCE = 1 << 18
"""About so many pairs are looked at in one go: the grains of an author's law are thousands of geoms, and their pairs would be more
than there is memory for.
"""
SHALLOW_M, SHALLOW_SHARE = 2e-3, 0.05
"""An overlap counts when it is deeper than both this many metres and this share of the smaller geom's radius."""


def write(model: "mujoco.MjModel", recording: "Recording", folder: Path) -> None:
    """Look for overlaps in a finished recording and write `overlaps.json` beside it."""
    from worldkit.files import write_json

    write_json(folder / OVERLAPS_FILE, {"rows": min(ROWS, len(recording)), "pairs": find(model, recording)})


def find(model: "mujoco.MjModel", recording: "Recording") -> list[dict[str, Any]]:
    """The deepest overlap of each pair of geoms: geoms, bodies, depth_m, time_s, why they cannot collide."""
    import numpy as np

    from .replay import Replay

    if not len(recording):
        return []
    replay = Replay(model, recording)
    contacts = recording.contacts

    def touching(row: int) -> set[frozenset[int]]:
        return _touching(model, contacts, row) if len(contacts) else set()

    evenly = np.linspace(0, len(recording) - 1, ROWS).round().astype(int)
    rows = np.array(list(dict.fromkeys(evenly.tolist())))  # each once; `np.unique` loads numpy.ma
    return search(model, recording.time, rows, replay.show, touching)


def search(
    model: "mujoco.MjModel",
    times: "np.ndarray",
    rows: "np.ndarray",
    show: Callable[[int], "mujoco.MjData"],
    touching: Callable[[int], set[frozenset[int]]],
    *,
    constant: bool = True,
) -> list[dict[str, Any]]:
    """Search any rows that can be shown; `window_s` tells when a pair was first and last seen inside each other.

    With `constant` off, a pair that overlaps equally in every row, as if it were built so, is left out.
    """
    from worldkit.naming import names

    candidates = _candidates(model)
    if not len(candidates):
        return []
    geoms, bodies = names(model, "geom", model.ngeom), names(model, "body", model.nbody)
    found: dict[tuple[int, int], list[tuple[float, float]]] = {}
    for row in rows:
        data = show(int(row))
        near = touching(int(row))
        for one, other in _near(model, data, candidates):
            if _pair(model, one, other) in near:
                continue
            depth = -_distance(model, data, one, other)
            sizes = [_radius(model, g) for g in (one, other)]
            if depth > max(SHALLOW_M, SHALLOW_SHARE * min(sizes)):
                found.setdefault((one, other), []).append((depth, float(times[row])))
    told = []
    for (one, other), seen in found.items():
        deepest, time = max(seen)
        if not constant and len(seen) == len(rows) > 1 and deepest - min(seen)[0] < SHALLOW_M:
            continue
        told.append(
            {
                "geoms": [geoms[one], geoms[other]],
                "bodies": [bodies[model.geom_bodyid[one]], bodies[model.geom_bodyid[other]]],
                "depth_m": deepest,
                "time_s": time,
                "window_s": [seen[0][1], seen[-1][1]],
                "why": _why(model, one, other),
            }
        )
    return sorted(told, key=lambda row: -row["depth_m"])


def _candidates(model: "mujoco.MjModel") -> "np.ndarray":
    """(P, 2) pairs of visible geoms of different trees that cannot collide, at least one of which moves."""
    import mujoco
    import numpy as np

    shown = np.flatnonzero(visible(model))
    body = model.geom_bodyid
    moves = (model.body_treeid[model.body_weldid] >= 0) | (model.body_mocapid >= 0)
    tree = np.where(
        moves, np.where(model.body_treeid >= 0, model.body_treeid, model.ntree + np.arange(model.nbody)), -1
    )
    mask = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    collides = np.zeros(model.nbody, bool)
    np.logical_or.at(collides, body, mask)
    mesh = model.geom_type == mujoco.mjtGeom.mjGEOM_MESH
    hull_of_its_own = ~mask & mesh & collides[body]
    bad = model.geom_type == mujoco.mjtGeom.mjGEOM_SDF
    shown = shown[~(hull_of_its_own | bad)[shown]]
    off = bool(model.opt.disableflags & (mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT))
    listed = np.sort(np.stack([model.pair_geom1, model.pair_geom2], axis=1), axis=1).astype(np.int64)
    named_pairs = listed[:, 0] * model.ngeom + listed[:, 1]
    joined = [*_ties(model), *_hinged(model)]
    found = [np.empty((0, 2), np.int32)]
    for one, other in _apart(tree[body[shown]]):
        one, other = shown[one], shown[other]
        masks = (model.geom_contype[one] & model.geom_conaffinity[other]) | (
            model.geom_contype[other] & model.geom_conaffinity[one]
        )
        signature = _signature(model, one, other)
        excluded = np.isin(signature, model.exclude_signature)
        low, high = np.minimum(one, other).astype(np.int64), np.maximum(one, other)
        can = np.isin(low * model.ngeom + high, named_pairs) | ((masks != 0) & ~excluded)
        free = ~np.isin(signature, joined) & (~can | off)
        found.append(np.stack([one[free], other[free]], axis=1).astype(np.int32))
    return np.concatenate(found)


def _apart(tree: "np.ndarray") -> "Iterator[tuple[np.ndarray, np.ndarray]]":
    """All pairs of two trees (n,), -1 for what stands fast, as places in it, the earlier first and in order; some `AT_ONCE`.

    What stands fast has no pair with what else stands fast, and is never held against it.
    """
    import numpy as np

    moving = np.flatnonzero(tree >= 0)
    ones: list[np.ndarray] = []
    others: list[np.ndarray] = []
    held = 0
    for place, own in enumerate(tree):
        behind = np.arange(place + 1, len(tree)) if own >= 0 else moving[np.searchsorted(moving, place) :]
        behind = behind[tree[behind] != own]
        ones.append(np.full(len(behind), place))
        others.append(behind)
        held += len(behind)
        if held >= AT_ONCE:
            yield np.concatenate(ones), np.concatenate(others)
            ones, others, held = [], [], 0
    if held:
        yield np.concatenate(ones), np.concatenate(others)


def _signature(model: "mujoco.MjModel", one: "np.ndarray", other: "np.ndarray") -> "np.ndarray":
    """MuJoCo's name of a pair of bodies: the smaller id in the upper half, the larger in the lower."""
    import numpy as np

    first, second = model.geom_bodyid[one].astype(np.int64), model.geom_bodyid[other].astype(np.int64)
    return (np.minimum(first, second) << 16) + np.maximum(first, second)


def _hinged(model: "mujoco.MjModel") -> list[int]:
    """Signatures of the bodies that turn on hinges or a ball in a body that stands fixed, and of that body.

    A fixed parent is no part of its child's tree, and yet a joint holds the two together.
    """
    import mujoco

    turning = (int(mujoco.mjtJoint.mjJNT_HINGE), int(mujoco.mjtJoint.mjJNT_BALL))
    found = []
    for body in range(1, model.nbody):
        parent, first, count = (int(v[body]) for v in (model.body_parentid, model.body_jntadr, model.body_jntnum))
        if parent and count and all(kind in turning for kind in model.jnt_type[first : first + count]):
            found.append((parent << 16) + body)
    return found


def _ties(model: "mujoco.MjModel") -> list[int]:
    """Signatures of the pairs of bodies that an equality ties."""
    from worldkit.naming import names

    from .describing import tied_bodies

    known = names(model, "body", model.nbody)
    found = []
    for equality in range(model.neq):
        ends = sorted(known.index(name) for name in tied_bodies(model, equality, known))
        if len(ends) == 2:
            found.append((ends[0] << 16) + ends[1])
    return found


def _near(model: "mujoco.MjModel", data: "mujoco.MjData", pairs: "np.ndarray") -> list[tuple[int, int]]:
    """The pairs whose bounding spheres overlap; a plane has no sphere and is near everything in front of it."""
    import numpy as np

    radius = np.where(model.geom_rbound > 0, model.geom_rbound, np.inf)
    near, gaps = [np.empty((0, 2), np.int32)], [np.empty(0)]
    for first in range(0, len(pairs), AT_ONCE):
        some = pairs[first : first + AT_ONCE]
        one, other = some[:, 0], some[:, 1]
        apart = np.sqrt(((data.geom_xpos[one] - data.geom_xpos[other]) ** 2).sum(axis=1))
        gap = apart - radius[one] - radius[other]
        near.append(some[gap < 0])
        gaps.append(gap[gap < 0])
    order = np.argsort(np.concatenate(gaps), kind="stable")[:MOST_PAIRS]
    return [(int(a), int(b)) for a, b in np.concatenate(near)[order]]


def _distance(model: "mujoco.MjModel", data: "mujoco.MjData", one: int, other: int) -> float:
    """Signed distance of two geoms, m; negative when they overlap."""
    import mujoco

    from .gaps import distance

    plane = int(mujoco.mjtGeom.mjGEOM_PLANE)
    if model.geom_type[other] == plane:
        one, other = other, one
    if model.geom_type[one] == plane:
        return _above(model, data, one, other)
    return distance(model, data, one, other, 1e3)


def _above(model: "mujoco.MjModel", data: "mujoco.MjData", plane: int, geom: int) -> float:
    """Height of a geom's lowest point over a plane, m (for meshes that of the bounding box); inf beside a finite plane."""
    import mujoco
    import numpy as np

    kind = mujoco.mjtGeom(model.geom_type[geom])
    if kind == mujoco.mjtGeom.mjGEOM_PLANE:
        return float("inf")
    frame, turn = data.geom_xmat[plane].reshape(3, 3), data.geom_xmat[geom].reshape(3, 3)
    box = model.geom_aabb[geom].ravel()
    centre = data.geom_xpos[geom] + turn @ box[:3]
    local = frame.T @ (centre - data.geom_xpos[plane])
    limits = model.geom_size[plane, :2]
    if np.any((limits > 0) & (np.abs(local[:2]) > limits)):
        return float("inf")
    normal, size = turn.T @ frame[:, 2], model.geom_size[geom]
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        reach = size[0]
    elif kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        reach = size[0] + size[1] * abs(normal[2])
    elif kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        reach = size[0] * np.sqrt(max(0.0, 1 - normal[2] ** 2)) + size[1] * abs(normal[2])
    elif kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        reach = np.sqrt(((size * normal) ** 2).sum())
    else:
        reach = np.abs(box[3:] * normal).sum()
    return float(local[2] - reach)


def _radius(model: "mujoco.MjModel", geom: int) -> float:
    return float(model.geom_rbound[geom]) or 1e3


def _pair(model: "mujoco.MjModel", one: int, other: int) -> frozenset[int]:
    return frozenset((int(model.geom_bodyid[one]), int(model.geom_bodyid[other])))


def _touching(model: "mujoco.MjModel", contacts: Any, row: int) -> set[frozenset[int]]:
    """Pairs of bodies in contact in a row."""
    import numpy as np

    first, last = np.searchsorted(contacts.row, (row, row + 1))
    pairs = zip(contacts.geom1[first:last], contacts.geom2[first:last], strict=True)
    return {_pair(model, int(one), int(other)) for one, other in pairs if one >= 0 and other >= 0}


def _why(model: "mujoco.MjModel", one: int, other: int) -> str:
    """The reason why two geoms cannot collide."""
    import mujoco
    import numpy as np

    flags = mujoco.mjtDisableBit
    if model.opt.disableflags & (flags.mjDSBL_CONTACT | flags.mjDSBL_CONSTRAINT):
        return "contacts are disabled"
    if np.isin(_signature(model, np.array([one]), np.array([other])), model.exclude_signature).any():
        return "an exclusion of their bodies"
    for geom in (one, other):
        if not model.geom_contype[geom] and not model.geom_conaffinity[geom]:
            name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_GEOM, geom) or f"geom_{geom}"
            return f"{name} has contype and conaffinity 0"
    return "their contype and conaffinity do not match"
