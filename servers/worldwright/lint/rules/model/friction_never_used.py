"""A friction coefficient is set that the contact has no dimension for.

What it does: finds geoms with a torsional or rolling friction of their own whose contacts have too small a `condim` (4
for torsion, 6 for rolling, 3 for sliding); the larger `condim` of two geoms counts.

Why is this bad: the coefficient is read and ignored. A ball rolls for ever, a spinning coin never stops.

Use instead: `condim="6"` with rolling friction, `condim="4"` with torsional; `worldkit.contacts.surface` does so.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem

CODE = "WM122"
SEVERITY = "error"
SCOPE = "any"
ROLL = (
    "<mujoco><worldbody><geom type='plane' size='9 9 .1'/><body name='ball' pos='0 0 .1'><freejoint/>"
    "<geom size='.1' friction='{0}' condim='{1}'/></body></worldbody>"
    "<keyframe><key name='start' qpos='0 0 .1 1 0 0 0' qvel='1 0 0 0 10 0'/></keyframe></mujoco>"
)
GOOD = (ROLL.format("1 .005 .01", "6"), ROLL.format("1", "3"))
BAD = (
    ROLL.format("1 .005 .01", "3"),
    ROLL.format("1 .1 .0001", "3"),
    ROLL.format(".2", "1").replace("9 9 .1'", "9 9 .1' condim='1'"),
)
EVIDENCE = Measured("the ball does not slow down", lambda s: float(after(s, 1.5)[1].qvel[0]), 0.3, "m/s")
DEFAULTS, NEEDED, WORDS = (1.0, 0.005, 0.0001), (3, 4, 6), ("sliding", "torsional", "rolling")


def check(view: ModelView) -> Iterator[Problem]:
    """Check geoms that can touch something, against the largest condim they can meet."""
    told: set[tuple[float, ...]] = set()
    for geom in np.flatnonzero(view.collides):
        met = view.may_touch(int(geom))
        if not met.any():
            continue
        most = max(int(view.geom_condim[geom]), int(view.geom_condim[met].max()))
        paired = ((view.pair_geom1 == geom) | (view.pair_geom2 == geom)).any()
        friction = view.geom_friction[geom]
        key = (*map(float, friction), most)
        if paired or key in told:
            continue
        for value, default, needed, word in zip(friction, DEFAULTS, NEEDED, WORDS, strict=True):
            if value > 0 and abs(value - default) > 1e-12 * default and most < needed:
                told.add(key)
                message = f"{word} friction {value:g} of {view.name('geom', int(geom))} is ignored: its contacts have condim {most}"
                yield view.at("geom", int(geom), message, f"set condim to {needed}")
                break
