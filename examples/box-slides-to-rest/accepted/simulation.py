"""A box is pushed across a wooden floor and slides to rest.

What the plan claims of it:
- A force pushes the box across the floor.
- The force then no longer acts on it, for the buffers catch the bar; the box leaves the bar and goes on alone.
- Once it is no longer pushed it slows down rapidly, by friction on the floor.
- In the end it lies at rest on the floor.
- Only the floor brakes it; it slides flat, without tipping, and sinks into nothing.
- The floor reads as wooden boards and the box as a wooden box; bar, rails and buffers can be told apart from it.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import actuators, bodies, cameras, contacts, joints, program, scene

TIME_STEP = 0.001  # s
DURATION = 3.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
PUSH_FORCE = 70.0  # N; HSE guidance L23 on manual handling, guideline figure for keeping a pushed load in motion: 7 kgf (women), 10 kgf (men)

# oak: Marks' Standard Handbook for Mechanical Engineers, table of friction: oak on oak, sliding, 0.48 along and 0.32
# across the grain; 0.4 is their mean. Restitution: chosen low, the box is never dropped
OAK = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, restitution=0.1, time_constant=4 * TIME_STEP)
# ground: the same pair of surfaces: the constants belong to both
GROUND = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, restitution=0.1, time_constant=4 * TIME_STEP)
# aluminium: chosen: the bar only presses on the box along its normal, the rails are touched by nothing; both are below
# the box's own 0.4, which acts
ALUMINIUM = contacts.surface(
    friction=0.3, torsional=0.005, rolling=0.0001, restitution=0.1, time_constant=4 * TIME_STEP
)
# rubber: chosen: buffers are made to absorb the impact; they touch the bar alone, never the box
RUBBER = contacts.surface(friction=0.5, torsional=0.005, rolling=0.0001, restitution=0.1, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 6 objects; crate, pusher should move."""
    spec = scene.new(
        "a-box-is-pushed-across-a-wooden-floor-and-slides-to-rest",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks_dark",
        floor_surface=GROUND,
    )
    # the box that is pushed
    bodies.box(spec, "crate", size=(0.45, 0.35, 0.35), pos=(-0.6, 0.0, 0.175), mass=12.0, look="wood_oak", surface=OAK)
    # bar that pushes
    bodies.box(
        spec,
        "pusher",
        size=(0.06, 0.66, 0.1),
        pos=(-0.855, 0.0, 0.102),
        mass=2.0,
        look="aluminium",
        surface=ALUMINIUM,
        joint=joints.Slide("pusher_slide", axis=(1.0, 0.0, 0.0)),
    )
    # guides the bar
    bodies.box(
        spec,
        "rail_left",
        size=(1.25, 0.06, 0.05),
        pos=(-0.375, 0.3, 0.025),
        look="steel_dark",
        surface=ALUMINIUM,
        fixed=True,
    )
    # guides the bar
    bodies.box(
        spec,
        "rail_right",
        size=(1.25, 0.06, 0.05),
        pos=(-0.375, -0.3, 0.025),
        look="steel_dark",
        surface=ALUMINIUM,
        fixed=True,
    )
    # buffer that catches the bar
    bodies.box(
        spec,
        "stop_left",
        size=(0.06, 0.06, 0.12),
        pos=(0.205, 0.3, 0.11),
        look="rubber_red",
        surface=RUBBER,
        fixed=True,
    )
    # buffer that catches the bar
    bodies.box(
        spec,
        "stop_right",
        size=(0.06, 0.06, 0.12),
        pos=(0.205, -0.3, 0.11),
        look="rubber_red",
        surface=RUBBER,
        fixed=True,
    )

    actuators.motor(spec, "push_motor", joint="pusher_slide")

    cameras.add(spec, "overview", view="perspective", subjects=("crate", "pusher", "stop_left", "stop_right"))
    cameras.add(spec, "side", view="side_minus_y", subjects=("crate", "pusher", "stop_left", "stop_right"), fovy=35.0)
    cameras.add(spec, "above", view="top_down", subjects=("crate", "pusher", "stop_left", "stop_right"))

    return spec


def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """What the plan declares to act on the state besides the engine."""
    # control on push_motor: constant force push_force = 70 N along +X on the slide of the pusher, the same at every
    # instant; it never follows the box (trigger: always; source: the push that the prompt asks for; size:
    # constants.push_force, HSE L23)
    data.actuator("push_motor").ctrl[0] = PUSH_FORCE


if __name__ == "__main__":
    program.main(build, control, duration=DURATION, fps=24, size=(1280, 720), movers=("crate", "pusher"))
