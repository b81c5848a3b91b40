"""A rope is built of rigid links by hand.

What it does: finds chains of at least ten bodies, each with one slender or round geom of about the same size, linked by
ball or hinge joints.

Why is this bad: links have no bending or twisting stiffness of their own, their joints chatter under tension, and each
costs a level of the kinematic tree. MuJoCo 4 has rods with Young's modulus, section, twist and contact.

Use instead: `<flexcomp type="grid" dim="1">` with `<elasticity young=… poisson=…/>`, edge equality against stretching and
`integrator="discrete"`; a thing that is a chain in reality (links one can count) may stay one: say so in an ignore.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Argued
from ...problem import Problem

CODE = "WM140"
SEVERITY = "warning"
SCOPE = "any"


def _chain(links: int) -> str:
    link = "<body pos='.1 0 0'><joint type='ball'/><geom type='capsule' size='.01' fromto='0 0 0 .1 0 0'/>"
    return f"<mujoco><worldbody>{link * links}{'</body>' * links}</worldbody></mujoco>"


GOOD = (_chain(5),)
BAD = (_chain(14),)
EVIDENCE = Argued(
    "the links move as linked rigid bodies do; that a rope was meant, and bends otherwise, only its maker knows"
)
LONGEST = 10


def check(view: ModelView) -> Iterator[Problem]:
    """Check the longest such chain below each body that begins one."""
    count = len(view.body_mass)
    link = np.zeros(count, bool)
    for body in range(1, count):
        geoms = int(view.body_geomnum[body]) == 1 and view.geom_kind[int(view.body_geomadr[body])]
        first, joints = int(view.body_jntadr[body]), int(view.body_jntnum[body])
        kinds = {view.joint_kind[j] for j in range(first, first + joints)} if joints else set()
        link[body] = (
            geoms in ("capsule", "cylinder", "sphere", "ellipsoid") and bool(kinds) and kinds <= {"ball", "hinge"}
        )
    length = link.astype(int)
    only = np.bincount(view.body_parentid[1:], minlength=count) <= 1
    for body in range(1, count):
        parent = int(view.body_parentid[body])
        if link[body] and parent and link[parent] and only[parent] and _are_alike(view, body, parent):
            length[body] = length[parent] + 1
    for end in np.flatnonzero(length >= LONGEST):
        if not (length[(view.body_parentid == end) & link] > length[end]).any():
            fix = "build it as a 1D flex: flexcomp dim=1 with elasticity, integrator discrete"
            yield view.at("body", int(end), f"{length[end]} bodies in a chain stand in for a rope or a cable", fix)


def _are_alike(view: ModelView, one: int, other: int) -> bool:
    a, b = (view.geom_size[int(view.body_geomadr[body])] for body in (one, other))
    return bool(np.allclose(a, b, rtol=0.25))
