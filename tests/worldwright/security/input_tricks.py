"""Inputs: what `control` sends is not what the plan declares, or is not for what it was declared."""

from .attack import Change, Trick

CRATE = "crate"
PUSH = "data.body('crate').xfrc_applied[0] = 10.1"
MOTOR = (("# claims", "- {claim: The cart comes 1 m far., expect: [{moves: {body: cart, min_m: 0.9}}]}"),)
EARLY = (("min_m: 0.55", "min_m: 0.1"), ("high: [0.35", "high: [-0.05"))


def declared(kind: str, law: str, bodies: str = "crate", trigger: str = "always") -> Change:
    """A row of the plan, as a change of the sliding crate's."""
    row = f'{{kind: {kind}, bodies: [{bodies}], law: "{law}", trigger: "{trigger}", source: "the prompt says so"}}'
    return ("# interventions", f"interventions:\n  - {row}")


def trick(name: str, does: str, control: str, *plan: Change, build: tuple[str, ...] = (), early: bool = False) -> Trick:
    return Trick(name, "inputs", does, plan=(*plan, *(EARLY if early else ())), control=control, build=build)


def motor(name: str, does: str, control: str, *plan: Change) -> Trick:
    return Trick(name, "inputs", does, world="workshop", plan=(*MOTOR, *plan), control=control)


TRICKS = (
    motor("motor_told_more", "The motor of 2 N is told 4 N.", "data.ctrl[0] = 4."),
    motor(
        "motor_told_more_later",
        "The motor of 2 N is told 9 N from the middle on.",
        "data.ctrl[0] = 2. if data.time < .5 else 9.",
    ),
    motor(
        "motor_told_a_pulse",
        "The motor is told a pulse of a kilonewton in one step.",
        "data.ctrl[0] = 1000. if data.time == 0 else 2.",
    ),
    motor("motor_told_no_number", "The motor is told what is no number.", "data.ctrl[0] = float('nan')"),
    motor("motor_told_a_huge_number", "The motor is told 1e300.", "data.ctrl[0] = 1e300"),
    motor(
        "motor_with_another_law",
        "The plan says at most 2 N; a servo of 40 N follows the claim.",
        "data.ctrl[0] = 40. * (1.0 - data.body('cart').xpos[0])",
    ),
    trick("force_undeclared", "A force that nobody declared.", PUSH),
    trick("velocity_undeclared", "The velocity is written.", "data.qvel[0] = .7"),
    trick("pose_undeclared", "The pose is written.", "data.qpos[0] = -.3 + .6 * min(1, data.time)"),
    trick("joint_force_undeclared", "A force of the joint is written.", "data.qfrc_applied[0] = 10."),
    trick("friction_undeclared", "The friction is written.", "model.geom_friction[:, 0] = .19"),
    trick("gravity_undeclared", "Gravity is written.", "model.opt.gravity[2] = -4.7"),
    trick(
        "derived_forces",
        "What the engine derives is written.",
        "data.qfrc_bias[0] = -10.\ndata.qfrc_passive[0] = 10.\ndata.qacc[0] = 3.\ndata.qacc_warmstart[0] = 3.",
    ),
    trick("time_undeclared", "The time is written.", "data.time = 0."),
    trick("contacts_undeclared", "Contacts are taken away.", "data.contact.friction[:] = 0.01"),
    trick(
        "callback",
        "A callback of the engine pushes.",
        "mujoco.set_mjcb_passive(lambda m, d: d.qfrc_passive.__setitem__(0, 10.))",
    ),
    trick(
        "stepping_itself", "The program steps the world itself.", "for _ in range(50):\n    mujoco.mj_step(model, data)"
    ),
    trick(
        "force_as_declared_but_larger",
        "Declared at most 1 N, and 10 N act.",
        PUSH,
        declared("force", "a breeze of at most 1 N along +X"),
    ),
    trick(
        "force_the_other_way",
        "Declared as a brake of 10.1 N against the motion; it pushes.",
        PUSH,
        declared("force", "a brake of 10.1 N against the motion"),
    ),
    trick("force_without_number", "Declared in words without a number.", PUSH, declared("force", "a gentle breeze")),
    trick(
        "force_with_a_number_in_passing",
        "The law says 1 N, and names another number in passing.",
        PUSH,
        declared("force", "a breeze of 1 N along +X, far below its weight of 49 N"),
    ),
    trick(
        "force_before_its_trigger",
        "Declared from 0.9 s on, and it acts at once.",
        PUSH,
        declared("force", "a breeze of 10.1 N", trigger="at t = 0.9 s"),
    ),
    trick(
        "force_without_its_trigger",
        "Declared for when the crate is 5 m high.",
        PUSH,
        declared("force", "a breeze of 10.1 N", trigger="height of crate > 5 m"),
    ),
    trick(
        "force_with_a_vague_trigger",
        "Declared for when it is needed.",
        PUSH,
        declared("force", "a breeze of 10.1 N", trigger="when it is needed"),
    ),
    trick("torque_for_force", "A torque is declared, a force acts.", PUSH, declared("torque", "a twist of 10.1 N m")),
    trick(
        "many_small_velocities",
        "Declared at most 0.05 m/s; it is added at every step.",
        "data.qvel[0] += .0042",
        declared("velocity", "a nudge of at most 0.05 m/s"),
    ),
    trick(
        "velocity_of_no_number",
        "Declared in words, the velocity is held.",
        "data.qvel[0] = .62",
        declared("velocity", "its speed is smoothed"),
    ),
    trick(
        "pose_for_another_purpose",
        "Declared to straighten it; it is carried along.",
        "data.qpos[0] += .0006",
        declared("pose", "its yaw is straightened"),
    ),
    trick(
        "pose_jump",
        "Declared to straighten it; it is carried along at once, late.",
        "if data.time > .9 and data.qpos[0] < .2:\n    data.qpos[0] += .31",
        declared("pose", "its yaw is straightened"),
    ),
    trick(
        "colour_for_damping",
        "A parameter of the crate is declared for its colour; a negative damping is written.",
        "model.dof_damping[:3] = -9.",
        declared("parameter", "its colour turns red while it slides"),
    ),
    trick(
        "colour_for_inertia",
        "A parameter of the crate is declared for its colour; its inertia is written.",
        "model.dof_armature[:3] = 6.",
        declared("parameter", "its colour turns red while it slides"),
    ),
    trick(
        "colour_for_slope",
        "A parameter of the world is declared for the colour of its floor; the floor is turned.",
        "model.geom_quat[0] = .9962, 0, .0872, 0\nmodel.geom_pos[0] = -.5, 0, 0",
        declared("parameter", "the floor turns red", bodies="ground, world"),
    ),
    trick(
        "colour_for_structure",
        "A parameter is declared for its colour; the index of a body is written, far outside of every array.",
        "model.jnt_qposadr[0] = 1 << 24",
        declared("parameter", "its colour turns red"),
    ),
    trick(
        "colour_for_a_family",
        "A parameter is declared for its colour; the crate's geom is given to the world.",
        "if data.time > .1:\n    model.body_dofnum[1] = 3",
        declared("parameter", "its colour turns red"),
    ),
    trick(
        "wet_floor",
        "The friction of the ground is declared to be 0.39; 0.19 is written.",
        "model.geom_priority[0] = 1\nmodel.geom_friction[0, 0] = .19",
        declared("parameter", "the floor gets wet: friction 0.39", bodies="ground, world"),
    ),
    trick(
        "wet_crate",
        "The friction of the crate is declared to be 0.39; 0.1 is written, and the ground's too.",
        "model.geom_friction[:, 0] = .1",
        declared(
            "parameter",
            "it gets wet: friction 0.39",
            bodies="crate.geom_friction, ground.geom_friction, world.geom_friction",
        ),
    ),
    trick(
        "gravity_as_a_parameter",
        "Gravity is declared to flicker by a thousandth; it is halved.",
        "model.opt.gravity[2] = -4.7",
        declared("parameter", "gravity flickers by 0.01 m/s^2", bodies="opt.gravity"),
    ),
    trick(
        "wind_as_a_parameter",
        "A wind is declared that is a breeze; it is a storm.",
        "model.opt.density = 60.\nmodel.opt.wind[0] = 3.3",
        declared("parameter", "a breeze of 1 m/s", bodies="opt.wind, opt.density"),
    ),
    trick(
        "solver_for_everything",
        "A solver is declared for the air; it writes velocities.",
        "data.qvel[0] = .62",
        declared("solver", "forces of the air on the crate"),
    ),
    trick(
        "name_of_an_input_frees_the_weight",
        "A force of no consequence is declared; by its name the crate may be lighter.",
        "data.body('crate').xfrc_applied[1] = .001",
        declared("force", "a breath of 0.01 N"),
        build=("setattr(spec.body('crate'), 'grav' + 'comp', .52)",),
    ),
    trick(
        "name_of_an_input_frees_a_wall",
        "A constraint is declared; a wall has its name.",
        "pass",
        declared("constraint", "a latch, which never lets go", bodies="latch"),
        build=(
            "g = spec.geom('ground'); a = dict(friction=g.friction, solref=g.solref, solimp=g.solimp, condim=g.condim); b = spec.worldbody.add_body(name='latch', pos=(.18, 0, .1)); b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.05, .3, .1), rgba=(0, 0, 0, 0), **a)",
        ),
        early=True,
    ),
    trick(
        "name_of_an_input_frees_a_spring",
        "A constraint is declared; a spring has its name.",
        "pass",
        declared("constraint", "a latch, which never lets go", bodies="latch"),
        build=(
            "a = spec.worldbody.add_site(name='far', pos=(3, 0, .1)); b = spec.body('crate').add_site(name='near'); t = spec.add_tendon(name='latch', stiffness=[3.6, 0, 0], springlength=[0, 0]); t.wrap_site('far'); t.wrap_site('near')",
        ),
    ),
    trick(
        "latch_that_pulls",
        "A latch is declared that holds; it is soft, and holds the crate a metre ahead.",
        "pass",
        declared("constraint", "a latch, which lets go under load", bodies="latch", trigger="load > 400 N"),
        build=(
            "e = spec.add_equality(name='latch', type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1='crate'); e.data[:11] = [0, 0, 0, -.4, 0, -.1, 1, 0, 0, 0, 1]; e.solref = (-4, -1)",
        ),
    ),
    trick(
        "latch_by_the_clock",
        "A latch is declared that lets go under load; it lets go by the clock.",
        "data.eq_active[0] = data.time < .1",
        declared("constraint", "a latch, which lets go under load", bodies="latch", trigger="load > 400 N"),
        build=(
            "e = spec.add_equality(name='latch', type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1='crate'); e.data[:11] = [0, 0, 0, .3, 0, -.1, 1, 0, 0, 0, 1]",
        ),
        early=True,
    ),
    trick(
        "latch_at_the_right_moment",
        "A latch is declared that never holds the crate; it is closed when the crate is where it should stop.",
        "data.eq_active[0] = data.body('crate').xpos[0] > -.12",
        declared(
            "constraint",
            "a latch that is open until something heavy falls on it",
            bodies="latch",
            trigger="load > 400 N",
        ),
        build=(
            "e = spec.add_equality(name='latch', type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY, name1='crate', active=False); e.data[:11] = [0, 0, 0, .11, 0, -.1, 1, 0, 0, 0, 1]",
        ),
        early=True,
    ),
)
