"""A body is where none of its joints can put it.

What it means: its pose was written, edited or taken from another body; a fixed part drifts; its quaternion is in another
order; its unit is not the other bodies'; or the model beside the recording is not the one that was recorded.

Formula: from the recorded pose of the parent, the joints of the model are fitted to the recorded pose of the body; left over
are a distance and an angle. The velocities alike: what the body's velocity against its parent has that no joint allows.
Threshold: 0.03 of the bounding radius (and 1e-5 of the way from the origin), or 0.03 rad, in two rows; blocking from three
times that. For velocities 0.3 sqrt(g r) in a tenth of a second: a warning.
Source: Featherstone, Rigid Body Dynamics Algorithms, chapter 4 (motion subspaces).
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import modelled
from ...predicting.joint_coordinates import fitted
from ..sign import Case, Context, Sign, spans

CODE = "WS135"
NEEDS = ("model",)
SHARE, ANGLE, SLIP, SLIP_S = 0.03, 0.03, 0.3, 0.1


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body's first stretch off its joints."""
    found = fitted(trajectory)
    most = max(2, round(SLIP_S / max(trajectory.interval_s, 1e-9)))
    for b, name in enumerate(trajectory.names):
        limit = SHARE * trajectory.size_m[b] + 1e-5 * float(np.abs(trajectory.pos[:, b]).max())
        share = np.maximum(found.gap_m[:, b] / limit, found.gap_rad[:, b] / ANGLE)
        off = [(a, z) for a, z in spans(share > 1, bridge=2) if z - a >= min(2, len(share))]
        if off:
            start, stop = max(off, key=lambda pair: share[pair[0] : pair[1]].max())
            worst = int(start + np.argmax(share[start:stop]))
            message = (
                f"{name} is {found.gap_m[worst, b]:.3g} m and {found.gap_rad[worst, b]:.3g} rad away from where its "
                "joints can put it on its parent"
            )
            severity = "blocking" if share[worst] > 3 else "warn"
            window = (trajectory.t[start], trajectory.t[stop - 1])
            yield Sign(name, window, float(share[worst]), 1.0, "of the limit", severity, message)
            continue
        slipping = [(a, z) for a, z in spans(found.slip[:, b] > SLIP * trajectory.speed_scale[b]) if z - a >= most]
        if slipping:
            start, stop = max(slipping, key=lambda pair: pair[1] - pair[0])
            fast = float(found.slip[start:stop, b].max())
            message = f"{name} moves at {fast:.3g} m/s against its parent in a way that none of its joints allows"
            window = (trajectory.t[start], trajectory.t[stop - 1])
            yield Sign(name, window, fast, SLIP * trajectory.speed_scale[b], "m/s", "warn", message)


@cache
def _pendulum() -> Trajectory:
    bob = (
        '<body name="arm" pos="0 0 2"><joint axis="0 1 0" ref="0"/><geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/>'
        '<body name="bob" pos="0.5 0 0"><joint type="ball"/><geom size="0.08" pos="0.2 0 0"/></body></body>'
    )
    return modelled.run(modelled.scene(bob, modelled.box("crate", "1 0 0.1")), 1.0)


def _drifting() -> Case:
    made = _pendulum()
    pos = made.pos.copy()
    pos[30:, 1, 1] += 0.05
    return Case("a bob beside its joint", replace(made, pos=pos), severity="blocking")


GOOD = (lambda: Case("a double pendulum", _pendulum()),)
BAD = (_drifting,)
