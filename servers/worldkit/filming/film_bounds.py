"""How much a film may hold. Its author is told at once, with the line; the engine checks the description again."""

MOST_FRAMES, MOST_LAMPS, MOST_PANELS, MOST_COPIES = 20_000, 64, 16, 2_000
PLACES = ("bottom", "top", "title", "left")
"""Where words stand in the picture."""
STORM_M_S = 40.0
"""The strongest wind that is drawn, m/s."""
PANEL_M = (0.005, 100.0)
"""The least and the most that a panel of light measures, m."""
GOBOS = ("window", "blinds", "leaves", "branches", "bars")
"""Patterns that may be held before the key light."""
GOBO_M = (0.01, 1000.0)
"""The least and the most that such a pattern measures, m."""
NATURAL_SHUTTER = 0.5
"""The share of a frame's time for which the shutter of a film camera is open: 180 degrees."""
