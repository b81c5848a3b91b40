"""A galvanised bucket with a swinging bail."""

from worldkit.joints import Hinge
from worldkit.sculpt import crisp

from ..kit import Kit, part

LOW, TOP, HIGH, PIN = 0.105, 0.145, 0.27, 0.252
WALL = [
    (0, 0.008),
    (LOW - 0.003, 0.008),
    (LOW - 0.002, 0.0),
    (LOW, 0.0),
    (0.118, 0.088),
    (0.121, 0.092),
    (0.1205, 0.098),
    (0.133, 0.19),
    (0.136, 0.194),
    (0.1355, 0.200),
    (TOP, HIGH - 0.006),
]
LIP = [(TOP + 0.004, HIGH - 0.003), (TOP + 0.002, HIGH), (TOP - 0.001, HIGH - 0.002)]
INNER = [(0.134, 0.200), (0.132, 0.19), (0.119, 0.098), (0.117, 0.090), (LOW - 0.001, 0.0095), (0, 0.0095)]
EARS = crisp.together(
    crisp.box((0.030, 0.006, 0.034), 0.002).translate(y=TOP + 0.001, z=PIN),
    crisp.cylinder(0.009, 0.012, 0.001).translate(z=-0.003).rotate(-90, "x").translate(y=TOP, z=PIN),
).mirror("y")
R = TOP + 0.008
BAIL = crisp.wire(
    [
        (0.0, -R, 0),
        (0.05, -R, 0.0),
        (0.115, -0.11, 0.0),
        (0.148, -0.045, 0),
        (0.152, 0, 0),
        (0.148, 0.045, 0),
        (0.115, 0.11, 0),
        (0.05, R, 0),
        (0, R, 0),
    ],
    0.006,
)
GRIP = crisp.wire([(0.1475, -0.048, 0), (0.152, 0, 0), (0.1475, 0.048, 0)], 0.020)

KIT = Kit(
    "household",
    "Galvanised steel bucket with a handle that swings",
    "typical bucket of 12 litres: 27 cm high, 29 cm across",
    "steel",
    (
        part("pail", crisp.turned([*WALL, *LIP, *INNER]) | EARS, "steel", hulls=32, triangles=9000),
        part(
            "bail",
            BAIL.rotate(-52, "y").translate(z=PIN),
            "steel",
            "pail",
            Hinge("handle", (0, 0, PIN), (0, 1, 0), frictionloss=0.12, damping=0.002),
            look="steel_dark",
        ),
        part("grip", GRIP.rotate(-52, "y").translate(z=PIN), "wood", "bail", look="wood_walnut"),
    ),
)
