"""Light, sky, air and grading that go together, by name: a film's weather and hour."""

from typing import Any

MOODS: dict[str, dict[str, dict[str, Any]]] = {
    "golden_hour": {
        "light": {"azimuth_deg": -150.0, "elevation_deg": 14.0, "colour": "#ffb46a", "strength": 1.15, "softness_deg": 1.5},
        "sky": {"zenith": "#5f86b8", "horizon": "#f5c79a", "ground": "#8a7a5f", "glow": 0.9, "clouds": 0.35},
        "fog": {"colour": "#f0c8a0", "visibility_m": 900.0, "height_m": 12.0},
        "grade": {"temperature": 0.12, "contrast": 1.05, "saturation": 1.06, "vignette": 0.22, "glow": 0.08},
    },
    "noon": {
        "light": {"azimuth_deg": -120.0, "elevation_deg": 58.0, "colour": "#fff4e4", "strength": 1.1, "softness_deg": 0.8},
        "sky": {"zenith": "#3f74c8", "horizon": "#bcd6f2", "ground": "#77806a", "glow": 0.35, "clouds": 0.45},
        "grade": {"contrast": 1.04, "saturation": 1.05, "vignette": 0.12},
    },
    "overcast": {
        "light": {"azimuth_deg": -120.0, "elevation_deg": 62.0, "colour": "#eef2f6", "strength": 0.32, "softness_deg": 9.0},
        "sky": {"zenith": "#aab3bd", "horizon": "#d3d7da", "ground": "#6c6f6b", "glow": 0.05, "clouds": 0.0, "strength": 1.25},
        "fog": {"colour": "#c9cfd3", "visibility_m": 900.0},
        "grade": {"contrast": 1.08, "saturation": 0.9, "temperature": -0.06, "vignette": 0.2},
    },
    "misty_morning": {
        "light": {"azimuth_deg": -60.0, "elevation_deg": 18.0, "colour": "#ffe2bd", "strength": 0.75, "softness_deg": 6.0},
        "sky": {"zenith": "#93b0cc", "horizon": "#e9e0d2", "ground": "#8b8c7e", "glow": 0.6, "clouds": 0.1},
        "fog": {"colour": "#dfe0dc", "visibility_m": 70.0, "height_m": 4.0},
        "grade": {"contrast": 1.08, "saturation": 0.95, "temperature": 0.03, "vignette": 0.16, "glow": 0.1},
    },
    "blue_hour": {
        "light": {"azimuth_deg": 160.0, "elevation_deg": 24.0, "colour": "#8fb4ff", "strength": 0.30, "softness_deg": 6.0},
        "sky": {"zenith": "#16264e", "horizon": "#8a7f9c", "ground": "#2a2f3a", "glow": 0.25, "clouds": 0.3, "stars": 0.25},
        "fog": {"colour": "#5f6a8c", "visibility_m": 300.0, "height_m": 15.0},
        "grade": {"exposure_stops": 0.5, "contrast": 1.06, "saturation": 1.05, "temperature": -0.14, "vignette": 0.3, "glow": 0.1},
    },
    "night": {
        "light": {"azimuth_deg": -125.0, "elevation_deg": 40.0, "colour": "#a9c1ff", "strength": 0.12, "softness_deg": 2.0},
        "sky": {"zenith": "#0a1024", "horizon": "#202c4a", "ground": "#0c0e12", "glow": 0.5, "clouds": 0.12, "stars": 1.0},
        "grade": {"exposure_stops": 0.9, "contrast": 1.06, "saturation": 0.95, "temperature": -0.04, "vignette": 0.3, "glow": 0.14},
    },
    "high_key": {
        "light": {"azimuth_deg": -120.0, "elevation_deg": 55.0, "colour": "#ffffff", "strength": 0.75, "softness_deg": 8.0},
        "sky": {"zenith": "#f2f4f6", "horizon": "#ffffff", "ground": "#e8e8e8", "glow": 0.0, "strength": 1.0, "indoors": True},
        "grade": {"exposure_stops": 0.1, "contrast": 0.98, "saturation": 1.0, "vignette": 0.0},
    },
    "drama": {
        "light": {"azimuth_deg": 140.0, "elevation_deg": 30.0, "colour": "#ffd9b0", "strength": 0.95, "softness_deg": 4.0},
        "sky": {"zenith": "#14161c", "horizon": "#2c2a2a", "ground": "#151412", "glow": 0.15, "strength": 0.8},
        "grade": {"contrast": 1.16, "saturation": 0.92, "temperature": 0.06, "vignette": 0.45, "glow": 0.1},
    },
}  # fmt: skip
"""The moods by name: keyword arguments of `Film.light`, `Film.sky`, `Film.fog` and `Film.grade`; the rest stays as it is."""
