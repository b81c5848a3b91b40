"""What demonstrations stand on and hang from."""

from worldkit.sculpt import crisp
from worldkit.sculpt.crisp import Solid


def gallows(height: float, reach: float, depth: float = 0.10, rod: float = 0.010) -> Solid:
    """A foot, a rod and an arm: what hangs at (0, reach / 2, height) hangs over the foot, m."""
    side, top = reach / 2, height + rod / 2
    return crisp.together(
        crisp.box((depth, reach + 0.07, 0.014), 0.003).translate(z=0.007),
        crisp.cylinder(2 * rod, 0.03, 0.002).translate(0, -side, 0.012),
        crisp.wire([(0, -side, 0.01), (0, -side, top + 0.004)], rod, smooth=False),
        crisp.wire([(0, -side - 0.012, top), (0, side + 0.012, top)], 0.8 * rod, smooth=False),
        crisp.box((2 * rod, 2 * rod, 2 * rod), 0.002).translate(0, -side, top),
    )


def disc_foot(diameter: float, thickness: float, rod: float, height: float) -> Solid:
    """A round foot with a low cone, and a post to a height, m."""
    r = diameter / 2
    steps = [
        (r - 0.002, 0),
        (r, 0.002),
        (r, 0.6 * thickness),
        (0.4 * r, thickness),
        (rod, 1.6 * thickness),
        (rod / 2, 2.2 * thickness),
    ]
    return crisp.lathe([*steps, (rod / 2, height)])
