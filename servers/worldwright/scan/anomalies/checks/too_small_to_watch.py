"""What the plan speaks of is so small in every planned picture that nobody can watch it.

What it means: the claim may hold, but no viewer sees it: the camera is too far away for a thing of this size.

Formula: the length in pixels of the longer side of the box around each object that should move or that a claim is about,
where it is largest, of some 60 frames of all planned cameras; its message tells which camera to move, and to where.
Threshold: a fortieth of the picture's width, in at least two frames. A warning.
Source: the pinhole camera (R. Hartley, A. Zisserman, Multiple View Geometry, chapter 6); the least size at which a drafted
thing's parts are told apart.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.plan import in_view
from ....model.plan.committed import Plan
from ....model.recording.stills import Lens
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..in_picture import largest
from ..sign import Case, Context, Sign, SkipError

CODE = "WS146"
REPAIR = "camera_placement"
NEEDS = ("pos",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield what is too small in all pictures: of the copies of an object the smallest, which says how many more are."""
    plan = context.plan
    if plan is None or not trajectory.cameras:
        raise SkipError("there is no plan, or where its cameras stand is not recorded")
    if unknown := [camera.name for camera in plan.cameras() if camera.name not in trajectory.cameras]:
        raise SkipError(f"where camera {unknown[0]} stands is not recorded, and it may show all of it large")
    width = plan.recording_mode.size[0]
    wanted, window = width * in_view.SHARE, (trajectory.t[0], trajectory.t[-1])
    small = {seen.name: seen for seen in largest(trajectory, plan) if seen.pixels < wanted}
    for name, others in in_view.once(plan, {name: seen.pixels for name, seen in small.items()}):
        seen = small[name]
        said = in_view.told(name, seen.pixels, seen.camera, width)
        moved = in_view.remedy(name, seen.camera, seen.eye, seen.place, seen.pixels, width, follows=seen.follows)
        message = f"{said} at {seen.time_s:.2f} s, its largest{others}; {moved}"
        yield Sign(name, window, seen.pixels, wanted, "pixels", "warn", message)


def _from(distance: float) -> Case:
    made = replace(analytic.falling(height=1.0, seconds=0.4), names=("body",))
    aside = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    lens = Lens(np.array([0.0, -distance, 0.7]), aside, 40.0, (640, 360))
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.001, "simulation_duration": 0.4},
            "objectives": [{"claim": "It falls.", "expect": [{"falls": {"body": "body"}}]}],
            "scene_objects": [{"name": "body", "primitive": "sphere", "size": [0.1, 0.1, 0.1]}],
            "implementation_steps": [{"description": "all", "cameras": [{"name": "side"}]}],
            "recording_mode": {"size": [640, 360]},
        }
    )
    return Case(f"a body of 10 cm seen from {distance:g} m", replace(made, cameras={"side": lens}), Context.of(plan))


GOOD = (lambda: _from(2.0),)
BAD = (lambda: replace(_from(12.0), severity="warn"),)
