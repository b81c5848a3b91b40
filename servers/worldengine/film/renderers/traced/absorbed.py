"""Paths of light through what is clear: glass, water, tea, wine, honey; they fade there by the way that they go in it.

Light keeps exp(-a d) of itself on a way d, m, in a substance that absorbs a, 1/m, of each colour (Beer and Lambert). That is
told for each stretch of a path from where it entered and left things, so it has no noise of its own; nothing is scattered.
Where a liquid reaches a little into the glass around it, both absorb, and light bends as if they touched (`interfaces`).

No path meets a light without a size by chance, so none would find it behind glass, which would throw the shadow of a wall.
Such a light is looked at straight through whatever is clear, less what its sides mirror (Fresnel) and what fades on the way:
a pale shadow without noise, and without the bright lines that bent light draws.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any

import numpy as np

from . import interfaces
from .interfaces import SURELY

LONGEST = 16
"""No path is ended by chance before this many turns."""
MOST_SIDES = 24
"""A light without a size is looked at through so many sides of clear things at most: four glasses of water are 24."""
MOST_MET = 64
"""A path ends after so many sides, those among them where nothing happens."""


def lets_through(coating: Any) -> bool:
    """Whether light goes straight through a material of Mitsuba's, or some of it."""
    import mitsuba as mi

    return any(mi.has_flag(coating.flags(), flag) for flag in (mi.BSDFFlags.DeltaTransmission, mi.BSDFFlags.Null))


def walker(depth: int, clear: Sequence[tuple[Any, tuple[float, float, float]]]) -> Any:
    """Mitsuba's integrator for paths of at most `depth` turns through clear shapes that absorb so much, 1/m; compiled variants
    only."""
    import drjit as dr
    import mitsuba as mi

    numbers = [_number(shape) for shape, _ in clear]
    table = np.zeros((4, max(numbers) + 1), np.float32)
    for number, (_, absorbs) in zip(numbers, clear, strict=True):
        table[:, number] = *absorbs, 1.0
    found = _kind()(mi.Properties())
    found.depth = depth
    found.table = [mi.Float(row) for row in table]
    dr.make_opaque(found.table)
    found.media = media(clear)
    return found


def media(clear: Sequence[tuple[Any, tuple[float, float, float]]]) -> interfaces.Interfaces:
    """What clear shapes are to light that goes through them."""
    return interfaces.Interfaces([(shape, _number(shape)) for shape, _ in clear])


def _number(shape: Any) -> int:
    """The number by which a ray names a shape."""
    import drjit as dr
    import mitsuba as mi

    return int(dr.reinterpret_array(mi.UInt32, mi.ShapePtr(shape))[0])


def weight(one: Any, other: Any) -> Any:
    """The power heuristic."""
    import drjit as dr

    one, other = dr.square(one), dr.square(other)
    return dr.select(one > 0, one / (one + other), 0)


@cache
def _kind() -> type:
    """The integrator's class, of the variant that is chosen: Mitsuba's own path tracer, and what is absorbed on the way."""
    import drjit as dr
    import mitsuba as mi

    class Absorbed(mi.SamplingIntegrator):
        depth = 0
        table: list[Any] = []
        media: Any = None

        def absorbs(self, shape: Any, active: Any) -> Any:
            """What a shape absorbs, 1/m, of each colour."""
            number: Any = dr.reinterpret_array(mi.UInt32, shape)
            active &= number < dr.width(self.table[0])
            return mi.Color3f([dr.gather(mi.Float, row, number, active) for row in self.table[:3]])

        def clear(self, shape: Any, active: Any) -> Any:
            """Whether light goes through a shape."""
            number: Any = dr.reinterpret_array(mi.UInt32, shape)
            active &= number < dr.width(self.table[0])
            return active & (dr.gather(mi.Float, self.table[3], number, active) > 0)

        @dr.syntax
        def arriving(self, scene: Any, si: Any, ds: Any, within: Any, lies: Any, active: Any) -> Any:
            """The share of the light of `ds` that arrives at `si`, which lies in what absorbs `within`, 1/m, and in the
            substances `lies`."""
            import drjit as dr
            import mitsuba as mi

            within, lies, asked = mi.Color3f(within), mi.UInt32(lies), mi.Bool(active)
            towards, passes, turns = si.spawn_ray_to(ds.p), mi.Color3f(1), mi.UInt32(0)
            while asked:
                near = scene.ray_intersect_preliminary(towards, coherent=False, active=asked)
                blocked = asked & near.is_valid()
                clear = self.clear(near.shape, blocked & ds.delta & (turns < MOST_SIDES))
                way = dr.select(near.is_valid(), near.t, dr.norm(ds.p - towards.o))
                passes *= dr.select(asked & dr.isfinite(way), dr.exp(-within * dr.select(dr.isfinite(way), way, 0)), 1)
                passes *= dr.select(blocked & ~clear, 0, 1)

                met = near.compute_surface_interaction(towards, +mi.RayFlags.All, clear)
                bsdf = met.bsdf()
                body = clear & mi.has_flag(bsdf.flags(), mi.BSDFFlags.DeltaTransmission)
                enters, slant = interfaces.enters(met, towards.d), mi.Float(dr.abs(met.wi.z))
                # The straight line is that outside: within, light is steeper, and never shut in.
                met.wi = dr.select(body, mi.Vector3f(0, 0, 1), mi.Vector3f(met.wi.x, met.wi.y, slant))
                context = mi.BSDFContext(mi.TransportMode.Importance)
                sampled, kept = bsdf.sample(context, met, mi.Float(SURELY), mi.Point2f(0.5), clear)
                let = mi.has_flag(sampled.sampled_type, mi.BSDFFlags.DeltaTransmission)
                let |= mi.has_flag(sampled.sampled_type, mi.BSDFFlags.Null)
                crossing = self.media.crossing(met.shape, enters, lies, mi.Bool(body))
                kept = mi.Color3f(kept) * dr.select(body, self.media.straight(crossing, slant), sampled.pdf)
                passes *= dr.select(clear, dr.select(let, kept, 0), 1)
                change = self.absorbs(met.shape, mi.Bool(body))
                within = dr.maximum(within + dr.select(body, dr.select(enters, change, -change), 0), 0)
                lies = dr.select(body, crossing.lies, lies)
                towards = met.spawn_ray_to(ds.p)
                turns += 1
                asked &= clear
            return passes

        @dr.syntax
        def sample(self, scene: Any, sampler: Any, ray: Any, medium: Any = None, active: Any = True) -> Any:
            """Light of a ray, as Mitsuba's `path` finds it, with the same chances."""
            import drjit as dr  # what is compiled from this text knows no names from around it
            import mitsuba as mi

            context = mi.BSDFContext()
            active = mi.Bool(active)
            ray = mi.Ray3f(ray)
            depth, met, eta, lies = mi.UInt32(0), mi.UInt32(0), mi.Float(1), mi.UInt32(0)
            throughput, result, within = mi.Spectrum(1), mi.Spectrum(0), mi.Color3f(0)
            seen = mi.Bool(scene.environment() is not None)
            before = dr.zeros(mi.SurfaceInteraction3f)
            before_pdf, before_delta = mi.Float(1), mi.Bool(True)
            while active:
                si = scene.ray_intersect(ray, +mi.RayFlags.All, coherent=depth == 0, active=active)
                throughput *= dr.select(si.is_valid(), dr.exp(-within * dr.select(si.is_valid(), si.t, 0)), 1)

                ds = mi.DirectionSample3f(scene, si, before)
                chance = scene.pdf_emitter_direction(before, ds, ~before_delta)
                result = dr.fma(
                    throughput, ds.emitter.eval(si, active & (before_pdf > 0)) * weight(before_pdf, chance), result
                )
                goes_on = active & (depth + 1 < self.depth) & (met < MOST_MET) & si.is_valid()

                bsdf = si.bsdf(ray)
                body = self.media.clear(si.shape, mi.Bool(goes_on))
                lit = goes_on & mi.has_flag(bsdf.flags(), mi.BSDFFlags.Smooth)
                ds, strength = scene.sample_emitter_direction(si, sampler.next_2d(), False, lit)
                lit &= ds.pdf != 0
                strength *= self.arriving(scene, si, ds, within, lies, lit)
                wo = si.to_local(ds.d)
                chosen = sampler.next_1d(goes_on)
                # Of a body the tint alone is asked; how it bends light depends on what it lies in.
                si.wi = dr.select(body, mi.Vector3f(0, 0, 1), si.wi)
                value, pdf, sampled, kept = bsdf.eval_pdf_sample(
                    context, si, wo, dr.select(body, SURELY, chosen), sampler.next_2d(goes_on), goes_on
                )
                share = dr.select(ds.delta, 1, weight(ds.pdf, pdf))
                result[lit] = dr.fma(throughput, value * strength * share, result)

                enters = interfaces.enters(si, ray.d)
                crossing = self.media.crossing(si.shape, enters, lies, mi.Bool(body))
                bent = interfaces.bent(si, ray.d, crossing)
                mirrored = body & (chosen <= bent.mirrored)
                bends = body & ~mirrored
                change = self.absorbs(si.shape, mi.Bool(bends))
                within = dr.maximum(within + dr.select(bends, dr.select(enters, change, -change), 0), 0)
                lies = dr.select(bends, crossing.lies, lies)
                ratio = crossing.after / crossing.before
                kept = dr.select(bends, kept * dr.square(sampled.eta / ratio), dr.select(mirrored, 1, kept))
                eta *= dr.select(bends, ratio, dr.select(mirrored, 1, sampled.eta))
                onward = dr.select(mirrored, bent.back, dr.select(bends, bent.through, si.to_world(sampled.wo)))
                ray = si.spawn_ray(onward)
                throughput[goes_on] *= kept
                seen |= goes_on & ~mi.has_flag(sampled.sampled_type, mi.BSDFFlags.Null)
                before = dr.detach(si, True)
                before_pdf = sampled.pdf
                before_delta = mi.has_flag(sampled.sampled_type, mi.BSDFFlags.Delta)

                depth[si.is_valid() & ~(bends & crossing.nothing)] += 1
                met += 1
                most: Any = dr.max(throughput)
                ends = sampler.next_1d() >= dr.minimum(most * dr.square(eta), 0.95)
                active = goes_on & ((depth < LONGEST) | ~ends) & (most != 0)
            return dr.select(seen, result, 0), seen, []

    return Absorbed
