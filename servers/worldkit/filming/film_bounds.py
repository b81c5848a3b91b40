"""How much a film may hold. Its author is told at once, with the line; the engine checks the description again."""

MOST_FRAMES, MOST_LAMPS, MOST_COPIES = 20_000, 64, 2_000
PLACES = ("bottom", "top", "title", "left")
"""Where words stand in the picture."""
