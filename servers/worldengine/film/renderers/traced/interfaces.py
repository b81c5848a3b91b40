"""How light crosses from one clear substance into the next: from air into glass, from glass into the water that it holds.

Clear things may lie in each other, as a liquid that reaches a little into the wall of its glass: where several are, only the one
that bends light most counts (nested dielectrics: Schmidt and Budge 2002, with the index for a priority). So glass is left for
the water behind it, not for air, a bead in the water that it is made of is not there, and no light is shut in between the two.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

AIR = 1.0
KINDS, BITS, MOST = 7, 4, 15
"""So many substances are told apart, and each as often as a path is in it at a time: a packed number has so many bits for each."""
SURELY = 0.99999
"""A chance by which a clear side lets light through, unless it mirrors all."""


def told_apart(indices: Sequence[float]) -> list[float]:
    """The indices of refraction that are told apart, in order: all, or where they are too many the nearest pairs as one."""
    found = sorted(set(indices))
    while len(found) > KINDS:
        del found[int(np.argmin(np.diff(found)))]
    return found


class Crossing(NamedTuple):
    """What becomes of light at a side of a clear thing; arrays of drjit's over paths."""

    enters: Any
    before: Any
    """Index of refraction where it comes from."""
    after: Any
    """And behind the side."""
    lies: Any
    """In what it lies once it is through."""

    @property
    def nothing(self) -> Any:
        """Nothing happens: on both sides the same counts."""
        return self.before == self.after


class Interfaces:
    """The clear substances of a scene; a path lies in some of them at a time, told by a packed number, 0 in air.

    Args:
        shapes: of Mitsuba, with the number by which a ray names each.
    """

    def __init__(self, shapes: Sequence[tuple[Any, int]]) -> None:
        import drjit as dr
        import mitsuba as mi

        own = {number: refraction(shape.bsdf()) for shape, number in shapes}
        apart = told_apart([index for index in own.values() if index > 0])
        kinds = np.zeros(max(own) + 1, np.uint32)
        for number, index in own.items():
            if index > 0:
                kinds[number] = 1 + int(np.argmin(np.abs(np.array(apart) - index)))
        self._kinds = mi.UInt32(kinds)
        self._indices = mi.Float(np.array([AIR, *apart], np.float32))
        dr.make_opaque(self._kinds, self._indices)

    def clear(self, shape: Any, active: Any) -> Any:
        """Whether a shape is a body that bends light."""
        return self._kind(shape, active) > 0

    def _kind(self, shape: Any, active: Any) -> Any:
        import drjit as dr
        import mitsuba as mi

        number: Any = dr.reinterpret_array(mi.UInt32, shape)
        active &= number < dr.width(self._kinds)
        return dr.gather(mi.UInt32, self._kinds, number, active)

    def index(self, lies: Any) -> Any:
        """The index of refraction where a path lies."""
        import drjit as dr
        import mitsuba as mi

        return dr.gather(mi.Float, self._indices, (31 - dr.lzcnt(lies | 1)) // BITS)

    def crossing(self, shape: Any, enters: Any, lies: Any, active: Any) -> Crossing:
        """What a path crosses that lies in `lies` and `enters` a shape, or leaves it."""
        import drjit as dr
        import mitsuba as mi

        place = BITS * self._kind(shape, active)
        one, held = mi.UInt32(1) << place, (lies >> place) & MOST
        within = lies + dr.select(held < MOST, one, 0)
        without = lies - dr.select(held > 0, one, 0)
        known = dr.select(held > 0, lies, within)  # a path that began inside was in it all along
        beyond = mi.UInt32(dr.select(enters, within, without))
        before = mi.Float(self.index(mi.UInt32(dr.select(enters, lies, known))))
        return Crossing(enters, before, mi.Float(self.index(beyond)), beyond)

    def straight(self, crossing: Crossing, cos: Any) -> Any:
        """The share of light that is let through on a straight line that met the side at this cosine in air; never shut in."""
        import drjit as dr
        import mitsuba as mi

        sine = dr.sqrt(dr.maximum(1 - dr.square(cos), 0)) / crossing.before
        mirrored = mi.fresnel(dr.sqrt(1 - dr.square(sine)), crossing.after / crossing.before)[0]
        return dr.select(crossing.nothing, 1, 1 - mirrored)


class Bent(NamedTuple):
    """Ways on from a side, and the share that is mirrored; arrays over paths."""

    mirrored: Any
    back: Any
    through: Any


def enters(si: Any, way: Any) -> Any:
    """Whether a path goes into the thing that it meets; by the thing itself, not by how it is shaded."""
    import drjit as dr

    return dr.dot(facing(si), way) < 0


def facing(si: Any) -> Any:
    """The normal of the triangle, outward."""
    import drjit as dr

    return dr.mulsign(si.n, dr.dot(si.n, si.sh_frame.n))


def bent(si: Any, way: Any, crossing: Crossing) -> Bent:
    """Mirror and refract a path that meets a side (Snell, Fresnel).

    Triangles are shaded as if they were round; where light would come out on the wrong side of one by that, its own normal counts.
    """
    import drjit as dr
    import mitsuba as mi

    def by(normal: Any) -> tuple[Any, Any, Any]:
        against = dr.select(crossing.enters, normal, -normal)
        cos = -dr.dot(against, way)
        mirrored, turned, _, ratio = mi.fresnel(dr.clip(cos, 0, 1), crossing.after / crossing.before)
        through = way * ratio + against * (ratio * cos - dr.abs(turned))
        return mirrored, way + against * (2 * cos), through

    own = facing(si)
    mirrored, back, through = by(own)
    shaded = by(si.sh_frame.n)
    out = dr.select(crossing.enters, own, -own)
    passes = (shaded[0] >= 1) | (dr.dot(shaded[2], out) < 0)
    round_ = passes & (dr.dot(shaded[1], out) > 0) & (dr.dot(si.sh_frame.n, way) * dr.dot(own, way) > 0)
    mirrored = dr.select(crossing.nothing, 0, dr.select(round_, shaded[0], mirrored))
    back = dr.normalize(dr.select(round_, shaded[1], back))
    through = dr.normalize(dr.select(crossing.nothing, way, dr.select(round_, shaded[2], through)))
    return Bent(mirrored, back, through)


def refraction(coating: Any) -> float:
    """The index of refraction of a material of Mitsuba's through which light goes bent; 0 of any other."""
    import mitsuba as mi

    if not mi.has_flag(coating.flags(), mi.BSDFFlags.DeltaTransmission):
        return 0.0
    return float(np.ravel(mi.traverse(coating)["eta"])[0])
