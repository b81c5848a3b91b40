"""How much a film may hold. Its author is told at once, with the line; the engine checks the description again."""

MOST_FRAMES, MOST_LAMPS, MOST_PANELS, MOST_COPIES = 20_000, 64, 16, 10_000
"""Each of so many copies is a thing of the drawn world: 2,000 are made in 0.1 s, 10,000 in 3, and twice as many in 15."""
MOST_PUFFS, MOST_PUFF_NUMBERS, MOST_EMITTERS = 200_000, 20_000_000, 100
"""Puffs at once, and in all frames together, 20 bytes each; and so many times a film may say `puffs` or `emit`."""
FAR_M = 1e5
"""Nothing of a film lies further away, or is larger, m; and nothing of it is later, s."""
PLACES = ("bottom", "top", "title", "left")
"""Where words stand in the picture."""
SEEN = 0.2
"""What is less opaque than this is hardly seen; clear glass, which is drawn with its mirror images, is 0.22 and more."""
SMOOTHEST = 3.0
"""The most that the surface of a crowd is evened out."""
STORM_M_S = 40.0
"""The strongest wind that is drawn, m/s."""
PANEL_M = (0.005, 100.0)
"""The least and the most that a panel of light measures, m."""
GOBOS = ("window", "blinds", "leaves", "branches", "bars")
"""Patterns that may be held before the key light."""
GOBO_M = (0.01, 1000.0)
"""The least and the most that such a pattern measures, m."""
LIGHT: dict[str, tuple[float, float]] = {
    "light_azimuth_deg": (-720, 720), "light_elevation_deg": (1, 90), "light_rgb": (0, 1), "light_strength": (0, 10),
    "light_softness_deg": (0, 45), "sky_zenith": (0, 1), "sky_horizon": (0, 1), "sky_ground": (0, 1), "sky_glow": (0, 4),
    "sky_clouds": (0, 1), "sky_stars": (0, 1), "sky_strength": (0, 10), "sky_indoors": (0, 1), "fog_rgb": (0, 1),
    "fog_density": (0, 100),
    "fog_height_m": (1e-3, 1e6), "grade_exposure_stops": (-8, 8), "grade_contrast": (0, 3), "grade_saturation": (0, 3),
    "grade_temperature": (-1, 1), "grade_tint": (-1, 1), "grade_vignette": (0, 1), "grade_glow": (0, 1),
    "grade_fade": (0, 1), "grade_outlines": (0, 1),
}  # fmt: skip
"""The numbers that a film may give of its light, air and developing, each with its limits."""
NATURAL_SHUTTER = 0.5
"""The share of a frame's time for which the shutter of a film camera is open: 180 degrees."""
COLOURS = ("light_rgb", "sky_zenith", "sky_horizon", "sky_ground", "fog_rgb")
"""Those that are three numbers."""
