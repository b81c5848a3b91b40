"""Each camera sees what it should show: in the picture, not hidden, and large enough to be recognised."""

from collections import Counter
from typing import Any

from ...model.plan import in_view
from ...model.plan.implementation_steps import CameraRow
from ..asking import RefusedLayoutError, simulate
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
MOST_MEASURED = 100
"""So many pairs of a camera and a thing that the plan speaks of are measured with rays; the scan measures all (`WS146`)."""


def check(layout: CheckedLayout) -> None:
    """Report WP312 for a subject outside the picture, WP313 for a hidden one, WP314 for a speck; note all in `views`.

    WP328: what the plan speaks of is less than a fortieth of the width long in every planned picture.
    """
    cameras = [camera for row in layout.plan.cameras() if _points(camera := _camera(layout, row))]
    if not layout.exact or not cameras or not layout.scene.objects or len(layout.scene.objects) > MOST_OBJECTS:
        return
    try:
        result = simulate(layout.plan, layout.scene, everything=True, cameras=cameras, moved=layout.moved)
    except RefusedLayoutError as error:
        layout.problems.add(
            "WP312",
            "out_of_view",
            f"the cameras could not be tried: {error.cause}",
            error.next_move,
            severity="warning",
        )
        return
    width, height = layout.plan.recording_mode.size
    rows: dict[tuple[str, str], dict[str, Any]] = {(row["camera"], row["object"]): row for row in result["views"]}
    subjects = {(camera["name"], name) for camera in cameras for name in camera["subjects"]}
    told = _smallest(layout, list(rows.values()))
    for pair, row in rows.items():
        if pair not in subjects:
            continue
        seen = Seen(
            camera=row["camera"],
            object=row["object"],
            pixels=round(row["share"] * width * height),
            share=round(row["share"], 6),
            in_frame=round(row["in_frame"], 4),
            hidden=round(row["hidden"], 4),
            length_px=round(row["length"] * width),
        )
        layout.views.append(seen)
        _judge(layout, seen, told)


def _camera(layout: CheckedLayout, row: CameraRow) -> dict[str, Any]:
    """The data that pose a camera: a template's pose, an explicit one, or a view and its subjects."""
    subjects = [n for n in (row.subjects or layout.plan.movers()) if n in layout.placed]
    placed = next((c for c in layout.scene.cameras if c.name == row.name), None)
    pose: dict[str, Any] = {"position": row.position, "target": row.target, "view": row.view}
    if placed is not None:
        pose = {"position": placed.position, "target": placed.target, "view": None}
    width, height = layout.plan.recording_mode.size
    spoken = [
        n for n in in_view.spoken_of(layout.plan) if n in layout.placed
    ]  # the first ones, the same for each camera
    measured = list(dict.fromkeys([*subjects, *spoken[: MOST_MEASURED // len(layout.plan.cameras())]]))
    return {
        "name": row.name,
        "subjects": subjects,
        "measured": measured,
        "fovy": row.fovy,
        "aspect": width / height,
        **pose,
    }


def _points(camera: dict[str, Any]) -> bool:
    """Whether it is known where a camera looks, at its subjects or at a place that the plan gives, and something is measured."""
    return bool(camera["subjects"]) or (bool(camera["measured"]) and None not in (camera["position"], camera["target"]))


def _smallest(layout: CheckedLayout, rows: list[dict[str, Any]]) -> set[str]:
    """Note what is smallest where it is seen largest; report what is too small to be watched, copies as one, and return all of it.

    Only what every planned camera was asked about counts: another picture may show it large.
    """
    width, planned = layout.plan.recording_mode.size[0], {row.name: row for row in layout.plan.cameras()}
    asked = Counter(row["object"] for row in rows)
    largest: dict[str, dict[str, Any]] = {}
    for row in rows:
        clear = row["in_frame"] >= CUT_OFF and row["hidden"] <= HIDDEN
        if clear and row["length"] > largest.get(row["object"], {"length": 0.0})["length"]:
            largest[row["object"]] = row
    spoken = [name for name in in_view.spoken_of(layout.plan) if name in largest and asked[name] == len(planned)]
    lengths = {name: float(largest[name]["length"]) for name in spoken}
    for name in sorted(spoken, key=lambda name: lengths[name])[:1]:
        layout.smallest = in_view.told(name, lengths[name] * width, largest[name]["camera"], width)
    small = {name: length for name, length in lengths.items() if length < in_view.SHARE}
    for name, others in in_view.once(layout.plan, small):
        row, pixels = largest[name], small[name] * width
        said = in_view.told(name, pixels, row["camera"], width)
        eye, place = tuple(row["eye"]), tuple(row["place"])
        follows = planned[row["camera"]].follow
        layout.problems.add(
            "WP328",
            "too_small",
            f"at the start {said}{others}; it is watched from {in_view.SHARE:.1%} on",
            in_view.remedy(name, row["camera"], eye, place, pixels, width, follows=follows),
            ("implementation_steps",),
            severity="warning",
        )
    return set(small)


def _judge(layout: CheckedLayout, seen: Seen, told: set[str]) -> None:
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
    elif seen.pixels < SMALL_PX and seen.object not in told:
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
