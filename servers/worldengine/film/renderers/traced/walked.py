"""Walk paths of light for a picture: the light, and what guides its denoiser; of all pixels, or of some.

With the same seed each path meets the same chances, so a pixel that is walked among few is the very one that is walked among all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from . import absorbed, behind_glass, plainly_through, variant

AT_ONCE = 64
"""Samples a pixel that are traced in one go, since the memory they take grows with them."""
Clear = Sequence[tuple[Any, tuple[float, float, float]]]


class Rays(NamedTuple):
    """One picture as it was traced: scene light, colours of surfaces and sky, normals, places (H, W, 3), and the share of things
    (H, W)."""

    light: np.ndarray
    albedo: np.ndarray
    normals: np.ndarray
    places: np.ndarray
    seen: np.ndarray

    def joined(self, other: Rays, before: int) -> Rays:
        """The mean of these, which are that of so many moments, and those of one more; a place counts as far as it is seen."""
        light, albedo, normals, seen = (
            (before * getattr(self, name) + getattr(other, name)) / np.float32(before + 1)
            for name in ("light", "albedo", "normals", "seen")
        )
        mine, theirs = before * self.seen[..., None], other.seen[..., None]
        places = (mine * self.places + theirs * other.places) / np.maximum(mine + theirs, 1e-6)
        return Rays(light, albedo, normals, places, seen)

    def over(self, other: Rays, where: np.ndarray) -> Rays:
        """These where a coarser mask (h, w) has it, the others elsewhere."""

        def chosen(mine: np.ndarray, theirs: np.ndarray) -> np.ndarray:
            mask = spread(where, *mine.shape[:2])
            return np.where(mask.reshape(*mask.shape, *[1] * (mine.ndim - 2)), mine, theirs)

        return Rays(*(chosen(mine, theirs) for mine, theirs in zip(self, other, strict=True)))


def spread(mask: np.ndarray, height: int, width: int) -> np.ndarray:
    """A mask (h, w) over a picture of another size (height, width)."""
    rows, columns = mask.shape
    return mask[np.arange(height)[:, None] * rows // height, np.arange(width) * columns // width]


def light(
    scene: Any,
    sensor: Any,
    depth: int,
    samples: int,
    seed: int,
    where: np.ndarray | None = None,
    clear: Clear = (),
) -> np.ndarray:
    """Scene light (H, W, 3) of paths of at most `depth` turns; where a coarser mask does not have it, nothing.

    Args:
        scene, sensor: Mitsuba's.
        depth: the longest paths.
        samples: a pixel.
        seed: of their chances.
        where: (h, w) of the pixels that are walked, a mask of any size.
        clear: shapes that light goes through, with how much of each colour fades there, 1/m; computed plainly, nothing does.
    """
    import mitsuba as mi

    compiled = variant.compiled()
    path = (
        absorbed.walker(depth, clear)
        if clear and compiled
        else mi.load_dict({"type": "path", "max_depth": depth, "rr_depth": absorbed.LONGEST})
    )
    total: Any = np.float32(0)
    for first in range(0, samples, AT_ONCE):
        some = min(AT_ONCE, samples - first)
        if where is None:
            drawn = np.array(mi.render(scene, sensor=sensor, integrator=path, spp=some, seed=seed + first))
        else:
            drawn = _some(scene, sensor, path, some, seed + first, where)
        total = total + drawn * np.float32(some / samples)
    if clear and not compiled:
        width, height = sensor.film().size()
        some_of = None if where is None else spread(where, int(height), int(width))
        total = total + plainly_through.light(scene, sensor, [shape for shape, _ in clear], some_of)
    return np.asarray(total)


def guides(scene: Any, sensor: Any, samples: int, where: np.ndarray | None = None, clear: Clear = ()) -> np.ndarray:
    """Red, green, blue, share of things, colour of the surface, normal, place (H, W, 13); a second walk, which around the
    path tracer itself would double its time. Colours and normals are those behind what is `clear`."""
    import mitsuba as mi

    if clear and variant.compiled():
        through = behind_glass.walker(absorbed.media(clear))
        if where is not None:
            return _some(scene, sensor, through, samples, 0, where)[..., -behind_glass.CHANNELS :]
        return np.array(mi.render(scene, sensor=sensor, integrator=through, spp=samples, seed=0))[
            ..., -behind_glass.CHANNELS :
        ]
    guide = mi.load_dict({"type": "aov", "aovs": "a:albedo,n:sh_normal,p:position", "any": {"type": "depth"}})
    if where is not None:
        return _some(scene, sensor, guide, samples, 0, where)[..., 3:]
    return np.array(mi.render(scene, sensor=sensor, integrator=guide, spp=samples, seed=0))


def covered(scene: Any, sensor: Any, samples: int, seed: int, where: np.ndarray | None = None) -> np.ndarray:
    """The share of things (H, W) in the very samples that `light` takes with this seed; a fiftieth of its work.

    Args:
        scene, sensor: Mitsuba's; the film is of red, green, blue and alpha.
        samples: a pixel.
        seed: of their chances.
        where: (h, w) of the pixels that are walked, a mask of any size; elsewhere nothing is there.
    """
    import mitsuba as mi

    depth = {"type": "aov", "aovs": "p:position", "any": {"type": "depth"}}
    total: Any = np.float32(0)
    for first in range(0, samples, AT_ONCE):
        some = min(AT_ONCE, samples - first)
        if where is None:
            drawn = np.array(
                mi.render(scene, sensor=sensor, integrator=mi.load_dict(depth), spp=some, seed=seed + first)
            )
        else:
            drawn = _some(scene, sensor, mi.load_dict(depth), some, seed + first, where)[..., 3:]
        total = total + drawn[..., 3] * np.float32(some / samples)
    return np.clip(total, 0.0, 1.0)


def ordered(light: np.ndarray, said: np.ndarray) -> Rays:
    """Bring what was traced into order; where there is only sky, nothing has a place."""
    for traced in (light, said):
        if not np.isfinite(traced).all():
            np.nan_to_num(traced, copy=False, nan=0.0, posinf=0.0, neginf=0.0)
    seen = np.clip(said[..., 3], 0.0, 1.0)
    places = said[..., 10:13] / np.maximum(seen, 1e-6)[..., None]
    return Rays(np.maximum(light, 0.0), np.clip(said[..., 4:7], 0, 1), said[..., 7:10], places, seen)


def _some(scene: Any, sensor: Any, integrator: Any, samples: int, seed: int, where: np.ndarray) -> np.ndarray:
    """What Mitsuba's own rendering gives in the pixels of a mask: light, then what else the integrator says (H, W, 3 + N).

    Each sample keeps the place in the order, and with it the chances, that it has among those of all pixels; what is
    left out costs a fortieth of what is walked.
    """
    import drjit as dr
    import mitsuba as mi

    width, height = (int(side) for side in sensor.film().size())
    sampler = mi.load_dict({"type": "independent"})
    count = width * height * samples
    # Numbers that a kernel shall not be compiled anew for are opaque to it.
    sampler.seed(dr.opaque(mi.UInt32, seed), count)
    each, wide = dr.opaque(mi.UInt32, samples), dr.opaque(mi.UInt32, width)
    pixel = dr.arange(mi.UInt32, count) // each
    row = pixel // wide
    active = dr.gather(mi.Bool, mi.Bool(spread(where, height, width).ravel()), pixel)
    place = mi.Vector2f(mi.Float(pixel - row * wide), mi.Float(row)) + sampler.next_2d()
    place /= mi.Vector2f(mi.Float(wide), dr.opaque(mi.Float, height))
    through = sampler.next_2d() if sensor.needs_aperture_sample() else mi.Point2f(0.5)
    ray, weight = sensor.sample_ray_differential(0.0, 0.0, mi.Point2f(place), mi.Point2f(through))
    ray.scale_differential(dr.rsqrt(mi.Float(each)))
    found, _, further = integrator.sample(scene, sampler, ray, None, active)
    totals = []
    for value in (*(found * weight), *further):
        totals.append(dr.zeros(mi.Float, width * height))
        dr.scatter_add(totals[-1], value, pixel, active)
    dr.eval(totals)
    return np.stack([np.array(total).reshape(height, width) for total in totals], -1) / np.float32(samples)
