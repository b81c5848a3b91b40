"""Each camera sees what it should show: in the picture, not hidden, and large enough to be recognised."""

from typing import Any

from ...model.errors import JobError
from ...model.plan.implementation_steps import CameraRow
from ..asking import simulate
from ..placement_results import Seen
from .checked_layout import CheckedLayout

CUT_OFF = 0.6
"""A subject with a smaller share inside the picture is cut off."""
HIDDEN = 0.75
"""A subject with a larger share behind other things cannot be recognised."""
SMALL_PX = 60
"""A subject with fewer pixels at the recording's size is a speck."""
MOST_OBJECTS = 1500
"""A layout with more objects is skipped: to build its shapes would take longer than a call may."""


def check(layout: CheckedLayout) -> None:
    """Report WP312 for a subject outside the picture, WP313 for a hidden one, WP314 for a speck; note all in `views`."""
    cameras = [camera for row in layout.plan.cameras() if (camera := _camera(layout, row))["subjects"]]
    if not layout.exact or not cameras or not layout.scene.objects or len(layout.scene.objects) > MOST_OBJECTS:
        return
    try:
        result = simulate(layout.plan, layout.scene, everything=True, cameras=cameras, moved=layout.moved)
    except JobError as error:
        layout.problems.add(
            "WP312",
            "out_of_view",
            f"the cameras could not be tried: {error.cause}",
            error.next_move,
            severity="warning",
        )
        return
    width, height = layout.plan.recording_mode.size
    for row in result["views"]:
        seen = Seen(
            camera=row["camera"],
            object=row["object"],
            pixels=round(row["share"] * width * height),
            share=round(row["share"], 6),
            in_frame=round(row["in_frame"], 4),
            hidden=round(row["hidden"], 4),
        )
        layout.views.append(seen)
        _judge(layout, seen)


def _camera(layout: CheckedLayout, row: CameraRow) -> dict[str, Any]:
    """The data that pose a camera: a template's pose, an explicit one, or a view and its subjects."""
    subjects = [n for n in (row.subjects or layout.plan.movers()) if n in layout.placed]
    placed = next((c for c in layout.scene.cameras if c.name == row.name), None)
    pose: dict[str, Any] = {"position": row.position, "target": row.target, "view": row.view}
    if placed is not None:
        pose = {"position": placed.position, "target": placed.target, "view": None}
    width, height = layout.plan.recording_mode.size
    return {"name": row.name, "subjects": subjects, "fovy": row.fovy, "aspect": width / height, **pose}


def _judge(layout: CheckedLayout, seen: Seen) -> None:
    index = next((i for i, s in enumerate(layout.plan.implementation_steps) if seen.camera in _names(s.cameras)), None)
    path = ("implementation_steps",) if index is None else ("implementation_steps", index)
    if seen.in_frame < CUT_OFF:
        words = (
            "is not in the picture of" if seen.in_frame == 0 else f"is {1 - seen.in_frame:.0%} outside the picture of"
        )
        layout.problems.add(
            "WP312",
            "out_of_view",
            f"`{seen.object}` {words} camera {seen.camera}",
            "name it among the camera's subjects, move the camera back, or give it another view",
            path,
            severity="error" if seen.in_frame == 0 else "warning",
        )
    elif seen.hidden > HIDDEN:
        layout.problems.add(
            "WP313",
            "hidden",
            f"{seen.hidden:.0%} of `{seen.object}` is behind other things in the picture of camera {seen.camera}",
            "choose a view from the other side or from above, or move what is in front",
            path,
            severity="warning",
        )
    elif seen.pixels < SMALL_PX:
        layout.problems.add(
            "WP314",
            "speck",
            f"`{seen.object}` covers only {seen.pixels} pixels in the picture of camera {seen.camera}",
            "add a close_up camera with it as its only subject",
            path,
            severity="warning",
        )


def _names(cameras: tuple[CameraRow | str, ...]) -> set[str]:
    return {c if isinstance(c, str) else c.name for c in cameras}
