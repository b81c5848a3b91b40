"""A magnifying glass lying on a table: a lens in a brass rim, a turned handle."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

R = 0.045
LENS = crisp.lathe(
    [
        (0, -0.0050),
        (0.02, -0.0042),
        (0.036, -0.0022),
        (R - 0.001, -0.0008),
        (R - 0.001, 0.0008),
        (0.036, 0.0022),
        (0.02, 0.0042),
        (0, 0.0050),
    ]
)
RIM = crisp.turned(
    [
        (R - 0.002, -0.0045),
        (R + 0.002, -0.006),
        (R + 0.004, -0.004),
        (R + 0.004, 0.004),
        (R + 0.002, 0.006),
        (R - 0.002, 0.0045),
    ]
)
FERRULE = (
    crisp.lathe([(0.0045, 0), (0.0045, 0.012), (0.0075, 0.016), (0.0075, 0.026), (0.006, 0.03)])
    .rotate(90, "y")
    .translate(x=R + 0.002)
)
GRIP = (
    crisp.lathe(
        [
            (0.0055, 0),
            (0.0075, 0.004),
            (0.0078, 0.03),
            (0.0105, 0.07),
            (0.0115, 0.092),
            (0.0095, 0.108),
            (0.004, 0.114),
            (0, 0.114),
        ],
        smooth=True,
    )
    .rotate(90, "y")
    .translate(x=R + 0.028)
)
LEAN = 1.47  # degrees: it lies on the rim's far edge and on the thick end of the handle
PARTS = (
    part("rim", (RIM | FERRULE).rotate(LEAN, (0, -1, 0)), "brass"),
    part("lens", LENS.rotate(LEAN, (0, -1, 0)), "glass", "rim", hulls="convex"),
    part("handle", GRIP.rotate(LEAN, (0, -1, 0)), "wood", "rim", look="wood_ebony", hulls="convex"),
)

KIT = Kit(
    "science",
    "Magnifying glass with a brass rim and a wooden handle, lying",
    "typical reading glass: 9 cm lens, 24 cm long",
    "wood",
    PARTS,
)
