"""Any shape by code: signed distance functions, exact solids, paint by position; a body of the world in one call.

    from worldkit import sculpt

    head = sculpt.ellipsoid((0.12, 0.09, 0.10)).blend(sculpt.sphere(0.05).translate(0.06, 0, -0.01), radius=0.03)
    sculpt.add(spec, head, name="head", pos=(0, 0, 0.05), density=400, paint=fur)

Metres, z up, +x is the front; a shape is made in coordinates of its own, and the body's frame is the centre of the box around
it. `worldwright sculpt sheet FILE.py` draws it from four sides. See `skills/sculpting`.
"""

from . import brushes, crisp
from .copied import linear, radial, repeat
from .deformed import bend, noise, rough, twist
from .figure import Part, add, assemble, dress
from .foliage import Leaf, leaf
from .following import along, share_along, skin
from .from_files import from_file
from .hand_bodies import hand_parts
from .hands import hand
from .minting import Made, made
from .primitives import box, capsule, cylinder, ellipsoid, half_space, round_cone, sphere, torus
from .profiles import extruded, revolved
from .signed import Shape, difference, intersection, union
from .tubing import strap, tube

__all__ = [
    "Leaf", "Made", "Part", "Shape", "add", "along", "assemble", "bend", "box", "brushes", "capsule", "crisp", "cylinder", "difference", "dress",
    "ellipsoid", "extruded", "from_file", "half_space", "hand", "hand_parts", "intersection", "leaf", "linear", "made", "noise", "radial", "repeat", "revolved",
    "rough", "round_cone", "share_along", "skin", "sphere", "strap", "torus", "tube", "twist", "union",
]  # fmt: skip
