"""A wooden duck rocks to rest.

What the plan claims of it:
- The duck rocks and comes to rest on its keel.
- It reads as a toy duck of painted wood.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import cameras, contacts, motion, program, scene, sculpt

TIME_STEP = 0.002  # s
DURATION = 2.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# wood: wood handbook: lime 530, beech 720 kg/m^3; wood on wood
WOOD = contacts.surface(
    friction=0.5,
    torsional=0.005,
    rolling=0.0001,
    restitution=0.1,
    onset=contacts.QUIET_ONSET,
    time_constant=4 * TIME_STEP,
    density=620.0,
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 1 object; duck should move."""
    spec = scene.new(
        "a-wooden-duck-rocks-to-rest",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks_pale",
    )
    sculpt.from_file(spec, "sculpt/duck.py", name="duck", pos=(0.0, 0.0, 0.1074), of="DUCK", surface=WOOD)

    cameras.add(spec, "overview", view="perspective", subjects=("duck",), fovy=35.0)
    cameras.add(spec, "front", view="side_plus_x", subjects=("duck",), fovy=35.0)

    motion.launch(
        spec,
        {
            "duck": motion.Launch(angular=(2.6, 0.0, 0.6)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(960, 540), movers=("duck",))
