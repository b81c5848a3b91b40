"""The survey never rules out what a row shows: its figures against the plain computation over all rows."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.model.recording.trajectory import Trajectory
from worldwright.scan.anomalies import survey as module
from worldwright.scan.anomalies.survey import survey


def wandering(seed: int, rows: int, bodies: int) -> Trajectory:
    """A random motion with jumps, held rows, turns and contacts."""
    rng = np.random.default_rng(seed)
    t = np.cumsum(rng.uniform(0.005, 0.02, rows))
    vel = np.cumsum(rng.normal(0, 0.2, (rows, bodies, 3)), axis=0)
    pos = np.cumsum(vel, axis=0) * 0.01
    pos[rows // 3 :, 0] += rng.normal(0, 2, 3)
    pos[rows // 2 : rows // 2 + 3] = pos[rows // 2]
    quat = np.cumsum(rng.normal(0, 0.2, (rows, bodies, 4)), axis=0) + np.array((3.0, 0, 0, 0))
    quat /= np.sqrt((quat**2).sum(axis=2, keepdims=True))
    force = rng.uniform(-1, 1, (rows, bodies)).clip(0)
    names = [f"b{k}" for k in range(bodies)]
    spin = rng.normal(0, 3, (rows, bodies, 3))
    return Trajectory.from_arrays(t, names, pos, quat=quat, linvel=vel, angvel=spin, contact_force_sum=force)


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(2, 90), st.integers(1, 4), st.sampled_from([40, 200, 16384]))
def test_figures_equal_those_over_all_rows(seed, rows, bodies, cells):
    made = wandering(seed, rows, bodies)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "CELLS", cells)
        look = survey(made)
    dt = np.diff(made.t)[:, None]
    step = np.diff(made.pos, axis=0)
    moved = np.sqrt((step**2).sum(axis=2))
    speed, spin = np.sqrt((made.linvel**2).sum(axis=2)), np.sqrt((made.angvel**2).sum(axis=2))
    assert np.allclose(made.speed, speed) and np.allclose(made.spin, spin)
    assert np.allclose(look.low.min(axis=0), made.pos.min(axis=0))
    assert np.allclose(look.high.max(axis=0), made.pos.max(axis=0))
    assert np.allclose(look.excess.max(axis=0), (moved - np.maximum(speed[1:], speed[:-1]) * dt).max(axis=0))
    near = np.full_like(moved, np.inf)
    near[1:-1] = moved[:-2] + moved[2:]
    assert np.allclose(look.lone.max(axis=0), np.where(moved > 8 * near, moved, 0).max(axis=0))
    assert np.array_equal(look.still.sum(axis=0), (step == 0).all(axis=2).sum(axis=0))
    assert np.array_equal(look.unturned.sum(axis=0), (np.diff(made.quat, axis=0) == 0).all(axis=2).sum(axis=0))
    touching = made.contact_force_sum > 0
    assert np.array_equal(look.touches.sum(axis=0), touching.sum(axis=0))
    assert np.array_equal(look.takeoffs.sum(axis=0), (touching[:-1] & ~touching[1:]).sum(axis=0))
    angle = 2 * np.arccos(np.clip(np.abs((made.quat[1:] * made.quat[:-1]).sum(axis=2)), 0, 1))
    turned = (angle - 1.2 * np.maximum(spin[1:], spin[:-1]) * dt).max(axis=0)
    assert np.all((look.overturn.max(axis=0) >= turned) | (turned < 0.2))
    change = np.sqrt((np.diff(made.linvel, axis=0) ** 2).sum(axis=2))
    apart = ~(touching[1:] | touching[:-1])
    assert np.all(look.weightless.sum(axis=0) >= (apart & (change < 0.05 * 9.80665 * dt)).sum(axis=0))


@settings(max_examples=25, deadline=None)
@given(st.integers(0, 10**6), st.integers(12, 90), st.integers(2, 10))
def test_no_window_goes_further_astray(seed, rows, window):
    made = wandering(seed, rows, 2)
    steps = (made.linvel[1:] + made.linvel[:-1]) / 2 * np.diff(made.t)[:, None, None]
    way = np.concatenate((np.zeros((1, 2, 3)), np.cumsum(steps, axis=0)))
    off = made.pos - way
    gap = np.sqrt(((off[window:] - off[:-window]) ** 2).sum(axis=2)).max(axis=0)
    assert np.all(survey(made).astray_over(window) >= gap - 1e-12)


@pytest.mark.parametrize("rows", [1, 2, 3])
def test_the_shortest_recordings(rows):
    assert survey(wandering(1, rows, 1)).low.shape == (1, 1, 3)
