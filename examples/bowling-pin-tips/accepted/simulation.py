"""A bowling pin tips over once its centre of mass passes its base.

What the plan claims of it:
- The pin stands by itself until the ball reaches it, rolling.
- The force from the ball lifts the pin's centre of mass over the edge of its base and beyond it.
- Only once it is beyond the base does the pin fall, brought down by its weight.
- It ends lying on the lane; it tipped and was not thrown.
- Nothing sinks into anything.
- It reads as a bowling ball and a white pin on a polished lane.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, bodies, cameras, contacts, motion, program, scene

TIME_STEP = 0.0005  # s
DURATION = 3.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# urethane: USBC equipment manual: ball on pin restitution 0.65-0.78, ball on dry lane friction 0.2
URETHANE = contacts.surface(
    friction=0.2, torsional=0.005, rolling=0.0001, restitution=0.65, time_constant=4 * TIME_STEP
)
# pin_coat: USBC equipment manual, the same pair
PIN_COAT = contacts.surface(
    friction=0.2, torsional=0.005, rolling=0.0001, restitution=0.65, time_constant=4 * TIME_STEP
)
# lane_maple: OpenStax College Physics table 5.1, wood on wood, static: the foot of the pin must hold; restitution as
# oak in skill materials, nearest row
LANE_MAPLE = contacts.surface(
    friction=0.5, torsional=0.005, rolling=0.0001, restitution=0.4, time_constant=4 * TIME_STEP
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 3 objects; ball, pin should move."""
    spec = scene.new(
        "a-bowling-pin-tips-over-once-its-centre-of-mass-passes-its-b",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks_dark",
    )
    # support
    bodies.box(
        spec, "lane", size=(3.0, 1.05, 0.04), pos=(0.0, 0.0, 0.02), look="wood_court", surface=LANE_MAPLE, fixed=True
    )
    assets.add(spec, "bowling_ball", name="ball", pos=(-0.41903, 0.0, 0.1485), mass=6.8, height=0.217, surface=URETHANE)
    assets.add(spec, "bowling_pin", name="pin", pos=(0.0, 0.0, 0.2305), mass=1.53, height=0.381, surface=PIN_COAT)

    cameras.add(spec, "overview", view="perspective", subjects=("ball", "pin"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("ball", "pin"))
    cameras.add(spec, "close", view="close_up", subjects=("pin",))

    motion.launch(
        spec,
        {
            "ball": motion.Launch(linear=(0.5, 0.0, 0.0), angular=(0.0, 4.608, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(1280, 720), movers=("ball", "pin"))
