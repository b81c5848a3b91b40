"""A slack rope is drawn taut and then pulls a box across the floor.

What the plan claims of it:
- While the rope is slack the box remains stationary, although the trolley already draws on the rope.
- The box starts to move only when the rope is pulled taut.
- Then the rope makes the box slide across the floor.
- Once taut, the rope keeps its length and the box follows steadily, straight and upright.
- The box is moved by nothing but the rope; it never touches the trolley or the rail, and sinks into nothing.
- The rope hangs visibly slack at first and is drawn as a straight line once taut.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import actuators, bodies, cameras, contacts, joints, program, scene, tendons

TIME_STEP = 0.001  # s
DURATION = 4.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
PULL_SPEED = 0.25  # m/s; inferred: a slow hauling speed; 0.25 m of slack is taken up in about a second

# crate_wood: OpenStax, College Physics, table 5.1: wood on wood, kinetic 0.3
CRATE_WOOD = contacts.surface(friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)
# ground: the same pair: wood on wood, kinetic 0.3
GROUND = contacts.surface(friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)
# rail_steel: Gere, Mechanics of Materials, appendix (density); OpenStax, table 5.1: steel on steel, dry, kinetic 0.3
RAIL_STEEL = contacts.surface(
    friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=7850.0
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 3 objects; box, trolley should move."""
    spec = scene.new(
        "a-slack-rope-is-drawn-taut-and-then-pulls-a-box-across-the-f",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks_dark",
        floor_surface=GROUND,
    )
    # is pulled
    bodies.box(spec, "box", size=(0.5, 0.5, 0.5), pos=(0.0, 0.0, 0.25), mass=10.0, look="wood_pine", surface=CRATE_WOOD)
    # carries the trolley
    bodies.box(
        spec, "rail", size=(1.6, 0.1, 0.03), pos=(1.85, 0.0, 0.015), look="steel_dark", surface=RAIL_STEEL, fixed=True
    )
    # pulls
    bodies.box(
        spec,
        "trolley",
        size=(0.4, 0.3, 0.4),
        pos=(1.25, 0.0, 0.232),
        mass=40.0,
        look="plastic_blue",
        surface=RAIL_STEEL,
        joint=joints.Slide("way", axis=(1.0, 0.0, 0.0)),
    )

    tendons.rope(spec, "rope", (("box", (0.25, 0.0, 0.35)), ("trolley", (1.05, 0.0, 0.35))), slack=0.25, diameter=0.01)

    actuators.velocity(spec, "pull", joint="way", gain=800.0, limit=150.0)

    cameras.add(spec, "side", view="side_minus_y", subjects=("box", "trolley"), fovy=30.0)
    cameras.add(spec, "overview", view="perspective", subjects=("box", "trolley"), fovy=35.0)
    cameras.add(spec, "top", view="top_down", subjects=("box", "trolley"), fovy=35.0)

    return spec


def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """What the plan declares to act on the state besides the engine."""
    # control on pull: speed servo of 800 N·s/m towards 0.25 m/s along the rail, with a force of at most 150 N (trigger:
    # always; source: the prompt's "used to pull"; 0.25 m/s is constants.pull_speed, 150 N is inferred, five times the
    # friction of 29.4 N that must be overcome)
    data.actuator("pull").ctrl[0] = PULL_SPEED


if __name__ == "__main__":
    program.main(build, control, duration=DURATION, fps=24, size=(960, 540), movers=("box", "trolley"))
