"""A stone is thrown across a river.

What the plan claims of it:
- The stone is thrown across the river, shore to shore through the air, and touches nothing on the way.
- Its path is a curve, the parabola of free fall.
- It rises to a peak over the river, and then falls.
- It falls, ever faster, to the far bank.
- The sand stops it, and it stays on the far bank.
- It reads as a dark river stone over blue water between a green and a sandy bank, under an open sky.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import bodies, cameras, contacts, motion, program, scene

TIME_STEP = 0.0005  # s
DURATION = 4.5  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# slate: CRC Handbook, density of solids: slate 2600-3300; friction, rolling and rebound: the row sand
SLATE = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.022, restitution=0.1, time_constant=4 * TIME_STEP, density=2750.0
)
# sand: angle of repose of dry sand 30-34 degrees, tan = 0.58-0.67; Engineering ToolBox, Rolling Resistance: on loose
# sand 0.2-0.4; R. Cross, Am. J. Phys. 67 (1999): what yields (clay) rebounds with 0
SAND = contacts.surface(friction=0.6, torsional=0.005, rolling=0.022, restitution=0.1, time_constant=4 * TIME_STEP)
# turf: the row sand: nothing is claimed to touch it
TURF = contacts.surface(friction=0.6, torsional=0.005, rolling=0.022, restitution=0.1, time_constant=4 * TIME_STEP)
# ground: the row sand: nothing is claimed to touch it
GROUND = contacts.surface(friction=0.6, torsional=0.005, rolling=0.022, restitution=0.1, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 13 objects; stone should move."""
    spec = scene.new(
        "a-stone-is-thrown-across-a-river",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="outdoor",
        floor="grass",
        floor_surface=GROUND,
    )
    # support
    bodies.box(spec, "near_bank", size=(7.0, 150.0, 0.4), pos=(-6.0, 6.0, 0.2), look="grass", surface=TURF, fixed=True)
    # support
    bodies.box(spec, "far_bank", size=(7.5, 150.0, 0.4), pos=(6.25, 6.0, 0.2), look="sand", surface=SAND, fixed=True)
    # the water, drawn only: no claim is measured on it
    bodies.box(spec, "river", size=(5.0, 150.0, 0.2), pos=(0.0, 6.0, 0.1), look="water", visual_only=True)
    # setting
    bodies.cylinder(spec, "trunk_1", diameter=0.3, height=2.0, pos=(-7.8, 8.0, 1.4), look="wood_walnut", fixed=True)
    # setting
    bodies.ellipsoid(spec, "crown_1", size=(2.8, 2.6, 3.0), pos=(-7.8, 8.0, 3.9), look="leaves", fixed=True)
    # setting
    bodies.cylinder(spec, "trunk_2", diameter=0.35, height=2.4, pos=(-4.8, 20.0, 1.6), look="wood_walnut", fixed=True)
    # setting
    bodies.ellipsoid(spec, "crown_2", size=(3.2, 3.4, 3.6), pos=(-4.8, 20.0, 4.6), look="leaves", fixed=True)
    # setting
    bodies.cylinder(spec, "trunk_3", diameter=0.3, height=1.8, pos=(9.0, 5.5, 1.3), look="wood_walnut", fixed=True)
    # setting
    bodies.ellipsoid(spec, "crown_3", size=(2.6, 2.8, 3.4), pos=(9.0, 5.5, 3.9), look="leaves", fixed=True)
    # setting
    bodies.ellipsoid(spec, "boulder_1", size=(0.9, 1.2, 0.6), pos=(-3.4, 3.6, 0.7), look="rock", fixed=True)
    # setting
    bodies.ellipsoid(spec, "boulder_2", size=(0.7, 0.6, 0.45), pos=(-3.1, 5.4, 0.625), look="rock", fixed=True)
    # setting
    bodies.ellipsoid(spec, "boulder_3", size=(1.0, 1.3, 0.7), pos=(3.65, 6.5, 0.75), look="rock", fixed=True)
    bodies.ellipsoid(spec, "stone", size=(0.17, 0.22, 0.13), pos=(-2.9, 0.0, 2.1), look="slate", surface=SLATE)

    cameras.add(spec, "shoulder", position=(-6.2, -2.6, 2.5), target=(0.5, 0.8, 2.2), subjects=("stone",))
    cameras.add(spec, "side", view="side_minus_y", subjects=("stone",))
    cameras.add(spec, "chase", view="close_up", subjects=("stone",), follow=True)

    motion.launch(
        spec,
        {
            "stone": motion.Launch(linear=(4.3, 0.0, 6.0), angular=(0.0, -6.0, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(864, 486), movers=("stone",), visual_only=("river",))
