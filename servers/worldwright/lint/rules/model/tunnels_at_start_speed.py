"""A body starts so fast that it can pass through what it should hit.

What it does: compares how far each free body moves in a step at its initial speed with its own thinnest extent; worlds
with speculative contacts are left alone.

Why is this bad: contacts are found where bodies are, not on the way between: a bullet is in front of the wall in one
step and behind it in the next.

Use instead: `<flag speculative="enable"/>` (new in MuJoCo 4), or a smaller time step.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem

CODE = "WM142"
SEVERITY = "warning"
SCOPE = "any"
SHOT = (
    "<mujoco><option gravity='0 0 0' timestep='{0}'><flag speculative='{1}'/></option><worldbody>"
    "<geom type='box' pos='1.013 0 0' size='.002 1 1'/><body name='bullet'><freejoint/><geom size='.004' mass='.008'/></body>"
    "</worldbody><keyframe><key name='start' qvel='100 0 0 0 0 0'/></keyframe></mujoco>"
)
GOOD = (SHOT.format("0.001", "enable"), SHOT.format("0.00002", "disable"))
BAD = (SHOT.format("0.001", "disable"),)
EVIDENCE = Measured("the bullet is behind the wall", lambda s: float(after(s, 0.02)[1].qpos[0]), 0.3, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check free bodies that are launched."""
    if "speculative" in view.enabled:
        return
    for body in np.flatnonzero(view.speed > 0):
        extent = view.body_high[body] - view.body_low[body]
        way = float(view.speed[body]) * view.time_step
        if np.isfinite(extent).all() and way > float(extent.min()):
            message = (
                f"{view.name('body', int(body))} starts at {view.speed[body]:g} m/s: {way * 1e3:.0f} mm a step, it is"
            )
            fix = "enable speculative contacts, or shorten the time step"
            yield view.at("body", int(body), f"{message} {extent.min() * 1e3:.1f} mm thick", fix)
