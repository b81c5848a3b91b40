"""Release a layout and tell what stays, what topples and what slides."""

import math
from typing import Any

from ..model.plan.committed import Plan, SettledOffset
from ..model.plan.layout import Scene
from .anchors import shown, wrap
from .asking import simulate, why_held
from .placement_results import Settled, SettleReport
from .statements import Locate, Problems
from .vocabulary import PREDICATES

SLIDE_M = 0.02
TILT_DEG = 3.0
SPEED_M_S = 0.05
DEEP_M = 2e-3
MOST_M, MOST_DEG = 0.02, 3.0
"""A tolerance for writing back may not be larger: what moves more was not at rest where its rows put it."""
NOISE_M, NOISE_DEG = 1e-4, 0.05
"""A smaller displacement is not written."""


def settle(plan: Plan, scene: Scene, *, file: str, locate: Locate, duration_s: float) -> SettleReport:
    """Release the layout for `duration_s` seconds and report what each loose object did.

    Objects named in motion_expectations may move as they like; any other that slides more than 2 cm, tilts more than
    3 degrees or is still moving at 5 cm/s is a finding.

    Raises:
        JobError: the pre-roll failed.
    """
    problems = Problems(file, locate)
    held = why_held(plan, scene)
    result = simulate(plan, scene, duration_s=duration_s)
    gaps = {
        name: float(gap)
        for row in plan.topology.scene_predicates
        for name in plan.families.get(row.subject, (row.subject,))
        if (entry := PREDICATES.entries.get(row.predicate)) and entry.SUPPORTS
        if isinstance(gap := row.params.get(entry.DROP), int | float)
    }
    movers = set(plan.movers())
    moved = []
    for placed in scene.objects:
        if placed.fixed or placed.name in held or placed.name not in result["objects"]:
            continue
        settled = _settled(placed.name, placed.deg_z, result["objects"][placed.name])
        moved.append(settled)
        if placed.name in movers:
            continue
        faults = []
        if settled.tilt_deg > TILT_DEG:
            faults.append(f"tilts by {settled.tilt_deg:.1f} deg")
        if settled.slide_m > SLIDE_M:
            faults.append(f"slides {settled.slide_m:.3f} m")
        if settled.drop_m > gaps.get(placed.name, 0.0) + SLIDE_M:
            faults.append(f"drops {settled.drop_m:.3f} m")
        if settled.speed_m_s > SPEED_M_S:
            faults.append(f"still moves at {settled.speed_m_s:.2f} m/s")
        if faults:
            index = next((i for i, r in enumerate(plan.topology.scene_predicates) if r.subject == placed.name), None)
            problems.add(
                "WP306",
                "unstable",
                f"`{placed.name}` does not stay: it {', '.join(faults)} within {duration_s:g} s",
                "move its centre over its support, give it more room, or name it in motion_expectations",
                ("topology",) if index is None else ("topology", "scene_predicates", index),
            )
    deepest = max((depth for _, _, depth in result["contacts"]), default=0.0)
    if deepest > DEEP_M:
        first, second, depth = result["contacts"][0]
        problems.add(
            "WP302",
            "overlap",
            f"`{first}` and `{second}` start {shown(depth)} m inside each other and are thrown apart",
            "move them apart (`worldwright place check` names the rows)",
        )
    moved.sort(key=lambda o: -(abs(o.drop_m) + o.slide_m + math.radians(o.tilt_deg)))
    return SettleReport(
        duration_s=duration_s,
        objects=tuple(moved),
        held=held,
        findings=tuple(problems.findings),
        deepest_m=round(deepest, 6),
    )


def offsets(
    plan: Plan, report: SettleReport, tolerance_m: float, tolerance_deg: float
) -> tuple[dict[str, dict[str, float]], list[str]]:
    """The offsets for `topology.settled`, and the objects that moved further than the tolerance allows.

    Offsets add to those already there, since the pre-roll starts from them. Movers are left where their rows put them.
    """
    movers = set(plan.movers())
    found: dict[str, dict[str, float]] = {}
    too_far: list[str] = []
    for settled in report.objects:
        before = plan.topology.settled.get(settled.name, SettledOffset())
        if settled.name in movers:
            continue
        x, y, z = (a + b for a, b in zip(settled.moved, (before.x, before.y, before.z), strict=True))
        turn = wrap(before.deg_z + settled.turn_deg)
        if math.hypot(x, y, z) > tolerance_m or max(abs(turn), settled.tilt_deg) > tolerance_deg:
            too_far.append(
                f"`{settled.name}` moved {shown(round(math.hypot(x, y, z), 5))} m, turned {shown(round(turn, 3))} deg and "
                f"tilted {shown(round(settled.tilt_deg, 3))} deg"
            )
        elif math.hypot(x, y, z) > NOISE_M or abs(turn) > NOISE_DEG:
            values = {"x": round(x, 6), "y": round(y, 6), "z": round(z, 6), "deg_z": round(turn, 4)}
            found[settled.name] = {key: value for key, value in values.items() if value}
    return found, too_far


def _settled(name: str, deg_z: float, row: dict[str, Any]) -> Settled:
    (x0, y0, z0), (x1, y1, z1) = row["start"], row["end"]
    w, x, y, z = row["quat"]
    up_z = 1 - 2 * (x * x + y * y)  # z component of the rotated z axis
    yaw = math.degrees(math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)))
    return Settled(
        name=name,
        drop_m=round(z0 - z1, 6),
        slide_m=round(math.hypot(x1 - x0, y1 - y0), 6),
        tilt_deg=round(math.degrees(math.acos(max(-1.0, min(1.0, up_z)))), 4),
        turn_deg=round(wrap(yaw - deg_z), 4),
        speed_m_s=round(row["speed"], 6),
        position=(round(x1, 6), round(y1, 6), round(z1, 6)),
        moved=(round(x1 - x0, 6), round(y1 - y0, 6), round(z1 - z0, 6)),
    )
