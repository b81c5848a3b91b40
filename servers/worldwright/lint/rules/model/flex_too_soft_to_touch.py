"""The contact of a flex is so soft, for the small mass of its points, that things sink through it.

What it does: reckons how stiff one point of a flex is under contact, from its mass and from `solref` and `solimp` as the
engine mixes them. It names a flex into which the heaviest loose body that it can touch would sink by more than its radius,
and one whose points give way under contact ten times more easily than its own material stretches.

Why is this bad: a contact is a spring per unit of mass. A point of a cloth weighs a gram, so the default contact (20 ms) is a
spring of some N/m. Beyond its radius a flex is on the other side: the ball falls through the cloth, a stretched band slides
through the peg. No warning is given.

Use instead: `solref` of two time steps for the flex and for what it touches, then `solimp` nearer to one (0.99 to 0.999).
Flexes on a lattice (trilinear, quadratic) are not reckoned.
"""

from collections.abc import Iterator
from math import pi

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, height_after
from ...problem import Problem

CODE = "WM118"
SEVERITY = "warning"
SCOPE = "any"
BAND = (
    "<mujoco><option integrator='discrete' timestep='0.001'/><worldbody><flexcomp name='band' type='grid' dim='2' "
    "count='21 3 1' spacing='.01 .01 .1' pos='0 0 .5' mass='.008' radius='.002'>"
    "<contact {0} selfcollide='none'/><elasticity young='1e6' poisson='.3' thickness='.002' damping='.05' elastic2d='both'/>"
    "<pin id='0 1 2 60 61 62'/></flexcomp><body name='rod' pos='0 0 .515'><freejoint/>"
    "<geom type='capsule' fromto='0 -.05 0 0 .05 0' size='.01' mass='.3' {0}/></body></worldbody></mujoco>"
)
ALONE = BAND.replace("<freejoint/>", "")
GOOD = (BAND.format("solref='.002 1'"), ALONE.format("solref='.002 1' solimp='.99 .999 .001'"))
BAD = (BAND.format(""), ALONE.format(""))
EVIDENCE = Measured("a rod of 300 g falls through the band", height_after, 0.2, "m")
FEWEST, SHARE, GIVES = 4, 0.25, 0.1
"""A body rests on so many contacts at least, on so much of the points at most (measured: a ball on a cloth has 5 to 13);
contact stiffness over the material's at which a stretched flex slid through a peg (measured: at 0.02, not at 0.2)."""
PER_ELEMENT = 21
"""Numbers that the compiler keeps of each element's elasticity."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check each flex of point bodies that something can touch: once, by what sinks deepest or by its own stretch."""
    for flex in range(len(view.flex_dim)):
        first = int(view.flex_vertadr[flex])
        owners = view.flex_vertbodyid[first : first + int(view.flex_vertnum[flex])]
        points = np.unique(owners[(owners > 0) & view.moving[owners]])
        mask = (view.flex_contype[flex] & view.geom_conaffinity) | (view.flex_conaffinity[flex] & view.geom_contype)
        touching = np.flatnonzero(mask)
        if view.flex_rigid[flex] or view.flex_interp[flex] or len(points) < FEWEST or not len(touching):
            continue
        light = float(np.median(view.body_invweight0[points, 0]))
        radius = float(view.flex_radius[flex])
        if light <= 0 or radius <= 0:
            continue
        told = _sinking(view, flex, touching, light, len(points), radius) or _stretching(view, flex, touching, light)
        if told:
            least = 2 * view.time_step
            fix = f"give {view.name('flex', flex)} and what it touches solref=({least:g}, 1); then solimp=(0.9, 0.999, 0.001, 0.5, 2)"
            point = f"a point of flex {view.name('flex', flex)} weighs {1e3 / light:.2g} g"
            yield view.at("flex", flex, f"{point}: {told}", fix)


def _sinking(view: ModelView, flex: int, touching: np.ndarray, light: float, points: int, radius: float) -> str:
    """What is to be said of the loose body that would sink deepest into the flex; nothing where none sinks too deep."""
    g = float(np.sqrt((np.asarray(view.gravity) ** 2).sum()))
    spacing = _spacing(view, flex)
    worst, said = radius, ""
    for geom in touching:
        body = int(view.geom_bodyid[geom])
        if not view.moving[body]:
            continue
        mass = float(view.body_subtreemass[view.body_rootid[body]])
        reach = float(view.geom_rbound[geom]) * (1.0 if view.geom_kind[geom] == "sphere" else 0.7)
        contacts = min(max(FEWEST, pi * reach**2 / spacing**2), max(FEWEST, SHARE * points))
        deep = mass * g / contacts * _compliance(view, flex, int(geom)) * (light + 1 / max(mass, 1e-9))
        if deep > worst:
            worst = deep
            said = f"under {view.name('body', body)} ({mass:.2g} kg) its contact would give by {deep * 1e3:.2g} mm, and its radius is {radius * 1e3:.2g} mm"
    return said


def _stretching(view: ModelView, flex: int, touching: np.ndarray, light: float) -> str:
    """What is to be said of a flex that gives way under contact before it stretches."""
    if view.flex_stiffnessadr[flex] < 0:
        return ""
    start = int(view.flex_stiffnessadr[flex])
    own = view.flex_stiffness[start : start + PER_ELEMENT * int(view.flex_elemnum[flex]) : PER_ELEMENT]
    # Energy per element: K (change of the squared length)^2 / 2, and l^2 changes by 2 l per unit of l.
    material = 4 * float(np.median(np.abs(own))) * _spacing(view, flex) ** 2 if len(own) else 0.0
    contact = min(1 / (_compliance(view, flex, int(geom)) * light) for geom in touching)
    if contact >= GIVES * material:
        return ""
    return f"its contact is a spring of {contact:.2g} N/m and its material one of {material:.2g}, so that it is pulled through what it is stretched over"


def _spacing(view: ModelView, flex: int) -> float:
    """The median distance of neighbouring points, m."""
    first, edge = int(view.flex_vertadr[flex]), int(view.flex_edgeadr[flex])
    places = view.flex_vert0[first : first + int(view.flex_vertnum[flex])] * 2 * view.flex_size[flex]
    pairs = view.flex_edge[edge : edge + int(view.flex_edgenum[flex])]
    return max(float(np.median(np.sqrt(((places[pairs[:, 0]] - places[pairs[:, 1]]) ** 2).sum(axis=1)))), 1e-6)


def _compliance(view: ModelView, flex: int, geom: int) -> float:
    """Metres by which their contact gives per newton and per unit of inverse mass (1/kg).

    Source: the manual, "Contact parameters" and "Constraint model": R f = k r with R = (1 - d) / d A, k of `solref`.
    """
    one, other = int(view.flex_priority[flex]), int(view.geom_priority[geom])
    mixes = float(view.flex_solmix[flex]), float(view.geom_solmix[geom])
    share = float(one > other) if one != other else mixes[0] / sum(mixes) if sum(mixes) > 0 else 0.5
    refs, imps = (view.flex_solref[flex], view.geom_solref[geom]), (view.flex_solimp[flex], view.geom_solimp[geom])
    d = share * float(imps[0][1]) + (1 - share) * float(imps[1][1])
    d = min(max(d, 1e-4), 0.9999)
    if one == other and min(refs[0][0], refs[1][0]) <= 0:
        reference = np.minimum(*refs)
    else:
        reference = share * refs[0] + (1 - share) * refs[1]
    if reference[0] <= 0:
        return (1 - d) / max(-float(reference[0]), 1e-9)
    constant = float(reference[0])
    if "refsafe" not in view.disabled and view.integrator != "discrete":
        constant = max(constant, 2 * view.time_step)
    return (1 - d) * (constant * float(reference[1])) ** 2
