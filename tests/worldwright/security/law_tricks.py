"""Laws: one option changes every contact or every joint at once."""

from .attack import Trick

OPTION = "spec.option."
OFF = "spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_{})"
ON = "spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_{})"
BY_NUMBER = "setattr(spec.option, 'disableflags', {})"


def trick(name: str, does: str, *build: str) -> Trick:
    return Trick(name, "laws", does, build=build)


TRICKS = (
    trick("weak_gravity", "Half the gravity is half the friction.", OPTION + "gravity = (0, 0, -4.7)"),
    trick("leaning_gravity", "Gravity leans forward.", OPTION + "gravity = (1.95, 0, -9.61)"),
    trick(
        "barely_leaning_gravity",
        "Gravity leans by its comparison's tolerance.",
        OPTION + "gravity = (9e-7, 0, -9.8091)",
    ),
    trick("no_gravity", "No gravity, by its flag.", OFF.format("GRAVITY")),
    trick("no_gravity_by_number", "The flag by its number, which no reader sees.", BY_NUMBER.format(1 << 7)),
    trick("no_contact_by_number", "Contacts are off, by number.", BY_NUMBER.format(1 << 4)),
    trick("no_constraints", "All constraints are off.", OFF.format("CONSTRAINT")),
    trick("no_warm_start", "The solver starts cold.", OFF.format("WARMSTART"), OPTION + "ls_iterations = 3"),
    trick("no_islands", "No islands.", OFF.format("ISLAND"), OPTION + "ls_iterations = 4"),
    trick("one_line_search", "The line search of the solver stops after one step.", OPTION + "ls_iterations = 1"),
    trick("three_line_searches", "Three steps of line search: a little further.", OPTION + "ls_iterations = 3"),
    trick("four_line_searches", "Four steps: exactly as far as is claimed.", OPTION + "ls_iterations = 4"),
    trick(
        "loose_line_search",
        "A line search that is content at once.",
        OPTION + "ls_tolerance = 1.0",
        OPTION + "ls_iterations = 4",
    ),
    trick(
        "gradient_solver",
        "Conjugate gradients with one step of line search.",
        OPTION + "solver = mujoco.mjtSolver.mjSOL_CG",
        OPTION + "ls_iterations = 1",
    ),
    trick(
        "projecting_solver",
        "Gauss-Seidel with one iteration.",
        OPTION + "solver = mujoco.mjtSolver.mjSOL_PGS",
        OPTION + "iterations = 1",
    ),
    trick("content_solver", "Any solution will do.", OPTION + "tolerance = 10."),
    trick("one_iteration", "The solver stops after one iteration.", OPTION + "iterations = 1"),
    trick("no_iteration", "The solver does not begin.", OPTION + "iterations = 0"),
    trick(
        "careless_collision",
        "Collisions are looked for with one iteration.",
        OPTION + "ccd_iterations = 1",
        OPTION + "ccd_tolerance = 1.",
    ),
    trick(
        "impratio",
        "Friction that is softer than the normal.",
        OPTION + "impratio = .001",
        OPTION + "cone = mujoco.mjtCone.mjCONE_ELLIPTIC",
    ),
    trick("pyramid", "Friction in four directions.", OPTION + "cone = mujoco.mjtCone.mjCONE_PYRAMIDAL"),
    trick(
        "override", "One set of parameters for every contact.", ON.format("OVERRIDE"), OPTION + "o_friction = [.19] * 5"
    ),
    trick("override_margin", "One margin for every contact.", ON.format("OVERRIDE"), OPTION + "o_margin = .05"),
    trick("no_slip", "A second solver takes the slip out.", OPTION + "noslip_iterations = 50"),
    trick("tail_wind", "A wind in a medium.", OPTION + "wind = (20, 0, 0)", OPTION + "density = 60."),
    trick("thick_air", "A medium that carries.", OPTION + "density = 120."),
    trick("honey", "A viscous medium stops it early.", OPTION + "viscosity = 5."),
    Trick(
        "medium_by_a_namesake",
        "laws",
        "The plan names the density of wood; the air has it, and stops the crate early.",
        plan=(
            ("# constants", 'constants: {wood_density: {value: 200, unit: kg/m^3, source: "balsa, a table"}}'),
            ("min_m: 0.55", "min_m: 0.1"),
            ("high: [0.35", "high: [-0.04"),
        ),
        build=(OPTION + "density = 200.",),
    ),
    Trick(
        "wind_from_the_other_side",
        "laws",
        "The plan names a wind and its source says against the crate; it blows from behind.",
        plan=(
            (
                "# constants",
                'constants: {air_density: {value: 1.2, unit: kg/m^3, source: "at 20 C"}, wind_speed: {value: 90, unit: m/s, source: "head wind, against the crate"}}',
            ),
            ("min_m: 0.55", "min_m: 0.4"),
            ("high: [0.35", "high: [1.10"),
        ),
        build=(OPTION + "density = 1.2", OPTION + "wind = (90., 0, 0)"),
    ),
    trick("another_step", "A step of 2 ms and a hundredth.", OPTION + "timestep = .00202"),
    trick("a_slow_clock", "The step is half the plan's.", OPTION + "timestep = .001"),
    trick("another_integrator", "Explicit Euler.", OPTION + "integrator = mujoco.mjtIntegrator.mjINT_EULER"),
    trick(
        "sleep_early",
        "Bodies sleep while they move, so that the crate stops early.",
        ON.format("SLEEP"),
        OPTION + "sleep_tolerance = 5.",
    ),
    trick(
        "sleep_within_tolerance",
        "Sleep as it may be switched on, and a crate that starts asleep.",
        ON.format("SLEEP"),
        "spec.body('crate').sleep = mujoco.mjtSleepPolicy.mjSLEEP_INIT",
    ),
    trick("barrier_contact", "Contacts by a barrier.", ON.format("IPC")),
    trick("speculative_contact", "Contacts ahead of time.", ON.format("SPECULATIVE")),
    trick("discrete_inverse", "The inverse of the discrete step.", ON.format("INVDISCRETE")),
    trick("heavy_joint", "Armature on the crate's joint.", "spec.joints[0].armature = 4."),
    trick("pushing_damping", "Negative damping pushes it along.", "spec.joints[0].damping[0] = -9."),
    trick("quadratic_damping", "Damping by the square of the speed, negative.", "spec.joints[0].damping[1] = -6."),
    trick(
        "dry_friction_of_the_joint",
        "Dry friction of the free joint, so that it stops early.",
        "spec.joints[0].frictionloss = 3.",
    ),
    trick(
        "spring_of_the_joint", "A spring on the free joint, whose rest is ahead.", "spec.joints[0].stiffness[0] = 20."
    ),
    trick("less_weight", "Half of its weight is compensated.", "spec.body('crate').gravcomp = .52"),
    trick("a_little_less_weight", "A thousandth of its weight is compensated.", "spec.body('crate').gravcomp = 1e-3"),
    Trick(
        "damping_by_a_namesake",
        "laws",
        "The plan names the damping of a shock absorber; the crate's own joint has it, and it stops early.",
        plan=(
            ("# constants", 'constants: {absorber_damping: {value: 6.0, unit: N s/m, source: "a data sheet"}}'),
            ("min_m: 0.55", "min_m: 0.1"),
            ("high: [0.35", "high: [-0.05"),
        ),
        build=("spec.joints[0].damping[0] = 6.",),
    ),
    Trick(
        "dry_friction_by_a_namesake",
        "laws",
        "The plan names a friction of 3; the joint of the crate has a frictionloss of 3 N.",
        plan=(
            ("# constants", 'constants: {bearing_friction: {value: 3.0, unit: N, source: "a data sheet"}}'),
            ("min_m: 0.55", "min_m: 0.1"),
            ("high: [0.35", "high: [-0.04"),
        ),
        build=("spec.joints[0].frictionloss = 3.",),
    ),
    Trick(
        "armature_by_a_namesake",
        "laws",
        "The plan names an armature of a motor; the crate has it.",
        plan=(("# constants", 'constants: {motor_armature: {value: 6.0, unit: kg, source: "a data sheet"}}'),),
        build=("spec.joints[0].armature = 6.",),
    ),
    Trick(
        "six_line_searches",
        "laws",
        "Six steps of line search: a little further than the plan's world.",
        plan=(("min_m: 0.55", "min_m: 0.294"),),
        build=(OPTION + "ls_iterations = 6",),
    ),
)
