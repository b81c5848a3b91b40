"""A free body starts with another velocity than the plan gives it.

What it does: compares the linear and angular velocity of every free body at the start with `initial_motion` (world frame,
linear velocity of the centre): more than 2 % and 1 mm/s apart. Bodies the plan does not launch must be at rest.

Why is this bad: how it starts decides how it ends. The engine keeps a free body's angular velocity in the body's own
frame, which is easily forgotten.

Use instead: `worldkit.motion.launch(spec, {...})`, last, with the plan's numbers.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem
from ._planned import THREE, free_joint

CODE = "WM156"
SEVERITY = "error"
SCOPE = "plan"
GOOD = (THREE,)
BAD = (THREE.replace("qvel='.5 ", "qvel='0 "), THREE.replace("qvel='.5 0 0 0 0 0", "qvel='.5 0 0 0 0 9"))
EVIDENCE = Measured("the crate does not start", lambda s: float(after(s, 0.0)[1].qvel[0]), 0.3, "m/s")
SHARE, LEAST = 0.02, 1e-3


def check(view: ModelView) -> Iterator[Problem]:
    """Check free bodies that the plan names."""
    assert view.plan is not None
    planned = view.plan.simulation_parameters.initial_motion
    for name in view.plan.object_names():
        body = view.root_named(name)
        joint = free_joint(view, body) if body is not None else None
        if body is None or joint is None:
            continue
        first, asked = int(view.jnt_dofadr[joint]), planned.get(name)
        linear, angular = view.qvel[first : first + 3], view.xmat[body] @ view.qvel[first + 3 : first + 6]
        for word, built, wanted in (
            ("moves at", linear, asked.linear if asked else (0.0, 0.0, 0.0)),
            ("turns at", angular, asked.angular if asked else (0.0, 0.0, 0.0)),
        ):
            if np.linalg.norm(built - wanted) > max(LEAST, SHARE * float(np.linalg.norm(wanted))):
                # An offset centre of mass moves the origin along: that is a matter of frames, not of the launch.
                if word == "moves at" and asked and np.linalg.norm(asked.angular) > 0:
                    continue
                here, there = (", ".join(f"{v:.3g}" for v in vector) for vector in (built, wanted))
                message = f"{name} {word} ({here}) at the start, the plan says ({there})"
                yield view.at("body", body, message, "launch it with worldkit.motion.launch and the plan's numbers")
