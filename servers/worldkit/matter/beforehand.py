"""What is refused before a run, with the numbers: too many points, overlapping sources, an open container, too many steps."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import ProgramError
from .first_places import Region, Source

if TYPE_CHECKING:
    import mujoco

    from .touched_geoms import Geoms

Array = np.ndarray
MOST_POINTS = 20_000
MOST_NODES = 6_000_000
"""Of the grid: 190 MB."""
MOST_WORK = 3e8
"""Points times steps in a simulated second: about three minutes of processor time."""
SHALLOW = 4.0
"""Cells: what sticks to a bowl less deep stays in it, for the grid holds the layers at its walls."""


def check_positive(what: str, **values: float | None) -> None:
    """Refuse a number that is not above zero; None is one that was left out.

    Raises:
        ProgramError: with its name.
    """
    for name, value in values.items():
        if value is not None and not (0.0 < value < np.inf):
            raise ProgramError(
                f"{what} has a {name} of {value:g}", "worldkit.matter", f"give a {name} above zero, or leave it out"
            )


def check_points(name: str, count: int, spacing: float) -> None:
    """Refuse none, and more than `MOST_POINTS`.

    Raises:
        ProgramError: with the spacing that would do.
    """
    if count == 0:
        raise ProgramError(
            f"{name} has no points", "worldkit.matter", "fill a region wider than the spacing, or pour it"
        )
    if count > MOST_POINTS:
        enough = spacing * (count / MOST_POINTS) ** (1 / 3)
        cause = f"{name} would have {count} points, more than {MOST_POINTS}"
        raise ProgramError(cause, "worldkit.matter", f"make the spacing {enough * 1.02:.2g} m, or have less of it")


def check_sources(
    name: str, sources: Sequence[Source], begins: Sequence[Region], spacing: float, bodies: Sequence[str]
) -> None:
    """Refuse sources that overlap while both give, or that lie in what is filled; those that nobody carries.

    Raises:
        ProgramError: with the two that overlap.
    """
    if sources and "world" not in bodies:
        raise ProgramError(f"what carries the sources of {name} is missing", name, 'let "world" be in `bodies`')
    reach = [s.radius if s.sides is None else float(np.hypot(*s.sides)) / 2 for s in sources]
    for i, one in enumerate(sources):
        for j in range(i):
            two = sources[j]
            if one.sides is not None or two.sides is not None:  # what is strewn is sparse
                continue
            apart = float(np.linalg.norm(np.subtract(one.at, two.at)))
            if apart < (reach[i] or 0) + (reach[j] or 0) and one.starts < two.ends and two.starts < one.ends:
                cause = f"sources {j} and {i} of {name} overlap: their middles are {apart:.3g} m apart, their radii {reach[j]:.3g} and {reach[i]:.3g} m"
                raise ProgramError(cause, name, "move one, or let one end before the other starts")
        for region in begins:
            at = np.array([one.at])
            if (at >= region.low - spacing).all() and (at <= region.high + spacing).all() and region.holds(at).any():
                cause = f"source {i} of {name} lies in what is filled at the start, at {one.at}"
                raise ProgramError(cause, name, "raise it above")


def check_work(name: str, count: int, longest: float, step: float | None) -> None:
    """Refuse a step that is too long for the stiffness, and more steps than anyone waits for.

    Raises:
        ProgramError: with the step, and what makes it longer.
    """
    if step is not None and step > longest:
        cause = f"the step of {name}, {step:.3g} s, is too long for its stiffness: stable up to {longest:.3g} s"
        raise ProgramError(
            cause, name, f"leave `step` out, or make it {longest:.2g} s; soften `sound` to have it longer"
        )
    if (work := count / (step or longest)) > MOST_WORK:
        cause = (
            f"{name} needs steps of {step or longest:.3g} s with {count} points: {work / MOST_WORK:.1f} times the most"
        )
        raise ProgramError(cause, name, "make the spacing larger, the speed of sound lower, or the liquid less viscous")


def check_container(matter: Any, data: "mujoco.MjData", geoms: "Geoms", begun: Array, container: str | None) -> None:
    """Refuse points that begin in a wall, and a container through which they could run out.

    Raises:
        ProgramError: with how many, and where.
    """
    from ..naming import names

    places = matter._leaves[begun]
    gap, walls = geoms.gaps(places)
    if (inside := gap < -0.5 * matter.spacing).any():
        deepest = int(gap.argmin())
        body = list(matter.bodies)[int(walls[deepest])]
        at = ", ".join(f"{value:.3g}" for value in places[deepest])
        cause = f"{int(inside.sum())} of {len(places)} points of {matter.name} begin in a wall of {body}, the deepest {-gap[deepest]:.3g} m, at ({at})"
        raise ProgramError(cause, matter.name, "fill only what is free: `within(test, low, high)`")
    if container is None:
        return
    model = matter._model
    known = names(model, "body", model.nbody)
    if container not in known:
        cause = f"the container of {matter.name} is {container!r}, which is no body of the world"
        raise ProgramError(cause, matter.name, f"name one of: {', '.join(known)}")
    mine = [g for g in range(model.ngeom) if model.geom_bodyid[g] == known.index(container)]
    reach = max(
        (
            float(np.linalg.norm(data.geom_xpos[g] - data.geom_xpos[mine[0]])) + float(model.geom_rbound[g])
            for g in mine
        ),
        default=0.0,
    )
    out = leak(geoms, places, matter.spacing, data.geom_xpos[mine[0]] if mine else np.zeros(3), reach)
    if out is not None:
        at = ", ".join(f"{value:.3g}" for value in out)
        cause = f"the container {container} is open below the {matter.name} in it: it would run out at ({at})"
        raise ProgramError(
            cause, matter.name, "close it there, or fill it less high; gaps under one spacing are closed"
        )


def check_bowl(matter: Any, geoms: "Geoms", begun: Array) -> None:
    """Refuse what would stick, unasked, in a bowl of less than `SHALLOW` cells: it hardly leaves one, whatever its viscosity.

    Raises:
        ProgramError: with the spacing that would do.
    """
    places, cell = matter._leaves[begun], matter.cell
    _, column = np.unique(np.floor(places[:, :2] / cell).astype(np.int64), axis=0, return_inverse=True)
    column = column.reshape(-1)
    low, high = np.full(column.max() + 1, np.inf), np.full(column.max() + 1, -np.inf)
    np.minimum.at(low, column, places[:, 2])
    np.maximum.at(high, column, places[:, 2])
    depth = float((high - low).max()) + matter.spacing
    if depth >= SHALLOW * cell:
        return
    bottom = places[places[:, 2] <= (places[:, 2].min() + places[:, 2].max()) / 2]
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    reach = float(np.ptp(places, axis=0).max()) / 2 + 2 * cell
    if leak(geoms, bottom, matter.spacing, middle, reach) is None:
        cause = f"{matter.name} lies {depth / cell:.1f} cells deep in a bowl and sticks to it: of less than {SHALLOW:g} cells hardly any runs out"
        move = f"make the spacing {depth / SHALLOW / 2:.2g} m, or tell its Liquid `sticks=False` (it slides) or `sticks=True` (it may stay)"
        raise ProgramError(cause, matter.name, move)


def leak(geoms: "Geoms", places: Array, spacing: float, middle: Array, reach: float) -> Array | None:
    """(3,) m: where what lies at places (n, 3) could leave a ball around the container without rising; None where it is held."""
    from scipy.ndimage import label

    low = middle - reach - spacing
    count = np.minimum(np.ceil(2 * (reach + spacing) / spacing).astype(int), 96)
    side = 2 * (reach + spacing) / count
    top = float(places[:, 2].max())
    axes = [low[i] + side * (np.arange(count) + 0.5) for i in range(3)]
    axes[2] = axes[2][axes[2] <= top + side / 2]
    if not len(axes[2]):
        return None
    cells = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    gap, _ = geoms.gaps(cells.reshape(-1, 3))
    free = (gap > side / 2).reshape(cells.shape[:3])
    at = ((places - low) // side).astype(int)
    inside = ((at >= 0) & (at < free.shape)).all(axis=1)
    parts, _ = label(free)
    mine = np.unique(parts[tuple(at[inside].T)])
    wet = np.isin(parts, mine[mine > 0])
    edge = np.zeros_like(wet)
    edge[[0, -1]] = edge[:, [0, -1]] = edge[:, :, 0] = True
    found = np.argwhere(wet & edge)
    return cells[tuple(found[0])] if len(found) else None
