"""An elastic flex is integrated explicitly with a long time step.

What it does: finds flexes with elasticity under `Euler` or `RK4` and a time step above 0.5 ms.

Why is this bad: elasticity is usually the stiffest force of a world. Explicit integration blows it up, and the engine
resets the state again and again (modeling.rst, Tuning: Deformables).

Use instead: `integrator="discrete"`, which is implicit in position: 1 to 4 ms are typical then.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, diverged
from ...problem import Problem

CODE = "WM104"
SEVERITY = "error"
SCOPE = "any"
BLOCK = (
    "<mujoco><option integrator='{0}' timestep='0.002'/><worldbody><geom type='plane' size='2 2 .1'/>"
    "<body name='b' pos='0 0 .5'><flexcomp name='j' type='grid' dim='3' count='4 4 4' spacing='.05 .05 .05' mass='1' "
    "radius='.005'><elasticity young='5e5' poisson='.3' damping='.002'/></flexcomp></body></worldbody></mujoco>"
)
GOOD = (BLOCK.format("discrete"), "<mujoco><option integrator='Euler'/></mujoco>")
BAD = (BLOCK.format("Euler"), BLOCK.format("RK4"))
EVIDENCE = Measured(
    "the engine gives up on the exploding state and resets it", lambda s: diverged(s, 0.1), 0.5, "resets"
)
LONGEST_S = 5e-4


def check(view: ModelView) -> Iterator[Problem]:
    """Check each flex with a stiffness of its own."""
    if view.integrator not in ("euler", "rk4") or view.time_step <= LONGEST_S:
        return
    for flex in range(len(view.flex_dim)):
        elastic = view.flex_stiffnessadr[flex] >= 0 or view.flex_bendingadr[flex] >= 0
        if elastic and not view.flex_rigid[flex]:
            message = f"flex {view.name('flex', flex)} is elastic, and integrator {view.integrator} is explicit"
            yield view.at(
                "flex", flex, message + f" at a step of {view.time_step * 1e3:g} ms", "use integrator discrete"
            )
