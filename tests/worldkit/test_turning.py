import mujoco
import numpy as np
import pytest

from worldkit import turning

RNG = np.random.default_rng(5)


def some(count=200):
    quat = RNG.normal(size=(count, 4))
    return quat / np.linalg.norm(quat, axis=1)[:, None]


def engine(name, size, *given):
    """What one of the engine's own functions makes of one quaternion at a time."""
    rows = []
    for row in zip(*given, strict=True):
        out = np.zeros(size)
        getattr(mujoco, name)(out, *row)
        rows.append(out)
    return np.array(rows)


def test_all_is_as_the_engine_has_it():
    one, other, vectors = some(), some(), RNG.normal(size=(200, 3))
    assert np.allclose(turning.matrices(one).reshape(-1, 9), engine("mju_quat2Mat", 9, one), atol=1e-15)
    assert np.allclose(turning.product(one, other), engine("mju_mulQuat", 4, one, other), atol=1e-15)
    assert np.allclose(turning.conjugate(one), engine("mju_negQuat", 4, one))
    assert np.allclose(turning.turned(one, vectors), engine("mju_rotVecQuat", 3, vectors, one), atol=1e-14)
    assert np.allclose(turning.rotation_vectors(one), engine("mju_quat2Vel", 3, one, np.ones(200)), atol=1e-14)
    found = np.array([turning.quaternion(matrix) for matrix in turning.matrices(one)])
    assert np.allclose(np.abs((found * one).sum(axis=1)), 1.0, atol=1e-14)


def test_a_turn_about_an_axis_is_its_rotation_vector():
    axis, angle = np.array([0.6, 0.0, -0.8]), np.linspace(-3.1, 3.1, 63)
    assert np.allclose(turning.rotation_vectors(turning.about(axis, angle)), angle[:, None] * axis, atol=1e-14)
    assert turning.about((0.0, 0.0, 1.0), np.pi / 2) == pytest.approx([0.5**0.5, 0, 0, 0.5**0.5])


@pytest.mark.parametrize("angle", [0.0, 1e-12, 1e-8, 1e-3, 1.0, 3.0, np.pi])
def test_the_angle_between_two_orientations_keeps_small_ones(angle):
    start = some(50)
    then = turning.product(turning.about((0.0, 1.0, 0.0), angle), start)
    assert np.allclose(turning.angles_between(start, then), angle, rtol=1e-6, atol=1e-15)
    assert np.allclose(turning.angles_between(-3 * start, 2 * then), angle, rtol=1e-6, atol=2e-15), "sign and length"


def test_an_orientation_without_length_is_half_a_turn_from_any_other():
    assert turning.angles_between(np.zeros(4), some(1)).tolist() == [np.pi]
    assert np.isnan(turning.angles_between(np.full(4, np.nan), some(1))).all()
