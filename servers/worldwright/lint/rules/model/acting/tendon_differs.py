"""A rope, spring or rod acts otherwise than the plan's, or is not the plan's at all.

What it does: compares every tendon with the one of that name in the world of the plan's draft: its limit, stiffness and rest,
damping, friction, armature, yield, how firm the limit is, and the bodies and points it is fastened to. Finds tendons that
act and that neither `topology.tendons` nor an intervention names.

Why is this bad: a tendon needs no contact and leaves no mark in a picture: a shorter rope pulls earlier, a hidden spring
holds what should fall.

Use instead: `worldkit.tendons` with the numbers of the plan.
"""

from collections.abc import Iterator

import numpy as np

from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._twins import PLAN, SOUND, changed, compared, holder, missing, names, shown, twins, unplanned, yields

CODE = "WM166"
SEVERITY = "error"
SCOPE = "acts"
HIDDEN = "tendons.spring(spec, 'hidden', (('world', (0, 0, 1)), ('crate', (0, 0, .1))), stiffness=500, length=0.1)"
ENDS = "(('world', (1.5, 0, 1.5)), ('arm', (1.5, 0, 0.5)))"
STRUT = {"name": "strut", "ends": [{"offset": [1.5, 0, 1.5]}, {"body": "arm"}], "rod": True}
ROD_PLAN = PLAN | {"topology": PLAN["topology"] | {"tendons": [*PLAN["topology"]["tendons"], STRUT]}}  # type: ignore[operator, index]
GOOD = (*SOUND, (changed(f"tendons.rod(spec, 'strut', {ENDS})")[0], ROD_PLAN))
BAD = (
    (changed(f"tendons.rope(spec, 'strut', {ENDS})")[0], ROD_PLAN),
    (changed(f"tendons.rod(spec, 'strut', {ENDS}, time_constant=0.2)")[0], ROD_PLAN),
    changed(HIDDEN),
    changed("spec.tendon('rope').range = (0, 1.6)"),
    changed("spec.tendon('rope').stiffness[0] = 20"),
    changed("spec.tendon('rope').damping[0] = 20"),
    changed("spec.site('rope_1').pos = (0.3, 0, 0)"),
)
EVIDENCE = Measured(
    "the crate is lifted",
    lambda s: float(after(s, 0.3)[1].body("crate").xpos[2]),
    0.05,
    "m",
    bad=changed(HIDDEN)[0],
    good=changed()[0],
)
NUMBERS = (
    ("tendon_stiffness", "stiffness"),
    ("tendon_stiffnesspoly", "further stiffness"),
    ("tendon_damping", "damping"),
    ("tendon_dampingpoly", "further damping"),
    ("tendon_frictionloss", "friction"),
    ("tendon_armature", "armature"),
    ("tendon_springyield", "yield"),
    ("tendon_limited", "limit"),
    ("tendon_actfrclimited", "limit on its actuators"),
)
LIMIT = (("tendon_range", "limit (m)"), ("tendon_margin", "margin of the limit"))
REST = (("tendon_lengthspring", "rest length"),)
NEAR_M = 2e-3
SITE = 3
"""`mjWRAP_SITE`."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check tendons of both worlds, then those of one."""
    planned = view.planned
    assert planned is not None
    for index, twin in twins(view, "tendon"):
        yield from compared(view, "tendon", NUMBERS, index, twin)
        if view.tendon_limited[index] and planned.tendon_limited[twin]:
            yield from compared(view, "tendon", LIMIT, index, twin)
            limit = (planned.tendon_solref_lim[twin], planned.tendon_solimp_lim[twin])
            if yields(view.tendon_solref_lim[index], view.tendon_solimp_lim[index], limit):
                message = f"the limit of tendon {names(view, 'tendon')[index]} is softer than the plan's"
                yield view.at("tendon", index, message, "leave solref_limit as worldkit.tendons sets it")
        grip = (planned.tendon_solref_fri[twin], planned.tendon_solimp_fri[twin])
        if view.tendon_frictionloss[index] and yields(
            view.tendon_solref_fri[index], view.tendon_solimp_fri[index], grip
        ):
            message = f"the dry friction of tendon {names(view, 'tendon')[index]} gives way more than the plan's"
            yield view.at("tendon", index, message, "leave solref_friction and solimp_friction alone")
        if view.tendon_stiffness[index] or np.any(view.tendon_stiffnesspoly[index]):
            yield from compared(view, "tendon", REST, index, twin)
        yield from _fastened(view, planned, index, twin)
    for index in unplanned(view, "tendon"):
        if _acts(view, index):
            message = f"{view.name('tendon', index)} is a tendon that the plan does not have"
            yield view.at("tendon", index, message, "add it to topology.tendons, or leave it out")
    for name in missing(view, "tendon"):
        yield view.of_world(f"the plan's tendon {name} is not there", "build it under that name", name)


def _fastened(view: ModelView, planned: ModelView, index: int, twin: int) -> Iterator[Problem]:
    """Compare point by point the body and the place on it (m, world frame) in the built pose."""
    name = names(view, "tendon")[index]
    built, wanted = _points(view, index), _points(planned, twin)
    if len(built) != len(wanted):
        yield view.at(
            "tendon",
            index,
            f"tendon {name} runs over {len(built)} points, by the plan over {len(wanted)}",
            "give the plan's ends",
        )
        return
    for number, ((body, point), (planned_body, there)) in enumerate(zip(built, wanted, strict=True)):
        if view.planned is not None and body != planned_body:
            message = (
                f"tendon {name} is fastened to {body or 'the world'}, by the plan to {planned_body or 'the world'}"
            )
            yield view.at("tendon", index, message, "give the plan's ends")
        elif np.linalg.norm(point - there) > NEAR_M:
            message = f"point {number} of tendon {name} is at {shown(point)} m, by the plan at {shown(there)} m"
            yield view.at("tendon", index, message, "give the plan's ends")


def _points(view: ModelView, index: int) -> list[tuple[str, np.ndarray]]:
    first, found = int(view.tendon_adr[index]), []
    for wrap in range(first, first + int(view.tendon_num[index])):
        target = int(view.wrap_objid[wrap])
        if int(view.wrap_type[wrap]) != SITE:
            found.append((f"{int(view.wrap_type[wrap])}", np.array([float(target), float(view.wrap_prm[wrap]), 0.0])))
            continue
        body = int(view.site_bodyid[target])
        found.append((holder(view, body), view.home_xpos[body] + view.home_xmat[body] @ view.site_pos[target]))
    return found


def _acts(view: ModelView, index: int) -> bool:
    """Whether a tendon limits, pulls or brakes, or an actuator pulls it."""
    passive = ("stiffness", "stiffnesspoly", "damping", "dampingpoly", "frictionloss", "armature")
    pulled = any(
        int(kind) == 3 and int(np.ravel(target)[0]) == index
        for kind, target in zip(view.actuator_trntype, view.actuator_trnid, strict=False)
    )
    return (
        bool(view.tendon_limited[index])
        or pulled
        or any(np.any(getattr(view, f"tendon_{word}")[index]) for word in passive)
    )
