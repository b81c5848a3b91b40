"""The colours of a layout sheet."""

from .canvas import Colour

PAPER: Colour = (250, 249, 246)
PANEL: Colour = (255, 255, 255)
GRID: Colour = (236, 234, 228)
AXIS: Colour = (205, 201, 192)
TEXT: Colour = (38, 40, 46)
QUIET: Colour = (126, 127, 132)
SCENERY: Colour = (226, 219, 206)
SCENERY_EDGE: Colour = (158, 147, 128)
GROUND: Colour = (232, 228, 218)
ERROR: Colour = (208, 48, 48)
WARNING: Colour = (205, 132, 16)
GOOD: Colour = (46, 128, 84)
MOTION: Colour = (36, 98, 190)
SWUNG: Colour = (118, 160, 222)
JOINT: Colour = (128, 52, 150)
ROPE: Colour = (138, 92, 40)
SPRING: Colour = (20, 128, 128)
LENS: Colour = (92, 104, 122)
THINGS: tuple[Colour, ...] = (
    (111, 163, 204),
    (236, 160, 92),
    (132, 184, 122),
    (214, 122, 122),
    (167, 142, 200),
    (221, 189, 92),
    (112, 188, 180),
    (222, 144, 178),
    (160, 140, 118),
)


def edge(colour: Colour) -> Colour:
    """A darker tone of the same colour, for outlines."""
    r, g, b = (round(part * 0.62) for part in colour)
    return (r, g, b)
