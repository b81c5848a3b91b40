"""Textbook cases of matter as material points (`worldkit.matter`): liquids, sand, snow; errors are relative ones."""

import mujoco
import numpy as np

from worldkit.matter import Liquid, Matter, Sand, Snow, Source, block, column

GRAVITY = 9.81
FLOOR = '<geom type="plane" size="1 1 1"/>'
MARTIN_MOYCE = ((0.84, 1.22), (1.19, 1.44), (1.43, 1.67), (1.63, 1.89), (1.83, 2.11), (1.98, 2.33), (2.2, 2.56), (2.32, 2.78), (2.51, 3.0))  # fmt: skip
"""Columns twice as high as wide: time in units of sqrt(a / 2 g), and the front in units of a."""


def walls(x: float, y: float) -> str:
    """Four walls around an inside of x by y, m, that begins at the origin's corner in x and is centred in y."""
    boxes = (
        (-0.01, 0, 0.01, 1),
        (x + 0.01, 0, 0.01, 1),
        (x / 2, -y / 2 - 0.01, x, 0.01),
        (x / 2, y / 2 + 0.01, x, 0.01),
    )
    return FLOOR + "".join(f'<geom type="box" pos="{a} {b} 0.3" size="{c} {d} 0.3"/>' for a, b, c, d in boxes)


def stood(world: str) -> "tuple[mujoco.MjModel, mujoco.MjData]":
    """A world in which nothing moves."""
    model = mujoco.MjModel.from_xml_string(f"<mujoco><worldbody>{world}</worldbody></mujoco>")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def let_go(law: Matter, world: str, seconds: float) -> Matter:
    """The law after so many seconds."""
    model, data = stood(world)
    law.start(model, data)
    for _ in range(round(seconds / 0.01)):
        law.step(model, data, 0.01)
    return law


def hydrostatics() -> float:
    """How the pressure in a tank grows with depth, by a line through the points a cell and more from its ends, against rho g."""
    law = Matter(Liquid(1000.0, 2.0, sound=8.0, sticks=False), 0.01, begins=[block((0, -0.04, 0), (0.08, 0.04, 0.16))])
    let_go(law, walls(0.08, 0.08), 0.6)
    pressure, z = law._law[0] * (1 - np.minimum(law._state[:, 0], 1)), law.points[:, 2]
    inside = (z > 0.03) & (z < 0.12)
    return abs(float(-np.polyfit(z[inside], pressure[inside], 1)[0]) / (1000.0 * GRAVITY) - 1)


def dam_break() -> float:
    """The front of a water column that is let go, against what was measured; the mean over nine instants."""
    wide, each = 0.05715, 0.002
    law = Matter(Liquid(1000.0, 0.001), 0.0057, begins=[block((0, -0.014, 0), (wide, 0.014, 2 * wide))])
    model, data = stood(walls(0.4, 0.0285))
    law.start(model, data)
    fronts = [wide]
    for _ in range(80):
        law.step(model, data, each)
        fronts.append(float(np.sort(law.points[:, 0])[-4:].mean()) + law.spacing / 2)
    time = np.arange(len(fronts)) * each / np.sqrt(wide / (2 * GRAVITY))
    t, z = np.array(MARTIN_MOYCE).T
    return float(np.abs(np.interp(t, time, fronts) / wide / z - 1).mean())


def spreading() -> float:
    """How fast a viscous drop spreads on a floor: the growth of its radius from 0.3 to 0.9 s, against t^(1/8)."""
    law = Matter(Liquid(1000.0, 20.0, sound=5.0), 0.008, begins=[column((0, 0, 0), 0.05, 0.03)])
    model, data = stood(FLOOR)
    law.start(model, data)
    radii = []
    for _ in range(90):
        law.step(model, data, 0.01)
        radii.append(float(np.sqrt(2 * (law.points[:, :2] ** 2).sum(axis=1).mean())))
    return abs(radii[89] / radii[29] / 3 ** (1 / 8) - 1)


def stream() -> float:
    """The speed of a thin liquid 0.15 m under its mouth, against sqrt(v^2 + 2 g h)."""
    pour = Source(mass=0.2, at=(0, 0, 0.3), starts=0.0, ends=0.6, radius=0.012)
    law = let_go(Matter(Liquid(1000.0, 0.01, sound=15.0), 0.006, poured=[pour]), FLOOR, 0.25)
    there = np.abs(law.points[:, 2] - 0.15) < 0.01
    v = 0.2 / (1000 * np.pi * 0.012**2 * 0.6)
    return abs(-float(law.velocities[there, 2].mean()) / np.sqrt(v**2 + 2 * GRAVITY * 0.15) - 1)


def repose() -> float:
    """The slope of a poured heap, by its mean height and radius (a cone has tan = 2 z / r), against its friction angle."""
    pour = Source(mass=0.45, at=(0, 0, 0.12), starts=0.0, ends=0.8, radius=0.02)
    law = let_go(Matter(Sand(1600.0, 32.0), 0.008, poured=[pour]), FLOOR, 1.2)
    z, r = law.points[:, 2].mean(), np.hypot(*law.points[:, :2].T).mean()
    return abs(float(np.degrees(np.arctan(2 * z / r))) / 32.0 - 1)


def runout(shape: float) -> float:
    """How far a column of sand runs out, in radii, which is as high as `shape` radii."""
    radius = 0.05 if shape < 1.5 else 0.04
    law = let_go(
        Matter(Sand(1600.0, 30.0, wall_friction=0.3), 0.005, begins=[column((0, 0, 0), radius, shape * radius)]),
        FLOOR,
        0.5,
    )
    return float(np.sort(np.hypot(*law.points[:, :2].T))[-10:].mean() / radius - 1)


def low_column() -> float:
    """The runout of a column 0.8 radii high, against 1.24 of its height."""
    return abs(runout(0.8) / (1.24 * 0.8) - 1)


def high_column() -> float:
    """The runout of a column 2.5 radii high, against 1.6 times the root."""
    return abs(runout(2.5) / (1.6 * np.sqrt(2.5)) - 1)


def snow_layer() -> float:
    """The height of a layer that fell on a board, twice its mean height, against mass over density and area."""
    sky = Source(mass=0.5, at=(0, 0, 0.3), starts=0.0, ends=0.6, sides=(0.24, 0.24), speed=1.0)
    law = let_go(
        Matter(Snow(100.0), 0.012, poured=[sky]), '<geom type="box" size="0.12 0.12 0.02" pos="0 0 -0.02"/>', 1.0
    )
    lies = (np.abs(law.points[:, :2]) < 0.12).all(axis=1) & (law.points[:, 2] > 0)
    return abs(2 * float(law.points[lies, 2].mean()) / (float(law.mass[lies].sum()) / 100 / 0.0576) - 1)
