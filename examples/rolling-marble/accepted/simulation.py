"""A marble rolls along a flat table in a straight line.

What the plan claims of it:
- The marble rolls a long way along the table.
- It stays on the table top all the way.
- The mugs stand still.
- The picture reads as a marble rolling over a wooden table.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, bodies, cameras, contacts, motion, program, scene

TIME_STEP = 0.0005  # s
DURATION = 2.6  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# glass: CRC Handbook: glass on wood, sliding friction 0.2 to 0.5; a marble's rolling resistance on a hard table is
# below 0.001 of its radius
GLASS = contacts.surface(friction=0.4, torsional=0.001, rolling=1e-05, restitution=0.6, time_constant=4 * TIME_STEP)
# oak: the same pair of surfaces: the constants belong to both
OAK = contacts.surface(friction=0.4, torsional=0.001, rolling=1e-05, restitution=0.6, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 4 objects; marble should move."""
    spec = scene.new(
        "a-marble-rolls-along-a-flat-table-in-a-straight-line",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
    )
    # rolls
    bodies.sphere(spec, "marble", diameter=0.016, pos=(-0.5, 0.0, 0.758), mass=0.0055, look="#1f6fb2", surface=GLASS)
    assets.add(spec, "table", name="table", pos=(0.0, 0.0, 0.375), height=0.75, surface=OAK, fixed=True)
    assets.add(spec, "mug", name="mug_left", pos=(0.1, 0.22, 0.7975), height=0.095)
    assets.add(spec, "mug", name="mug_right", pos=(-0.15, -0.2, 0.7975), height=0.095, look="#2f6f73")

    cameras.add(spec, "overview", view="perspective", subjects=("marble", "mug_left", "mug_right"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("marble",), fovy=30.0)

    motion.launch(
        spec,
        {
            "marble": motion.Launch(linear=(0.4, 0.0, 0.0), angular=(0.0, 50.0, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(960, 540), movers=("marble",))
