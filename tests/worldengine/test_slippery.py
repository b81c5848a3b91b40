"""What is taken of a contact is its friction and nothing else: with a factor of 1 everything moves as before, bit for bit."""

import copy

import mujoco
import numpy as np
import pytest

from worldengine.variants import slippery

SURFACES = {
    "friction": ('friction="1.2 .02 .001"', 'friction=".3"'),
    "softness": ('solref=".01 .5"', 'solref=".03 .2" solmix="3"'),
    "stiffness": ('solref="-2000 -30"', 'solref=".03 .2"'),
    "priority": ('friction=".2"', 'priority="3" friction=".9" solref=".05 1" condim="6"'),
    "kind": ('condim="1"', 'condim="4"'),
    "margin": ('margin=".02" gap=".01"', 'margin=".005"'),
    "adhesion": ('adhesion="3"', 'adhesion="1"'),
    "a belt": ('surfacevel=".5 0 0 0 0 0"', ""),
}
SHEETS = {
    "a sheet": ("", 'friction="1"'),
    "a sheet above all": ("", 'friction="1" priority="5"'),
    "a softer sheet": ('solref=".01 1"', 'friction=".2" solref=".05 1"'),
}
SHEET = """<flexcomp name="s" type="grid" count="5 5 1" spacing=".1 .1 .1" pos="0 0 .3" dim="2" mass=".5" radius=".01">
<contact selfcollide="none" {}/><edge equality="true"/><pin id="0 4 20 24"/></flexcomp>"""


def world(box: str, under: str, sheet: bool) -> mujoco.MjModel:
    """A box that slides on a floor or on a sheet held at its corners."""
    ground = SHEET.format(under) if sheet else f'<geom type="plane" size="5 5 .1" {under}/>'
    return mujoco.MjModel.from_xml_string(
        f"""<mujoco><worldbody>{ground}<body name="box" pos="0 0 {0.42 if sheet else 0.099}"><freejoint/>
        <geom type="box" size=".1 .1 .1" mass="1" {box}/></body></worldbody></mujoco>"""
    )


def slid(model: mujoco.MjModel) -> np.ndarray:
    """(300, nq)"""
    data = mujoco.MjData(model)
    data.qvel[-6] = 0.6
    rows = []
    for _ in range(300):
        mujoco.mj_step(model, data)
        rows.append(data.qpos.copy())
    return np.array(rows)


@pytest.mark.parametrize("kind", [*SURFACES, *SHEETS])
def test_a_factor_of_one_changes_nothing_and_one_of_none_takes_friction_away(kind: str) -> None:
    model = world(*{**SURFACES, **SHEETS}[kind], sheet=kind in SHEETS)
    geoms = [g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body("box").id]
    same, none = copy.copy(model), copy.copy(model)
    slippery.of_geoms(same, geoms, 1.0)
    slippery.of_geoms(none, geoms, 0.0)
    as_built, without = slid(model), slid(none)
    assert np.array_equal(slid(same), as_built)
    assert without[-1][-7] > as_built[-1][-7] + 0.05
