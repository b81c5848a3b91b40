"""Draw what moves and what holds on one view: ropes and springs, joints, the pose and the velocities at the start.

Each mark is small and comes with a `Note`: a few words that are placed with the names of the objects, never on one another.
"""

import itertools
import math

import numpy as np

from ...model.plan.committed import InitialMotion, Joint, Plan
from ...model.plan.layout import Scene
from ...model.plan.scene_objects import Vec3
from ..anchors import shown
from ..start import STILL, Hung, Motion, hung, motions, way
from . import palette
from .canvas import Colour, Point, circle
from .labels import Note, Rect, inked
from .panel import View
from .silhouettes import silhouette

ALONG = 0.85
"""With a larger cosine, an axis counts as pointing at the onlooker."""


def start_pose(view: View, plan: Plan, scene: Scene) -> None:
    """Draw outlines of objects that start elsewhere than laid out: the swung pose of what is on joints."""
    moved = motions(plan, scene)
    for placed in scene.objects:
        if placed.name in moved:
            polygons = view.of(silhouette(plan, placed, moved[placed.name]))
            view.canvas.fill(view.pixels(polygons), palette.MOTION, 0.10)
            view.canvas.outline(view.pixels(polygons), palette.SWUNG, 1.4)


def tendons(view: View, plan: Plan, scene: Scene) -> list[Note]:
    """Draw ropes as lines that sag by their slack, springs as zigzags, both at the start."""
    notes = []
    moved = motions(plan, scene)
    for one in hung(plan, scene):
        points = way(plan, scene, one.tendon, moved) or []
        spring = one.tendon.stiffness > 0
        colour = palette.SPRING if spring else palette.ROPE
        line = [view.at(p) for p in (points if spring else _sagging(points, one))]
        for a, b in itertools.pairwise(line):
            if spring:
                _zigzag(view, a, b, colour)
            else:
                view.canvas.line(a, b, colour, 2.2)
        for end in (line[0], line[-1]):
            view.canvas.dot(end, 3.2, colour)
        middle = line[len(line) // 2] if len(line) > 2 else _between(line[0], line[-1])
        notes.append(Note(_hung_words(one), _around(middle, 4), colour, inked(*line)))
    return notes


def joints(view: View, plan: Plan, scene: Scene) -> list[Note]:
    """Draw hinges as a ring with their axis, slides as a double arrow, balls as a ring with a dot; welds have no mark."""
    notes = []
    places = {o.name: o.position for o in scene.objects}
    moved = motions(plan, scene)
    for joint in plan.topology.joints:
        anchor = joint.anchor or places.get(joint.child)
        if joint.type == "weld" or anchor is None:
            continue
        centre = view.at(moved.get(joint.parent, Motion())(anchor))
        ink = inked(*_symbol(view, joint, centre), half=5)
        start = plan.simulation_parameters.initial_motion.get(joint.name)
        notes.append(Note(_joint_words(joint, start), _around(centre, 7), palette.JOINT, ink))
    return notes


def velocities(view: View, plan: Plan, scene: Scene) -> list[Note]:
    """Draw arrows for the velocities at the start, of free bodies and of what is on joints, with their size."""
    found = list(_starts(plan, scene))
    fastest = max((math.hypot(*velocity) for _, velocity, _ in found), default=0.0)
    notes = []
    for origin, velocity, words in found:
        size = math.hypot(*velocity)
        u, v = (velocity[axis] for axis in view.axes)
        flat = math.hypot(u, v)
        a = view.at(origin)
        if flat < 0.2 * size or not size:
            if not size:
                notes.append(Note(words, _around(a, 3), palette.MOTION))
            continue
        length = (40 + 60 * size / fastest) * flat / size
        b = (a[0] + u / flat * length, a[1] - v / flat * length)
        view.canvas.arrow(a, b, palette.MOTION, 2.2, 10)
        notes.append(Note(words, _around(b, 4), palette.MOTION, inked(a, b, half=5)))
    return notes


def _starts(plan: Plan, scene: Scene) -> "list[tuple[Vec3, Vec3, str]]":
    """(place, velocity in m/s, words) of each start; the velocity of a mere spin is zero."""
    placed = {o.name: o.position for o in scene.objects}
    by_name = {joint.name: joint for joint in plan.topology.joints}
    moved = motions(plan, scene)
    found: list[tuple[Vec3, Vec3, str]] = []
    for name, start in plan.simulation_parameters.initial_motion.items():
        if name in placed:
            words = [f"{math.hypot(*start.linear):.3g} m/s"] if any(start.linear) else []
            words += [f"spins at {math.hypot(*start.angular):.3g} rad/s"] if any(start.angular) else []
            if words:
                found.append((placed[name], start.linear, ", ".join(words)))
            continue
        joint = by_name.get(name)
        if joint is None or not start.joint_velocity or joint.child not in placed:
            continue
        own = moved.get(joint.child, Motion())
        centre, anchor = own(placed[joint.child]), joint.anchor or placed[joint.child]
        turn = Motion(moved[joint.parent].rotation if joint.parent in moved else STILL)
        axis = np.array(turn(joint.axis)) / (math.hypot(*joint.axis) or 1.0)
        along = axis if joint.type == "slide" else np.cross(axis, np.subtract(centre, own(anchor)))
        x, y, z = (float(part) for part in along * start.joint_velocity)
        unit = "m/s" if joint.type == "slide" else "rad/s"
        found.append((centre, (x, y, z), f"{abs(start.joint_velocity):.3g} {unit}"))
    return found


def _symbol(view: View, joint: Joint, centre: Point) -> tuple[Point, Point]:
    """Draw a joint's mark; returns the ends of the line along which it lies."""
    canvas, (x, y) = view.canvas, centre
    axis = np.array(joint.axis, dtype=float) / (math.hypot(*joint.axis) or 1.0)
    flat = np.array([axis[view.axes[0]], -axis[view.axes[1]]])
    facing = float(np.hypot(*flat)) < math.sqrt(1 - ALONG**2)
    if joint.type == "slide" and not facing:
        for way_ in (flat, -flat):
            canvas.arrow(centre, (x + 24 * way_[0], y + 24 * way_[1]), palette.JOINT, 1.8, 7)
        return (x - 24 * flat[0], y - 24 * flat[1]), (x + 24 * flat[0], y + 24 * flat[1])
    canvas.fill([circle(centre, 6.5)], palette.PANEL, 0.9)
    canvas.outline([circle(centre, 6.5)], palette.JOINT, 1.8)
    if joint.type == "ball" or facing:
        canvas.dot(centre, 2.4, palette.JOINT)
        return centre, centre
    ends = (x - 22 * flat[0], y - 22 * flat[1]), (x + 22 * flat[0], y + 22 * flat[1])
    canvas.dashes(*ends, palette.JOINT, 1.4, 4)
    return ends


def _joint_words(joint: Joint, start: InitialMotion | None) -> str:
    position = start.joint_position if start else None
    unit = "°" if joint.type == "hinge" else " m"
    return f"{joint.name} ({joint.type}" + (f", starts at {shown(position)}{unit})" if position else ")")


def _hung_words(one: Hung) -> str:
    name, slack = one.tendon.name, one.slack_m
    if one.tendon.stiffness:
        return f"{name} ({shown(round(one.tendon.stiffness, 1))} N/m)"
    if one.tendon.rod:
        return f"{name} (rod)"
    if abs(slack) < 1e-6:
        return f"{name} (taut)"
    return f"{name} ({'slack' if slack > 0 else 'too short'} by {shown(round(abs(slack), 3))} m)"


def _sagging(points: list[Vec3], one: Hung) -> list[Vec3]:
    """The way of a rope, whose longest stretch hangs by the slack: a parabola with a sag of sqrt(3/8 · chord · slack)."""
    if one.slack_m < 1e-6 or one.tendon.rod:
        return points
    longest = max(range(len(points) - 1), key=lambda i: math.dist(points[i], points[i + 1]))
    a, b = np.array(points[longest]), np.array(points[longest + 1])
    chord = float(np.linalg.norm(b - a))
    sag = min(math.sqrt(3 / 8 * chord * one.slack_m), 0.35 * chord)
    hanging: list[Vec3] = []
    for t in np.linspace(0, 1, 25):
        x, y, z = (float(part) for part in a + (b - a) * t)
        hanging.append((x, y, max(z - 4 * sag * float(t * (1 - t)), min(a[2], b[2], 0.0))))
    return [*points[:longest], *hanging, *points[longest + 2 :]]


def _zigzag(view: View, start: Point, end: Point, colour: Colour) -> None:
    a, b = np.array(start), np.array(end)
    length = float(np.hypot(*(b - a)))
    if length < 12:
        view.canvas.line(start, end, colour, 2.0)
        return
    along = (b - a) / length
    across = np.array([-along[1], along[0]])
    teeth = max(4, round(length / 14))
    turns = [a, *(a + (b - a) * (k + 0.5) / teeth + across * (5 if k % 2 else -5) for k in range(teeth)), b]
    for p, q in itertools.pairwise(turns):
        view.canvas.line((p[0], p[1]), (q[0], q[1]), colour, 1.8)


def _between(a: Point, b: Point) -> Point:
    return ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)


def _around(centre: Point, reach: float) -> Rect:
    x, y = centre
    return (x - reach, y - reach, x + reach, y + reach)
