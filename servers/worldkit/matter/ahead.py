"""Compile what matter needs before it is needed: a confined process may not keep it.

`python -m worldkit.matter.ahead`; some ten seconds of processor time, and hardly any where it was done before.
"""

from contextlib import suppress

import mujoco

from ..files import write_atomic
from ..kept_kernels import BESIDE, MARK, compiled, state
from ..sculpt import box
from ..skins import Gas, Wall, ball
from .first_places import block
from .liquids import Liquid
from .material_points import Matter
from .membranes import Membrane
from .moulded import Moulded
from .sands import Sand
from .snows import Snow
from .soft_solids import clay, foam
from .stirred import Stirred
from .stirred_vessels import Vessel


def compile_all() -> None:
    """Step a few points of each kind on a floor, small soft cubes, a cup of water, and a small skin."""
    model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><geom type="plane" size="1 1 1"/></worldbody></mujoco>')
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for stuff in (Liquid(), Sand(), Snow()):
        law = Matter(stuff, 0.01, begins=[block((0, 0, 0.001), (0.02, 0.02, 0.02))])
        law.start(model, data)
        law.step(model, data, 0.001)
    for solid in (foam(), clay()):
        soft = Moulded(solid, box((0.03, 0.03, 0.03)), (0, 0, 0.015), 0.015)
        soft.start(model, data)
        soft.step(model, data, 0.001)
    cup = Vessel([(0.0, 0.0), (0.04, 0.0), (0.04, 0.1)])
    turned = Stirred(cup, 0.05, dye=lambda places: 0.5 + 0 * places[:, :1])
    turned.start(model, data)
    turned.step(model, data, 0.001)
    skin = Membrane(ball(0.05, (0, 0, 0.05), finer=1), Wall(1e6, 2.5e-4, 950.0, stretched=2.0), Gas(hole=0.005))
    skin.start(model, data)
    skin.step(model, data, 0.001)


if __name__ == "__main__":
    if not compiled():
        # numba asks only whether a function's own file changed, and would keep what called a function of another.
        with suppress(OSError):
            for old in BESIDE.glob("*.nb[ic]"):
                old.unlink(missing_ok=True)
        compile_all()
        with suppress(OSError):  # where nothing can be kept beside, numba has a place of the user's own
            write_atomic(MARK, state())
