"""The laws of fields: forces are slopes of the energy, both feel the same, and what a brake takes it warms."""

import os
import subprocess
import sys

import mujoco
import numpy as np
import pytest

from worldkit.errors import ProgramError
from worldkit.fields import coulomb, eddies, expansion, filaments, lumped_heat, magnetism
from worldkit.turning import matrices

BAR = filaments.bar(0.01, 0.01, 0.03, 1.2)
DISC = filaments.cylinder(0.006, 0.004, 1.3)
UP = np.eye(3)
ASLANT = matrices(np.array([0.8, 0.4, -0.2, 0.4]))
BALLS = np.array([[0.004, 0.002, 0.03], [-0.015, 0.0, 0.02]])
VOLUME, SATURATION = np.array([4.2e-6, 5e-7]), np.array([2.0, 0.3])
"""The second is saturated."""


def placed(magnet: filaments.Filaments, at: tuple[float, float, float], turn: np.ndarray = UP) -> filaments.Filaments:
    return magnet._replace(at=magnet.at @ turn.T + at, current=magnet.current @ turn.T)


def turned(angle: float) -> np.ndarray:
    """About x."""
    return np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])


def test_two_magnets_push_each_other_by_the_slope_of_one_energy() -> None:
    here, way = placed(BAR, (0, 0, 0)), (0.01, 0.004, 0.03)
    felt = magnetism.between(here, placed(DISC, way, ASLANT))
    count, step = len(BAR.at), 1e-6
    slope = [
        (
            magnetism.between(here, placed(DISC, tuple(way + step * axis), ASLANT)).energy
            - magnetism.between(here, placed(DISC, tuple(way - step * axis), ASLANT)).energy
        )
        / (2 * step)
        for axis in np.eye(3)
    ]
    assert felt.currents[count:].sum(axis=0) == pytest.approx(-np.array(slope), rel=1e-5, abs=1e-9)
    assert np.abs(felt.currents.sum(axis=0)).max() < 1e-12 * np.abs(felt.currents).sum()
    arms = np.cross(np.concatenate([here.at, placed(DISC, way, ASLANT).at]), felt.currents)
    assert np.abs((arms + felt.turned).sum(axis=0)).max() < 1e-12 * np.abs(felt.currents).sum()
    other = placed(DISC, way, ASLANT)
    torque = (np.cross(other.at - way, felt.currents[count:]) + felt.turned[count:]).sum(axis=0)
    about_x = [magnetism.between(here, placed(DISC, way, turned(a) @ ASLANT)).energy for a in (1e-5, -1e-5)]
    assert torque[0] == pytest.approx(-(about_x[0] - about_x[1]) / 2e-5, rel=1e-5)


def test_soft_balls_saturated_or_not_and_a_magnet_push_each_other_by_the_slope_of_one_energy() -> None:
    uniform = np.array([0.01, 0.0, -0.02])

    def energy(balls: np.ndarray) -> float:
        return magnetism.on_balls(BAR, balls, VOLUME, SATURATION, uniform).energy

    felt, step = magnetism.on_balls(BAR, BALLS, VOLUME, SATURATION, uniform), 1e-6
    for ball, axis in np.ndindex(BALLS.shape):
        there = np.zeros_like(BALLS)
        there[ball, axis] = step
        slope = (energy(BALLS + there) - energy(BALLS - there)) / (2 * step)
        assert felt.balls[ball, axis] == pytest.approx(-slope, rel=1e-5, abs=1e-8)
    assert np.abs(felt.currents.sum(axis=0) + felt.balls.sum(axis=0)).max() < 1e-12 * np.abs(felt.currents).sum()
    moment, _ = magnetism.magnetised(np.array([[0.0, 0.0, 0.2]]), VOLUME[1:], SATURATION[1:])
    assert moment[0, 2] == pytest.approx(VOLUME[1] * 0.3 / 1.25663706e-6), "no more than its saturation"


def test_magnets_that_touch_face_to_face_hold_on() -> None:
    """As much as the book says of two magnetised faces, B_r^2 A / (2 mu0) less what the far faces push: within 6 %."""
    disc = filaments.cylinder(0.006, 0.012, 1.3)
    felt = magnetism.between(disc, placed(disc, (0, 0, 0.012)))
    assert felt.currents[: len(disc.at)].sum(axis=0)[2] == pytest.approx(64.0, rel=0.06)
    assert magnetism.between(disc, placed(disc, (0, 0, 0.0119))).currents[: len(disc.at)].sum(axis=0)[2] > 50, "deeper"


@pytest.mark.parametrize("net", [eddies.tube(0.008, 0.01, 0.06, 5.8e7), eddies.plate(0.06, 0.05, 0.001, 5.8e7)])
def test_a_brake_warms_what_it_takes(net: eddies.Net) -> None:
    field = filaments.field(net.at, placed(DISC, (0.001, 0, 0.006)))
    speed = np.array([0.1, 0.0, 0.2])
    driven = np.einsum("ej,ej->e", np.cross(-speed, field), net.along)
    current = net.currents(driven)
    force = -np.cross(current[:, None] * net.along, field).sum(axis=0)
    assert force @ speed < 0, "it brakes"
    assert float(current @ driven) == pytest.approx(-float(force @ speed), rel=1e-12)


def test_currents_of_a_plate_flow_into_no_corner() -> None:
    """Kirchhoff: what comes to each corner goes from it; where the field is even, nothing flows at all."""
    net = eddies.plate(0.04, 0.03, 0.001, 5.8e7)
    current = net.currents(np.random.default_rng(0).normal(size=len(net.at)))
    ends = np.round(np.concatenate([net.at + net.along / 2, net.at - net.along / 2]), 9)
    _, corner = np.unique(ends, axis=0, return_inverse=True)
    assert np.abs(np.bincount(corner, np.concatenate([current, -current]))).max() < 1e-9 * np.abs(current).max()
    even = np.cross([0.3, 0.1, 0.0], [0.0, 0.0, 0.5])
    assert np.abs(net.currents(net.along @ even)).max() < 1e-9 * np.abs(current).max()


def test_far_from_a_magnet_a_tube_is_left_out_ring_by_ring() -> None:
    net = eddies.tube(0.008, 0.01, 0.2, 5.8e7)
    near = net.near([(np.array([0.0, 0.0, 0.09]), 0.005)], 0.025)
    assert 0 < len(near.at) < len(net.at) and near.at[:, 2].min() > 0.06
    assert len(near.conducts) * eddies.AROUND == len(near.at)


def test_charges_push_each_other_alike() -> None:
    at, charge = np.array([[0, 0, 0], [0.1, 0, 0], [0, 0.2, 0.0]]), np.array([1e-6, -2e-6, 3e-6])
    forces, energy = coulomb.felt(at, charge, np.zeros(3))
    assert forces.sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-15)
    assert forces[0, 0] > 0 > forces[1, 0], "unlike ones attract"
    assert energy < 0
    assert coulomb.felt(at, charge, np.array([0, 0, 5.0]))[0][:, 2] == pytest.approx(5.0 * charge)


def test_two_charges_at_one_place_are_pushed_nowhere_and_near_it_by_the_slope_of_one_energy() -> None:
    charge, core = np.array([1e-9, -2e-9]), coulomb.CORE_M

    def felt(apart: float) -> tuple[np.ndarray, float]:
        return coulomb.felt(np.array([[0.0, 0, 0], [apart, 0, 0]]), charge, np.zeros(3))

    assert not felt(0.0)[0].any() and np.isfinite(felt(0.0)[1])
    for apart in (0.3 * core, 0.9 * core, core, 1.1 * core):
        step = 1e-5 * core
        slope = (felt(apart + step)[1] - felt(apart - step)[1]) / (2 * step)
        assert felt(apart)[0][1, 0] == pytest.approx(-slope, rel=1e-4)
    assert felt(0.9 * core)[0][1, 0] == pytest.approx(0.9 * felt(core)[0][1, 0]), "as inside an even ball"


LAST_DIGITS = """
import numpy as np
from worldkit.fields import eddies, lumped_heat
n, rng = 150, np.random.default_rng(0)
touching = rng.random((n, n)) * (rng.random((n, n)) < 0.1)
warmth = lumped_heat.Warmth(300 + rng.random(n), 100 + rng.random(n), rng.random(n), 290.0, np.zeros(n), np.full(n, np.inf), np.zeros(n))
warmth.advance(1.0, touching + touching.T)
print(eddies.plate(0.06, 0.05, 0.001, 5.8e7).conducts.tobytes().hex()[:4096], warmth.temperature.tobytes().hex(), warmth.lost.hex())
"""


def test_the_last_digits_of_currents_and_temperatures_depend_on_no_number_of_threads() -> None:
    told = {
        subprocess.run(
            [sys.executable, "-c", LAST_DIGITS],
            env={**os.environ, "OPENBLAS_NUM_THREADS": threads, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))},
            capture_output=True,
            check=True,
        ).stdout
        for threads in ("1", "2")
    }
    assert len(told) == 1


def test_heat_goes_nowhere_and_ice_melts_at_one_temperature() -> None:
    """A hot plate, ice on it, air around both: what the sources made is stored or lost, also while it melts and when it freezes again."""
    warmth = lumped_heat.Warmth(
        temperature=np.array([350.0, 260.0]), capacity=np.array([500.0, 40.0]), loss=np.array([0.5, 0.1]), around=250.0,
        source=np.array([30.0, 0.0]), melts=np.array([np.inf, 273.15]), latent=np.array([0.0, 6000.0]),
    )  # fmt: skip
    touching, begins, seen = np.array([[0.0, 4.0], [4.0, 0.0]]), warmth.stored, []
    for seconds in range(400):
        if seconds == 200:
            warmth.source[:] = 0.0
        warmth.advance(1.0, touching)
        seen.append((warmth.temperature[1], warmth.melted[1]))
        assert warmth.stored + warmth.lost - warmth.made == pytest.approx(begins, rel=1e-12)
    warm, melted = np.array(seen).T
    between = (melted > 0) & (melted < 1)
    assert between.sum() > 20 and np.abs(warm[between] - 273.15).max() < 1e-9
    assert melted.max() == 1.0 and warm.max() > 280


RING = """<mujoco><worldbody><body name="a"><freejoint/><geom type="box" size=".1 .02 .01" pos=".1 0 0" mass="1"/>
  <geom type="sphere" size=".03" pos="-.1 0 0" mass="1"/><geom type="sphere" size=".5" contype="0" conaffinity="0" mass="0"/></body>
  <body name="b" pos="0 0 3"><freejoint/><geom type="mesh" mesh="m" mass="1"/></body>
  <body name="c" pos="0 0 6"><freejoint/><geom type="sphere" size=".5" contype="0" conaffinity="0"/></body></worldbody>
  <asset><mesh name="m" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset></mujoco>"""


def test_a_body_of_several_shapes_grows_about_its_middle_and_back() -> None:
    model = mujoco.MjModel.from_xml_string(RING)
    size, place, reach = model.geom_size.copy(), model.geom_pos.copy(), model.geom_rbound.copy()
    grown = expansion.Grown(model, [1, 2], np.array([2e-5, 0.0]), ["world", "a", "b"])
    assert grown.follow(np.array([500.0, 500.0])) == pytest.approx([0.01, 0.0])
    assert model.geom_size[:2] == pytest.approx(1.01 * size[:2]) and model.geom_rbound[:2] == pytest.approx(
        1.01 * reach[:2]
    )
    middle = model.body_ipos[1]
    assert model.geom_pos[:2] - middle == pytest.approx(1.01 * (place[:2] - middle))
    assert (model.geom_size[2:] == size[2:]).all(), "what only shows, and what does not grow, stays"
    grown.follow(np.zeros(2))
    assert (model.geom_size == size).all() and model.geom_pos == pytest.approx(place)


def test_two_bodies_of_several_shapes_meet_where_they_have_grown() -> None:
    """Before, the boxes around a body's shapes stayed as they were, and a rod of several parts went through what it met."""
    rod = "".join(f'<geom type="box" size=".25 .02 .02" pos="{x} 0 0"/>' for x in (-0.75, -0.25, 0.25, 0.75))
    wall = "".join(f'<geom type="box" size=".1 .1 .02" pos="1.105 0 {z}"/>' for z in (0, 0.1))
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody><body><freejoint/>{rod}</body><body><freejoint/>{wall}</body></worldbody></mujoco>"
    )
    grown, data = expansion.Grown(model, [1, 2], np.array([2e-5, 0.0]), ["world", "rod", "wall"]), mujoco.MjData(model)
    for warmer, touching in ((0.0, 0), (500.0, 4), (0.0, 0)):
        grown.follow(np.array([warmer, 0.0]))
        mujoco.mj_forward(model, data)
        assert data.ncon == touching


@pytest.mark.parametrize(
    ("share", "warmer", "said"),
    [
        ((0, 1e-5), 1.0, "mesh"),
        ((-1e-5, 0), 1.0, "its expansion is -1e-05"),
        ((0, 0, -1e-5), 1.0, "'c' cannot grow"),
        ((0, 0, float("nan")), 1.0, "'c' cannot grow"),
        ((1e-4, 0), 400.0, "0.04"),
    ],
)
def test_what_cannot_grow_or_grows_too_far_is_refused(share: tuple[float, ...], warmer: float, said: str) -> None:
    model = mujoco.MjModel.from_xml_string(RING)
    bodies, called = [1, 2, 3][: len(share)], ["world", "a", "b", "c"]
    with pytest.raises(ProgramError, match=said):
        expansion.Grown(model, bodies, np.array(share), called).follow(np.full(len(share), warmer))
