"""A body sinks under the surface.

Measures how deep its highest point is under the surface at the end of the window, metres. It must also have gone down
since the start. Source: Archimedes' principle: what is denser than the medium sinks.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.flow import floating, sinking
from ....measuring.immersion import extent
from ....measuring.measured import Measured, OfBody, all_of, at_least, body_index, window

CODE = "WE261"
EVENT = True


class Given(OfBody):
    """The body, the surface, and the depth to reach."""

    surface_m: float = Field(description="height of the surface, m")
    min_m: float = Field(default=0.01, gt=0, description="least depth of its highest point in the end, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the depth in the end."""
    rows = window(trajectory, given.window_s, 2)
    _, top = extent(trajectory, body_index(trajectory, given.body), rows)
    depth, down = given.surface_m - float(top[-1]), float(top[0] - top[-1])
    message = f"the top of {given.body} ends {depth:.4f} m under the surface, {down:.4f} m lower than at the start"
    return all_of(at_least(depth, given.min_m, "m", message), at_least(down, 1e-6, "m", message))


GOOD = ((sinking, {"body": "body", "surface_m": 1.0, "min_m": 0.79}),)
BAD = (
    (sinking, {"body": "body", "surface_m": 1.0, "min_m": 0.81}),
    (lambda: floating(0.6), {"body": "body", "surface_m": 1.0}),
    (lambda: sinking(0.0, surface=0.5), {"body": "body", "surface_m": 2.0}),
)
