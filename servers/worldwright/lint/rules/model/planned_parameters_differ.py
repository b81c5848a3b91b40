"""The compiled world runs under other laws than the plan's.

What it does: compares the time step, the gravity and the integrator of the compiled world with the plan's
`simulation_parameters`, whatever expressions the program computes them from.

Why is this bad: the plan is what was approved. A world at another step or gravity is another experiment.

Use instead: the plan's numbers, or another plan.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, height_after
from ...problem import Problem
from ._planned import THREE

CODE = "WM155"
SEVERITY = "error"
SCOPE = "plan"
GOOD = (THREE,)
BAD = (
    THREE.replace("timestep='0.002'", "timestep='0.002' gravity='0 0 9.81'"),
    THREE.replace("0.002", "0.004"),
    THREE.replace("implicitfast", "Euler"),
)
EVIDENCE = Measured("the mug falls upwards", lambda s: height_after(s, 0.5), 0.5, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check step, gravity, integrator."""
    assert view.plan is not None
    planned = view.plan.simulation_parameters
    if not isinstance(planned.time_step, str) and not np.isclose(view.time_step, planned.time_step, rtol=1e-6):
        message = f"the world steps by {view.time_step:g} s, the plan says {planned.time_step:g} s"
        yield view.of_world(message, f"set the time step to {planned.time_step:g}", "time_step", "timestep")
    if not np.allclose(view.gravity, planned.gravity_vector, rtol=1e-4, atol=1e-6):
        here, there = (", ".join(f"{v:g}" for v in g) for g in (view.gravity, planned.gravity_vector))
        yield view.of_world(f"gravity is ({here}), the plan says ({there})", f"set it to ({there})", "gravity")
    if view.integrator != planned.integrator:
        message = f"the integrator is {view.integrator}, the plan says {planned.integrator}"
        yield view.of_world(message, f"set it to {planned.integrator}", "integrator", "scene")
