"""What a bicycle and its rider look like: a diamond of tubes, a seated rider with hands on the bars, wheels with spokes."""

from typing import TYPE_CHECKING

from .bicycle_numbers import Bicycle
from .regions import RUBBER, STEEL, TRIM, Regions, dress_body, patch

if TYPE_CHECKING:
    import mujoco

    from ..sculpt import Shape

SKIN, JERSEY, SHORTS, HAIR = "#c89a78", "#2f6fb2", "#1d1f24", "#e8e8e4"


def dress_bicycle(spec: "mujoco.MjSpec", bicycle: Bicycle, name: str, look: str) -> None:
    """Frame and rider, then fork with bars, then wheels."""
    from .. import sculpt

    radius, half = bicycle.wheel_radius_m, bicycle.wheelbase_m / 2
    ax, _, az = bicycle.steering_axis
    foot = (half - bicycle.axes_ahead_m, radius)

    def on_axis(high: float) -> tuple[float, float, float]:
        return foot[0] + ax / az * (high - foot[1]), 0.0, high

    crank, seat, rear = (-0.08, 0.0, 0.28), (-0.24, 0.0, 0.86), (-half, 0.0, radius)
    head, neck = on_axis(0.72), on_axis(0.86)
    tubes = [(crank, head), (crank, seat), ((-0.22, 0.0, 0.8), neck), (head, neck)]
    stays = [(crank, rear), ((-0.215, 0.0, 0.76), rear)]
    frame = sculpt.union(*(sculpt.capsule(a, b, 0.036) for a, b in tubes))
    for (xa, _, za), (xb, _, zb) in stays:
        frame = frame | sculpt.capsule((xa, 0.05, za), (xb, 0.05, zb), 0.02).mirror("y")
    saddle = sculpt.ellipsoid((0.27, 0.15, 0.07)).translate(-0.25, 0, 0.9)
    ring = sculpt.cylinder(0.18, 0.01).rotate(90, "x").translate(crank[0], -0.05, crank[2])
    hip, shoulder, top = (-0.24, 0.0, 1.0), (0.08, 0.0, 1.44), bicycle.height_m
    torso = sculpt.round_cone(hip, shoulder, 0.28, 0.30).scale((1.0, 1.25, 1.0))
    skull = sculpt.sphere(0.2).translate(0.16, 0, top - 0.1)
    body = torso.blend(sculpt.capsule(shoulder, (0.14, 0, top - 0.2), 0.11), 0.05) | skull
    hands = on_axis(1.02)
    for side, pedal in ((1.0, (0.06, 0.19)), (-1.0, (-0.22, 0.36))):
        y = 0.1 * side
        knee = (0.19 if pedal[1] > 0.3 else 0.14, 1.2 * y, 0.82 if pedal[1] > 0.3 else 0.66)
        ankle = (pedal[0] - 0.06, y, pedal[1] + 0.09)
        leg = sculpt.round_cone((-0.22, y, 0.96), knee, 0.18, 0.12).blend(
            sculpt.round_cone(knee, ankle, 0.12, 0.07), 0.04
        )
        body = (
            body
            | leg
            | sculpt.capsule((ankle[0] - 0.03, y, pedal[1] + 0.03), (pedal[0] + 0.1, y, pedal[1] + 0.02), 0.08)
        )
        frame = frame | sculpt.capsule((crank[0], 0.06 * side, crank[2]), (pedal[0], 0.09 * side, pedal[1]), 0.02)
        elbow = (0.2, 0.26 * side, 1.2)
        arm = sculpt.round_cone((0.07, 0.17 * side, 1.42), elbow, 0.11, 0.085)
        body = body | arm | sculpt.round_cone(elbow, (hands[0] + 0.02, 0.25 * side, 1.03), 0.085, 0.06)
    regions = (
        (saddle.grow(0.004), TRIM, 0.6),
        (ring.grow(0.004), STEEL, 0.3),
        (body.grow(0.006), SKIN, 0.6),
        (sculpt.intersection(body.grow(0.006), patch(-0.1, 0, 1.3, (0.62, 0.44, 0.52))), JERSEY, 0.7),
        (sculpt.intersection(body.grow(0.006), patch(-0.2, 0, 0.9, (0.5, 0.5, 0.3))), SHORTS, 0.7),
        (sculpt.intersection(body.grow(0.006), patch(0.1, 0, 0.2, (1.0, 0.5, 0.22)) | patch(-0.2, -0.1, 0.38, (0.4, 0.2, 0.1))), TRIM, 0.6),
        (sculpt.intersection(skull.grow(0.006), patch(0.15, 0, top, (0.6, 0.6, 0.22))), HAIR, 0.5),
    )  # fmt: skip
    dress_body(spec, name, frame | saddle | ring | body, Regions(look, 0.3, regions), (0, 0, radius), cells=210)
    blades = sculpt.capsule((half, 0.055, radius), (*on_axis(0.70)[:1], 0.055, 0.70), 0.028).mirror("y")
    crown = sculpt.capsule(on_axis(0.70), on_axis(0.95), 0.034) | sculpt.box((0.05, 0.14, 0.05), 0.01).translate(
        *on_axis(0.70)
    )
    bar = sculpt.tube([(hands[0], -0.29, 1.0), (hands[0] + 0.05, 0, 0.97), (hands[0], 0.29, 1.0)], 0.026)
    grips = patch(hands[0], 0, 1.0, (0.2, 1, 0.2)) - patch(hands[0], 0, 1.0, (0.3, 0.4, 0.3))
    paint = Regions(look, 0.3, ((grips, RUBBER, 0.8),))
    dress_body(spec, f"{name}_fork", blades | crown | bar, paint, (half, 0, radius), cells=120)
    for corner in bicycle.corners:
        shape = _wheel_shape(bicycle)
        rim = sculpt.cylinder(2 * (radius - 0.022), 1.0).rotate(90, "x")
        paint = Regions(RUBBER, 0.8, ((rim, "#b4b8bd", 0.3),))
        sculpt.dress(spec, f"{name}_{corner}_wheel", shape, paint=paint, cells=130, triangles=9_000, texels=256)


def _wheel_shape(bicycle: Bicycle) -> "Shape":
    """A thin tyre on a rim with sixteen spokes, its axle along y."""
    from .. import sculpt

    radius, thick = bicycle.wheel_radius_m, bicycle.tyre_width_m
    tyre = sculpt.torus(2 * radius, thick)
    rim = sculpt.cylinder(2 * radius - 1.2 * thick, 0.022) - sculpt.cylinder(2 * radius - 2.6 * thick, 0.1)
    spoke = sculpt.capsule((0.02, 0, 0), (radius - thick, 0, 0), 0.007)
    return sculpt.union(tyre, rim, sculpt.radial(spoke, 16), sculpt.cylinder(0.06, 0.07)).rotate(90, "x")
