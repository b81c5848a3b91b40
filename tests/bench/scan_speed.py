"""All checks over ten minutes of a hundred bodies at 100 Hz, as a multiple of one `np.isfinite` pass over the arrays.

Balls bounce, without a model beside them and then again with sizes, masses and geoms known: clean, so that every check
has to look at everything. What a check finds costs extra, since it is measured and told apart.
"""

import sys
import time

import numpy as np
from figures import Figure, report

from worldwright.model.recording.mechanics import Mechanics
from worldwright.model.recording.trajectory import Trajectory
from worldwright.scan.anomalies import engine

GOAL = 25.0
BODIES, RATE, SECONDS = 100, 100, 600


def motion(seed: int = 0) -> dict[str, np.ndarray]:
    """The interchange's arrays: balls that bounce for ever, each between its own two walls."""
    rng = np.random.default_rng(seed)
    t = np.arange(RATE * SECONDS) / RATE
    phase = rng.uniform(0, 1, (BODIES, 3))
    pos = np.zeros((len(t), BODIES, 3))
    vel = np.zeros_like(pos)
    pos[:, :, 0] = 0.2 * np.arange(BODIES)
    # A triangle wave along y: constant speed, and a wall at either end.
    speed = rng.uniform(0.3, 1.5, BODIES)
    way = np.mod(speed * t[:, None] + 10 * phase[:, 1], 10.0)
    pos[:, :, 1] = np.minimum(way, 10.0 - way)
    vel[:, :, 1] = np.where(way < 5.0, speed, -speed)
    at_wall = np.minimum(pos[:, :, 1], 5.0 - pos[:, :, 1]) < 1.5 * speed / RATE
    period = 1.0 + phase[:, 2]
    s = np.mod(t[:, None] + period * phase[:, 0], period)
    pos[:, :, 2] = 0.05 + 4.9 * s * (period - s)
    vel[:, :, 2] = 4.9 * (period - 2 * s)
    quat = np.zeros((len(t), BODIES, 4))
    quat[:, :, 0] = 1.0
    touching = ((np.minimum(s, period - s) < 1.5 / RATE) | at_wall).astype(float)
    return {
        "t": t, "pos": pos, "quat": quat, "linvel": vel, "angvel": np.zeros_like(pos),
        "ncon": touching.sum(axis=1), "contact_force_sum": 20 * touching,
        "energy": np.stack([4.9 * pos[:, :, 2].sum(axis=1), (vel**2).sum(axis=(1, 2)) / 4], axis=1),
    }  # fmt: skip


def main() -> int:
    """Measure and print."""
    arrays = motion()
    names = tuple(f"b{k}" for k in range(BODIES))
    passes = []
    for _ in range(5):
        began = time.perf_counter()
        for array in arrays.values():
            np.isfinite(array)
        passes.append(time.perf_counter() - began)
    base = sorted(passes)[2]
    figures = []
    half = np.full((BODIES, 3), 0.05)
    turn = np.tile((1.0, 0.0, 0.0, 0.0), (BODIES, 1))
    facts = Mechanics(
        mass=np.full(BODIES, 0.5), com=np.zeros((BODIES, 3)), inertia=np.full((BODIES, 3), 5e-4), inertia_quat=turn,
        center=np.zeros((BODIES, 3)), half_extents=half, dynamic=np.ones(BODIES, bool), free=np.ones(BODIES, bool),
        mocap=np.zeros(BODIES, bool), parent=np.full(BODIES, -1), ground_z=0.0, gravity=np.array([0, 0, -9.8]),
        unforced=np.ones(BODIES, bool), geom_names=names, geom_body=np.arange(BODIES), geom_half_extents=half,
        geom_type=("sphere",) * BODIES, geom_pos=np.zeros((BODIES, 3)), geom_quat=turn,
        geom_collides=np.ones(BODIES, bool), geom_friction=np.full(BODIES, 0.5),
    )  # fmt: skip
    for title, mechanics in (("poses alone", Mechanics()), ("with a model", facts)):
        trajectory = Trajectory(names=names, mechanics=mechanics, **arrays)
        began = time.perf_counter()
        scanned = engine.scan(trajectory)
        taken = time.perf_counter() - began
        figures.append(Figure(f"scan / isfinite, {title}", taken / base, GOAL))
        looked = sum(check.status != "skipped" for check in scanned.checks)
        print(f"{title}: {looked} checks in {taken:.2f} s = {taken / base:.1f} x isfinite ({base * 1000:.0f} ms)")
        if "-v" in sys.argv:
            for entry in engine.CHECKS.values():
                began = time.perf_counter()
                run, _ = engine.run_check(entry, trajectory, engine.Context())
                print(f"    {entry.name:28} {(time.perf_counter() - began) / base:6.2f}  {run.status}")
    return report(*figures)


if __name__ == "__main__":
    sys.exit(main())
