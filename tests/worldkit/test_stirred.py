"""A stirred liquid against closed forms: the paraboloid of a rigid rotation, waves of a long basin, spin-down by Ekman's layer, and
what is kept: volume, angular momentum with a tool, energy, mass with a drain."""

from itertools import pairwise

import mujoco
import numpy as np
import pytest

from worldkit import materials, moved_shapes
from worldkit.errors import ProgramError
from worldkit.matter import Stirred, Vessel

GLASS = Vessel([(0, 0.0), (0.04, 0.0), (0.04, 0.12)])
G = 9.81


class Water(Stirred):
    name, bodies, shown_by = "water", ("world",), "water"


class Spooned(Stirred):
    name, bodies, shown_by = "water", ("spoon", "world"), "water"


def world(text: str = "") -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option timestep="0.004" integrator="implicitfast"/>{text or "<worldbody/>"}</mujoco>'
    )
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def run(law: Stirred, seconds: float, each: float = 0.004) -> None:
    model, data = world()
    law.start(model, data)
    for _ in range(round(seconds / each)):
        law.step(model, data, each)


SPOON = """<worldbody><body name="spoon"><joint name="a" axis="0 0 1"/>
<geom type="box" size="0.012 0.003 0.02" pos="0.02 0 0.04" mass="0.02"/></body></worldbody>
<actuator><velocity joint="a" kv="0.004"/></actuator>"""


def test_a_rigid_rotation_is_a_paraboloid_and_stays_one() -> None:
    law = Water(GLASS, 0.065, spin=12.0, rough=0.0, viscosity=1e-12)
    begins, energy = law.volume(), law.angular_momentum()
    run(law, 0.4)
    far = (np.arange(law.grid.rows) + 0.5) * law.grid.deep
    slope = np.polyfit(far**2, law.depth.mean(axis=1), 1)[0]
    assert slope == pytest.approx(12.0**2 / (2 * G), rel=0.03)
    assert law.volume() == pytest.approx(begins, rel=1e-9)
    assert law.angular_momentum() == pytest.approx(energy, rel=1e-3)


def test_a_long_basin_sways_at_the_speed_of_long_waves() -> None:
    law = Water(
        Vessel([(0, 0.0), (0, 0.2)], sides=(1.0, 0.3)), 0.05, rough=0.0, viscosity=1e-12, calms=None, foam=4, motes=2
    )
    x = np.linspace(0, 1, law.grid.rows + 1)
    law.depth = law.depth + 0.002 * np.cos(np.pi * (x[1:] + x[:-1]) / 2)[:, None]
    model, data = world()
    law.start(model, data)
    heights = []
    for _ in range(400):
        law.step(model, data, 0.01)
        heights.append(law.depth[0].mean() - 0.05)
    falls = [n + a / (a - b) for n, (a, b) in enumerate(pairwise(heights)) if a > 0 >= b]
    assert 0.01 * np.diff(falls).mean() == pytest.approx(2.0 / np.sqrt(G * 0.05), rel=0.01)


def test_it_spins_down_as_ekman_says() -> None:
    """dw/dt = -sqrt(nu w) w / h, where nothing rubs but the floor's laminar layer (Greenspan 1968)."""
    law, nu, w, h = Water(GLASS, 0.02, viscosity=0.05, spin=8.0, rough=0.0), 0.05 / 998.0, 8.0, 0.02
    begins = law.angular_momentum()
    run(law, 0.5)
    for _ in range(500):
        w -= 0.001 * np.sqrt(nu * w) * w / h
    assert law.angular_momentum() / begins == pytest.approx(w / 8.0, rel=0.05)
    assert w < 7.0


def test_what_a_spoon_gives_the_water_has_and_the_surface_falls_in_the_middle() -> None:
    model, data = world(SPOON)
    law = Spooned(GLASS, 0.065, rough=0.0, viscosity=1e-12)
    data.ctrl[:] = 24.0
    law.start(model, data)
    begins, given = law.volume(), 0.0
    for n in range(250):
        middle = data.xipos[1].copy()
        found = law.step(model, data, 0.004)
        given -= 0.004 * (found[0, 5] + middle[0] * found[0, 1] - middle[1] * found[0, 0])
        data.xfrc_applied[1] = found[0]
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        if n == 10:
            first = law.angular_momentum()
    assert law.angular_momentum() == pytest.approx(given, rel=0.03)
    assert law.angular_momentum() > 3 * first > 0
    assert law.volume() == pytest.approx(begins, rel=1e-9)
    ring = law.depth.mean(axis=1)
    assert ring[-1] - ring[0] > 0.003
    assert np.ptp(law.points[: len(law._body.places), 2]) > 0.003  # and so it is drawn


def test_all_forces_are_weight_and_the_change_of_momentum() -> None:
    model, data = world(SPOON)
    law = Spooned(GLASS, 0.065)
    data.ctrl[:] = 24.0
    law.start(model, data)
    before = law.mass @ law.velocities
    total = np.zeros(3)
    for _ in range(25):
        found = law.step(model, data, 0.004)
        total += 0.004 * found[:, :3].sum(axis=0)
        data.xfrc_applied[1] = found[0]
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
    weight = law.mass.sum() * np.array(model.opt.gravity) * 0.1
    assert law.mass @ law.velocities - before + total == pytest.approx(weight, abs=1e-9)


def test_energy_only_falls_without_a_tool() -> None:
    law = Water(GLASS, 0.065, spin=10.0)
    law.depth = law.depth + 0.004 * (law._x / 0.04)
    model, data = world()
    law.start(model, data)

    def energy() -> float:
        return law.energy() + 0.5 * law.mass @ (law.velocities**2).sum(axis=1) + G * law.mass @ law.points[:, 2]

    told = []
    for _ in range(100):
        law.step(model, data, 0.004)
        told.append(energy())
    assert max(np.diff(told)) < 0.01 * (told[0] - told[-1])


def test_a_drain_makes_a_whirl_of_slow_turning_and_loses_no_mass() -> None:
    law = Water(Vessel([(0, 0.0), (0.15, 0.0), (0.15, 0.2)]), 0.1, spin=1.0, drain=(0.0, 0.0, 0.02), viscosity=1e-6)
    mass = law.mass.sum()
    run(law, 2.0, 0.01)
    assert law.mass.sum() == pytest.approx(mass, rel=1e-9)
    assert law.drained > 0.05 * mass / 998.0
    far = (np.arange(law.grid.rows) + 0.5) * law.grid.deep
    rate = law.v.mean(axis=1) / far
    assert rate[3] > 3 * rate[-1] > 0  # what flows in turns faster, as its angular momentum is kept
    assert law.depth.mean(axis=1)[0] < law.depth.mean(axis=1)[-1]


def test_a_float_is_borne_and_carried_round() -> None:
    text = '<worldbody><body name="spoon" pos="0.02 0 0.068"><freejoint/><geom type="sphere" size="0.008" density="400"/></body></worldbody>'
    model, data = world(text)
    law = Spooned(GLASS, 0.065, spin=6.0)
    law.start(model, data)
    angle, last = 0.0, 0.0
    for _ in range(250):
        found = law.step(model, data, 0.004)
        data.xfrc_applied[1] = found[0]
        mujoco.mj_step(model, data)
        mujoco.mj_forward(model, data)
        now = float(np.arctan2(data.xpos[1, 1], data.xpos[1, 0]))
        angle, last = angle + (now - last + np.pi) % (2 * np.pi) - np.pi, now
    assert angle > 2.0
    assert 0.055 < data.xpos[1, 2] < 0.075


def test_dye_is_carried_and_mixes() -> None:
    def halves(places: np.ndarray) -> np.ndarray:
        return np.where(places[:, :1] > 0, (0.9, 0.85, 0.8), (0.25, 0.14, 0.08))

    law = Water(GLASS, 0.065, spin=0.0, dye=halves)
    law.v[:] = 0.25 * np.exp(-(((np.arange(law.grid.rows) - 6) / 5.0) ** 2))[:, None]
    begins = law.colours.copy()
    run(law, 0.8)
    drawn = len(law._body.places)
    assert np.abs(law.colours[:drawn] - begins[:drawn]).mean() > 0.1
    assert law.colours.min() >= 0 and law.colours.max() <= 1
    blends = (np.abs(law.colours[:drawn, 0] - 0.575) < 0.2).mean()
    assert blends > 0.04


def test_a_bowl_has_a_hollow_floor_and_what_cannot_be_is_refused() -> None:
    bowl = Vessel([(0, 0.0), (0.05, 0.005), (0.09, 0.03), (0.1, 0.09)])
    law = Water(bowl, 0.06, foam=10, motes=0)
    assert law.depth[0].mean() > law.depth[-1].mean()
    run(law, 0.1)
    assert np.abs(law.u).max() < 1e-3  # at rest over a hollow floor it stays so
    with pytest.raises(ProgramError, match="between the floor"):
        Water(GLASS, 0.2)
    with pytest.raises(ProgramError, match="dry in the middle"):
        Water(GLASS, 0.02, spin=30.0)
    with pytest.raises(ProgramError, match="profile"):
        Vessel([(0, 0.0), (0.04, -0.01)])
    with pytest.raises(ProgramError, match="drain"):
        Water(GLASS, 0.05, drain=(0.2, 0.0, 0.01))


def test_it_is_drawn_closed_and_of_a_clear_look_of_any_colour() -> None:
    law, spec = Water(GLASS, 0.065, foam=6, motes=2), mujoco.MjSpec()
    moved_shapes.surface(spec, "water", law.points, law.triangles, "clear #9fd3e6 45mm")
    model = mujoco.MjModel.from_xml_string((spec.compile(), spec.to_xml())[1])
    name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_MATERIAL, int(model.flex_matid[model.flex_elemadr[0]]))
    assert materials.look(name).clear > 0
    sides = np.concatenate([law.triangles[:, [0, 1]], law.triangles[:, [1, 2]], law.triangles[:, [2, 0]]])
    there = {tuple(side) for side in sides.tolist()}
    assert len(there) == len(sides)
    assert {(b, a) for a, b in there} == there
