"""A brass pendulum swings under a lamp.

What the plan claims of it:
- The bob swings to the other side.
- It reads as a pendulum in the light of one lamp.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import math

import mujoco

from worldkit import bodies, cameras, contacts, joints, motion, parts, program, scene

TIME_STEP = 0.002  # s
DURATION = 2.4  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# brass: engineering handbook, brass
BRASS = contacts.surface(friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=8500.0)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 2 objects; pendulum should move."""
    spec = scene.new(
        "a-brass-pendulum-swings-under-a-lamp",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks_dark",
    )
    stand_parts = (
        parts.Part("foot", "box", size=(0.34, 0.2, 0.03), offset=(0.0, 0.0, 0.015), look="wood_walnut"),
        parts.Part("post", "box", size=(0.03, 0.03, 0.5), offset=(0.0, 0.07, 0.28)),
        parts.Part("arm", "box", size=(0.03, 0.17, 0.03), offset=(0.0, 0.0, 0.515)),
    )
    bodies.compound(spec, "stand", parts=stand_parts, pos=(0.0, 0.0, 0.265), look="paint_green", fixed=True)
    pendulum_parts = (
        parts.Part("rod", "cylinder", size=(0.006, 0.006, 0.34), look="steel_brushed"),
        parts.Part("bob", "sphere", size=(0.075, 0.075, 0.075), offset=(0.0, 0.0, -0.18)),
    )
    bodies.compound(
        spec,
        "pendulum",
        parts=pendulum_parts,
        pos=(0.0, -0.06, 0.29375),
        look="brass",
        surface=BRASS,
        joint=joints.Hinge("pivot", anchor=(0.0, -0.06, 0.5), axis=(0.0, 1.0, 0.0), damping=0.001),
    )

    cameras.add(spec, "overview", view="perspective", subjects=("stand", "pendulum"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("pendulum",), fovy=35.0)

    motion.launch(
        spec,
        {
            "pivot": motion.Launch(position=math.radians(32.0), velocity=0.0),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(960, 540), movers=("pendulum",))
