"""Two bodies touch otherwise than their materials in the plan make them.

What it does: works out, by the engine's own rules, how each pair of bodies touches (masks, exclusions, priorities, mixing,
explicit pairs), and compares sliding, torsional and rolling friction, rebound, softness, margin, adhesion and the speed of
surfaces with the world of the plan's draft; of a body of several surfaces part by part. Our own pairs against hopping count
as the contacts they replace. Of a thing that is built as a flex, whether it touches and how it slides counts: its rebound is its
own elasticity's. A stiffer contact of the same rebound is free; without a stated rebound MuJoCo's own contact is,
too.

Why is this bad: the friction that is written on a geom need not act: a pair or a priority overrides it, and a crate slides
twice as far on the same plan.

Use instead: `contacts.surface` with the plan's constants on every geom of the body, priorities and pairs left alone; to let
two bodies pass through each other, say so in the plan with `visual_only`. A surface that runs has an intervention of kind
`force`, `parameter`, `control` or `solver` that names its body, with its speed (`0.8 m/s`, `2 rad/s`, a constant's name) in its law.
"""

from collections.abc import Iterator
from functools import partial

import numpy as np

from worldkit.contacts import restitution_of
from worldkit.sliding import GRIP

from .....model.plan import law_words
from .....model.plan.declaration import DRIVES
from ....compiled.touching import Touch, Touching
from ....compiled.view import ModelView
from ....harm import Measured, after
from ....problem import Problem
from ._part_points import away
from ._twins import SOUND, changed, flexed, holder, rebounds_otherwise, sheet, shown, stated, twins

CODE = "WM160"
SEVERITY = "error"
SCOPE = "acts"
PAIR = "spec.add_pair(geomname1='crate', geomname2='ground', condim=3, friction=[0.01, 0.01, 0, 0, 0])"


Bar = tuple[float, float, float, str]
"""Half the length of a bar, and where its middle is along x and z, m; its surface."""
EVEN: tuple[Bar, ...] = ((0.15, 0, -0.05, "LEAD"), (0.15, 0, 0.05, "RUBBER"))
KNOBBED: tuple[Bar, ...] = ((0.5, 0, -0.05, "LEAD"), (0.05, 0.4, 0.05, "RUBBER"))
"""A long foot, and a small knob upon its end."""


def _block(wanted: tuple[Bar, ...], *built: Bar) -> tuple[str, dict[str, object]]:
    """A case with a block that by its plan has a foot of lead and a top of rubber, built of these bars."""
    text, plan = changed(
        "LEAD, RUBBER = (contacts.surface(friction=0.3, restitution=r, time_constant=0.004) for r in (0.05, 0.85))",
        "b = spec.worldbody.add_body(name='block', pos=(0, 3, 0.6))",
        "b.add_freejoint(name='block')",
        *(
            f"b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=({half}, .15, .05), pos=({x}, 0, {z}), mass=1, **{surface})"
            for half, x, z, surface in built
        ),
    )
    parts = [
        {
            "name": name,
            "primitive": "box",
            "size": [2 * half, 0.3, 0.1],
            "offset": [x, 0, 0.1 + z],
            "material": material,
        }
        for (half, x, z, _), name, material in zip(wanted, ("foot", "top"), ("lead", "rubber"), strict=True)
    ]
    row = {"name": "block", "primitive": "compound", "material": "lead", "parts": parts}
    known: dict = plan["simulation_parameters"] | {}  # type: ignore[operator]
    made = {m: {"friction": 0.3, "restitution": r, "source": "a table"} for m, r in (("lead", 0.05), ("rubber", 0.85))}
    topology: dict = plan["topology"]  # type: ignore[assignment]
    return text, plan | {
        "simulation_parameters": known
        | {"materials": known["materials"] | made, "masses": known["masses"] | {"block": 2}},
        "scene_objects": [*plan["scene_objects"], row],  # type: ignore[misc]
        "topology": topology | {"body_positions": topology["body_positions"] | {"block": {"x": 0, "y": 3, "z": 0.6}}},
    }


def _running(constant: str, law: str, of: str, way: tuple[float, float] = (0.45, 0)) -> tuple[str, dict[str, object]]:
    """A case with a ground that runs at 0.45 m/s, the value of this constant, and an intervention on a body."""
    text, plan = changed(f"spec.geom('ground').surfacevel = ({way[0]}, {way[1]}, 0, 0, 0, 0)")
    known: dict = plan["simulation_parameters"]  # type: ignore[assignment]
    said = {constant: {"value": 0.45, "unit": "m/s", "source": "a drawing"}}
    row = {"kind": "force", "bodies": [of], "law": law, "trigger": "always", "source": "the prompt's belt"}
    return text, plan | {"simulation_parameters": known | {"constants": said, "interventions": [row]}}


def _sticky(*lines: str) -> tuple[str, dict[str, object]]:
    """A case with things that stick by 5 N at each point, as the plan has it but for these statements."""
    text, plan = changed(
        "for name in ('crate', 'arm'): spec.geom(name).adhesion, spec.geom(name).gap = 5, contacts.REACH_M", *lines
    )
    known: dict = plan["simulation_parameters"]  # type: ignore[assignment]
    wood = known["materials"]["wood"] | {"adhesion": 5}
    return text, plan | {"simulation_parameters": known | {"materials": known["materials"] | {"wood": wood}}}


GOOD = (
    *SOUND,
    _sticky(),
    sheet(),
    sheet("spec.worldbody.add_body(name='sheet', pos=(0, 3, 1)).add_geom(size=(.01, 0, 0), contype=0, conaffinity=0)"),
    _running("speed", "runs at 0.45 m/s along +X", "ground"),
    _running("belt_speed", "runs at belt_speed", "ground"),
    _running("belt_speed", "runs askew at 0.45 m/s", "ground", (0.36, 0.27)),
    _block(EVEN, *EVEN),
    _block(KNOBBED, (0.25, -0.25, -0.05, "LEAD"), (0.25, 0.25, -0.05, "LEAD"), KNOBBED[1]),
    changed(
        "spec.geom('crate').solref = (-1 / 0.008**2, 0)",
        "spec.geom('crate').solref[1] = spec.geom('ground').solref[1] / 2",
    ),
)
BAD = (
    _sticky("spec.geom('ground').priority = 1"),
    sheet("f.friction[0] = 1.0"),
    sheet("f.contype = f.conaffinity = 0"),
    sheet("spec.geom('crate').solref = (-250000, -20)", "f.name = 'crate_drawn'", "f.contype = f.conaffinity = 0"),
    _block(EVEN, (0.15, 0, -0.05, "RUBBER"), (0.15, 0, 0.05, "LEAD")),
    _block(KNOBBED, (0.25, -0.25, -0.05, "LEAD"), (0.25, 0.25, -0.05, "RUBBER"), KNOBBED[1]),
    changed(PAIR),
    changed("spec.geom('crate').priority = 1", "spec.geom('crate').friction = (0.05, 0.005, 0.0001)"),
    changed("spec.geom('ground').friction[0] = 1.0"),
    changed("spec.geom('crate').solref = (-250000, -20)", "spec.geom('ground').solref = (-250000, -20)"),
    changed("spec.geom('crate').contype = spec.geom('crate').conaffinity = 0"),
    changed("spec.add_exclude(bodyname1='crate', bodyname2='arm')"),
    changed("spec.geom('ground').surfacevel = (1, 0, 0, 0, 0, 0)"),
    _running("belt_speed", "a push of 1 N", "ground"),
    _running("belt_speed", "runs at 0.45 m/s", "crate"),
    _running("belt_speed", "runs at belt_speed", "ground", (0.45, 0.45)),
    changed("spec.geom('crate').adhesion = 30"),
    changed("spec.geom('crate').margin = 0.02"),
    changed("spec.geom('crate').gap = 0.02"),
    changed("spec.geom('crate').solref = (-1e9, -1e4)", "spec.geom('ground').solref = (-1e9, -1e4)"),
    changed(
        "spec.geom('crate').solimp = (0.1, 0.2, 0.05, 0.5, 2)", "spec.geom('ground').solimp = (0.1, 0.2, 0.05, 0.5, 2)"
    ),
)
EVIDENCE = Measured(
    "the crate slides further",
    lambda s: float(after(s, 1.0)[1].body("crate").xpos[0]),
    0.1,
    "m",
    bad=changed(PAIR)[0],
    good=changed()[0],
)
SHARE, LEAST = 0.01, 1e-3
SPIN_M, ROLL_M = 0.005, 1e-4
"""Torsional and rolling friction, m, of a plan that states none: a program may leave these out."""
SOFTEST_S = 0.02
MOST = 12
"""So many pairs of one body are shown: more would say the same."""


def check(view: ModelView) -> Iterator[Problem]:
    """Check pairs of bodies whose contacts are not the plan's, or not there."""
    assert view.planned is not None
    planned_view = view.planned
    built, planned = (Touching(world, partial(holder, world)) for world in (view, planned_view))
    yield from _swapped(view, built, planned)
    soft = flexed(view)
    yield from _soft(view, built, planned, soft)
    known, seen = set(planned.geoms) - soft.keys(), set()
    for one in built.suspects(planned):
        shown_pairs = 0
        for other in sorted(known & {*built.geoms} - {one}) if one not in soft else ():
            ends = Touching.ends(one, other)
            if ends in seen or shown_pairs >= MOST:
                continue
            seen.add(ends)
            message = _difference(view, built.between(one, other), planned.between(one, other))
            if message:
                shown_pairs += 1
                yield _problem_of(view, one, other, message)


def _soft(view: ModelView, built: Touching, planned: Touching, soft: dict[str, list[int]]) -> Iterator[Problem]:
    """Things that are built as flexes and slide otherwise than the plan says, or touch what they should not, or nothing.

    How they rebound and give way is the matter's own doing, which no contact of a solid thing can be held against.
    """
    by_plan = flexed(planned.view)
    for one, flexes in soft.items():
        for other in sorted({*planned.geoms} & {*built.geoms} - {one, *soft}):
            touches = set[Touch]().union(*(built.of_flex(flex, other) for flex in flexes), built.between(one, other))
            wanted = set[Touch]().union(*(planned.of_flex(flex, other) for flex in by_plan.get(one, ())))
            message = _difference(view, touches, wanted | planned.between(one, other), solid=False)
            if message:
                said = message.format(f"{one} and {other}")
                yield view.at(
                    "flex", flexes[0], said, "give the flex the friction of the plan's material, and its masks"
                )


def _swapped(view: ModelView, built: Touching, planned: Touching) -> Iterator[Problem]:
    """Bodies with several surfaces of which one part has another's.

    Each geom is compared with that of the plan's in whose box its middle lies, or whose box is nearest: a long part may be built
    of several, whose middles lie far from its own.
    """
    twin_view = planned.view
    for body, twin in twins(view, "body"):
        mine, theirs = (
            np.flatnonzero((world.geom_bodyid == index) & world.collides)
            for world, index in ((view, body), (twin_view, twin))
        )
        if body == 0 or not len(mine) or len({planned.kind(geom) for geom in theirs.tolist()}) < 2:
            continue
        own, seen = holder(view, body), set[tuple[int, int]]()
        others = sorted({*planned.geoms} & {*built.geoms} - {own})
        for geom in mine.tolist():
            middle = view.geom_pos[geom][None]
            from_box = [round(float(away(twin_view, one, twin, middle)[0]), 6) for one in theirs.tolist()]
            from_middle = np.linalg.norm(twin_view.geom_pos[theirs] - middle, axis=1)
            near = int(theirs[np.lexsort((from_middle, from_box))[0]])
            alike = (built.kind(geom), planned.kind(near))
            if alike in seen and not (built.is_paired(geom) or planned.is_paired(near)):
                continue
            seen.add(alike)
            for other in others:
                message = _difference(view, built.of_geom(geom, other), planned.of_geom(near, other))
                if message:
                    said = message.format(f"{view.name('geom', geom)} and {other}")
                    yield view.at("geom", geom, said, "give each part the plan's material")
                    break


def _problem_of(view: ModelView, one: str, other: str, message: str) -> Problem:
    bodies = view.texts["names"]["body"]
    name = one if one in bodies else other
    said = message.format(f"{one} and {other}")
    return view.at("body", bodies.index(name) if name in bodies else 0, said, "give both geoms the plan's material")


def _difference(view: ModelView, built: set[Touch], planned: set[Touch], *, solid: bool = True) -> str:
    """What differs between the contacts of two bodies, with a place for their names; empty when nothing does. `solid`: both
    are, so how they rebound and give way counts, too."""
    if planned and not built:
        return "{} pass through each other, by the plan they touch"
    if built and not planned:
        return "{} touch, by the plan they pass through each other or hold together"
    for touch in sorted(built, key=repr):
        said = [_describe_difference(view, touch, twin, solid=solid) for twin in planned]
        if all(said):
            return min(said, key=len)
    return ""


def _describe_difference(view: ModelView, built: Touch, planned: Touch, *, solid: bool) -> str:
    """How one contact differs from what the plan makes it; empty when it does not."""
    assert view.plan is not None
    slide, across, spin, roll = built.acting
    theirs = planned.acting
    if abs(slide - theirs[0]) > max(LEAST, SHARE * theirs[0]) or abs(across - theirs[1]) > max(
        LEAST, SHARE * theirs[1]
    ):
        here = shown(slide) if slide == across else f"{shown(slide)} one way and {shown(across)} across it"
        return f"between {{}} a friction of {here} acts, by the plan {shown(theirs[0])}"
    if not solid:
        return ""
    for word, mine, planned_m, free in (("torsional", spin, theirs[2], SPIN_M), ("rolling", roll, theirs[3], ROLL_M)):
        if abs(mine - planned_m) > max(1e-6, 0.05 * planned_m) and not (mine == 0 and planned_m <= free):
            return f"between {{}} a {word} friction of {shown(mine)} m acts, by the plan {shown(planned_m)} m"
    (ratio, give), (wanted, planned_give) = built.spring(view.time_step), planned.spring(view.time_step)
    if rebounds_otherwise(ratio, wanted):
        return f"between {{}} the rebound is {restitution_of(ratio):.2f}, by the plan {restitution_of(wanted):.2f}"
    if built.solref[0] < 0 and give < min(2 * view.time_step, 0.95 * planned_give):
        return f"the contact between {{}} is too stiff for the time step (time constant {give * 1e3:.3g} ms)"
    if give > 1.05 * max(planned_give, SOFTEST_S) or _yields(built, planned):
        return f"the contact between {{}} is softer than the plan's (time constant {give * 1e3:.3g} ms, solimp {shown(built.solimp)})"
    if not _same_grip(built, planned):
        return f"friction between {{}} gives way by a rule of its own (solreffriction {shown(built.solref_friction)})"
    if abs(built.margin - planned.margin) > 1e-4:
        return f"{{}} touch at a distance of {shown(built.margin)} m, by the plan of {shown(planned.margin)} m"
    if abs(built.gap - planned.gap) > 1e-4:
        return f"{{}} count as touching {shown(built.gap)} m before they meet (gap)"
    if abs(built.adhesion - planned.adhesion) > 1e-9 and not stated(view.plan, built.adhesion, "adhesion", "stick"):
        return f"{{}} stick together by up to {shown(built.adhesion)} N at each point, which the plan does not say"
    if built.surface != planned.surface and not all(_told(view, built.surface[n : n + 6]) for n in (0, 6)):
        speeds = [v for v in built.surface if v]
        return f"a surface between {{}} runs at {shown(speeds)}, which no intervention says"
    return ""


def _told(view: ModelView, surface: tuple[float, ...]) -> bool:
    """Whether interventions give each body with a surface (6,), m/s and rad/s, just its speed, askew or along each axis."""
    assert view.plan is not None
    parameters = view.plan.simulation_parameters
    running = np.isclose(view.geom_surfacevel.reshape(-1, 6), surface).all(axis=1)
    for geom in np.flatnonzero(running).tolist() if any(surface) else ():
        names = {
            view.name("geom", geom),
            view.name("body", int(view.geom_bodyid[geom])),
            holder(view, int(view.geom_bodyid[geom])),
        }
        laws = [row.law for row in parameters.interventions if row.kind in DRIVES and names.intersection(row.bodies)]
        known = [speed for law in laws for speed in law_words.said(law, "velocity", parameters.constants)]
        for part in np.abs(surface).reshape(2, 3):
            if not (_among(known, np.sqrt((part**2).sum())) or _among(known, *part[part > 0])):
                return False
    return True


def _among(known: list[float], *speeds: float) -> bool:
    """Whether each of some speeds is a number of its own among those that laws state; none is where there is none, or it is 0."""
    left = list(known)
    for speed in filter(None, speeds):
        same = [value for value in left if np.isclose(value, speed, rtol=1e-3)]
        if not same:
            return False
        left.remove(same[0])
    return True


def _yields(built: Touch, planned: Touch) -> bool:
    """Whether a contact gives way more than the plan's and than MuJoCo's own."""
    least, most, width = built.solimp[:3]
    soft = least < min(planned.solimp[0], 0.9) - 0.01 or most < min(planned.solimp[1], 0.95) - 0.01
    return soft or (least < most and width > 1.05 * max(planned.solimp[2], 1e-3))


def _same_grip(built: Touch, planned: Touch) -> bool:
    ours = ((0.0, 0.0), (-1.0, -GRIP), built.solref, planned.solref_friction)
    return tuple(built.solref_friction) in ours or np.allclose(
        built.solref_friction, planned.solref_friction, rtol=SHARE
    )
