"""A pendulum swings, dies out and stops.

What the plan claims of it:
- The pendulum swings back and forth, driven by its weight.
- Its swings get smaller and smaller, because friction in the pivot takes its energy.
- It gradually slows down, each pass through the bottom slower than the last.
- In the end it comes to a stop, hanging straight down, held by the friction of the pivot.
- It swings freely; nothing but the pin holds or brakes it.
- It reads as a brass pendulum on a wooden stand.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import math

import mujoco

from worldkit import bodies, cameras, contacts, joints, motion, program, scene

TIME_STEP = 0.001  # s
DURATION = 13.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
JOURNAL_FRICTION = 0.3  # 1; OpenStax, metal on wood, kinetic 0.3: the oak rod's eye on its dry steel pin
JOURNAL_RADIUS = 0.0065  # m; half the diameter of the pin, size of scene object pin

# brass: Gere, brass 8400-8600 kg/m^3; brass on steel, kinetic 0.44; it touches nothing
BRASS = contacts.surface(
    friction=0.44, torsional=0.005, rolling=0.0001, restitution=0.5, time_constant=4 * TIME_STEP, density=8500.0
)
# oak: wood handbook, oak 590-930 kg/m^3; wood on wood, kinetic; the rod touches nothing
OAK = contacts.surface(
    friction=0.3, torsional=0.005, rolling=0.0001, restitution=0.4, time_constant=4 * TIME_STEP, density=690.0
)
# steel: Gere, Mechanics of Materials, appendix; metal on wood
STEEL = contacts.surface(
    friction=0.3, torsional=0.005, rolling=0.0001, restitution=0.6, time_constant=4 * TIME_STEP, density=7850.0
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 5 objects; rod, bob should move."""
    spec = scene.new(
        "a-pendulum-swings-dies-out-and-stops", time_step=TIME_STEP, gravity=GRAVITY, integrator="rk4", setting="studio"
    )
    # support
    bodies.box(spec, "foot", size=(0.3, 0.2, 0.03), pos=(0.0, 0.04, 0.015), look="wood_walnut", surface=OAK, fixed=True)
    # support
    bodies.box(
        spec, "post", size=(0.04, 0.04, 0.42), pos=(0.0, 0.07, 0.24), look="wood_walnut", surface=OAK, fixed=True
    )
    # the axle, sticks out of the post
    bodies.cylinder(
        spec,
        "pin",
        diameter=0.013,
        height=0.046,
        pos=(0.0, 0.027, 0.4),
        tilt_deg=90.0,
        look="steel_brushed",
        surface=STEEL,
        fixed=True,
    )
    # swings on the pin
    bodies.box(
        spec,
        "rod",
        size=(0.024, 0.006, 0.222),
        pos=(0.0, 0.0, 0.301),
        look="wood_maple",
        surface=OAK,
        joint=joints.Hinge("pivot", anchor=(0.0, 0.0, 0.4), axis=(0.0, 1.0, 0.0), frictionloss=0.0168),
    )
    # the weight, on the lower end of the rod
    bodies.cylinder(
        spec,
        "bob",
        diameter=0.08,
        height=0.02,
        pos=(0.0, 0.0, 0.15),
        tilt_deg=90.0,
        look="brass",
        surface=BRASS,
        parent="rod",
        fixed=True,
    )

    cameras.add(spec, "overview", view="perspective", subjects=("foot", "post", "bob"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("bob", "rod", "foot"), fovy=30.0)
    cameras.add(spec, "bearing", view="close_up", subjects=("pin",))

    motion.launch(
        spec,
        {
            "pivot": motion.Launch(position=math.radians(20.0), velocity=0.0),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(960, 540), movers=("rod", "bob"))
