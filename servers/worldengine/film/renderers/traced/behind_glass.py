"""What guides the denoiser, looked at through whatever is clear: the colours and normals of the cork in the water, not of its glass.

A clear body has no colour of its own, so by what is met first all that is seen in it would be one black patch, and the denoiser
would smear it. Paths go through, bent as light is (`interfaces`), and tell what they come to; its place is where they entered.
"""

from __future__ import annotations

from functools import cache
from typing import Any

from . import interfaces

DEEP = 16
"""So many sides are gone through at most."""
CHANNELS = 13
INDEX = 1.5
"""Of refraction, of thin walls."""


def walker(media: interfaces.Interfaces) -> Any:
    """Mitsuba's integrator for guides through these media, in the order of `walked.guides`; compiled variants only."""
    import mitsuba as mi

    found = _kind()(mi.Properties())
    found.media = media
    return found


@cache
def _kind() -> type:
    """The integrator's class, of the variant that is chosen."""
    import drjit as dr
    import mitsuba as mi

    class Guides(mi.SamplingIntegrator):
        media: Any = None

        def aov_names(self) -> list[str]:
            return [f"guide{number}" for number in range(CHANNELS)]

        @dr.syntax
        def sample(self, scene: Any, sampler: Any, ray: Any, medium: Any = None, active: Any = True) -> Any:
            """Nothing, whether a thing is met, and the guides."""
            import drjit as dr  # what is compiled from this text knows no names from around it
            import mitsuba as mi

            active = mi.Bool(active)
            si = scene.ray_intersect(mi.Ray3f(ray), +mi.RayFlags.All, coherent=True, active=active)
            met, place = active & si.is_valid(), dr.select(si.is_valid(), si.p, 0)
            colour, normal, tint, clear = mi.Color3f(0), mi.Vector3f(0), mi.Color3f(1), mi.Float(1)
            on, lies, sides, way = mi.Bool(met), mi.UInt32(0), mi.UInt32(0), mi.Vector3f(ray.d)
            while on:
                bsdf = si.bsdf()
                body = self.media.clear(si.shape, mi.Bool(on)) & (sides < DEEP)
                # A thin wall turns nothing aside; what it mirrors shows its rim.
                thin = on & mi.has_flag(bsdf.flags(), mi.BSDFFlags.Null) & (sides < DEEP)
                thin &= ~mi.has_flag(bsdf.flags(), mi.BSDFFlags.Smooth)
                passes = body | thin
                ends = on & ~passes
                one = mi.fresnel(dr.abs(dr.dot(si.sh_frame.n, way)), INDEX)[0]
                mirrors = dr.select(thin, 2 * one / (1 + one), 0)
                share = dr.select(ends, 1, mirrors)
                colour += dr.select(ends, tint * bsdf.eval_diffuse_reflectance(si, ends), tint * mirrors)
                normal = mi.Vector3f(normal + clear * share * si.sh_frame.n)
                tint *= 1 - mirrors
                clear *= 1 - share

                crossing = self.media.crossing(si.shape, interfaces.enters(si, way), lies, mi.Bool(body))
                bent = interfaces.bent(si, way, crossing)
                shut_in = bent.mirrored >= 1
                lies = dr.select(body & ~shut_in, crossing.lies, lies)
                way = dr.select(body, dr.select(shut_in, bent.back, bent.through), way)
                onward = si.spawn_ray(way)
                si = scene.ray_intersect(onward, +mi.RayFlags.All, coherent=False, active=passes)
                gone = passes & ~si.is_valid()
                around = mi.Color3f(0)
                if dr.hint(scene.environment() is not None, mode="scalar"):
                    around = scene.environment().eval(si, gone)
                colour = dr.select(gone, colour + tint * dr.clip(around, 0, 1), colour)
                on = passes & si.is_valid()
                sides += 1
            told = [mi.Float(0), mi.Float(0), mi.Float(0), dr.select(met, mi.Float(1), 0), colour.x, colour.y, colour.z]
            told += [normal.x, normal.y, normal.z, place.x, place.y, place.z]
            return mi.Spectrum(0), met, told

    return Guides
