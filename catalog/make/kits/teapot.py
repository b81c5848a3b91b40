"""A teapot of white china: a round belly, a spout, a handle, a lid with a knob that lifts off."""

from worldkit.joints import Slide
from worldkit.sculpt import crisp

from ..kit import Kit, part

BELLY = [
    (0.045, 0.0),
    (0.047, 0.004),
    (0.060, 0.014),
    (0.077, 0.040),
    (0.080, 0.062),
    (0.070, 0.092),
    (0.050, 0.110),
    (0.043, 0.113),
    (0.043, 0.119),
]
HOLLOW = [
    (0.039, 0.119),
    (0.039, 0.111),
    (0.047, 0.106),
    (0.066, 0.090),
    (0.0755, 0.062),
    (0.0725, 0.041),
    (0.056, 0.018),
    (0.040, 0.008),
    (0.0, 0.007),
]
POT = crisp.turned([(0, 0), *crisp.curve(BELLY, steps=3).tolist(), *crisp.curve(HOLLOW, steps=3).tolist()])
WAY = [(0.062, 0, 0.040), (0.092, 0, 0.050), (0.112, 0, 0.084), (0.135, 0, 0.112)]
BORE = crisp.lathe([(0, 0), (0.0715, 0.02), (0.0735, 0.06), (0.045, 0.105), (0, 0.106)]).translate(z=0.007)
SPOUT = (crisp.wire(WAY, 0.040, scales=[1.05, 0.75, 0.50, 0.40]) - BORE) - crisp.wire(
    [(0.085, 0, 0.046), *WAY[1:], (0.150, 0, 0.128)], 0.030, scales=[0.65, 0.70, 0.45, 0.34, 0.34]
)
HANDLE = (
    crisp.wire(
        [
            (-0.070, 0, 0.092),
            (-0.098, 0, 0.100),
            (-0.124, 0, 0.084),
            (-0.122, 0, 0.056),
            (-0.098, 0, 0.034),
            (-0.072, 0, 0.034),
        ],
        0.013,
    )
    - BORE
)
LID = crisp.lathe(
    [
        (0, 0.112),
        (0.036, 0.112),
        (0.036, 0.119),
        (0.044, 0.1195),
        (0.043, 0.123),
        (0.030, 0.131),
        (0.010, 0.136),
        (0.006, 0.140),
        (0.0115, 0.148),
        (0.010, 0.156),
        (0, 0.159),
    ]
)

KIT = Kit(
    "tableware",
    "Teapot of white porcelain with a lid that lifts off",
    "typical teapot of one litre: 26 cm from handle to spout",
    "ceramic",
    (
        part("pot", crisp.together(POT, SPOUT, HANDLE), "ceramic", hulls=40, triangles=10000),
        part("lid", LID, "ceramic", "pot", Slide("lid", axis=(0, 0, 1), range_m=(0, 0.2), damping=0.5), hulls="convex"),
    ),
)
