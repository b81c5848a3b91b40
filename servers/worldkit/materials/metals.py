"""Colours of bare metals, by what they reflect head-on.

Each is |(n + ik - 1) / (n + ik + 1)|² of the measured index of refraction n + ik, weighed by the CIE 1931 observer under D65
and given as linear sRGB, so that a perfect mirror is white. The indices are those of refractiveindex.info (public domain):
Johnson and Christy, Phys. Rev. B 6, 4370 (1972) and 9, 5056 (1974); aluminium: McPeak et al., ACS Photonics 2, 326 (2015);
brass (30 % zinc) and bronze (10 %): Querry, CRDC-CR-85034 (1985); steel (austenitic, stainless): Karlsson and Ribbing,
J. Appl. Phys. 53, 6340 (1982). `tests/worldkit/test_metals.py` computes them again.
"""

Rgb = tuple[float, float, float]

REFLECTED: dict[str, Rgb] = {
    "aluminium": (0.906, 0.916, 0.923),
    "brass": (0.907, 0.779, 0.424),
    "bronze": (0.957, 0.715, 0.464),
    "chromium": (0.550, 0.556, 0.554),
    "copper": (0.924, 0.625, 0.522),
    "gold": (1.000, 0.729, 0.366),
    "iron": (0.529, 0.513, 0.494),
    "silver": (0.989, 0.984, 0.978),
    "steel": (0.669, 0.639, 0.598),
    "titanium": (0.618, 0.580, 0.543),
}
"""Linear sRGB by metal; gold's red, 1.03, lies beyond what sRGB can show."""


def bare(metal: str, met: float = 1.0) -> Rgb:
    """The colour of a metal as looks have it: sRGB, by the power 2.2 with which renderers take it back.

    Light has `met` the metal so many times before it comes back, which deepens its colour: once on a perfect mirror, twice
    and more among scratches, under a film of tarnish, in the pores of a casting.
    """
    red, green, blue = (value ** (met / 2.2) for value in REFLECTED[metal])
    return (red, green, blue)
