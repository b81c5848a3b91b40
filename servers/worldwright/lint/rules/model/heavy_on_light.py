"""A light body has to carry, or to pull, one that is very much heavier.

What it does: compares the masses of moving bodies that touch at the start with the lighter one below (1 : 100), and of
trees that an active connect or weld ties together (1 : 1,000).

Why is this bad: contacts and constraints are soft by a share that depends on the masses. The light body is pressed
through the floor; the bond tears open by decimetres, and no warning is given.

Use instead: masses from sources (a factor of ten is nature, of a thousand a unit error), one body instead of two tied
ones, or a stiffer contact (`solimp`) for what must carry.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, height_after
from ...problem import Problem

CODE = "WM111"
SEVERITY = "warning"
SCOPE = "any"
STACK = (
    "<mujoco><worldbody><geom type='plane' size='2 2 .1'/><body name='base' pos='0 0 .05'><freejoint/>"
    "<geom type='box' size='.05 .05 .05' mass='{0}'/></body><body name='load' pos='0 0 .2'><freejoint/>"
    "<geom type='box' size='.1 .1 .1' mass='{1}'/></body></worldbody></mujoco>"
)
BOND = (
    "<mujoco><option gravity='0 0 0'/><worldbody><body name='a'><freejoint/><geom size='.05' mass='{0}'/></body>"
    "<body name='b' pos='.2 0 0'><freejoint/><geom size='.05' mass='{1}'/></body></worldbody>"
    "<equality><weld body1='a' body2='b'/></equality></mujoco>"
)
GOOD = (STACK.format("1", "10"), STACK.format("1000", "1"), BOND.format("1", "50"))
BAD = (STACK.format(".1", "1000"), BOND.format(".01", "100"))
EVIDENCE = Measured("the load sinks through the body below it", lambda s: height_after(s, 2.0), 0.08, "m")
CONTACT, BONDED = 100.0, 1000.0


def check(view: ModelView) -> Iterator[Problem]:
    """Check pairs in contact, then pairs that are tied."""
    roots = view.body_rootid
    told: set[tuple[int, int]] = set()
    for one, other in view.near_geom:
        if one >= 0 and other >= 0:
            bodies = (int(view.geom_bodyid[one]), int(view.geom_bodyid[other]))
            light, heavy = sorted(bodies, key=lambda b: float(view.body_subtreemass[roots[b]]))
            down = view.gravity @ (view.xpos[light] - view.xpos[heavy]) > 0
            if down:
                yield from _problems(view, light, heavy, CONTACT, "carries", told)
    for index, kind in enumerate(view.equality_kind):
        if kind in ("connect", "weld") and view.eq_active0[index] and int(view.eq_objtype[index]) == 1:
            ends = (int(view.eq_obj1id[index]), int(view.eq_obj2id[index]))
            light, heavy = sorted(ends, key=lambda b: float(view.body_subtreemass[roots[b]]))
            yield from _problems(view, light, heavy, BONDED, "is tied to", told)


def _problems(
    view: ModelView, light: int, heavy: int, most: float, verb: str, told: set[tuple[int, int]]
) -> Iterator[Problem]:
    masses = [float(view.body_subtreemass[view.body_rootid[b]]) for b in (light, heavy)]
    if not (view.moving[light] and view.moving[heavy]) or masses[0] <= 0 or (light, heavy) in told:
        return
    if masses[1] / masses[0] > most * (1 + 1e-9) and np.isfinite(masses).all():
        told.add((light, heavy))
        names = [view.name("body", b) for b in (light, heavy)]
        message = f"{names[0]} ({masses[0]:.3g} kg) {verb} {names[1]} ({masses[1]:.3g} kg)"
        yield view.at("body", light, message, "check both masses (kg); make one body of them, or stiffen the contact")
