"""A stove kettle: a round enamelled belly, a short spout, a handle over it, a lid with a knob that lifts off."""

from worldkit.joints import Slide
from worldkit.sculpt import crisp

from ..kit import Kit, part

BELLY = [
    (0.088, 0.0),
    (0.094, 0.004),
    (0.103, 0.030),
    (0.100, 0.070),
    (0.084, 0.108),
    (0.060, 0.130),
    (0.046, 0.136),
]
HOLLOW = [
    (0.043, 0.134),
    (0.058, 0.127),
    (0.081, 0.105),
    (0.0965, 0.069),
    (0.0995, 0.030),
    (0.090, 0.006),
    (0.085, 0.004),
]
POT = crisp.turned([(0, 0), *crisp.curve(BELLY, steps=4).tolist(), *crisp.curve(HOLLOW, steps=4).tolist(), (0, 0.004)])
BORE = crisp.lathe([(0, 0.004), (0.090, 0.006), (0.0995, 0.030), (0.0965, 0.069), (0.081, 0.105), (0.043, 0.134)])
WAY = [(0.085, 0, 0.062), (0.112, 0, 0.082), (0.138, 0, 0.114), (0.152, 0, 0.137)]
SPOUT = (crisp.wire(WAY, 0.044, scales=[1.15, 0.88, 0.66, 0.58]) - BORE) - crisp.wire(
    [(0.096, 0, 0.068), *WAY[1:], (0.164, 0, 0.156)], 0.036, scales=[0.9, 0.80, 0.60, 0.54, 0.54]
)
LUGS = crisp.box((0.012, 0.022, 0.030), 0.003).translate(x=0.074, z=0.112)
LUGS = crisp.together(LUGS, LUGS.mirror("x")) - BORE
BOW = crisp.wire(
    [(0.075, 0, 0.132), (0.082, 0, 0.170), (0.058, 0, 0.214), (0, 0, 0.228), (-0.058, 0, 0.214), (-0.082, 0, 0.170), (-0.075, 0, 0.132)],
    0.0085,
)  # fmt: skip
GRIP = crisp.wire([(0.044, 0, 0.2195), (0, 0, 0.2285), (-0.044, 0, 0.2195)], 0.024, scales=[0.85, 1.08, 0.85])
LID = crisp.lathe(
    [(0, 0.133), (0.044, 0.133), (0.051, 0.1365), (0.050, 0.1395), (0.030, 0.146), (0.008, 0.149), (0, 0.149)]
)
KNOB = crisp.lathe(
    [(0, 0.147), (0.007, 0.147), (0.006, 0.153), (0.013, 0.160), (0.013, 0.166), (0.008, 0.170), (0, 0.171)]
)

KIT = Kit(
    "kitchen",
    "Kettle of red enamel with a spout, a handle over it and a lid that lifts off",
    "typical stove kettle of two litres: 21 cm across, 24 cm high",
    "steel",
    (
        part("pot", crisp.together(POT, SPOUT), "steel", look="paint_red", hulls=40, triangles=10000, density=2400),
        part("lugs", LUGS, "steel", "pot", look="steel_brushed", hulls=2),
        part("bow", BOW, "steel", "pot", look="steel_brushed", hulls=8),
        part("grip", GRIP, "wood", "pot", look="wood_walnut", hulls=2),
        part("lid", LID, "steel", "pot", Slide("lid", axis=(0, 0, 1), range_m=(0, 0.05), damping=0.5), look="paint_red", hulls="convex", density=2400),
        part("knob", KNOB, "wood", "lid", look="wood_walnut", hulls="convex"),
    ),
)  # fmt: skip
