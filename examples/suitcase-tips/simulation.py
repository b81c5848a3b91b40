"""An unevenly packed suitcase tips over.

What the plan claims of it:
- Packed evenly, with the same weight, the case stands, half its weight on each runner.
- With both books in front, the centre of mass is beyond the front runner, which carries all, the back runner nothing.
- Therefore it tips over, forwards, in the time that its centre of mass takes to turn about the edge.
- Its own weight brings it down, slowly first, then onto its pocket.
- It ends lying on its packed side, with the books still in the pocket.
- It tips by itself; the other case has no part in it, and nothing sinks into anything.
- They read as two alike leather travel cases, one with a red book on either side, one with both red books in front.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, bodies, cameras, contacts, program, scene

TIME_STEP = 0.0005  # s
DURATION = 3.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# rubber: OpenStax College Physics table 5.1, shoe on wood, kinetic
RUBBER = contacts.surface(friction=0.7, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)
# ground: the same pair: constants belong to both surfaces
GROUND = contacts.surface(friction=0.7, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)
# leather: nearest row: OpenStax College Physics table 5.1, wood on wood, 0.3 kinetic to 0.5 static, for book cloth on
# leather
LEATHER = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)
# canvas: the same row, for book cloth on canvas
CANVAS = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)
# book_cloth: the same pair
BOOK_CLOTH = contacts.surface(friction=0.4, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 21 objects; uneven_case, uneven_book_left, uneven_book_right should move."""
    spec = scene.new(
        "an-unevenly-packed-suitcase-tips-over",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks_pale",
        floor_surface=GROUND,
    )
    # shell of the unevenly packed case, full of clothes
    bodies.box(
        spec,
        "uneven_case",
        size=(0.18, 0.46, 0.52),
        pos=(0.0, 0.3, 0.29),
        mass=3.5,
        look="leather_brown",
        surface=LEATHER,
    )
    # open front pocket
    bodies.container(
        spec,
        "uneven_pocket_front",
        size=(0.08, 0.45, 0.32),
        wall=0.005,
        pos=(0.13, 0.3, 0.25),
        mass=0.3,
        look="fabric_linen",
        surface=CANVAS,
        parent="uneven_case",
        fixed=True,
    )
    # open back pocket
    bodies.container(
        spec,
        "uneven_pocket_back",
        size=(0.08, 0.45, 0.32),
        wall=0.005,
        pos=(-0.13, 0.3, 0.25),
        mass=0.3,
        look="fabric_linen",
        surface=CANVAS,
        parent="uneven_case",
        fixed=True,
    )
    # rubber runner it stands on
    bodies.box(
        spec,
        "uneven_runner_front",
        size=(0.03, 0.4, 0.03),
        pos=(0.04, 0.3, 0.015),
        mass=0.3,
        look="rubber_black",
        surface=RUBBER,
        parent="uneven_case",
        fixed=True,
    )
    # rubber runner it stands on
    bodies.box(
        spec,
        "uneven_runner_back",
        size=(0.03, 0.4, 0.03),
        pos=(-0.04, 0.3, 0.015),
        mass=0.3,
        look="rubber_black",
        surface=RUBBER,
        parent="uneven_case",
        fixed=True,
    )
    # post of the handle
    bodies.box(
        spec,
        "uneven_post_left",
        size=(0.02, 0.02, 0.03),
        pos=(0.0, 0.36, 0.565),
        mass=0.05,
        look="brass",
        surface=LEATHER,
        parent="uneven_case",
        fixed=True,
    )
    # post of the handle
    bodies.box(
        spec,
        "uneven_post_right",
        size=(0.02, 0.02, 0.03),
        pos=(0.0, 0.24, 0.565),
        mass=0.05,
        look="brass",
        surface=LEATHER,
        parent="uneven_case",
        fixed=True,
    )
    # grip of the handle
    bodies.capsule(
        spec,
        "uneven_grip",
        diameter=0.028,
        height=0.2,
        pos=(0.0, 0.3, 0.594),
        mass=0.2,
        tilt_deg=90.0,
        look="leather_black",
        surface=LEATHER,
        parent="uneven_case",
        fixed=True,
    )
    # heavy book
    bodies.box(
        spec,
        "uneven_book_left",
        size=(0.064, 0.2, 0.36),
        pos=(0.13, 0.405, 0.275),
        mass=3.2,
        look="fabric_red",
        surface=BOOK_CLOTH,
    )
    # heavy book
    bodies.box(
        spec,
        "uneven_book_right",
        size=(0.064, 0.2, 0.36),
        pos=(0.13, 0.195, 0.275),
        mass=3.2,
        look="fabric_red",
        surface=BOOK_CLOTH,
    )
    # shell of the evenly packed case, full of clothes
    bodies.box(
        spec,
        "even_case",
        size=(0.18, 0.46, 0.52),
        pos=(-0.45, -0.35, 0.29),
        mass=3.5,
        look="leather_brown",
        surface=LEATHER,
    )
    # open front pocket
    bodies.container(
        spec,
        "even_pocket_front",
        size=(0.08, 0.45, 0.32),
        wall=0.005,
        pos=(-0.32, -0.35, 0.25),
        mass=0.3,
        look="fabric_linen",
        surface=CANVAS,
        parent="even_case",
        fixed=True,
    )
    # open back pocket
    bodies.container(
        spec,
        "even_pocket_back",
        size=(0.08, 0.45, 0.32),
        wall=0.005,
        pos=(-0.58, -0.35, 0.25),
        mass=0.3,
        look="fabric_linen",
        surface=CANVAS,
        parent="even_case",
        fixed=True,
    )
    # rubber runner it stands on
    bodies.box(
        spec,
        "even_runner_front",
        size=(0.03, 0.4, 0.03),
        pos=(-0.41, -0.35, 0.015),
        mass=0.3,
        look="rubber_black",
        surface=RUBBER,
        parent="even_case",
        fixed=True,
    )
    # rubber runner it stands on
    bodies.box(
        spec,
        "even_runner_back",
        size=(0.03, 0.4, 0.03),
        pos=(-0.49, -0.35, 0.015),
        mass=0.3,
        look="rubber_black",
        surface=RUBBER,
        parent="even_case",
        fixed=True,
    )
    # post of the handle
    bodies.box(
        spec,
        "even_post_left",
        size=(0.02, 0.02, 0.03),
        pos=(-0.45, -0.29, 0.565),
        mass=0.05,
        look="brass",
        surface=LEATHER,
        parent="even_case",
        fixed=True,
    )
    # post of the handle
    bodies.box(
        spec,
        "even_post_right",
        size=(0.02, 0.02, 0.03),
        pos=(-0.45, -0.41, 0.565),
        mass=0.05,
        look="brass",
        surface=LEATHER,
        parent="even_case",
        fixed=True,
    )
    # grip of the handle
    bodies.capsule(
        spec,
        "even_grip",
        diameter=0.028,
        height=0.2,
        pos=(-0.45, -0.35, 0.594),
        mass=0.2,
        tilt_deg=90.0,
        look="leather_black",
        surface=LEATHER,
        parent="even_case",
        fixed=True,
    )
    # heavy book
    bodies.box(
        spec,
        "even_book_front",
        size=(0.064, 0.2, 0.36),
        pos=(-0.32, -0.35, 0.275),
        mass=3.2,
        look="fabric_red",
        surface=BOOK_CLOTH,
    )
    # heavy book
    bodies.box(
        spec,
        "even_book_back",
        size=(0.064, 0.2, 0.36),
        pos=(-0.58, -0.35, 0.275),
        mass=3.2,
        look="fabric_red",
        surface=BOOK_CLOTH,
    )
    assets.add(spec, "chair", name="chair", pos=(-1.35, 0.1, 0.43), height=0.86, fixed=True)

    cameras.add(spec, "overview", view="perspective", subjects=("uneven_case", "even_case"), fovy=35.0)
    cameras.add(spec, "side", view="side_plus_y", subjects=("uneven_case", "even_case"), fovy=35.0)
    cameras.add(spec, "close", view="close_up", subjects=("uneven_case", "uneven_pocket_front"), fovy=35.0)

    return spec


if __name__ == "__main__":
    program.main(
        build,
        duration=DURATION,
        fps=24,
        size=(1280, 720),
        movers=("uneven_case", "uneven_book_left", "uneven_book_right"),
    )
