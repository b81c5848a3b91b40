"""Contact: the crate slides further, or stops, because what touches does not touch as its materials say."""

from .attack import Trick

GROUND, CRATE = "spec.geom('ground')", "spec.geom('crate')"
BOTH = f"for g in ({GROUND}, {CRATE}): "
PAIR = "spec.add_pair(name='pair', geomname1='crate', geomname2='ground', condim={dim}, friction=[{mu}, {mu}, .005, .0001, .0001], solref={solref}, solimp={solimp}{more})"
SOLREF, SOLIMP = "[-15625., -157.884]", "[.99, .99, .001, .5, 2]"


def pair(mu: float = 0.4, dim: int = 6, solref: str = SOLREF, solimp: str = SOLIMP, more: str = "") -> tuple[str, ...]:
    """An explicit pair of crate and ground, otherwise as the materials make it."""
    return (PAIR.format(mu=mu, dim=dim, solref=solref, solimp=solimp, more=more),)


def trick(name: str, does: str, *build: str) -> Trick:
    return Trick(name, "contact", does, build=build)


SLIGHT = (("min_m: 0.55", "min_m: 0.294"),)
"""A claim of 2.5 % more than the plan's own world does."""
RUNNERS = (
    (
        "  ground: {friction: 0.4",
        '  lid: {friction: 0.19, restitution: 0.2, source: "made up for a test"}\n  ground: {friction: 0.1',
    ),
    (
        'primitive: box, size: [0.4, 0.3, 0.2], material: wood, look: "#b3261e"}',
        (
            "primitive: compound, material: wood, parts: ["
            "{name: box, primitive: box, size: [0.4, 0.3, 0.16], offset: [0, 0, 0.12], material: lid}, "
            "{name: runner, primitive: box, size: [0.4, 0.05, 0.04], offset: [0, -0.125, 0.02], repeat: {count: 2, step: [0, 0.25, 0]}}]}"
        ),
    ),
)
"""The crate stands on two runners that grip, and only its box is slippery."""
TRICKS = (
    trick("ice_on_both", "Half the friction on crate and ground.", BOTH + "g.friction[0] = .19"),
    trick(
        "ice_by_priority",
        "The crate outranks the ground, with half its friction.",
        f"{CRATE}.priority = 1; {CRATE}.friction[0] = .19",
    ),
    trick(
        "ice_by_ground_priority", "The ground outranks the crate.", f"{GROUND}.priority = 5; {GROUND}.friction[0] = .19"
    ),
    trick("ice_by_pair", "A pair outdoes both materials.", *pair(mu=0.19)),
    trick("pair_at_the_edge", "A pair of 1 % less friction, at the edge of what counts as equal.", *pair(mu=0.3961)),
    trick("pair_without_friction", "A pair of condim 1.", *pair(dim=1)),
    trick(
        "pair_one_way",
        "A pair that grips across the way and not along it.",
        *pair(),
        "p = spec.pair('pair'); p.friction[0] = .19",
    ),
    trick(
        "pair_twice",
        "Two pairs of the same geoms: an honest one, and a slippery one.",
        *pair(mu=0.19),
        *(line.replace("'pair'", "'again'") for line in pair()),
    ),
    trick(
        "pair_swapped",
        "The slippery pair names the geoms in the other order, beside an honest one.",
        *pair(),
        *(
            line.replace(
                "name='pair', geomname1='crate', geomname2='ground'",
                "name='again', geomname1='ground', geomname2='crate'",
            )
            for line in pair(mu=0.19)
        ),
    ),
    trick(
        "pair_of_soft_grip",
        "Friction that yields by a solreffriction of its own.",
        *pair(more=", solreffriction=[5.0, 1.0]"),
    ),
    trick(
        "pair_of_no_grip",
        "Friction with a negative solreffriction that hardly brakes.",
        *pair(more=", solreffriction=[-0.001, -0.001]"),
    ),
    trick("pair_with_gap", "A pair with a negative gap: contacts come and go.", *pair(more=", gap=-.03")),
    trick("pair_with_margin", "A pair that holds before it touches.", *pair(more=", margin=.05")),
    trick("frictionless", "condim 1 on both.", BOTH + "g.condim = 1"),
    trick("condim_three", "No rolling nor torsional friction.", BOTH + "g.condim = 3"),
    trick(
        "negative_gap",
        "A negative gap lets contacts come and go while the crate sinks and rises.",
        f"{GROUND}.gap = -.028; {CRATE}.gap = -.0",
    ),
    trick("negative_gap_of_the_crate", "The gap is the crate's.", f"{CRATE}.gap = -.03"),
    trick("negative_gap_small", "A gap of 1 cm: the crate flies a little at every step.", f"{GROUND}.gap = -.022"),
    trick("wide_gap", "A wide gap.", f"{GROUND}.gap = .05"),
    trick("margin", "They touch before they meet.", f"{GROUND}.margin = .04"),
    trick(
        "margin_and_gap", "A negative margin, made up for by the gap.", f"{GROUND}.margin = -.02; {GROUND}.gap = .02"
    ),
    trick(
        "margins_that_cancel",
        "A margin on one and its negative on the other, with a gap.",
        f"{GROUND}.margin = .03; {CRATE}.margin = -.03; {CRATE}.gap = -.03",
    ),
    trick(
        "trampoline",
        "Contacts far stiffer than the step, of the same rebound: the crate hops on.",
        f"for g in ({GROUND}, {CRATE}): g.solref = (-2.6e5, -2 * .6315 * 2.6e5**.5)",
    ),
    trick(
        "trampoline_hard", "Stiffer still.", f"for g in ({GROUND}, {CRATE}): g.solref = (-3e5, -2 * .6315 * 3e5**.5)"
    ),
    trick("mud", "Contacts of no stiffness.", BOTH + "g.solref = (-5., -2.)"),
    trick(
        "mixed_solref",
        "A positive and a negative number in one solref, which the engine replaces.",
        BOTH + "g.solref = (.004, -5.)",
    ),
    trick("undamped", "Contacts without damping.", BOTH + "g.solref = (-15625., 0.)"),
    trick("overdamped", "Contacts that never push off.", BOTH + "g.solref = (-15625., -15000.)"),
    trick("soft_solimp", "Constraints that give way by half.", BOTH + "g.solimp = (.1, .3, .01, .5, 2)"),
    trick("late_solimp", "Constraints that harden late.", BOTH + "g.solimp = (.9, .95, .05, .9, 6)"),
    trick(
        "weight_of_mixing",
        "solmix lets a softer one of the two decide.",
        f"{CRATE}.solmix = 1e6; {CRATE}.solref = (-300., -5.)",
    ),
    trick(
        "excluded",
        "Crate and ground are excluded from each other, and the crate flies.",
        "spec.add_exclude(bodyname1='crate', bodyname2='world')",
    ),
    trick("bits_that_never_match", "Masks that never match.", f"{CRATE}.contype = {CRATE}.conaffinity = 2"),
    trick("one_sided_bits", "Only the ground asks.", f"{CRATE}.contype = 0"),
    trick("moving_ground", "The surface of the ground runs along.", f"{GROUND}.surfacevel = (.5, 0, 0, 0, 0, 0)"),
    trick("turning_ground", "The surface of the ground turns.", f"{GROUND}.surfacevel = (0, 0, 0, 0, 0, .8)"),
    trick(
        "moving_underside",
        "The underside of the crate runs backwards, like tracks.",
        f"{CRATE}.surfacevel = (-.5, 0, 0, 0, 0, 0)",
    ),
    Trick(
        "belt_by_a_namesake",
        "contact",
        "The plan names a launch speed; the ground's surface runs at that speed.",
        plan=(("# constants", 'constants: {launch_speed: {value: 0.35, unit: m/s, source: "the speed of a hand"}}'),),
        build=(f"{GROUND}.surfacevel = (.35, 0, 0, 0, 0, 0)",),
    ),
    trick("sticky", "Adhesion presses the crate down, so that it stops early.", f"{CRATE}.adhesion = 10"),
    trick("negative_adhesion", "Negative adhesion carries part of the weight.", f"{CRATE}.adhesion = -6"),
    Trick(
        "stick_by_a_namesake",
        "contact",
        "The plan names a stick's length; the crate adheres by that many newtons, and stops early.",
        plan=(
            ("# constants", 'constants: {stick_length: {value: 3.0, unit: m, source: "a stick"}}'),
            ("min_m: 0.55", "min_m: 0.1"),
            ("high: [0.35", "high: [-0.05"),
        ),
        build=(f"{CRATE}.adhesion = 3",),
    ),
    Trick(
        "trampoline_slight",
        "contact",
        "Contacts just stiffer than the step carries: a little further.",
        plan=SLIGHT,
        build=(f"for g in ({GROUND}, {CRATE}): g.solref = (-2e5, -2 * .6315 * 2e5**.5)",),
    ),
    Trick(
        "swapped_materials",
        "contact",
        "The runners get the surface of the box, which touches nothing, and the box that of the runners.",
        plan=RUNNERS,
        build=(
            "b = [g for g in spec.body('crate').geoms if g.contype or g.conaffinity]",
            "box = max(b, key=lambda g: g.size[2] * g.size[1]); runners = [g for g in b if g is not box]",
            "slip, grip = tuple(box.friction), tuple(runners[0].friction); box.friction = grip; [setattr(g, 'friction', slip) for g in runners]",
        ),
    ),
)
