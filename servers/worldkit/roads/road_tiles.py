"""A road as ground: height fields of 50 m with shared borders, so that a wheel rolls from one to the next without a step.

A height field carries at most 50 contacts with one geom, and is right for heights of 0 to 1 times its size: each tile has its own.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from .road_surface import Road

if TYPE_CHECKING:
    import mujoco

TILE_M, CELL_M, BELOW_M = 50.0, 0.5, 0.5
VERGE_M = 6.0
ROAD_LOOK, VERGE_LOOK = "#3b3d40", "#55692f"
APART_M = TILE_M / 4
"""So close lie the places at which is asked what tiles a road touches."""
MOST_TILES = 1_000


def add(
    spec: "mujoco.MjSpec",
    road: Road,
    *,
    name: str,
    pos: tuple[float, float, float] = (0.0, 0.0, 0.0),
    yaw_deg: float = 0.0,
    verge_m: float = VERGE_M,
    surface: dict[str, Any] | None = None,
    places: Sequence[tuple[float, float]] | None = None,
    drawn: bool = True,
) -> "mujoco.MjsBody":
    """Add a road with a verge on both sides, its file's origin at `pos`, m.

    Args:
        spec: the world under construction.
        road: from `read`.
        name: of the body; its tiles are `NAME_1` and so on.
        pos: of the origin of the road's own frame.
        yaw_deg: its turn about z.
        verge_m: how far the ground goes on beside it, as high as its edge.
        surface: from `contacts.surface`.
        places: lower left corners of those of its `tiles` that are wanted; all when None.
        drawn: give it its look, asphalt between grass.

    Raises:
        ValueError: there is a body of this name, or the road would take too many tiles.
    """
    import mujoco
    import numpy as np

    if spec.body(name) is not None:
        raise ValueError(f"there is a body {name!r} already: name this road otherwise")
    turn = np.radians(yaw_deg)
    low_corner, high_corner = box(road, verge_m)
    middle = (np.array(low_corner) + high_corner) / 2
    c, s = np.cos(turn), np.sin(turn)
    # The body's frame is the middle of the box around it, as of every object of a plan.
    at = np.add(pos, (c * middle[0] - s * middle[1], s * middle[0] + c * middle[1], middle[2]))
    body = spec.worldbody.add_body(name=name, pos=at, quat=(np.cos(turn / 2), 0, 0, np.sin(turn / 2)))
    side = round(TILE_M / CELL_M) + 1
    ticks = np.linspace(0, TILE_M, side)
    for number, (left, low) in enumerate(tiles(road, verge_m) if places is None else places, 1):
        grid = np.stack(np.meshgrid(left + ticks, low + ticks), axis=-1).reshape(-1, 2)
        heights, _ = road.height(grid)
        bottom, rise = float(heights.min()), max(float(np.ptp(heights)), 1e-3)
        tile = f"{name}_{number}"
        field = spec.add_hfield(name=tile, nrow=side, ncol=side, size=(TILE_M / 2, TILE_M / 2, rise, BELOW_M))
        field.userdata = ((heights - bottom) / rise).astype(np.float32).tolist()
        material = _drawn(spec, tile, road, left, low) if drawn else ""
        body.add_geom(
            name=tile, type=mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname=tile, material=material,
            pos=np.array((left + TILE_M / 2, low + TILE_M / 2, bottom)) - middle, **(surface or {}),
        )  # fmt: skip
    return body


def tiles(road: Road, verge_m: float = VERGE_M) -> list[tuple[float, float]]:
    """The lower left corners (x, y), m, of the tiles that a road and its verges touch, on one raster."""
    import numpy as np

    step = float(np.linalg.norm(np.diff(road.line[:, :2], axis=0), axis=1).max(initial=0.0))
    if step > APART_M:
        raise ValueError(
            f"the road is told every {step:.3g} m of its way, {APART_M:g} m at most: survey it more closely"
        )
    first, last = float(road.sections_m[0]) - verge_m, float(road.sections_m[-1]) + verge_m
    if last - first > APART_M * MOST_TILES:
        raise ValueError(f"the road is {last - first:.4g} m wide with its verges, {APART_M * MOST_TILES:g} m at most")
    edges = (first, float(road.sections_m[0]), float(road.sections_m[-1]), last)
    wide = np.unique(np.concatenate([edges, np.linspace(first, last, int(np.ceil((last - first) / APART_M)) + 4)]))
    x, y, turn = road.line[:, 0], road.line[:, 1], road.heading
    found = set[tuple[int, int]]()
    for beside in wide:
        cells = np.floor(np.stack([x - beside * np.sin(turn), y + beside * np.cos(turn)], axis=1) / TILE_M).astype(int)
        found |= {(int(i), int(j)) for i, j in np.unique(cells, axis=0)}
    if len(found) > MOST_TILES:
        raise ValueError(
            f"the road takes {len(found)} tiles of {TILE_M:g} m, {MOST_TILES} at most: cut a shorter road of it"
        )
    return [(i * TILE_M, j * TILE_M) for i, j in sorted(found)]


def box(road: Road, verge_m: float = VERGE_M) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
    """The lowest and the highest corner of the box around a road's tiles, in the road's own frame, m."""
    corners = tiles(road, verge_m)
    x, y = zip(*corners, strict=True)
    low = (min(x), min(y), float(road.heights.min()) - BELOW_M)
    return low, (max(x) + TILE_M, max(y) + TILE_M, float(road.heights.max()))


def _drawn(spec: "mujoco.MjSpec", tile: str, road: Road, left: float, low: float) -> str:
    """The look of a tile: asphalt with white edges, and grass beside it."""
    import mujoco
    import numpy as np

    size = 256
    ticks = (np.arange(size) + 0.5) * TILE_M / size
    grid = np.stack(np.meshgrid(left + ticks, low + ticks), axis=-1).reshape(-1, 2)
    _, away = road.height(grid)
    first, last = road.sections_m[0], road.sections_m[-1]
    on = (away > first) & (away < last)
    edge = on & ((away < first + 0.35) & (away > first + 0.1) | (away > last - 0.35) & (away < last - 0.1))
    noise = np.random.default_rng(0).integers(-7, 8, len(away))[:, None]
    rgb = np.where(on[:, None], np.array(_rgb(ROAD_LOOK)), np.array(_rgb(VERGE_LOOK))) + noise
    rgb[edge] = 215
    picture = np.clip(rgb, 0, 255).astype(np.uint8).reshape(size, size, 3)
    texture = spec.add_texture(name=tile, type=mujoco.mjtTexture.mjTEXTURE_2D, width=size, height=size, nchannel=3)
    texture.data = picture.tobytes()
    material = spec.add_material(name=tile, specular=0.1, shininess=0.1)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = tile
    material.texrepeat, material.texuniform = (1, 1), False
    return tile


def _rgb(look: str) -> tuple[int, int, int]:
    r, g, b = (int(look[k : k + 2], 16) for k in (1, 3, 5))
    return r, g, b
