"""The colours of metals are those of their measured indices of refraction, computed here once more."""

import numpy as np
import pytest

from worldkit.materials import look
from worldkit.materials.metals import REFLECTED, bare

EVERY_20 = "400 420 440 460 480 500 520 540 560 580 600 620 640 660 680 700"
JOHNSON = "381.5 397.4 413.3 430.5 450.9 471.4 495.9 520.9 548.6 582.1 616.8 659.5 704.5 756.0"
MEASURED = {
    "gold": (JOHNSON, "1.46 1.47 1.46 1.45 1.38 1.31 1.04 .62 .43 .29 .21 .14 .13 .14",
             "1.933 1.952 1.958 1.948 1.914 1.849 1.833 2.081 2.455 2.863 3.272 3.697 4.103 4.542"),
    "copper": (JOHNSON, "1.33 1.32 1.28 1.25 1.24 1.25 1.22 1.18 1.02 .70 .30 .22 .21 .24",
               "2.045 2.116 2.207 2.305 2.397 2.483 2.564 2.608 2.577 2.704 3.205 3.747 4.205 4.665"),
    "silver": (JOHNSON, ".05 .05 .05 .04 .04 .05 .05 .05 .06 .05 .06 .05 .04 .03",
               "1.864 2.070 2.275 2.462 2.657 2.869 3.093 3.324 3.586 3.858 4.152 4.483 4.838 5.242"),
    "chromium": (JOHNSON, "1.92 2.00 2.08 2.19 2.33 2.51 2.75 2.94 3.18 3.22 3.17 3.09 3.05 3.08",
                 "2.74 2.83 2.93 3.04 3.14 3.24 3.30 3.33 3.33 3.30 3.30 3.34 3.39 3.42"),
    "iron": (JOHNSON, "2.12 2.24 2.35 2.48 2.59 2.67 2.74 2.86 2.95 2.94 2.88 2.92 2.86 2.87",
             "2.50 2.58 2.65 2.71 2.77 2.82 2.88 2.91 2.93 2.99 3.05 3.10 3.19 3.28"),
    "titanium": (JOHNSON, "1.99 2.08 2.14 2.21 2.27 2.32 2.36 2.44 2.54 2.60 2.67 2.76 2.86 3.00",
                 "2.93 2.95 2.98 3.01 3.04 3.10 3.19 3.30 3.43 3.58 3.72 3.84 3.96 4.01"),
    "brass": (EVERY_20, "1.445 1.350 1.191 .994 .816 .686 .602 .549 .505 .468 .450 .449 .444 .445 .444 .446",
              "1.805 1.786 1.797 1.883 2.046 2.250 2.464 2.668 2.860 3.059 3.253 3.434 3.609 3.778 3.943 4.106"),
    "bronze": (EVERY_20, "1.098 1.047 1.002 .959 .912 .846 .738 .592 .457 .377 .346 .333 .323 .317 .311 .306",
               "1.693 1.796 1.897 1.990 2.073 2.140 2.211 2.329 2.516 2.739 2.950 3.137 3.312 3.478 3.638 3.795"),
    "steel": (EVERY_20, "1.525 1.576 1.639 1.717 1.792 1.864 1.935 2.007 2.081 2.156 2.233 2.312 2.396 2.484 2.573 2.662",
              "2.793 2.924 3.056 3.179 3.293 3.401 3.507 3.617 3.730 3.845 3.959 4.050 4.138 4.226 4.316 4.407"),
    "aluminium": (EVERY_20, ".375 .418 .464 .515 .568 .626 .688 .754 .829 .909 .992 1.088 1.190 1.304 1.426 1.560",
                  "4.226 4.447 4.669 4.888 5.106 5.320 5.536 5.746 5.958 6.165 6.369 6.567 6.759 6.942 7.116 7.274"),
}  # fmt: skip
"""Wavelengths in nm, n, and k (sources: `worldkit.materials.metals`)."""
D65 = (49.98, 82.75, 93.43, 104.87, 117.81, 115.92, 109.35, 104.79, 104.41, 100.0, 95.79, 90.01, 87.70, 83.70, 80.21,
       78.28, 71.61, 75.09, 63.59, 46.42)  # fmt: skip
"""Relative power of daylight every 20 nm from 380 to 760 nm (CIE 15)."""
TO_SRGB = np.array([[3.2405, -1.5371, -0.4985], [-0.9693, 1.8760, 0.0416], [0.0556, -0.2040, 1.0572]])


def lobe(at: np.ndarray, middle: float, rise: float, fall: float) -> np.ndarray:
    return np.exp(-0.5 * ((at - middle) * np.where(at < middle, rise, fall)) ** 2)


def observer(at: np.ndarray) -> np.ndarray:
    """The colour matching functions (3, W) by the fit of Wyman, Sloan and Shirley, JCGT 2, 2 (2013)."""
    x = 0.362 * lobe(at, 442.0, 0.0624, 0.0374) + 1.056 * lobe(at, 599.8, 0.0264, 0.0323)
    x -= 0.065 * lobe(at, 501.1, 0.0490, 0.0382)
    y = 0.821 * lobe(at, 568.8, 0.0213, 0.0247) + 0.286 * lobe(at, 530.9, 0.0613, 0.0322)
    z = 1.217 * lobe(at, 437.0, 0.0845, 0.0278) + 0.681 * lobe(at, 459.0, 0.0385, 0.0725)
    return np.stack([x, y, z])


@pytest.mark.parametrize("metal", REFLECTED)
def test_a_metal_has_the_colour_of_its_measured_indices(metal: str) -> None:
    at, n, k = (np.array(row.split(), dtype=float) for row in MEASURED[metal])
    reflected = np.abs((n + 1j * k - 1) / (n + 1j * k + 1)) ** 2
    nm = np.arange(380.0, 761.0, 2.0)
    seen = TO_SRGB @ (observer(nm) * np.interp(nm, np.arange(380.0, 761.0, 20.0), D65))
    found = seen @ np.interp(nm, at, reflected) / seen.sum(axis=1)
    assert REFLECTED[metal] == pytest.approx(np.minimum(found, 1.0), abs=0.002), found.round(3)


@pytest.mark.parametrize(("name", "metal"), [("chrome", "chromium"), ("silver", "silver"), ("titanium", "titanium")])
def test_a_renderer_takes_the_colour_back(name: str, metal: str) -> None:
    entry = look(name)
    assert entry.metallic == 1.0
    assert np.array(entry.rgba[:3]) ** 2.2 == pytest.approx(REFLECTED[metal], abs=1e-6)


def test_light_that_met_copper_more_often_is_deeper_and_of_the_same_hue_order() -> None:
    once, often = np.array(bare("copper")), np.array(look("copper").rgba[:3])
    assert (often < once).all() and (np.diff(often) < np.diff(once)).any()
    assert often[0] / often[2] > 1.2 * once[0] / once[2]
