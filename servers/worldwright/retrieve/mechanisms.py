"""Mechanisms: what makes a world happen, as a sentence says it and as a plan has it, and the skill that explains it.

Each row reads: name; words of a sentence (`*`: any ending; several words must all occur); expectations that measure it; skill.
"""

import re
from collections.abc import Iterator
from functools import cache
from typing import NamedTuple

from ..model.plan import robots_declared
from ..model.plan.committed import Plan

_TABLE = """
    rope     ; string, rope, cord, tether*, chain, yo-yo, yoyo, kite, crane, hang, hung, pulley, hoist ; keeps_length ; tendons-and-ropes
    swinging ; swing, pendul*, sway, cradle, wrecking, metronome ; has_period, rings_down, oscillates, keeps_amplitude ; joints-and-actuators
    turning  ; turn, rotat*, wheel, mill, windmill, door, hinge, pivot*, see-saw, seesaw, lever, crank, axle, propell*, clock, carousel, spin, orbit, circl* ; orbits, circles, turns, reaches_spin, spins_at_constant_rate, precesses ; joints-and-actuators
    spring   ; spring, catapult*, slingshot, bow, arrow, jack-in-the-box, trampolin*, elastic*, bungee ; spring_becomes_kinetic ; tendons-and-ropes
    motor    ; motor*, drive, driven, servo, engine, machine, conveyor, pump ; ; joints-and-actuators
    rolling  ; roll, marble, slope, ramp, hill, downhill ; rolls_without_slipping ; contacts-and-friction
    sliding  ; slid*, push, drag, skid, sled, sledge, puck, curling ; slides, slides_and_stops, sticks ; contacts-and-friction
    flight   ; throw, thrown, hurl, shoot, shot, kick, toss, jump, leap, fly, flies, flight, trajector*, cannon*, launch ; follows_parabola ; cameras
    bouncing ; bounc*, drop, rebound*, dribbl* ; bounces, rebounds ; materials
    impact   ; collid*, collision, strik*, struck, hit, knock, crash, billiard*, cradle, hammer*, bowling ; opposite_directions ; contacts-and-friction
    tipping  ; tip, toppl*, domino*, fall over, lean, balanc*, ladder*, wobbl*, overturn*, see-saw, seesaw ; tips_over ; solver-and-time-step
    stacking ; stack, pile, tower, brick ; ; layouts
    crowded  ; laid, crowd*, bookshel*, dining, dinner, desk, workshop, street ; ; layouts
    air      ; wind, blow, blown, breez*, draught, carried away, carried off, parachut*, feather, leaf, flutter*, sail, flag, kite, windmill, gust, air ; ; fluid-drag-and-wind
    water    ; water, float, sink, swim, boat, ship, raft, river, pond, lake, wave, buoy* ; floats, sinks, surfaces ; fluid-drag-and-wind
    flowing  ; pour*, flow, flows, flowing, flowed, paint* blend*, paint* mix*, spill*, splash*, drip*, ooz*, honey, syrup, caramel, batter, molten, sand, snow, snowfall, snowflake* ; pours_into, covers, blends ; media
    stirred  ; stir, stirred, stirring, stirs, swirl*, vortex*, vortic*, whirlpool*, whirl, plughole*, bath drain*, basin drain*, sink drain*, tub drain*, tornado glass, tornado bottle, tornado jar, milk coffee, cream coffee, milk tea ; swirls_round ; media
    inflated ; balloon, inflat*, deflat*, airbag, bottle deform*, bottle cool*, bottle collaps*, bottle crush*, bottle shrink*, vacuum ; has_volume ; media
    soft     ; cloth, flag, curtain, towel, jelly, rubber, sponge, soft*, bend, bent, hose, cable, branch, bough, twig, reed, tree ; sags, bends, stretches, keeps_new_shape, returns_to_shape ; flex-cloth-soft-rods
    pressed  ; squeez*, compress*, squash*, sponge, foam, cushion, pillow, mattress, dough, knead*, dent, indent*, mould*, mold*, putty, plasticine, lump clay, clay squeez*, clay press*, clay flatten* ; ; media
    breaking ; break, broke, broken, snap, shatter*, crack, tear, torn, burst, fractur*, collaps* ; breaks, breaks_at, comes_apart ; breakable-things
    figure   ; person, man, woman, child, dancer, gymnast, doll, puppet, walk, acrobat, fist, finger*, hand squeez*, hand hold*, hand held, hand press*, hand put*, hand pour* ; ; articulated-figures
    vehicle  ; car, truck, cart, bicycl*, bike, train, wagon, vehicl*, tractor, skateboard* ; ; vehicles
    force    ; attract*, repel*, planet*, thrust, rocket ; ; custom-forces
    field    ; magnet*, electr*, eddy, charge, charged, copper tube, copper pipe ; has_reading ; fields
    heat     ; melt*, heat*, warms, cools, temperature, red-hot ; has_reading ; fields
    robot    ; robot*, humanoid, quadruped, drone, quadcopter*, gripper ; ; robots
    model    ; urdf, mjcf ; ; importing-models
"""

UNLESS = {"pressed": "spring"}
"""What is pressed is soft matter by itself, and no mechanism of its own where the sentence names what else gives way."""
ELASTIC = re.compile(r"neo-hookean|elastic|rubber|foam", re.IGNORECASE)
"""What the author's own law of a soft solid speaks of."""
WIND = {"wind", "opt.wind"}
"""What an intervention that is a wind speaks of."""
LIQUID = 100.0
"""kg/m^3: what is denser is a liquid; no gas of a plan comes near, and every liquid is several times as dense."""


class Mechanism(NamedTuple):
    """One row of the table."""

    name: str
    said: tuple[tuple[str, ...], ...]
    """Phrases; each a tuple of words."""
    measured: tuple[str, ...]
    """Names of expectations."""
    skill: str


@cache
def table() -> tuple[Mechanism, ...]:
    """Every mechanism, in the order of the table."""
    rows = []
    for line in _TABLE.strip().splitlines():
        name, said, measured, skill = (part.strip() for part in line.split(";"))
        phrases = tuple(tuple(phrase.split()) for phrase in said.split(",") if phrase.strip())
        rows.append(Mechanism(name, phrases, tuple(measured.replace(",", " ").split()), skill))
    return tuple(rows)


def of_sentence(sentence: str) -> tuple[str, ...]:
    """The mechanisms that a sentence names.

    >>> of_sentence("a steady wind turns a windmill")
    ('turning', 'air')
    """
    spoken = re.findall(r"[a-z][a-z-]*", sentence.lower())
    found = [
        row.name
        for row in table()
        if any(all(any(_means(word, part) for word in spoken) for part in phrase) for phrase in row.said)
    ]
    return tuple(name for name in found if UNLESS.get(name) not in found)


def _means(word: str, part: str) -> bool:
    """Whether a word is one of the table: in a simple form of it, or beginning with it where it ends with `*`."""
    if part.endswith("*"):
        return word.startswith(part[:-1])
    return word == part or _forms(part).fullmatch(word) is not None


@cache
def _forms(part: str) -> re.Pattern[str]:
    """What a word of the table is spoken as besides itself."""
    last = re.escape(part[-1])
    stem, ending = (re.escape(part[:-1]), "e") if part.endswith("e") else (re.escape(part), "")
    return re.compile(rf"{stem}(?:{ending}s?|es|ed|er|ers|ing|{last}ed|{last}ing)")


def of_plan(plan: Plan) -> tuple[str, ...]:
    """The mechanisms that a plan has, by its sections and by what it measures."""
    found = {*of_sentence(plan.title), *_built(plan)}
    names = {name for objective in plan.objectives for row in objective.expect for name in row}
    found |= {row.name for row in table() if any(name in row.measured for name in names)}
    return tuple(row.name for row in table() if row.name in found)


def _built(plan: Plan) -> Iterator[str]:
    topology, parameters = plan.topology, plan.simulation_parameters
    if any(not tendon.stiffness for tendon in topology.tendons):
        yield "rope"
    if any(tendon.stiffness for tendon in topology.tendons) or any(joint.stiffness for joint in topology.joints):
        yield "spring"
    if any(joint.type in ("hinge", "ball") for joint in topology.joints):
        yield "turning"
    if topology.actuators:
        yield "motor"
    if any(robots_declared.does(row) is not None for row in plan.assets):
        yield "robot"
    if any(row.vehicle is not None for row in plan.assets):
        yield "vehicle"
    if parameters.medium is not None and parameters.medium.density > LIQUID:
        yield "water"  # its wind is a current
    elif parameters.medium is not None or any(WIND & {*i.bodies, *i.law.split()} for i in parameters.interventions):
        yield "air"
    laws = [row.law for row in parameters.interventions if row.solver and row.solver.file]
    if any(ELASTIC.search(law) for law in laws) or any(
        row.soft and row.soft.kind == "jelly" for row in plan.scene_objects
    ):
        yield "pressed"
    if any(row.breaks for row in plan.scene_objects):
        yield "breaking"
    if plan.layout_density:
        yield "crowded"


def skills(names: tuple[str, ...]) -> tuple[str, ...]:
    """The skills of mechanisms, each once."""
    return tuple(dict.fromkeys(row.skill for row in table() if row.name in names))
