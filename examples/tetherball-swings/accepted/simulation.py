"""A tetherball is hit and circles its pole, held on its way by the rope.

What the plan claims of it:
- The glove, swung by its spring, hits the ball, and the hit sends it round the pole.
- The tension of the rope keeps it on a circle about the pole.
- It circles high, the rope slanting at about 45 degrees, and neither droops nor is driven on.
- One hit is all that touches it; it clears the pole, the post, the arm and the court.
- It reads as a tetherball court on a lawn, a yellow ball on a pale rope, and a boxing glove that serves it.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import bodies, cameras, contacts, joints, motion, program, scene, tendons

TIME_STEP = 0.0005  # s
DURATION = 6.5  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
AIR_DENSITY = 0.0  # kg/m^3; idealisation: drag of 0.17 N at 4 m/s against 3.92 N of weight is left out
ROPE_RADIUS = 0.006  # m; a tetherball cord of 12 mm, for drawing it

# ball_skin: inferred: The Physics Factbook, handball 0.75 on a hard floor, less what a padded glove takes; the pair
# shares both numbers
BALL_SKIN = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.6, time_constant=4 * TIME_STEP
)
# glove_leather: the same pair
GLOVE_LEATHER = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.6, time_constant=4 * TIME_STEP
)
# ash_wood: wood handbook, ash
ASH_WOOD = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=680.0)
# steel: Gere, Mechanics of Materials, appendix; friction of painted steel, inferred
STEEL = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=7850.0)
# court_rubber: skill materials, rubber; rubber on dry concrete 0.7 to 1.0
COURT_RUBBER = contacts.surface(
    friction=0.8, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=1100.0
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 13 objects; ball, arm, glove should move."""
    spec = scene.new(
        "a-tetherball-is-hit-and-circles-its-pole-held-on-its-way-by-",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="outdoor",
        floor="grass",
    )
    # playing circle of 3.05 m radius (10 ft)
    bodies.cylinder(
        spec,
        "court",
        diameter=6.1,
        height=0.02,
        pos=(0.0, 0.0, 0.01),
        look="ceramic_terracotta",
        surface=COURT_RUBBER,
        fixed=True,
    )
    # the tetherball pole
    bodies.cylinder(
        spec, "pole", diameter=0.048, height=2.98, pos=(0.0, 0.0, 1.51), look="steel_brushed", surface=STEEL, fixed=True
    )
    # swivel pin on the pole that the rope hangs from
    bodies.cylinder(
        spec, "pin", diameter=0.016, height=0.05, pos=(0.0, 0.0, 3.025), look="steel_dark", surface=STEEL, fixed=True
    )
    # the tetherball
    bodies.sphere(
        spec,
        "ball",
        diameter=0.22,
        pos=(1.0563, 0.0, 1.0634),
        mass=0.4,
        hollow=True,
        look="tennis_ball",
        surface=BALL_SKIN,
    )
    # steel plate under the post
    bodies.cylinder(
        spec, "foot", diameter=0.5, height=0.04, pos=(2.241, -0.21, 0.04), look="steel_dark", surface=STEEL, fixed=True
    )
    # carries the arm and its spring
    bodies.cylinder(
        spec,
        "post",
        diameter=0.09,
        height=1.37,
        pos=(2.241, -0.21, 0.745),
        look="steel_dark",
        surface=STEEL,
        fixed=True,
    )
    # hits the ball
    bodies.sphere(
        spec,
        "glove",
        diameter=0.2,
        pos=(2.241, -0.86, 1.459),
        mass=0.41,
        look="leather_black",
        surface=GLOVE_LEATHER,
        joint=joints.Hinge(
            "shoulder",
            anchor=(2.241, -0.21, 1.459),
            axis=(0.0, 0.0, -1.0),
            range_deg=(-10.0, 170.0),
            stiffness=1.3,
            rest_deg=200.0,
            damping=0.03,
        ),
    )
    # swings the glove
    bodies.capsule(
        spec,
        "arm",
        diameter=0.05,
        height=0.59,
        pos=(2.241, -0.465, 1.459),
        mass=0.77,
        tilt_deg=90.0,
        look="wood_maple",
        surface=ASH_WOOD,
        parent="glove",
        fixed=True,
    )
    # part of the glove that is laced over the rod's end
    bodies.cylinder(
        spec,
        "cuff",
        diameter=0.13,
        height=0.12,
        pos=(2.241, -0.74, 1.459),
        mass=0.02,
        tilt_deg=90.0,
        look="fabric_linen",
        surface=GLOVE_LEATHER,
        parent="glove",
        fixed=True,
    )
    # part of the glove on top of it and off the hitting side
    bodies.capsule(
        spec,
        "thumb",
        diameter=0.07,
        height=0.18,
        pos=(2.261, -0.845, 1.551),
        mass=0.02,
        tilt_deg=90.0,
        look="leather_black",
        surface=GLOVE_LEATHER,
        parent="glove",
        fixed=True,
    )
    # setting
    bodies.box(
        spec,
        "bench_leg_1",
        size=(0.06, 0.36, 0.42),
        pos=(-1.75, 3.7, 0.21),
        look="steel_dark",
        surface=STEEL,
        fixed=True,
    )
    # setting
    bodies.box(
        spec,
        "bench_leg_2",
        size=(0.06, 0.36, 0.42),
        pos=(-0.65, 3.7, 0.21),
        look="steel_dark",
        surface=STEEL,
        fixed=True,
    )
    # setting
    bodies.box(
        spec, "bench_seat", size=(1.5, 0.4, 0.05), pos=(-1.2, 3.7, 0.445), look="wood_oak", surface=ASH_WOOD, fixed=True
    )

    tendons.rope(
        spec,
        "rope",
        (("pin", (0.0, 0.0, 3.05)), ("ball", (1.0047, 0.0, 1.1605))),
        length=2.14,
        time_constant=0.002,
        diameter=0.012,
        look="fabric_linen",
    )

    cameras.add(
        spec,
        "overview",
        position=(3.82, -4.32, 3.55),
        target=(0.2, 0.0, 1.5),
        subjects=("ball", "pole", "glove"),
        fovy=35.0,
    )
    cameras.add(spec, "top", view="top_down", subjects=("ball", "glove"), fovy=35.0)
    cameras.add(spec, "hit", view="close_up", subjects=("glove",), fovy=35.0)

    motion.launch(
        spec,
        {
            "ball": motion.Launch(linear=(2.46, 0.0, 1.308), angular=(0.0, -1.238, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=30, size=(960, 720), movers=("ball", "arm", "glove"))
