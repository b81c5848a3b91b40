"""How a film answers to light, and its white balance: what every renderer develops its pictures with."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

BRIGHTEST = 16.0
"""Scene light beyond this becomes white."""


def film_curve(light: np.ndarray) -> np.ndarray:
    """Display value (sRGB, 0..1) of scene light: a soft toe, a straight middle, a long shoulder.

    After Lottes, "Advanced Techniques and Optimization of HDR Color Pipelines" (2016): 0.18 stays near middle grey.
    """
    import numpy as np

    contrast, shoulder, middle_in, middle_out, white = 1.20, 0.965, 0.18, 0.205, 10.0
    ws, wd = white**contrast, white ** (contrast * shoulder)
    ms, md = middle_in**contrast, middle_in ** (contrast * shoulder)
    b = (-ms + ws * middle_out) / ((wd - md) * middle_out)
    k = (wd * ms - ws * md * middle_out) / ((wd - md) * middle_out)
    z = np.maximum(light, 0.0) ** contrast
    linear = np.clip(z / (z**shoulder * b + k), 0.0, 1.0)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 1e-6) ** (1 / 2.4) - 0.055)


def gains(temperature: float, tint: float) -> np.ndarray:
    """(3,) factors of the colours of light that keep the brightness of grey: -1 is cool or green, 1 warm or magenta."""
    import numpy as np

    raw = np.array([1 + 0.30 * temperature, 1 - 0.18 * tint, 1 - 0.30 * temperature])
    return raw / (raw @ np.array([0.2126, 0.7152, 0.0722]))
