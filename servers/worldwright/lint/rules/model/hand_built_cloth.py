"""A cloth or a net is built of point masses and springs by hand.

What it does: finds at least sixteen small bodies tied to one another by at least as many two-body tendons or connect
constraints.

Why is this bad: springs between points have no bending stiffness, no Poisson's ratio and no collision surface between
them; stiff ones explode, soft ones stretch.

Use instead: `<flexcomp dim="2">` with `<elasticity young=… thickness=… elastic2d="both"/>` and `integrator="discrete"`.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Argued
from ...problem import Problem

CODE = "WM141"
SEVERITY = "warning"
SCOPE = "any"


def _net(side: int) -> str:
    bodies = "".join(
        f"<body pos='{x / 10} {y / 10} 1'><freejoint/><geom size='.01'/><site name='s{x}_{y}'/></body>"
        for x in range(side)
        for y in range(side)
    )
    ties = "".join(
        f"<spatial stiffness='100'><site site='s{x}_{y}'/><site site='s{u}_{v}'/></spatial>"
        for x in range(side)
        for y in range(side)
        for u, v in ((x + 1, y), (x, y + 1))
        if u < side and v < side
    )
    return f"<mujoco><worldbody>{bodies}</worldbody><tendon>{ties}</tendon></mujoco>"


GOOD = (_net(2),)
BAD = (_net(5),)
EVIDENCE = Argued(
    "masses and springs move as such; that a cloth was meant, which also bends and shears, only its maker knows"
)
LEAST = 16


def check(view: ModelView) -> Iterator[Problem]:
    """Check free or sliding bodies with one round geom, against the springs and connects of the world."""
    small = {
        int(view.jnt_bodyid[j])
        for j, kind in enumerate(view.joint_kind)
        if kind in ("free", "slide") and int(view.body_geomnum[int(view.jnt_bodyid[j])]) == 1
    }
    small = {b for b in small if view.geom_kind[int(view.body_geomadr[b])] in ("sphere", "capsule", "ellipsoid")}
    springs = int((view.tendon_stiffness > 0).sum()) + sum(
        kind in ("connect", "distance") for kind in view.equality_kind
    )
    flexed = {int(b) for b in view.flex_vertbodyid}
    if len(small - flexed) >= LEAST and springs >= len(small):
        message = f"{len(small)} point masses and {springs} springs stand in for a cloth or a soft body"
        yield view.of_world(message, "build it as a flexcomp of dim 2 or 3", "spatial", "connect", "add_tendon")
