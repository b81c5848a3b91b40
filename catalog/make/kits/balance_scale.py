"""A pair of scales: a beam on a column, a brass pan hanging from each end."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part
from ..stands import disc_foot

HIGH, ARM, DROP = 0.34, 0.16, 0.19
BEAM = crisp.wire(
    [(0, -ARM, HIGH), (0, -0.09, HIGH + 0.006), (0, 0, HIGH + 0.020), (0, 0.09, HIGH + 0.006), (0, ARM, HIGH)],
    0.010,
    scales=[0.6, 0.9, 1.5, 0.9, 0.6],
)
NEEDLE = crisp.wire([(0.009, 0, HIGH + 0.015), (0.009, 0, HIGH - 0.11)], 0.003, smooth=False, scales=[1.2, 0.5])
PIVOT = crisp.cylinder(0.012, 0.030, 0.001).translate(z=-0.015).rotate(90, "y").translate(z=HIGH + 0.014)
KNOB = crisp.ball(0.020).translate(z=HIGH + 0.040)
DISH = crisp.turned([(0.0, 0.0), (0.030, 0.002), (0.055, 0.012), (0.0565, 0.012), (0.031, 0.0), (0.0, -0.0016)])
CORDS = crisp.around(crisp.wire([(0.054, 0, 0.011), (0.001, 0, DROP)], 0.0016, smooth=False), 3)


def pan(side: float, name: str):
    """A dish on three cords, hinged to an end of the beam."""
    shape = crisp.together(DISH, CORDS, crisp.ball(0.006).translate(z=DROP)).translate(0, side, HIGH - DROP)
    return part(name, shape, "brass", "beam", Hinge(f"{name}_hook", (0, side, HIGH), (1, 0, 0), damping=2e-4), hulls=24)


KIT = Kit(
    "science",
    "Balance scale with two hanging pans of brass",
    "typical laboratory balance: 36 cm high, beam of 32 cm",
    "wood",
    (
        part("column", crisp.together(disc_foot(0.17, 0.016, 0.014, HIGH + 0.004), crisp.box((0.008, 0.026, 0.05), 0.002).translate(-0.006, 0, HIGH)), "brass"),
        part("beam", crisp.together(BEAM, NEEDLE, PIVOT, KNOB), "brass", "column",
             Hinge("beam", (0, 0, HIGH + 0.014), (1, 0, 0), range_deg=(-18, 18), damping=5e-4, stiffness=0.05)),
        pan(-ARM, "pan_left"),
        pan(ARM, "pan_right"),
    ),
)  # fmt: skip
