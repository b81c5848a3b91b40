"""The named views: where a camera stands, seen from its subjects. Source: the reference paper's camera templates."""

from dataclasses import dataclass
from math import cos, radians, sin

Vec3 = tuple[float, float, float]


@dataclass(frozen=True)
class View:
    """A direction from the subjects to the camera, and how tightly it frames them."""

    description: str
    azimuth_deg: float
    """Counter-clockwise from +X."""
    elevation_deg: float
    margin: float = 1.25
    """Size of the frame over the size of what must be in it."""

    def direction(self, turn_deg: float = 0.0, lift_deg: float = 0.0) -> Vec3:
        """Unit vector from the subjects to the camera, turned and lifted by so much."""
        azimuth = radians(self.azimuth_deg + turn_deg)
        elevation = radians(min(self.elevation_deg + lift_deg, 89.9))
        return (cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth), sin(elevation))


VIEWS: dict[str, View] = {
    "perspective": View("three-quarter view from the front right, from above", -52, 24),
    "close_up": View("near, low three-quarter view", -38, 16, 1.08),
    "side_minus_x": View("from behind (-X)", 180, 10),
    "side_plus_x": View("from the front (+X)", 0, 10),
    "side_minus_y": View("from the right (-Y)", -90, 10),
    "side_plus_y": View("from the left (+Y)", 90, 10),
    "camera_side_minus_y": View("from the right (-Y), level", -90, 4),
    "top_down": View("from straight above, front at the top", 180, 89.9),
    "inside_minus_x_wall": View("from the inner face of the wall behind (-X)", 180, 22),
    "inside_plus_x_wall": View("from the inner face of the front wall (+X)", 0, 22),
    "inside_minus_y_wall": View("from the inner face of the right wall (-Y)", -90, 22),
    "inside_plus_y_wall": View("from the inner face of the left wall (+Y)", 90, 22),
}
