"""Placement at scale: resolve and check 1,000 objects in under 0.5 s, and 10,000 in under 12 times that, on one core.

A yard of crates in rows: each stands beside its neighbour, every fifth on another one, every third faces the first (so that its
extents are rotated ones). Prints the best of five repetitions in processor time, the growth exponent log(t2 / t1) / log(n2 / n1), and the share
of coordinates that some row or baseline explains.
"""

import math
import sys
import time

from figures import Figure, report

from worldwright.model.plan.committed import Plan
from worldwright.place.checks import check
from worldwright.place.engine import Resolution, resolve

SIZES = (1_000, 10_000)
LIMIT_S, LIMIT_RATIO = 0.5, 12.0


def yard(count: int) -> Plan:
    """A square of crates, about 2.6 rows each."""
    side = math.isqrt(count)
    objects, rows = [], []
    for index in range(count):
        name = f"crate_{index}"
        objects.append({"name": name, "primitive": "box", "size": [0.5, 0.4, 0.3 + 0.1 * (index % 3)]})
        line, place = divmod(index, side)
        if index == 0:
            rows.append({"subject": name, "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}})
        elif place % 5 == 4:
            params = {"offset": [0.05, 0]}
            rows.append({"subject": name, "predicate": "PLACE-ON", "object": f"crate_{index - 1}", "params": params})
        elif place == 0:
            gap = {"gap": 1.1 * line}
            rows += [
                {"subject": name, "predicate": "PLACE-ON-BASE"},
                {"subject": name, "predicate": "FRONT-OF", "object": "crate_0", "params": gap},
                {"subject": name, "predicate": "ALIGN-CENTER-LR", "object": "base"},
            ]
        else:
            neighbour = f"crate_{index - 1 if place % 5 else index - 2}"
            rows += [
                {"subject": name, "predicate": "PLACE-ON-BASE"},
                {"subject": name, "predicate": "LEFT-OF", "object": neighbour, "params": {"gap": 0.25}},
                {"subject": name, "predicate": "ALIGN-FRONT", "object": neighbour},
            ]
            if place % 3 == 0:
                rows.append({"subject": name, "predicate": "FACING-TO", "object": "crate_0"})
    return Plan.model_validate(
        {
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1},
            "objectives": [{"claim": "the yard stands"}],
            "scene_objects": objects,
            "topology": {"scene_predicates": rows},
        }
    )


def once(plan: Plan) -> tuple[float, float, Resolution]:
    """Seconds to resolve, seconds to check, and the layout."""
    start = time.process_time()
    resolution = resolve(plan)
    middle = time.process_time()
    report = check(plan, resolution, locate=lambda *path: None)
    end = time.process_time()
    if not (resolution.scene.ok and report.ok):
        sys.exit("the yard does not hold: " + "; ".join(map(str, report.findings[:3])))
    return middle - start, end - middle, resolution


def main() -> int:
    """Measure, print, and say by the exit code whether the goals are met."""
    once(yard(100))  # imports and caches
    totals = []
    for count in SIZES:
        plan = yard(count)
        runs = [once(plan) for _ in range(5)]
        resolved, checked, resolution = min(runs, key=lambda run: run[0] + run[1])
        totals.append(resolved + checked)
        unexplained = sum(len(o.provenance) < 4 for o in resolution.scene.objects)
        rows = len(plan.topology.scene_predicates)
        print(
            f"{count:6d} objects, {rows} rows: resolve {resolved:.3f} s + check {checked:.3f} s = {totals[-1]:.3f} s; "
            f"{unexplained} objects with an unexplained coordinate"
        )
    ratio = totals[1] / totals[0]
    exponent = math.log(ratio) / math.log(SIZES[1] / SIZES[0])
    print(f"growth exponent {exponent:.2f}")
    return report(
        Figure("placing 1,000 objects", totals[0], LIMIT_S, "s"),
        Figure("placing 10,000 / 1,000 objects", ratio, LIMIT_RATIO),
    )


if __name__ == "__main__":
    sys.exit(main())
