"""What is drawn only and could be taken for a mover: as large as it, and flying or riding about, or standing in its place.

Particles are as large as what they make together (`clumps`), above all under one surface, and so are puffs of smoke that are too thick for any (`thick_puffs`). It may be drawn, and says so: its size in statement and report, and its name in the picture's corner, unless it is the dress of the very mover it is fixed to.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

    from ..recording.stored import Recording

LIKE = 0.5
"""From this share of a mover's longest side on, something is as large as it."""
COVERS = 0.9
"""What is fixed to a body and has this share of each of its sides, around its middle, covers it."""
TWIN = 0.25
"""What differs by less in each of its sides (the logarithm of their ratio) has another's shape."""
MOVES_M = 1e-3
ROWS = 100
"""At so many moments, evenly spread, it is asked where the movers were."""


def movers(recording: "Recording") -> list[str]:
    """Bodies that the plan expects to move, and all others that did."""
    import numpy as np

    told = set(recording.meta.get("movers") or ())
    gone = np.ptp(recording.pos, axis=0).max(axis=-1) > MOVES_M if len(recording.names) else ()
    return [name for name, moved in zip(recording.names, gone, strict=True) if moved or name in told]


def told(
    things: "tuple[dict[str, Any], ...]",
    arrays: "dict[str, np.ndarray]",
    recording: "Recording",
    surfaces: "tuple[dict[str, Any], ...]" = (),
) -> "tuple[dict[str, Any], ...]":
    """The drawn things, with `like`, such as `0.2 m, as large as ball`, of each that could be taken for a mover.

    Particles under one of the `surfaces` have its name as `under`: it is what is seen of them.
    """
    import numpy as np

    from worldkit.turning import turned

    from . import clumps
    from .motion_facts import boxes

    under = {name: surface["name"] for surface in surfaces for name in surface["of"]}
    moving, names = movers(recording), _shaped(recording)
    if not names or not things:
        return things
    index = [recording.names.index(name) for name in names]
    middle, half = (found[index] for found in boxes(recording))
    together = clumps.sizes(things, arrays)
    ways = np.array(recording.pos[:: max(len(recording.time) // ROWS, 1)], dtype=float)[:, index]
    found = []
    for thing in things:
        (size, centre), rides = _extent(thing, arrays), thing["to"] in moving
        if thing["to"] and not rides:  # it stands where the body stands that carries it
            row = recording.names.index(thing["to"])
            centre = (
                turned(np.array(recording.quat[0, row], dtype=float)[None], centre[None])[0] + recording.pos[0, row]
            )
        like = _like(thing, rides, (size, centre), names, middle, half, ways)
        if thing.get("ways"):
            like = like or _clumped(together[thing["name"]], thing["name"] in under, names, 2 * half.max(axis=1))
            like |= {"under": under[thing["name"]]} if thing["name"] in under else {}
        worn = bool(like) and rides and _worn(thing, size, centre, names, middle, half)
        found.append(thing | like | ({"worn": True} if worn else {}))
    return tuple(found)


def of_puffs(
    rows: "tuple[dict[str, Any], ...]", arrays: "dict[str, np.ndarray]", recording: "Recording"
) -> "tuple[dict[str, Any], ...]":
    """The puffs, with `like` of those of which some are together as thick as a thing, and as large as a mover."""
    from . import thick_puffs
    from .motion_facts import boxes

    names = _shaped(recording) if rows else []
    if not names:
        return rows
    _, half = boxes(recording)
    largest = 2 * half[[recording.names.index(name) for name in names]].max(axis=1)
    return tuple(one | _clumped(thick_puffs.sizes(one, arrays), False, names, largest) for one in rows)


def _shaped(recording: "Recording") -> list[str]:
    """The movers that have a size: a vertex of a cloth has none of its own."""
    shaped = {geom["body"] for geom in recording.meta["geoms"] if geom["type"] != "plane"}
    return [name for name in movers(recording) if name in shaped]


def _worn(
    thing: dict[str, Any],
    size: "np.ndarray",
    centre: "np.ndarray",
    names: list[str],
    middle: "np.ndarray",
    half: "np.ndarray",
) -> bool:
    """Whether a thing dresses the very mover it is fixed to: the middle of one lies within the other, it is about as large, from half
    to twice, is no other mover's twin, and goes nowhere by itself. What is seen to move is that mover then,
    as under a skin; a smaller one may look like another mover, and what rides above it or beside it may be taken for one more."""
    import numpy as np

    from worldkit.turning import turned

    if thing["to"] not in names or thing.get("ways"):
        return False
    own = names.index(thing["to"])
    away = centre - middle[own]
    back = np.array(thing["quat"], dtype=float) * (1, -1, -1, -1)
    around = (np.abs(turned(back[None], away[None])[0]) <= size / 2).all()
    longest, sides = 2 * half.max(axis=1), np.sort(2 * half, axis=1)
    with np.errstate(divide="ignore"):  # a flat sheet has a side of nothing, and is unlike all that has three
        unlike = np.abs(np.log(np.sort(size) / sides)).max(axis=1)  # by its side that differs most
    return bool(
        (around or (np.abs(away) <= half[own]).all())
        and LIKE * longest[own] <= size.max() <= longest[own] / LIKE
        and (unlike[own] <= unlike.min() or unlike.min() > TWIN)
    )


def _like(
    thing: dict[str, Any],
    rides: bool,
    extent: "tuple[np.ndarray, np.ndarray]",
    names: list[str],
    middle: "np.ndarray",
    half: "np.ndarray",
    ways: "np.ndarray",
) -> dict[str, str]:
    """`like` of one thing of some sides and middle beside movers (M) with their boxes (M, 3), m, and ways (R, M, 3), m.

    What flies, and what `rides` on a mover, goes about: there its size tells, and where it is only of the mover that carries it.
    """
    import numpy as np

    if thing["instead"]:  # a skin has its body's size and place, and is told as one
        return {}
    (size, centre), largest, away = extent, 2 * half.max(axis=1), np.linalg.norm(half, axis=1)
    same, there = size.max() >= LIKE * largest, np.zeros(len(names), bool)
    if not thing.get("ways"):
        same &= size.max() <= largest / LIKE
        if rides:
            own = np.array(names) == thing["to"]
            whole = (np.sort(size) >= COVERS * np.sort(2 * half, axis=1)).all(axis=1)
            there = own & whole & (np.linalg.norm(middle - centre, axis=1) < 0.5 * away)
            same &= ~own
        else:
            some = np.flatnonzero(same)
            there[some] = (np.linalg.norm(ways[:, some] - centre, axis=2) < away[some]).any(axis=0)
            same = there
    for some, where in ((there, ", and in its place"), (same, "")):
        if some.any():
            return {"like": f"{size.max():.2g} m, as large as {names[int(np.argmax(some))]}{where}"}
    return {}


def _clumped(sides: "np.ndarray", covered: bool, names: list[str], largest: "np.ndarray") -> dict[str, str]:
    """`like` of particles that make clumps of such longest sides (K,), m, beside movers (M) of theirs (M,), m.

    A cloud that is far larger than a mover is none; a surface over it, which looks like a thing, may be as large as it likes.
    """
    import numpy as np

    same = sides[:, None] >= LIKE * largest
    same &= covered | (sides[:, None] <= largest / LIKE)
    for side, some in zip(sides, same, strict=True):
        if some.any():
            return {"like": f"{side:.2g} m together, as large as {names[int(np.argmax(some))]}"}
    return {}


def _extent(thing: dict[str, Any], arrays: "dict[str, np.ndarray]") -> "tuple[np.ndarray, np.ndarray]":
    """Full sides (3,), m, of a thing, and its middle (3,), m, in the frame it is fixed in."""
    import numpy as np

    from worldkit.turning import turned

    size, middle = np.array(thing["size"], dtype=float), np.zeros(3)
    if thing["shape"] == "mesh":
        points = arrays[thing["vertices"]] * size
        size, middle = np.ptp(points, axis=0), 0.5 * (points.min(axis=0) + points.max(axis=0))
    if thing.get("ways") and "turns" not in thing:
        size = np.full(3, float(arrays[thing["sizes"]].max(initial=0.0)))
    return size, turned(np.array(thing["quat"], dtype=float)[None], middle[None])[0] + np.array(thing["pos"])


def covered(surface: dict[str, Any], things: "tuple[dict[str, Any], ...]") -> str:
    """What is said of a surface: in place of how much it stands, and what it could be taken for."""
    like = [f", {thing['like']}" for thing in things if thing.get("under") == surface["name"] and thing.get("like")][:1]
    return f"{surface['name']} (one surface in place of {len(surface['of'])} shapes{''.join(like)})"


def words(film: Any, frame: int) -> str:
    """What the picture says of them: `drawn: dust`; empty where none is shown. What a mover wears, the statement alone tells."""
    from . import thick_puffs

    shown = [
        thing.get("under") or thing.get("of") or thing["name"]
        for thing in film.things
        if thing.get("like")
        and not thing.get("worn")
        and (not thing.get("ways") or film.arrays[thing["sizes"]][frame].max() > 0)
    ]
    puffs = [one for one in film.puffs if one.get("like")]
    shown += [one["name"] for one in puffs if thick_puffs.thick(one, film.arrays, frame).any()]
    shown = list(dict.fromkeys(shown))
    return f"drawn: {', '.join(shown[:3])}{' …' * (len(shown) > 3)}" if shown else ""
