"""What solvers beside the engine read of shapes, and what they are told to take."""

from .attack import Change, Trick

AWAY = "{moves: {body: bar, min_m: 0.01}}, {stays_within: {body: bar, low: [0.165, -1, 0], high: [2, 1, 1]}}"
NEARER = "{moves: {body: bar, min_m: 0.01}}, {stays_within: {body: bar, low: [0, -1, 0], high: [0.175, 1, 1]}}"
COLD = "{{has_reading: {{channel: heat.temperature, body: stove, most: {}}}}}"
BOX = "type=mujoco.mjtGeom.mjGEOM_BOX"
DRAWN = "contype=0, conaffinity=0, mass=0"


def claims(bar: str, stove: str) -> Change:
    return (
        "# claims",
        f"- {{claim: What the bar does., expect: [{bar}]}}\n- {{claim: How cold it gets., expect: [{stove}]}}",
    )


HONEST = claims(NEARER, COLD.format(390))
"""The bar is pulled nearer, and the stove comes to 387.6 K."""


def trick(name: str, does: str, told: Change, *build: str, plan: tuple[Change, ...] = ()) -> Trick:
    return Trick(name, "fields", does, world="fields", plan=(told, *plan), build=build)


TRICKS = (
    trick(
        "magnet_turned",
        "The bar is turned end to end in its own box, and is pushed away.",
        claims(AWAY, COLD.format(390)),
        "spec.body('bar').geoms[0].quat = (0, 0, 0, 1)",
    ),
    trick(
        "magnet_of_two_halves",
        "The bar is two halves of one box, of which one is turned round and the other longer.",
        claims(AWAY, COLD.format(390)),
        "g = spec.body('bar').geoms[0]; a = dict(friction=g.friction, solref=g.solref, solimp=g.solimp)",
        "g.size, g.pos, g.mass = (.021, .02, .02), (.029, 0, 0), .168",
        f"spec.body('bar').add_geom({BOX}, size=(.029, .02, .02), pos=(-.021, 0, 0), mass=.232, quat=(0, 0, 0, 1), **a)",
    ),
    trick(
        "stove_with_unseen_fins",
        "A drawn mesh that touches nothing and weighs nothing enlarges what the stove cools over.",
        claims(NEARER, COLD.format(375)),
        "spec.add_mesh(name='fin', uservert=[0, 0, 0, .04, 0, 0, 0, .04, 0, 0, 0, .04])",
        f"[spec.body('stove').add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname='fin', {DRAWN}) for _ in range(60)]",
    ),
    trick(
        "stove_below_absolute_zero",
        "A source takes heat where none is left.",
        claims(NEARER, COLD.format(-100)),
        plan=(
            ("# constants", '  loss: {value: -30000, unit: W, source: "made up for a test"}'),
            ("cooling: cooling}", "cooling: cooling, source: loss}"),
        ),
    ),
)
