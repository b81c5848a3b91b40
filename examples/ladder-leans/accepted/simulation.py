"""A ladder leans on a wall, and stands as long as its centre of mass stays between its base and the wall.

What the plan claims of it:
- Each ladder leans on the wall and stands by itself, its centre of mass between its base and the wall.
- The slow ball lifts ladder A off the wall.
- The centre of mass of ladder A stays between base and wall all the time, so its weight lays it back, and it stands on.
- The fast ball, at the same moment and in the same place, drives the centre of mass of ladder B over its base and
  beyond.
- Only once its centre of mass is beyond its base does ladder B fall, brought down by its weight.
- Each ball gives one push and stays up on the terrace; the ladders do not meet, hold together, and nothing sinks into
  anything.
- It reads as two ladders on a brick garden wall, the red rung marking the middle, and a basketball each on the terrace.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, bodies, cameras, contacts, motion, program, scene

TIME_STEP = 0.0005  # s
DURATION = 4.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# rail_aluminium: Gere, aluminium 2700 kg/m^3 in a tube of 70 x 25 x 1.1 mm (204 of 1750 mm^2); friction as the wall's;
# restitution of the pair with the ball, the lower partner counts elsewhere
RAIL_ALUMINIUM = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.8, time_constant=4 * TIME_STEP, density=315.0
)
# rung_aluminium: Gere, aluminium 2700 kg/m^3 in a tube of 30 x 1.2 mm (109 of 707 mm^2); friction and restitution of
# the pair with the ball
RUNG_ALUMINIUM = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.8, time_constant=4 * TIME_STEP, density=415.0
)
# ball_rubber: FIBA Official Basketball Rules: from 1800 mm the top of the ball rebounds to 1200-1400 mm, e = sqrt(1.15
# / 1.8); friction as the project's plan bouncing-basketball
BALL_RUBBER = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.001, restitution=0.8, time_constant=4 * TIME_STEP
)
# brick: Engineering ToolBox, brick on wood 0.6, nearest row to brick on aluminium; restitution inferred, below a steel
# ball's 0.60 on a floor (The Physics Factbook)
BRICK = contacts.surface(friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.3, time_constant=4 * TIME_STEP)
# deck_wood: OpenStax, College Physics, table 5.1, shoe on wood, kinetic 0.7, nearest row to a rubber ball; restitution
# as the wall's
DECK_WOOD = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.3, time_constant=4 * TIME_STEP
)
# ground: Engineering ToolBox, car tyre on asphalt 0.72: the ladder's rubber feet; restitution as the wall's
GROUND = contacts.surface(friction=0.72, torsional=0.005, rolling=0.0001, restitution=0.3, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 27 objects; ball_a, ball_b, ladder_a_rung_5, ladder_a_rail_left, ladder_a_rail_right, ladder_a_rung_1, ladder_a_rung_2, ladder_a_rung_3, ladder_a_rung_4, ladder_a_rung_6, ladder_a_rung_7, ladder_a_rung_8, ladder_a_rung_9, ladder_b_rung_5, ladder_b_rail_left, ladder_b_rail_right, ladder_b_rung_1, ladder_b_rung_2, ladder_b_rung_3, ladder_b_rung_4, ladder_b_rung_6, ladder_b_rung_7, ladder_b_rung_8, ladder_b_rung_9 should move."""
    spec = scene.new(
        "a-ladder-leans-on-a-wall-and-stands-as-long-as-its-centre-of",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="outdoor",
        floor="asphalt",
        floor_surface=GROUND,
    )
    spec.option.impratio = 10.0
    # garden wall, the ladders lean on its front top edge
    bodies.box(spec, "wall", size=(0.3, 4.4, 1.92), pos=(-0.15, 0.0, 0.96), look="brick", surface=BRICK, fixed=True)
    # the raised ground behind the wall
    bodies.box(spec, "terrace", size=(4.4, 4.4, 1.87), pos=(-2.5, 0.0, 0.935), look="brick", surface=BRICK, fixed=True)
    # boards of the terrace, level with the wall
    bodies.box(
        spec,
        "deck",
        size=(4.4, 4.4, 0.05),
        pos=(-2.5, 0.0, 1.895),
        look="wood_planks_pale",
        surface=DECK_WOOD,
        fixed=True,
    )
    # ladder A: its middle rung in a red sleeve, its centre of mass
    bodies.cylinder(
        spec,
        "ladder_a_rung_5",
        diameter=0.03,
        height=0.36,
        pos=(0.16058, 1.0, 1.45795),
        tilt_deg=90.0,
        look="plastic_red",
        surface=RUNG_ALUMINIUM,
    )
    bodies.box(
        spec,
        "ladder_a_rail_left",
        size=(0.025, 0.07, 3.0),
        pos=(0.16058, 1.1925, 1.457947),
        yaw_deg=90.0,
        tilt_deg=-15.0,
        look="aluminium",
        surface=RAIL_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.box(
        spec,
        "ladder_a_rail_right",
        size=(0.025, 0.07, 3.0),
        pos=(0.16058, 0.8075, 1.457947),
        yaw_deg=90.0,
        tilt_deg=-15.0,
        look="aluminium",
        surface=RAIL_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_1",
        diameter=0.03,
        height=0.36,
        pos=(0.47116, 1.0, 0.29884),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_2",
        diameter=0.03,
        height=0.36,
        pos=(0.39352, 1.0, 0.58862),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_3",
        diameter=0.03,
        height=0.36,
        pos=(0.31587, 1.0, 0.87839),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_4",
        diameter=0.03,
        height=0.36,
        pos=(0.23823, 1.0, 1.16817),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_6",
        diameter=0.03,
        height=0.36,
        pos=(0.08293, 1.0, 1.74773),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_7",
        diameter=0.03,
        height=0.36,
        pos=(0.00529, 1.0, 2.03751),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_8",
        diameter=0.03,
        height=0.36,
        pos=(-0.07236, 1.0, 2.32728),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_a_rung_9",
        diameter=0.03,
        height=0.36,
        pos=(-0.15001, 1.0, 2.61706),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_a_rung_5",
        fixed=True,
    )
    # ladder B: its middle rung in a red sleeve, its centre of mass
    bodies.cylinder(
        spec,
        "ladder_b_rung_5",
        diameter=0.03,
        height=0.36,
        pos=(0.16058, -1.0, 1.45795),
        tilt_deg=90.0,
        look="plastic_red",
        surface=RUNG_ALUMINIUM,
    )
    bodies.box(
        spec,
        "ladder_b_rail_left",
        size=(0.025, 0.07, 3.0),
        pos=(0.16058, -0.8075, 1.457947),
        yaw_deg=90.0,
        tilt_deg=-15.0,
        look="aluminium",
        surface=RAIL_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.box(
        spec,
        "ladder_b_rail_right",
        size=(0.025, 0.07, 3.0),
        pos=(0.16058, -1.1925, 1.457947),
        yaw_deg=90.0,
        tilt_deg=-15.0,
        look="aluminium",
        surface=RAIL_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_1",
        diameter=0.03,
        height=0.36,
        pos=(0.47116, -1.0, 0.29884),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_2",
        diameter=0.03,
        height=0.36,
        pos=(0.39352, -1.0, 0.58862),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_3",
        diameter=0.03,
        height=0.36,
        pos=(0.31587, -1.0, 0.87839),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_4",
        diameter=0.03,
        height=0.36,
        pos=(0.23823, -1.0, 1.16817),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_6",
        diameter=0.03,
        height=0.36,
        pos=(0.08293, -1.0, 1.74773),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_7",
        diameter=0.03,
        height=0.36,
        pos=(0.00529, -1.0, 2.03751),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_8",
        diameter=0.03,
        height=0.36,
        pos=(-0.07236, -1.0, 2.32728),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    bodies.cylinder(
        spec,
        "ladder_b_rung_9",
        diameter=0.03,
        height=0.36,
        pos=(-0.15001, -1.0, 2.61706),
        tilt_deg=90.0,
        look="aluminium",
        surface=RUNG_ALUMINIUM,
        parent="ladder_b_rung_5",
        fixed=True,
    )
    assets.add(
        spec, "basketball", name="ball_a", pos=(-1.38121, 1.0, 2.0415), mass=0.6, height=0.243, surface=BALL_RUBBER
    )
    assets.add(
        spec, "basketball", name="ball_b", pos=(-2.88121, -1.0, 2.0415), mass=0.6, height=0.243, surface=BALL_RUBBER
    )

    cameras.add(
        spec,
        "overview",
        view="perspective",
        subjects=(
            "ball_a",
            "ladder_a_rung_5",
            "ladder_a_rail_left",
            "ladder_a_rail_right",
            "ladder_a_rung_1",
            "ladder_a_rung_2",
            "ladder_a_rung_3",
            "ladder_a_rung_4",
            "ladder_a_rung_6",
            "ladder_a_rung_7",
            "ladder_a_rung_8",
            "ladder_a_rung_9",
            "ladder_b_rung_5",
            "ladder_b_rail_left",
            "ladder_b_rail_right",
            "ladder_b_rung_1",
            "ladder_b_rung_2",
            "ladder_b_rung_3",
            "ladder_b_rung_4",
            "ladder_b_rung_6",
            "ladder_b_rung_7",
            "ladder_b_rung_8",
            "ladder_b_rung_9",
        ),
        fovy=35.0,
    )
    cameras.add(spec, "side", view="side_minus_y", subjects=("ladder_b_rail_right", "ball_a", "ball_b"), fovy=30.0)
    cameras.add(spec, "wall_edge", view="close_up", subjects=("ladder_a_rung_7", "ball_a"), fovy=35.0)

    motion.launch(
        spec,
        {
            "ball_a": motion.Launch(linear=(2.5, 0.0, 0.0), angular=(0.0, 20.576, 0.0)),
            "ball_b": motion.Launch(linear=(5.5, 0.0, 0.0), angular=(0.0, 45.267, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(
        build,
        duration=DURATION,
        fps=24,
        size=(1280, 720),
        movers=(
            "ball_a",
            "ball_b",
            "ladder_a_rung_5",
            "ladder_a_rail_left",
            "ladder_a_rail_right",
            "ladder_a_rung_1",
            "ladder_a_rung_2",
            "ladder_a_rung_3",
            "ladder_a_rung_4",
            "ladder_a_rung_6",
            "ladder_a_rung_7",
            "ladder_a_rung_8",
            "ladder_a_rung_9",
            "ladder_b_rung_5",
            "ladder_b_rail_left",
            "ladder_b_rail_right",
            "ladder_b_rung_1",
            "ladder_b_rung_2",
            "ladder_b_rung_3",
            "ladder_b_rung_4",
            "ladder_b_rung_6",
            "ladder_b_rung_7",
            "ladder_b_rung_8",
            "ladder_b_rung_9",
        ),
    )
