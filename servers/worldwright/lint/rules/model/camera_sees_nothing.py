"""A camera looks away from everything.

What it does: tests whether the field of view of each camera meets the bounding sphere of any visible geom that is not an
endless plane. Cameras that worldkit aims are left to it.

Why is this bad: the film shows the floor or the sky. A MuJoCo camera looks along its own -z axis, which is easily taken
for +x or +z.

Use instead: `xyaxes` (right and up), or `mode="targetbody"` with a `target`; in worldkit a named view and `subjects`.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, pixels
from ...problem import Problem

CODE = "WM132"
SEVERITY = "error"
SCOPE = "any"
LOOK = (
    "<mujoco><worldbody><camera name='eye' pos='0 -3 .5' {0}/><geom type='plane' size='9 9 .1'/>"
    "<geom name='ball' pos='0 0 .5' size='.5'/></worldbody></mujoco>"
)
GOOD = (LOOK.format("xyaxes='1 0 0 0 0 1'"),)
BAD = (LOOK.format("xyaxes='-1 0 0 0 0 1'"), LOOK.format(""))
EVIDENCE = Measured("the ball is not in the picture", pixels, 0.02, "of the picture")
ASPECT = 16.0 / 9.0


def check(view: ModelView) -> Iterator[Problem]:
    """Check perspective cameras of a world that has something to see."""
    aimed = {name.removeprefix("worldkit.camera.") for name in view.annotated_cameras}
    solid = view.visible & (view.geom_rbound > 0)
    if not solid.any():
        return
    for camera in range(len(view.cam_fovy)):
        if view.name("camera", camera) in aimed or int(view.cam_projection[camera]) == 1:
            continue
        # In the camera's frame: x right, y up, looking along -z.
        places = (view.geom_xpos[solid] - view.cam_xpos[camera]) @ view.cam_xmat[camera]
        reach, depth = view.geom_rbound[solid], -places[:, 2]
        half = np.radians(float(view.cam_fovy[camera])) / 2
        seen = depth > -reach
        for axis, angle in ((0, np.arctan(np.tan(half) * ASPECT)), (1, half)):
            # Distance beyond the side of the field of view, against the radius.
            beyond = np.abs(places[:, axis]) * np.cos(angle) - depth * np.sin(angle)
            seen &= beyond < reach
        if not seen.any():
            message = f"camera {view.name('camera', camera)} sees nothing but planes"
            yield view.at("camera", camera, message, "a camera looks along its own -z: turn it with xyaxes")
