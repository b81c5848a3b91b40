"""A finding matters when a claim rests on it or a viewer can see it; otherwise it becomes a remark.

A claim rests on what its expectations and its cause name, and on whatever these touch, through however many others, before
the last of its effects is over: the rest of the world may do as it likes. A viewer sees what measures two pixels in one of
the planned pictures, for two frames. How many pixels a metre has is reckoned from what each camera frames, or from where it
stands; where that cannot be reckoned, everything is visible.

Checks that want this set `RELATIVE`. Staging, and faults of the recording itself, always matter.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from ...model.finding import Anomaly
from ...model.plan.committed import Plan
from ...model.plan.implementation_steps import CameraRow
from ...model.recording.trajectory import Trajectory
from ..objectives.claims import EXPECTATIONS
from .declared import mentioned
from .wholes import head_names

PIXELS, FRAMES = 2.0, 2
FILLED = 0.7
"""Share of a picture's height that a camera fills with what it frames."""


class Rests(NamedTuple):
    """A claim that rests on a body, and until when."""

    objective: int
    until_s: float


def weighed(anomalies: Iterable[Anomaly], trajectory: Trajectory, plan: Plan) -> Iterator[Anomaly]:
    """The findings: a blocking one names the claim or picture that it spoils; without one it becomes a remark."""
    listed = list(anomalies)
    if not any(a.severity == "blocking" for a in listed):
        yield from listed
        return
    resting, cameras = claimed(trajectory, plan), dict(pixels_per_metre(trajectory, plan))
    frame_s = 1.0 / plan.recording_mode.fps
    for anomaly in listed:
        if anomaly.severity != "blocking":
            yield anomaly
            continue
        names = {part for part in anomaly.body.replace(",", " ").split() if part != "and"}
        claim = next(
            (resting[n] for n in sorted(names) if n in resting and anomaly.window_s[0] <= resting[n].until_s), None
        )
        shown = _where_seen(anomaly, cameras, frame_s)
        if claim is not None:
            why = f"objective {claim.objective} rests on it"
        elif shown:
            why = shown
        elif names.isdisjoint(trajectory.names):
            yield anomaly  # it is about the world as a whole
            continue
        else:
            why = "no claim rests on it and no planned picture shows it"
            yield anomaly.model_copy(update={"severity": "info", "message": f"{anomaly.message}; {why}"})
            continue
        yield anomaly.model_copy(update={"message": f"{anomaly.message}; {why}"})


def claimed(trajectory: Trajectory, plan: Plan) -> dict[str, Rests]:
    """Bodies on which claims rest, each with the claim that does so longest."""
    from ..audits.moment import event_s
    from ..objectives.expecting import named

    head, found = head_names(trajectory), dict[str, Rests]()
    end = float(trajectory.t[-1])
    for index, objective in enumerate(plan.objectives):
        until, names = 0.0, mentioned(objective.cause)
        for row in objective.expect:
            for name, given in row.items():
                names |= mentioned(given)
                event = name in EXPECTATIONS and EXPECTATIONS[name].EVENT
                moment = event_s(trajectory, name, named(given)) if event else None
                until = max(until, end if moment is None else moment)
        start = {b for b, name in enumerate(trajectory.names) if not names.isdisjoint({name, head[name]})}
        for b in _touched_bodies(trajectory, start, until):
            name = trajectory.names[b]
            if name not in found or found[name].until_s < until:
                found[name] = Rests(index, until)
    return found


def _touched_bodies(trajectory: Trajectory, start: set[int], until_s: float) -> set[int]:
    """Bodies that by then touch one of these, or one that does, and so on; what stands still passes nothing on."""
    contacts = trajectory.contacts
    if contacts is None:
        return start
    early = trajectory.t[contacts.row] <= until_s
    pairs = np.unique(np.stack([contacts.body1[early], contacts.body2[early]], axis=1), axis=0)
    moves = np.ptp(trajectory.pos, axis=0).max(axis=1) > 1e-6
    found, new = set(start), set(start)
    while new:
        reached = {int(b) for a, b in pairs if a in new} | {int(a) for a, b in pairs if b in new}
        found |= (fresh := {b for b in reached if b >= 0} - found)
        new = {b for b in fresh if moves[b]}
    return found


def pixels_per_metre(trajectory: Trajectory, plan: Plan) -> Iterator[tuple[str, float]]:
    """Each planned camera with the most pixels that it gives a metre of its subjects."""
    height = plan.recording_mode.size[1]
    for camera in plan.cameras():
        yield camera.name, _scale(trajectory, camera, height)


def _scale(trajectory: Trajectory, camera: CameraRow, height: int) -> float:
    wanted = camera.subjects or trajectory.names
    mine = [b for b, name in enumerate(trajectory.names) if name in wanted]
    if not mine:
        return float("inf")
    path, size = trajectory.pos[:, mine], trajectory.size_m[mine]
    if camera.position is not None:
        away = float(np.sqrt(((path - np.asarray(camera.position)) ** 2).sum(axis=2)).min())
        return height / (2 * max(away, 1e-3) * np.tan(np.radians(camera.fovy) / 2))
    extent = path.max(axis=(0, 1)) - path.min(axis=(0, 1)) if not camera.follow else np.ptp(path, axis=1).max(axis=0)
    return FILLED * height / float(max(np.sqrt((extent**2).sum()), 2 * size.max()))


def _where_seen(anomaly: Anomaly, cameras: dict[str, float], frame_s: float) -> str:
    """Say where a viewer sees an anomaly; empty where nobody does."""
    start, end = anomaly.window_s
    lasts = end - start
    metres = {"m": anomaly.measured, "m/s": anomaly.measured * lasts}.get(anomaly.unit, anomaly.extent_m)
    if metres is None or not cameras:
        return "how large it is in a picture cannot be reckoned"
    camera = max(cameras, key=lambda name: cameras[name])
    pixels = metres * cameras[camera]
    if pixels < PIXELS or 0 < lasts < FRAMES * frame_s:
        return ""
    return f"it measures {pixels:.0f} pixels in camera {camera}"
