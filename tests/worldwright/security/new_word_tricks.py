"""Newer words of a plan: stops, pairs, the medium, forms, copies, pretension, touch triggers, numbers measured again."""

from pathlib import Path
from typing import Any

from worldwright.model.evidence.reports import Sighting, VisualDescription
from worldwright.model.evidence.run import sha256_file
from worldwright.model.evidence.verdict import Recognition, Verdict

from . import forging
from .attack import Change, Touch, Trick
from .evidence_tricks import TRUE

ALL_OF = "geoms = spec.body({name!r}).geoms"
TURNED = "[(setattr(g, 'pos', (-g.pos[0], -g.pos[1], g.pos[2])), setattr(g, 'quat', (-g.quat[3], -g.quat[2], g.quat[1], g.quat[0]))) for g in geoms]"
"""Half a turn of every geom about the body's own vertical."""
FLIPPED = "[(setattr(g, 'pos', (g.pos[0], -g.pos[1], -g.pos[2])), setattr(g, 'quat', (-g.quat[1], g.quat[0], -g.quat[3], g.quat[2]))) for g in geoms]"
"""Half a turn about its own x."""
PAIRED = "pairs = [p for p in spec.pairs if {name!r} in (p.geomname1, p.geomname2)]"


def trick(
    name: str, does: str, body: str, expect: str, *build: str, plan: tuple[Change, ...] = (), **more: Any
) -> Trick:
    """A lie about one of the things of the yard."""
    rest = ", ".join(f"{{moves: {{body: {other}, min_m: 0.02}}}}" for other in MOVERS if other != body)
    claims = f"- {{claim: The {body} moves as it should not., expect: [{expect}]}}\n- {{claim: The others move., expect: [{rest}]}}"
    if body not in MOVERS:
        plan = (("tile, peg]", f"tile, peg, {body}]"), *plan)
    return Trick(name, "words", does, world="new-words", plan=(("# claims", claims), *plan), build=build, **more)


def moves(body: str, metres: float) -> str:
    return f"{{moves: {{body: {body}, min_m: {metres}}}}}"


def within(body: str, low: str, high: str, more: str = "") -> str:
    return (
        f"{{moves: {{body: {body}, min_m: 0.05}}}}, {{stays_within: {{body: {body}, low: {low}, high: {high}{more}}}}}"
    )


def constant(name: str, value: float, unit: str) -> tuple[Change, ...]:
    return (("# constants", f'constants: {{{name}: {{value: {value}, unit: {unit}, source: "of another place"}}}}'),)


def pushing(trigger: str) -> tuple[Change, ...]:
    row = f'interventions:\n  - {{kind: force, bodies: [cart], law: "constant force 3 N along +X", trigger: {trigger}, source: "a push"}}'
    return (("# interventions", row),)


def elsewhere(edit: forging.Edit) -> Touch:
    """The stamp says that another machine made it, with another trajectory; so only a tolerance is asked for."""

    def told(value: Any) -> Any:
        value["predicate"]["cpu"] = "another processor"
        value["predicate"]["proof"]["trajectory_sha256"] = "0" * 64
        return edit(value)

    return lambda run: forging.resealed(run, told)


def further(value: Any) -> Any:
    for expectation in value["predicate"]["expectations"]:
        if expectation["name"] == "moves":
            expectation["measured"], expectation["margin"] = 0.38, 0.1
    return value


def lit(share: str) -> tuple[Change, ...]:
    """A claim about the light at a place of the floor beside the crate."""
    claim = f"- {{claim: The floor is bright., expect: [{{light: {{camera: overview, of: brightness, place: [-0.3, 0, 0.2], {share}}}}}]}}"
    return (("# more objectives", claim),)


def painted(run: Path) -> None:
    import cv2
    import numpy as np

    stills = forging.folder_of(run) / "stills"
    for path in stills.glob("overview*.png"):
        cv2.imwrite(str(path), np.full_like(cv2.imread(str(path)), 255))
    forging.edited(
        stills / "result.json",
        lambda r: {
            **r,
            "files": {n: sha256_file(stills / n) if (stills / n).is_file() else h for n, h in r["files"].items()},
        },
    )
    forging.rewrite(run)


def brighter(value: Any, by: float = 0.5) -> Any:
    for expectation in value["predicate"]["expectations"]:
        if expectation["name"] == "light":
            expectation["measured"] += by
            expectation["margin"] += by
    return value


THING_SEEN, EVENT_SEEN = "a grey cube", "a blob comes to rest"


def blindly(description: VisualDescription) -> VisualDescription:
    sighting = Sighting(seen=THING_SEEN, camera="overview")
    return description.model_copy(
        update={
            "author": "a person",
            "named": (sighting,),
            "event": EVENT_SEEN,
            "belief": 9,
            "betrays": ("a", "b", "c"),
        }
    )


def recognised(verdict: Verdict, crate: str = THING_SEEN, event: str = EVENT_SEEN, doubted: bool = False) -> Verdict:
    doubt = (Recognition(wanted="crate", seen_as=THING_SEEN, same=False),) if doubted else ()
    rows = (
        Recognition(wanted="crate", seen_as=crate, same=True),
        Recognition(wanted="event", seen_as=event, same=True),
    )
    return verdict.model_copy(update={"recognised": (*doubt, *rows)})


PUSH = "data.body('cart').xfrc_applied[0] = 3.0"
MOVERS = ("sled", "ball", "arm", "cart", "marble", "pebble", "balloon", "tile", "peg_1", "peg_2", "peg_3")
STOP = "spec.joint('stopped')"

TRICKS = (
    trick(
        "stop_that_is_dead",
        "The plan's stop throws back; this one swallows.",
        "arm",
        within("arm", "[-9, -9, 0]", "[9, 9, 0.83]", ", window_s: [0.6, 1.0]"),
        f"{STOP}.solref_limit = (.02, 1)",
    ),
    trick(
        "stop_livelier_than_the_plan",
        "The stop throws the arm back nearly as fast as it came.",
        "arm",
        "{rises: {body: arm, min_m: 0.12}}",
        f"{STOP}.solref_limit = (-10000, -5)",
    ),
    trick(
        "stop_a_third_softer",
        "The stop has the plan's rebound, and gives way nearly three times as slowly.",
        "arm",
        "{falls: {body: arm, min_m: 0.206}}",
        f"z = -{STOP}.solref_limit[1] / (2 * (-{STOP}.solref_limit[0])**.5)",
        f"{STOP}.solref_limit = (-1 / .029**2, -2 * z / .029)",
    ),
    trick(
        "stop_off_in_the_plan_on_in_the_world",
        "The cart, which the plan lets run, is stopped.",
        "cart",
        within("cart", "[-9, -9, 0]", "[0.3, 9, 9]"),
        "spec.joint('rails').limited = True; spec.joint('rails').range = (-1, .25)",
    ),
    trick(
        "freedom_beside",
        "The arm also slides, by a joint beside its hinge that the plan lacks.",
        "arm",
        "{falls: {body: arm, min_m: 0.4}}",
        program=(
            (
                "    motion.launch(",
                "    spec.body('arm').add_joint(name='more', type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(0, 0, 1))\n    motion.launch(",
            ),
        ),
    ),
    trick(
        "pair_weaker",
        "The pair of sled and ground has a quarter of its friction.",
        "sled",
        moves("sled", 0.55),
        PAIRED.format(name="sled"),
        "[setattr(p, 'friction', [.1, .1, .005, .0001, .0001]) for p in pairs]",
    ),
    trick(
        "pair_left_out",
        "The pair is not there, so that the slippery materials count.",
        "sled",
        moves("sled", 0.55),
        PAIRED.format(name="sled"),
        "[spec.delete(p) for p in pairs]",
    ),
    trick(
        "pair_weaker_one_way",
        "Only along the way of the sled the pair has less friction.",
        "sled",
        moves("sled", 0.55),
        PAIRED.format(name="sled"),
        "[setattr(p, 'friction', [.1, .4, .005, .0001, .0001]) for p in pairs]",
    ),
    trick(
        "pair_livelier",
        "The pair of ball and ground rebounds higher by what counts as equal.",
        "ball",
        "{rises: {body: ball, min_m: 0.44}}",
        "from worldkit import contacts as c; s = c.surface(friction=.4, restitution=.948, time_constant=.008)['solref']",
        PAIRED.format(name="ball"),
        "[setattr(p, 'solref', s) for p in pairs]",
    ),
    trick(
        "pair_of_one_copy",
        "The pair of the third peg alone is slippery.",
        "peg_3",
        moves("peg_3", 0.55),
        PAIRED.format(name="peg_3"),
        "[setattr(p, 'friction', [.1, .1, .005, .0001, .0001]) for p in pairs]",
    ),
    trick(
        "copy_faster",
        "The second peg starts faster.",
        "peg_2",
        moves("peg_2", 0.5),
        "j = [j.name or b.name for b in spec.bodies for j in b.joints]",
        "k = spec.key('start'); k.qvel = [v * 1.5 if v == 1.5 and i > 6 else v for i, v in enumerate(k.qvel)]",
    ),
    trick(
        "copy_on_a_ball",
        "The third peg touches the ground with a ball inside.",
        "peg_3",
        moves("peg_3", 0.55),
        "g = spec.body('peg_3').geoms[0]; g.type, g.size = mujoco.mjtGeom.mjGEOM_ELLIPSOID, (.1, .1, .05)",
    ),
    trick(
        "copy_higher",
        "The second peg starts 3 mm higher.",
        "peg_2",
        "{falls: {body: peg_2, min_m: 0.0025}}",
        "spec.key('start').qpos = [v + .003 if v == .05 else v for v in spec.key('start').qpos]",
    ),
    trick(
        "wind_turned_round",
        "The plan's wind blows the other way.",
        "balloon",
        within("balloon", "[-9, -9, 0]", "[0.1, 9, 9]"),
        "spec.option.wind = (-6, 0, 0)",
    ),
    trick(
        "wind_turned_round_by_a_namesake",
        "The plan's wind blows the other way, and a constant knows its speed.",
        "balloon",
        within("balloon", "[-9, -9, 0]", "[0.1, 9, 9]"),
        "spec.option.wind = (-6, 0, 0)",
        plan=constant("wind_speed", 6, "m/s"),
    ),
    trick(
        "wind_still_by_a_namesake",
        "No wind blows, and a constant is nil.",
        "balloon",
        within("balloon", "[-9, -9, 0]", "[0.1, 9, 9]"),
        "spec.option.wind = (0, 0, 0)",
        plan=constant("wind_indoors", 0, "m/s"),
    ),
    trick(
        "water_by_a_namesake",
        "The plan's air is water, of which a constant knows the density.",
        "balloon",
        "{stays_within: {body: balloon, low: [-9, -9, 2.5], high: [9, 9, 9]}}",
        "spec.option.density = 1000.; spec.option.wind = (0, 0, 0)",
        plan=(
            (
                "# constants",
                'constants: {water_density: {value: 1000, unit: kg/m^3, source: "a table"}, wind_indoors: {value: 0, unit: m/s, source: "a room"}}',
            ),
        ),
    ),
    trick(
        "syrup_by_a_namesake",
        "The plan's air is as tough as syrup, of which a constant knows the viscosity.",
        "balloon",
        "{stays_within: {body: balloon, low: [-9, -9, 2.5], high: [9, 9, 9]}}",
        "spec.option.viscosity = 50.",
        plan=constant("syrup_viscosity", 50, "Pa*s"),
    ),
    trick(
        "vacuum_by_a_namesake",
        "There is no air, and a constant of nil knows it.",
        "balloon",
        within("balloon", "[-9, -9, 0]", "[0.1, 9, 9]"),
        "spec.option.density = 0.; spec.option.viscosity = 0.",
        plan=(
            (
                "# constants",
                'constants: {air_density: {value: 0, unit: kg/m^3, source: "space"}, space_viscosity: {value: 0, unit: Pa*s, source: "space"}}',
            ),
        ),
    ),
    trick(
        "spring_pulls_harder",
        "The spring starts with twice the plan's pretension.",
        "cart",
        moves("cart", 0.6),
        "spec.tendon('tow').springlength = [0, 0]",
    ),
    trick(
        "spring_yields",
        "The spring has a yield of its own.",
        "cart",
        within("cart", "[-9, -9, 0]", "[0.3, 9, 9]"),
        "spec.tendon('tow').springlength = [0, 1.5]",
    ),
    trick(
        "tile_sticks",
        "The tile hangs by adhesion that no material has.",
        "tile",
        "{stays: {body: tile, max_m: 0.05}}",
        "[setattr(g, 'adhesion', 5.) for g in spec.body('tile').geoms]",
    ),
    trick(
        "tile_sticks_by_a_namesake",
        "It adheres by as many newtons as a constant about a stick has metres.",
        "tile",
        "{stays: {body: tile, max_m: 0.05}}",
        "[setattr(g, 'adhesion', 3.) for g in spec.body('tile').geoms]",
        plan=constant("stick_length", 3, "m"),
    ),
    trick(
        "wedge_turned",
        "The ramp rises towards the other side, in the same box.",
        "marble",
        within("marble", "[-0.05, -9, 0]", "[9, 9, 9]"),
        ALL_OF.format(name="slope"),
        TURNED,
    ),
    trick(
        "hill_turned",
        "The hill falls towards the other side, in the same box and of the same volume.",
        "pebble",
        within("pebble", "[-9, -9, 0]", "[-0.1, 9, 9]"),
        ALL_OF.format(name="hillside"),
        TURNED,
    ),
    trick(
        "hill_of_another_profile",
        "The hill has a plateau before its slope, and the same volume: the pebble stays.",
        "pebble",
        "{stays: {body: pebble, max_m: 0.1}}",
        program=(("(0.5, 0.35), (1.0, 0.1), (1.5, 0.05)", "(0.6, 0.4), (0.62, 0.12), (1.5, 0.05)"),),
    ),
    trick(
        "vase_pointed",
        "The vase ends in a tip, and is wider at its waist: its volume is the same.",
        "top",
        "{falls: {body: top, min_m: 0.1}}",
        program=(
            ("(0.2, 0.1), (0.1, 0.2), (0.1, 0.3), (0.2, 0.4), (0.0, 0.4)", "(0.2, 0.1), (0.2, 0.17), (0.0, 0.4)"),
        ),
    ),
    trick(
        "cone_on_its_tip",
        "The cone touches with its tip down, in the same box.",
        "top",
        "{falls: {body: top, min_m: 0.1}}",
        ALL_OF.format(name="top"),
        FLIPPED,
    ),
    trick(
        "built_row_of_another_size",
        "The ramp is marked as written down from the program, and the program has another.",
        "marble",
        within("marble", "[-9, -9, 0.2]", "[9, 9, 9]"),
        program=(("size=(0.8, 0.4, 0.4)", "size=(2.4, 0.4, 0.4)"),),
        plan=(("role: a ramp,", "role: a ramp, built: true,"),),
    ),
    trick(
        "built_joint_of_another_range",
        "The hinge is marked as written down from the program, and its range is another.",
        "arm",
        "{falls: {body: arm, min_m: 0.25}}",
        f"{STOP}.range = (-90, 80)",
        plan=(("range: [-90, 40],", "range: [-90, 40], built: true,"),),
    ),
    trick(
        "mass_inferred_and_another",
        "The cart's mass is listed as inferred, and is half of it.",
        "cart",
        moves("cart", 0.6),
        "spec.body('cart').geoms[0].mass = 1",
        plan=(("inferred: [time_step,", "inferred: [masses.cart, time_step,"), ("masses, materials", "materials")),
    ),
    trick(
        "touch_that_never_is",
        "A push while the cart touches the ramp, which it never does.",
        "cart",
        moves("cart", 0.8),
        plan=pushing('"while cart touches slope"'),
        control=PUSH,
    ),
    trick(
        "touch_of_a_family",
        "A push while the cart touches a peg: no peg is called that, only its copies.",
        "cart",
        moves("cart", 0.8),
        plan=pushing('"while cart touches peg"'),
        control=PUSH,
    ),
    trick(
        "touch_in_other_words",
        "A push while the cart is touching the ramp.",
        "cart",
        moves("cart", 0.8),
        plan=pushing('"while cart is touching slope"'),
        control=PUSH,
    ),
    trick(
        "touch_of_any_of_two",
        "A push while the cart touches the ramp and always: the second half is not read.",
        "cart",
        moves("cart", 0.8),
        plan=pushing('"while cart touches slope, height of cart > 0.5 m"'),
        control=PUSH,
    ),
    Trick(
        "light_painted",
        "words",
        "A still is painted white before its light is measured, and every hash made to fit.",
        plan=(*TRUE, *lit("min_share: 0.9")),
        touch={"drawn": painted},
    ),
    Trick(
        "light_number_forged",
        "words",
        "For whoever: the stamp says a place is nearly white.",
        plan=(*TRUE, *lit("min_share: 0.01")),
        touch={"accepted": lambda run: forging.resealed(run, brighter)},
        anybody=True,
    ),
    Trick(
        "light_number_forged_elsewhere",
        "words",
        "For whoever: the stamp says another machine measured a little more light.",
        plan=(*TRUE, *lit("min_share: 0.01")),
        touch={"accepted": elsewhere(lambda value: brighter(value, 0.05))},
        anybody=True,
    ),
    Trick(
        "thing_recognised_in_the_event",
        "words",
        "Nobody named a crate; the sentence about what happens is given as what it was seen as.",
        plan=TRUE,
        tells=blindly,
        judges=lambda verdict: recognised(verdict, crate=EVENT_SEEN),
    ),
    Trick(
        "event_recognised_in_a_thing",
        "words",
        "What happens was not recognised; a thing's name is given for it.",
        plan=TRUE,
        tells=blindly,
        judges=lambda verdict: recognised(verdict, event=THING_SEEN),
    ),
    Trick(
        "recognised_after_all",
        "words",
        "The crate is said not to be recognised, and then that it is.",
        plan=TRUE,
        tells=blindly,
        judges=lambda verdict: recognised(verdict, doubted=True),
    ),
    Trick(
        "number_forged_elsewhere",
        "words",
        "For whoever: the stamp says another machine measured a third more.",
        plan=TRUE,
        touch={"accepted": elsewhere(further)},
        anybody=True,
    ),
)
