"""Textbook cases of what the suite simulates: what the book says, what comes out, and the error that is allowed.

`python tests/validation/textbook.py` prints the table of the README; `make test-validation` holds each case to its bound.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

if __name__ == "__main__":
    sys.path[:0] = [str(Path(__file__).parents[1]), str(Path(__file__).parents[2] / "servers")]

import mujoco
import numpy as np
from scipy.special import jnp_zeros, jv

from validation import flowing
from worldengine.solvers import water
from worldengine.waves.body_of_water import Liquid, Water
from worldengine.waves.hull_samples import Hulls
from worldengine.waves.wet_grid import WetGrid
from worldkit.skins import Gas, Skin, Wall, ball

GRAVITY = 9.81
TUB = '<geom name="tub" type="box" size="{0} {0} 0.15" pos="0 0 0.15" contype="0" conaffinity="0"/>'


class Case(NamedTuple):
    """One case: its error is the relative one, or what its words say."""

    says: str
    source: str
    error: Callable[[], float]
    bound: float


def ran(
    body: str, seconds: float, side: float = 0.3, step: float = 0.004
) -> "tuple[water.Pool, mujoco.MjData, np.ndarray]":
    """A body in a tub of water, 0.3 m deep; the pool, the state at the end, and rows of (energy of all, volume, height, force)."""
    world = f'<mujoco><option timestep="{step}"><flag energy="enable"/></option><worldbody>{TUB.format(side)}{body}</worldbody></mujoco>'
    model = mujoco.MjModel.from_xml_string(world)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    pool = water.start(model, data, [1], {"density": 1000.0, "level": 0.3}, "tub")
    told = {column.name: array for column, array in pool.channels.items()}
    rows = []
    for _ in range(round(seconds / step)):
        mujoco.mj_step1(model, data)
        data.xfrc_applied[1] = pool.look(data)[0]
        rows.append(
            (float(told["energy"]) + data.energy.sum(), told["volume"], data.xipos[1, 2], data.xfrc_applied[1, 2])
        )
        mujoco.mj_step2(model, data)
        data.xfrc_applied[1] = 0.0
        pool.advance(step)
    return pool, data, np.array(rows, float)


def sphere_afloat() -> float:
    """Depth of a sphere half as dense as water, dropped from 1 cm above where it floats; its last half second on the mean."""
    pool, _, rows = ran(
        '<body name="a" pos="0 0 0.31"><freejoint/><geom type="sphere" size="0.05" density="500"/></body>', 3.0
    )
    level = pool.water.level + pool.water.swell / pool.water.grid.area
    return abs(float(rows[-125:, 2].mean()) - level) / 0.05


def cylinder_afloat() -> float:
    """Draught of an upright cylinder, broad enough not to lean: its density over water's, times its height."""
    body = '<body name="a" pos="0 0 0.32"><freejoint/><geom type="cylinder" size="0.08 0.03" density="300"/></body>'
    pool, _, rows = ran(body, 3.0)
    level = pool.water.level + pool.water.swell / pool.water.grid.area
    draught = level - (float(rows[-125:, 2].mean()) - 0.03)
    return abs(draught / (0.3 * 0.06) - 1)


def frequency(
    outline: "np.ndarray", shape: "Callable[[np.ndarray], np.ndarray]", k: float, depth: float, cell: float
) -> float:
    """The relative error of a standing wave's omega against sqrt(g k tanh(k h)), by its phase after some periods."""
    grid = WetGrid(outline, cell)
    model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><geom size="0.01"/></body></worldbody></mujoco>')
    liquid = Liquid(1000.0, viscosity=1e-9, tension=0.0)
    pool = Water(grid, 0.0, depth, liquid, Hulls(model, [1]), GRAVITY)
    omega = np.sqrt(GRAVITY * k * np.tanh(k * depth))
    wave = shape(grid.middle)
    pool.height[:] = pool.waves.shares((wave * grid.areas)[None])[0]
    felt = pool.weigh(np.full((len(pool.hulls.volume), 3), (0.0, 0.0, 9.0)))
    times, heights, step = [], [], 2 * np.pi / omega / 24
    for n in range(24 * 6):
        times.append(n * step)
        heights.append(float((pool.surface() * wave * grid.areas).sum()))
        pool.advance(felt, step)
    t, y = np.array(times), np.array(heights)
    up = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    cross = t[up] - y[up] * step / (y[up + 1] - y[up])
    found = 2 * np.pi * (len(cross) - 1) / (cross[-1] - cross[0])
    return abs(float(found / omega) - 1)


def sloshing() -> float:
    """The first sloshing of a tank 0.6 m long and 0.1 m deep."""
    k = np.pi / 0.6
    box = np.array([[0, 0], [0.6, 0], [0.6, 0.2], [0, 0.2]])
    return frequency(box, lambda at: np.cos(k * at[:, 0]), k, 0.1, 0.01)


def deep_ripples() -> float:
    """Short waves on deep water: 8 of them across a tank."""
    k = 16 * np.pi / 0.6
    box = np.array([[0, 0], [0.6, 0], [0.6, 0.2], [0, 0.2]])
    return frequency(box, lambda at: np.cos(k * at[:, 0]), k, 0.3, 0.005)


def in_a_glass(round_it: int, rings: int) -> float:
    """Sloshing of a round glass of 35 mm radius (Lamb, section 191): a Bessel function, zero slope at the wall."""
    turn = 2 * np.pi * np.arange(128) / 128
    k = float(jnp_zeros(round_it, rings)[-1] / 0.035)
    glass = 0.035 * np.column_stack([np.cos(turn), np.sin(turn)])

    def shape(at: "np.ndarray") -> "np.ndarray":
        return jv(round_it, k * np.hypot(*at.T)) * np.cos(round_it * np.arctan2(at[:, 1], at[:, 0]))

    return frequency(glass, shape, k, 0.06, 0.002)


FALLS = '<body name="a" pos="0.03 -0.02 0.45"><freejoint/><geom type="sphere" size="0.03" density="{}"/></body>'


def volume_kept() -> float:
    """What a falling ball splashes, displaces and leaves, over the water's own volume."""
    pool, _, rows = ran(FALLS.format(600), 1.0)
    return float(np.abs(rows[:, 1]).max()) / (pool.water.grid.area * pool.water.depth)


def energy_falls() -> float:
    """The largest rise of the energy of ball, waves and drops above an earlier value, over what the ball brings along."""
    _, _, rows = ran(FALLS.format(600), 1.5, step=0.002)
    brings = 600 * 4 / 3 * np.pi * 0.03**3 * GRAVITY * 0.15
    return float((rows[:, 0] - np.minimum.accumulate(rows[:, 0])).max()) / brings


def released() -> float:
    """How a light ball sets off under water, against (rho - rho_b) g / (rho_b + rho / 2): it moves half of its water, too."""
    body = '<body name="a" pos="0 0 0.12"><freejoint/><geom type="sphere" size="0.03" density="100"/></body>'
    _, data, _ = ran(body, 0.016, step=0.002)
    return abs(float(data.qvel[2]) / 0.016 / (900 * GRAVITY / (100 + 500)) - 1)


def sinking() -> float:
    """The speed at which a ball sinks, against that where drag, 0.47 rho/2 A v^2, carries its weight in water."""
    body = '<body name="a" pos="0 0 0.25"><freejoint/><geom type="sphere" size="0.004" density="1200"/></body>'
    _, data, _ = ran(body, 0.9)
    return abs(-float(data.qvel[2]) / np.sqrt(200 * 4 / 3 * 0.004 * GRAVITY * 2 / (1000 * 0.47)) - 1)


def settled(skin: Skin, steps: int) -> Skin:
    """A skin in empty space, after so many steps of 10 ms."""
    model = mujoco.MjModel.from_xml_string('<mujoco><option gravity="0 0 0"/></mujoco>')
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    skin.start(model, data)
    for _ in range(steps):
        skin.step(model, data, 0.01)
    return skin


def balloon() -> float:
    """The overpressure of a balloon twice its size, against 2 mu t / r0 (1 / a - 1 / a^7), a the stretch that it comes to from 1.5."""
    wall = Wall(young=9e5, thickness=3e-4, density=950.0, rubber=True, stretched=1.5, damping=0.01)
    skin = settled(Skin(ball(0.1), wall, Gas(pressure=2.41e5)), 25)
    grown = 1.5 * float(np.cbrt(skin.room / (4 / 3 * np.pi * 0.1**3)))
    book = 2 * 3e5 * 3e-4 / (0.1 / 1.5) * (1 / grown - grown**-7)
    return abs((skin.pressure - skin.gas.outside) / book - 1)


def cooling() -> float:
    """The room of gas in a slack skin after the time that cooling takes: V / V0 = T / T0, T = T1 + (T0 - T1) / e."""
    wall = Wall(young=2e3, thickness=1e-4, density=950.0, rubber=True)
    skin = Skin(ball(0.1, finer=2), wall, Gas(warm=350.0, around=250.0, takes=0.3))
    room = skin.room
    settled(skin, 30)
    return abs(skin.room / room / ((250 + 100 / np.e) / 350) - 1)


CASES = (
    Case("A sphere half as dense as water floats half under", "Archimedes, On Floating Bodies, I.5", sphere_afloat, 0.02),
    Case("An upright cylinder draws its share of its height", "Archimedes, On Floating Bodies, I.5", cylinder_afloat, 0.02),
    Case("The first sloshing of a tank", "Lamb, Hydrodynamics, section 228", sloshing, 0.002),
    Case("Waves of 75 mm on deep water", "Lamb, Hydrodynamics, section 229", deep_ripples, 0.002),
    Case("A round glass sloshes to and fro", "Lamb, Hydrodynamics, section 191", lambda: in_a_glass(1, 1), 0.01),
    Case("A round glass sloshes in rings", "Lamb, Hydrodynamics, section 191", lambda: in_a_glass(0, 2), 0.01),
    Case("Water keeps its volume through a splash", "continuity", volume_kept, 1e-12),
    Case("Energy only falls without wind", "Lamb, Hydrodynamics, section 11", energy_falls, 0.01),
    Case("A light ball let go under water takes half of its water along", "Lamb, Hydrodynamics, section 92", released, 0.03),
    Case("A ball sinks as fast as drag lets it", "Hoerner, Fluid-Dynamic Drag, section 3-8", sinking, 0.03),
    Case("A balloon twice its size has the pressure of its rubber", "Müller and Strehlow, Rubber and Rubber Balloons, chapter 3", balloon, 0.01),
    Case("Gas that cools in a slack skin shrinks with its temperature", "Newton 1701; p V = n R T", cooling, 0.005),
    Case("Pressure in a tank grows with depth", "Batchelor, An Introduction to Fluid Dynamics, section 1.4", flowing.hydrostatics, 0.08),
    Case("The front of a dam that breaks", "Martin and Moyce 1952", flowing.dam_break, 0.08),
    Case("A stream falls as fast as anything", "Torricelli 1643", flowing.stream, 0.01),
    Case("A viscous drop spreads on a floor as its eighth root of time", "Huppert 1982", flowing.spreading, 0.03),
    Case("Sand that is poured lies at its friction angle", "Coulomb 1773", flowing.repose, 0.2),
    Case("A low column of sand runs out", "Lube et al. 2004", flowing.low_column, 0.3),
    Case("A high column of sand runs out", "Lube et al. 2004", flowing.high_column, 0.2),
    Case("Snow lies as high as what fell", "continuity", flowing.snow_layer, 0.15),
)  # fmt: skip


def table() -> str:
    """The rows of the README's table."""
    lines = ["| case | source | error reached | allowed |", "|---|---|---|---|"]
    lines += [f"| {case.says} | {case.source} | {case.error():.1g} | {case.bound:g} |" for case in CASES]
    return "\n".join(lines)


if __name__ == "__main__":
    print(table())
