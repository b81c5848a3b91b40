"""Weight: the mass may be right, and act elsewhere or otherwise. A tall block tips, or not, by a centimetre."""

from .attack import Trick

CRATE = "spec.geom('crate')"
ALIKE = "g = spec.geom('ground'); a = dict(friction=g.friction, solref=g.solref, solimp=g.solimp, condim=g.condim)"


def trick(name: str, does: str, *build: str, plan: tuple[tuple[str, str], ...] = ()) -> Trick:
    return Trick(name, "weight", does, plan=plan, build=build)


SLIGHT = (("min_m: 0.55", "min_m: 0.294"),)
"""A claim of 2.5 % more than the plan's own world does."""
TALL = (
    ("size: [0.4, 0.3, 0.2]", "size: [0.2, 0.3, 0.46]"),
    (
        'friction: 0.4, restitution: 0.2, source: "made up for a test"}\n  ground: {friction: 0.4',
        'friction: 1.5, restitution: 0.0, source: "made up for a test"}\n  ground: {friction: 1.5',
    ),
    ("- moves: {body: crate, min_m: 0.55}", "- tips_over: {body: crate}"),
    ("    - stays_within: {body: crate, low: [-1, -1, -1], high: [0.35, 1, 1]}\n", ""),
    ("linear: [1.5, 0, 0]", "linear: [0.86, 0, 0]"),
)

TRICKS = (
    trick(
        "heavy_foot",
        "The weight lies at the foot.",
        "b = spec.body('crate'); b.explicitinertial = True; b.mass = 5; b.ipos = (0, 0, -.08); b.inertia = (.05, .08, .1)",
    ),
    trick(
        "small_inertia",
        "The crate turns as easily as a ball.",
        "b = spec.body('crate'); b.explicitinertial = True; b.mass = 5; b.inertia = (.005, .005, .005)",
    ),
    trick("shell", "The crate is a shell.", f"{CRATE}.typeinertia = mujoco.mjtGeomInertia.mjINERTIA_SHELL"),
    trick("heavier", "The crate weighs more.", f"{CRATE}.mass = 6"),
    trick(
        "hidden_ballast",
        "A weightless-looking child carries ballast, and the crate weighs less.",
        f"{CRATE}.mass = 4",
        "spec.body('crate').add_body(name='ballast', pos=(.1, 0, 0)).add_geom(size=(.02, 0, 0), mass=1, contype=0, conaffinity=0, rgba=(0, 0, 0, 0))",
    ),
    trick(
        "ballast_on_a_joint",
        "The ballast hangs on a joint of its own.",
        f"{CRATE}.mass = 4",
        "b = spec.body('crate').add_body(name='ballast'); b.add_joint(name='swing', axis=(0, 1, 0)); b.add_geom(size=(.02, 0, 0), pos=(0, 0, -.05), mass=1, contype=0, conaffinity=0)",
    ),
    trick(
        "ballast_on_a_joint_without_name",
        "The joint has no name.",
        f"{CRATE}.mass = 4",
        "b = spec.body('crate').add_body(name='ballast'); b.add_joint(axis=(0, 1, 0)); b.add_geom(size=(.02, 0, 0), pos=(0, 0, -.05), mass=1, contype=0, conaffinity=0)",
    ),
    trick(
        "flywheel",
        "A child spins on a joint of the crate's name.",
        "b = spec.body('crate').add_body(name='wheel'); j = b.add_joint(name='crate_wheel', axis=(0, 1, 0)); b.add_geom(size=(.05, 0, 0), mass=.01, contype=0, conaffinity=0)",
    ),
    trick(
        "massless_sled",
        "A weightless child with slippery runners carries the crate.",
        "c = spec.geom('crate'); c.size = (.2, .15, .099); c.pos = (0, 0, .001)",
        "spec.body('crate').add_body(name='sled').add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.2, .15, .01), pos=(0, 0, -.09), mass=0, friction=(.19, .005, .0001), solref=c.solref, solimp=c.solimp, condim=6)",
    ),
    trick(
        "sled_on_slides",
        "A child slides under the crate, with the plan's friction.",
        ALIKE,
        "b = spec.body('crate').add_body(name='sled'); b.add_joint(name='runner', type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0)); b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.2, .15, .002), pos=(0, 0, -.1), mass=.01, **a)",
    ),
    trick(
        "free_body_welded",
        "A second free body is welded on.",
        ALIKE,
        "b = spec.worldbody.add_body(name='rocket', pos=(-.3, 0, .4)); b.add_freejoint(); b.add_geom(size=(.05, 0, 0), mass=5, contype=0, conaffinity=0)",
        "spec.add_equality(name='weld', type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1='crate', name2='rocket')",
    ),
    trick(
        "faster_within_tolerance",
        "The crate starts 2 % faster, which counts as equal.",
        "spec.key('start').qvel[0] = 1.5299",
        plan=SLIGHT,
    ),
    trick("faster", "The crate starts at 2.2 m/s.", "spec.key('start').qvel[0] = 2.2"),
    trick("thrown_up", "The crate starts upwards, too.", "spec.key('start').qvel[2] = 2."),
    trick("spinning", "The crate starts spinning.", "spec.key('start').qvel[4] = -6."),
    trick(
        "lifted_within_tolerance",
        "The crate starts 4.9 mm high.",
        "spec.key('start').qpos[2] = .1049",
        plan=(("- moves: {body: crate, min_m: 0.55}", "- falls: {body: crate, min_m: 0.004}"),),
    ),
    trick(
        "ahead_within_tolerance",
        "The crate starts 4.9 mm ahead, and so ends there.",
        "spec.key('start').qpos[0] = -.2951",
        plan=(
            (
                "- moves: {body: crate, min_m: 0.55}",
                "- reaches: {body: crate, place: [-0.0082, 0, 0.1], tolerance_m: 0.001}",
            ),
        ),
    ),
    trick(
        "turned_within_tolerance",
        "The crate starts turned by one degree.",
        "spec.key('start').qpos[3], spec.key('start').qpos[6] = .99996, .0087",
        plan=(
            (
                "- moves: {body: crate, min_m: 0.55}",
                "- ends_facing: {body: crate, axis: x, direction: [1, 0.0174, 0], max_angle_deg: 0.5}",
            ),
        ),
    ),
    trick("started_elsewhere", "The crate starts 30 cm ahead.", "spec.key('start').qpos[0] = 0."),
    trick(
        "tipped_start",
        "The crate starts tipped.",
        "spec.key('start').qpos[3], spec.key('start').qpos[5] = .966, .259; spec.key('start').qpos[2] = .3",
    ),
    trick("clock_ahead", "The start's clock stands at 0.6 s.", "spec.key('start').time = .6"),
    trick("clock_behind", "The start's clock stands before zero.", "spec.key('start').time = -1."),
    trick(
        "second_start",
        "A second keyframe has a faster start.",
        "k = spec.add_key(name='start2'); k.qpos = spec.key('start').qpos; k.qvel = [2.2, 0, 0, 0, 0, 0]",
    ),
    trick(
        "start_under_another_name",
        "The planned start is renamed, and a faster one takes its name.",
        "k = spec.key('start'); k.name = 'rest'; n = spec.add_key(name='start'); n.qpos = k.qpos; n.qvel = [2.2, 0, 0, 0, 0, 0]",
    ),
    trick(
        "reference_moved",
        "The free body's built pose is another than its start's.",
        "spec.body('crate').pos = (.3, 0, .1)",
    ),
    trick(
        "balance_within_tolerance",
        "The centre of mass is 1 cm higher, which counts as equal: a tall crate tips where it should stand.",
        "b = spec.body('crate'); b.explicitinertial = True; b.mass = 5.05; b.ipos = (.011, 0, .003); b.inertia = (5 / 12 * (.3**2 + .46**2) * .96, 5 / 12 * (.2**2 + .46**2) * .96, 5 / 12 * (.2**2 + .3**2))",
        plan=TALL,
    ),
)
