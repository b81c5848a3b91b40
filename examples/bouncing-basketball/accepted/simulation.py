"""A dropped basketball bounces lower and lower.

What the plan claims of it:
- The ball falls and hits the ground.
- In free fall its energy is conserved.
- It bounces again and again, each time lower than before.
- In the end it lies still on the ground.
- A textured basketball on a wooden court floor, its shadow shrinking to meet it.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, cameras, contacts, program, scene

TIME_STEP = 0.001  # s
DURATION = 7.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# rubber: FIBA Official Basketball Rules, equipment: dropped from 1800 mm, the top of the ball rebounds to 1200-1400 mm;
# e = sqrt(1.15 / 1.8)
RUBBER = contacts.surface(friction=0.6, torsional=0.005, rolling=0.001, restitution=0.8, time_constant=4 * TIME_STEP)
# ground: the same test is made on a wooden playing floor: the constant belongs to the pair
GROUND = contacts.surface(friction=0.6, torsional=0.005, rolling=0.001, restitution=0.8, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 1 object; basketball should move."""
    spec = scene.new(
        "a-dropped-basketball-bounces-lower-and-lower",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="studio",
        floor="wood_court",
        floor_surface=GROUND,
    )
    assets.add(spec, "basketball", name="basketball", pos=(0.0, 0.0, 1.921), mass=0.6, height=0.242, surface=RUBBER)

    cameras.add(spec, "overview", view="perspective", subjects=("basketball",))
    cameras.add(spec, "side", view="side_minus_y", subjects=("basketball",))
    cameras.add(spec, "close", view="close_up", subjects=("basketball",), fovy=35.0)

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(1280, 720), movers=("basketball",))
