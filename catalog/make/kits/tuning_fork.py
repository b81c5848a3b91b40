"""A tuning fork of steel on its resonance box of spruce, which is open to the front."""

from worldkit.sculpt import crisp

from ..kit import Kit, part

U = [(0, -0.011, 0.105), (0, -0.011, 0.03), (0, -0.0078, 0.0215), (0, 0, 0.018), (0, 0.0078, 0.0215), (0, 0.011, 0.03)]
FORK = (
    crisp.together(
        crisp.sweep([(-0.003, -0.004), (0.003, -0.004), (0.003, 0.004), (-0.003, 0.004)], [*U, (0, 0.011, 0.105)]),
        crisp.cylinder(0.0085, 0.024, 0.001),
        crisp.cylinder(0.013, 0.006, 0.001),
    )
    .rotate(90)
    .translate(z=0.05)
)
BOX = crisp.box((0.18, 0.09, 0.05), 0.002) - crisp.box((0.18, 0.078, 0.038)).translate(x=0.006)

KIT = Kit(
    "science",
    "Tuning fork for 440 Hz on a wooden resonance box, open to the front",
    "typical demonstration fork: 18 cm box, tines of 8 to 11 cm",
    "pine",
    (
        part("box", BOX.translate(z=0.025), "pine"),
        part("fork", FORK, "steel", "box"),
    ),
)
