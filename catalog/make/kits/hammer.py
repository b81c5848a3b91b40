"""A claw hammer lying on its side: a forged head, a handle of ash."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

FACE = (
    crisp.lathe([(0.0125, 0), (0.014, 0.0015), (0.014, 0.012), (0.0095, 0.020), (0.0095, 0.030)])
    .rotate(90, "x")
    .translate(y=0.042)
)
CHEEK = crisp.box((0.026, 0.030, 0.026), 0.003)
CLAW = crisp.sweep(
    [(-0.012, -0.005), (0.012, -0.005), (0.012, 0.005), (-0.012, 0.005)],
    [(0, -0.010, 0.003), (0, -0.030, 0.004), (0, -0.050, -0.004), (0, -0.066, -0.022)],
    scales=[1.0, 1.0, 0.95, 0.75],
)
SLIT = crisp.slab([(-0.0006, 0), (0.0006, 0), (0.0045, -0.04), (-0.0045, -0.04)], 0.08).translate(0, -0.034, -0.04)
HEAD = crisp.together(FACE, CHEEK, CLAW) - SLIT
GRIP = crisp.loft(
    [
        [(0.5 * w * x, 0.5 * d * y, z) for x, y in crisp.ring(2.0, 20)]
        for z, w, d in (
            (0.014, 0.018, 0.024),
            (-0.02, 0.018, 0.024),
            (-0.06, 0.017, 0.022),
            (-0.14, 0.022, 0.028),
            (-0.24, 0.026, 0.034),
            (-0.30, 0.026, 0.036),
            (-0.315, 0.020, 0.028),
        )
    ]
)


def lying(solid):
    """On its side, the handle along -x, the face to the left."""
    return solid.rotate(90, "y").rotate(-24).translate(z=0.0135)


KIT = Kit(
    "tool",
    "Claw hammer with a wooden handle, lying on its side",
    "typical 16 oz claw hammer: 33 cm long",
    "wood",
    (
        part("head", lying(HEAD), "steel", look="steel_dark"),
        part("handle", lying(GRIP), "wood", "head", look="wood_oak", hulls=4),
    ),
)
