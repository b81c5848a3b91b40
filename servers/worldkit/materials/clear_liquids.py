"""A clear substance of any colour: a syrup, juice, oil or tinted glass that the library does not have.

It is told by the colour that it has at a depth, as a glass of it is looked through against white paper: "clear #b5651d" has that
colour 10 mm deep, "clear #b5651d 30mm" 30 mm deep; paler where it is thinner, and darker where it is deeper (Beer and Lambert).
"""

import math
import re

from .look import Look

_NAME = re.compile(r"clear[ _](#[0-9a-fA-F]{6})(?:[ _]([0-9]{1,4}) ?mm)?")
DEPTH_MM = 10.0
DARKEST = 0.002
"""Of light that comes through at the depth that is told: below that no eye tells colours apart."""
INDEX = 1.4
"""Of refraction: between water (1.33) and honey (1.49)."""


def of(name: str) -> Look | None:
    """The look of a name such as "clear #b5651d 30mm"; None where the name is none of this kind."""
    found = _NAME.fullmatch(name)
    if found is None or not float(found[2] or DEPTH_MM):
        return None
    red, green, blue = (int(found[1][i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    depth_m = float(found[2] or DEPTH_MM) / 1000.0
    absorbs = tuple(-math.log(max(_linear(value), DARKEST)) / depth_m for value in (red, green, blue))
    return Look(
        f"Clear, {found[1]} where it is {1000 * depth_m:g} mm deep",
        rgba=(red, green, blue, 0.5), roughness=0.04, coat=1.0, clear=0.9, index=INDEX, absorbs=absorbs,  # type: ignore[arg-type]
    )  # fmt: skip


def _linear(value: float) -> float:
    """Of light, from sRGB."""
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4
