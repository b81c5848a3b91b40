"""Draw a film's puffs of smoke and mist over a picture: soft, lit, shading each other, hidden by what stands before them.

A picture is a picture here, whoever drew it, so preview and traced film have the same smoke. Puffs are sorted into slices of depth.
In each the optical depth of all of them is summed, as coarsely as they are wide, so that 20,000 cost as much as 200 large ones;
light goes through it as exp(-depth). Each slice is held against the distance of what the picture shows, softly, so that no puff is
cut by a plane. How much of the key light comes through to each is summed along the light's way in a coarse grid.

Its white is that of the picture: nothing of a film says how bright a white wall would be developed, but its brightest parts do.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from .wisps import depth_of, torn

if TYPE_CHECKING:
    from .carrying import Surfaces
    from .treatment import Treatment

Array = np.ndarray
SLICES, FINE_PX, GRID, EXTENT = 14, 4.0, 20, 1.5
"""Slices of depth; radius that a puff has on the grid it is summed on, at most twice that; cells each way of light; half the width of
a puff's picture, in radii of its bell."""
DIM, DARKEST, BRIGHTEST = 0.45, 0.06, 0.92
"""The light of the surroundings beside the key's; the least and most bright that white smoke is developed."""
SCATTERED = 0.2
"""How much sooner than that light which comes through scattered has lost a share: what goes on forwards is not lost."""
SUN = (0.35, -0.5, 0.8)
LIGHT = (np.arange(256, dtype=np.uint8).astype(np.float32) / 255.0) ** 2.2
"""The light of each value of a picture."""


def check(told: dict[str, Any], arrays: dict[str, Array], frames: int) -> tuple[dict[str, Any], ...]:
    """The puffs of a description.

    Raises:
        ValueError: they are none.
    """
    from worldkit.filming import film_bounds as bounds

    found = []
    if len(told.get("puffs", ())) > bounds.MOST_EMITTERS:
        raise ValueError(f"a film has at most {bounds.MOST_EMITTERS} kinds of puffs, not {len(told['puffs'])}")
    for one in told.get("puffs", ()):
        row: dict[str, Any] = {"name": str(one["name"])[:60], "rgb": tuple(float(v) for v in one["rgb"])}
        row["eddies_m"] = float(one.get("eddies_m", 0.0))
        row |= {what: str(one[what]) for what in ("places", "wide", "opaque")}
        places, wide, opaque = (arrays[str(one[what])] for what in ("places", "wide", "opaque"))
        good = (
            places.ndim == 3
            and places.shape[0] == frames
            and places.shape[2] == 3
            and places.shape[1] <= bounds.MOST_PUFFS
        )
        good = good and wide.shape == opaque.shape == places.shape[:2] and wide.size <= bounds.MOST_PUFF_NUMBERS
        good = good and 0 <= row["eddies_m"] <= bounds.FAR_M
        if not good or len(row["rgb"]) != 3 or not all(np.isfinite(a).all() for a in (places, wide, opaque)):
            raise ValueError(f"the puffs {row['name']!r} are none that can be drawn")
        found.append(row)
    return tuple(found)


def over(
    picture: Array,
    arrays: dict[str, Array],
    puffs: tuple[dict[str, Any], ...],
    frame: int,
    shown: "Surfaces",
    treatment: "Treatment",
    clouds: tuple[Any, ...] = (),
) -> Array:
    """The picture (H, W, 3), uint8, with the puffs of a frame, rows as `check` returns them, and the clouds (`wisps.Cloud`) of laws; `shown`
    is what it shows."""
    rows = []
    for kind in puffs:
        found, wide, opaque = (np.asarray(arrays[kind[what]][frame], float) for what in ("places", "wide", "opaque"))
        eddies = kind.get("eddies_m", 0.0)
        rows.append((*(torn(found, wide, opaque, eddies) if eddies else (found, wide / 2, opaque)), kind["rgb"]))
    rows += [(*cloud.puffs(frame), cloud.rgb) for cloud in clouds]
    places = np.concatenate([row[0] for row in rows])
    radius, opaque = (np.concatenate([np.asarray(row[n], float) for row in rows]) for n in (1, 2))
    rgb = np.concatenate([np.tile(row[3], (len(row[0]), 1)) for row in rows])
    height, width = picture.shape[:2]
    view = shown.view
    local = (places - view.eye) @ view.axes
    deep = -local[:, 2]
    there = np.flatnonzero((radius > 0) & (opaque > 0) & (deep > np.maximum(2 * view.near_m, 0.5 * radius)))
    if not len(there):
        return picture
    local, deep, radius, opaque, rgb = local[there], deep[there], radius[there], opaque[there], rgb[there]
    x = (local[:, 0] / deep / view.tangents[0] + 1) * width / 2
    y = (1 - local[:, 1] / deep / view.tangents[1]) * height / 2
    wide = radius / deep / view.tangents[1] * height / 2
    inside = (x > -2 * wide) & (x < width + 2 * wide) & (y > -2 * wide) & (y < height + 2 * wide)
    if not inside.any():
        return picture
    light = _lit(places[there], radius, opaque, _sun(treatment))
    x, y, wide, deep, radius, opaque, rgb, light = (a[inside] for a in (x, y, wide, deep, radius, opaque, rgb, light))
    thick = depth_of(opaque)
    colour = (rgb**2.2) * light[:, None]
    edges = np.geomspace(deep.min() * 0.999, deep.max() * 1.001, SLICES + 1)
    slices = np.clip(np.searchsorted(edges, deep) - 1, 0, SLICES - 1)
    white = _white(picture) * _tint(picture, treatment)
    out, touched = LIGHT[picture], []
    far = np.where(shown.depth > 0, shown.depth, np.inf)
    if far.shape != (height, width):
        import cv2

        far = cv2.resize(far.astype(np.float32), (width, height), interpolation=cv2.INTER_NEAREST)
    for one in range(SLICES - 1, -1, -1):
        mine = slices == one
        if not mine.any():
            continue
        sums, box = _summed(x[mine], y[mine], wide[mine], thick[mine], colour[mine], (height, width))
        middle = float(np.average(deep[mine], weights=thick[mine]))
        soft = max(float(np.median(radius[mine])), 1e-4)
        seen = np.clip((far[box] - middle) / (2 * soft) + 0.5, 0.0, 1.0)
        depth = sums[..., 0] * seen
        hides = -np.expm1(-depth)[..., None]
        own = sums[..., 1:] / np.maximum(sums[..., :1], 1e-9) * white
        out[box] = out[box] * (1 - hides) + own * hides
        touched.append(box)
    # Beside them the picture stays as it is: to raise all of it to a power takes longer than the puffs.
    rows, columns = zip(*touched, strict=True)
    part = tuple(
        slice(min(side.start for side in sides), max(side.stop for side in sides)) for sides in (rows, columns)
    )
    found = picture.copy()
    found[part] = np.rint(255 * np.clip(out[part], 0, 1) ** (1 / 2.2)).astype(np.uint8)
    return found


def _summed(
    x: Array, y: Array, wide: Array, thick: Array, colour: Array, size: tuple[int, int]
) -> tuple[Array, tuple[slice, slice]]:
    """(h, w, 4): optical depth, and of that by colours, in the box of the picture that the puffs touch, and that box."""
    import cv2

    reach = EXTENT * wide + 2
    low = np.maximum(np.floor([(y - reach).min(), (x - reach).min()]).astype(int), 0)
    high = np.minimum(np.ceil([(y + reach).max(), (x + reach).max()]).astype(int) + 1, size)
    box = slice(low[0], max(high[0], low[0] + 1)), slice(low[1], max(high[1], low[1] + 1))
    h, w = box[0].stop - box[0].start, box[1].stop - box[1].start
    total = np.zeros((h, w, 4), np.float32)
    level = np.clip(np.ceil(np.log2(np.maximum(wide, 1e-6) / FINE_PX)), 0, 8).astype(int)
    for number in np.unique(level):
        mine, step = level == number, 2 ** int(number)
        gh, gw = h // step + 2, w // step + 2
        # A puff narrower than a pixel is as thick, spread over one.
        r = np.maximum(wide[mine] / step, 0.7)
        strong = thick[mine] * np.minimum(wide[mine] / step / r, 1.0) ** 2
        gx, gy = (x[mine] - low[1]) / step - 0.5, (y[mine] - low[0]) / step - 0.5
        n = int(np.ceil(EXTENT * r.max())) + 1
        around = np.arange(-n, n + 1)
        cx, cy = np.rint(gx).astype(int), np.rint(gy).astype(int)
        px, py = cx[:, None] + around, cy[:, None] + around
        ex = np.exp(-2.0 * ((px - gx[:, None]) / r[:, None]) ** 2)
        ey = np.exp(-2.0 * ((py - gy[:, None]) / r[:, None]) ** 2)
        each = strong[:, None, None] * np.maximum(ey[:, :, None] * ex[:, None, :] - np.exp(-2.0 * EXTENT**2), 0.0)
        good = (py[:, :, None] >= 0) & (py[:, :, None] < gh) & (px[:, None, :] >= 0) & (px[:, None, :] < gw)
        at = (py[:, :, None] * gw + px[:, None, :])[good]
        grid = np.empty((gh, gw, 4), np.float32)
        weights = each[good]
        which = np.broadcast_to(np.arange(len(r))[:, None, None], each.shape)[good]
        grid[..., 0] = np.bincount(at, weights, minlength=gh * gw).reshape(gh, gw)
        own = colour[mine]
        for channel in range(3):
            grid[..., 1 + channel] = np.bincount(at, weights * own[which, channel], minlength=gh * gw).reshape(gh, gw)
        if step > 1:
            grid = cv2.resize(grid, (gw * step, gh * step), interpolation=cv2.INTER_CUBIC)
            np.maximum(grid, 0.0, out=grid)
        total += grid[:h, :w]
    return total, box


def _sun(treatment: "Treatment") -> Array:
    """The unit vector towards the key light."""
    if treatment.light_azimuth_deg is None or treatment.light_elevation_deg is None:
        way = np.array(SUN)
    else:
        turn, high = np.radians(treatment.light_azimuth_deg), np.radians(treatment.light_elevation_deg)
        way = np.array([np.cos(high) * np.cos(turn), np.cos(high) * np.sin(turn), np.sin(high)])
    return np.asarray(way / np.linalg.norm(way))


def _tint(picture: Array, treatment: "Treatment") -> Array:
    """(3,) linear: the colour of white smoke, a little of the key light's and of what is bright in the picture, where lamps shine."""
    some = picture[::4, ::4].reshape(-1, 3).astype(np.float32) / 255.0
    luma = some.mean(axis=1)
    bright = some[luma >= np.percentile(luma, 90)].mean(axis=0) ** 2.2
    key = np.asarray(treatment.light_rgb or (1.0, 1.0, 1.0), float) ** 2.2
    return np.asarray(0.6 + 0.2 * sum(colour / max(float(colour.max()), 1e-6) for colour in (bright, key)))


def _lit(places: Array, radius: Array, opaque: Array, sun: Array) -> Array:
    """(P,) how bright each puff is, up to 1: by the surroundings, and by what the others let through of the key light."""
    aside = np.cross(sun, (0.0, 0.0, 1.0) if abs(sun[2]) < 0.9 else (1.0, 0.0, 0.0))
    aside /= np.linalg.norm(aside)
    along = np.stack([places @ aside, places @ np.cross(sun, aside), places @ sun], axis=1)
    low, size = along.min(axis=0), np.maximum(np.ptp(along, axis=0), 2 * float(radius.mean()))
    cell = np.clip(((along - low) / size * GRID).astype(int), 0, GRID - 1)
    area = size[0] * size[1] / GRID**2
    depth = depth_of(opaque) * np.pi * radius**2 / 2 / max(area, 1e-12)
    grid: Array = np.bincount(np.ravel_multi_index(cell.T, (GRID,) * 3), depth, minlength=GRID**3).reshape((GRID,) * 3)
    wide = np.pad(grid, ((1, 1), (1, 1), (0, 0)))  # a puff is no cell; what it shades beyond the grid is lost
    wide = (wide[:-2] + 2 * wide[1:-1] + wide[2:]) / 4
    grid = (wide[:, :-2] + 2 * wide[:, 1:-1] + wide[:, 2:]) / 4
    before = np.cumsum(grid[:, :, ::-1], axis=2)[:, :, ::-1] - grid
    depth = before[tuple(cell.T)]
    # What is white loses hardly any light to itself: most of what is turned aside comes on from puff to puff.
    through = 0.35 * np.exp(-depth) + 0.65 * np.exp(-SCATTERED * depth)
    return np.asarray(DIM + (1 - DIM) * through)


def _white(picture: Array) -> float:
    """How bright white smoke is in a picture, by its brighter parts; linear, 0 to 1."""
    luma = picture[::4, ::4].astype(np.float32) @ np.array([0.2126, 0.7152, 0.0722], np.float32) / 255.0
    return float(np.clip(1.5 * np.percentile(luma, 96), DARKEST, BRIGHTEST) ** 2.2)
