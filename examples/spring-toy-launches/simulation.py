"""A compressed spring in a toy releases its energy and launches the toy upward.

What the plan claims of it:
- The compressed spring lets go and its energy becomes motion of the toy.
- That launches the whole toy upward, off the floor and high into the air.
- In the air only gravity acts; the toy flies straight up, comes down where it started, and lands on its foot.
- Nothing sinks into anything, and the toy hits nothing but the floor.
- It reads as a bright toy bunny on a steel spring, on a playroom floor.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import bodies, cameras, contacts, joints, program, scene, tendons

TIME_STEP = 0.0002  # s
DURATION = 2.4  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
SPRING_RATE = 270.0  # N/m; G d^4 / (8 D^3 n), steel wire 1.4 mm, coil 26 mm, 8 turns, G = 79 GPa
SPRING_COMPRESSION = 0.04  # m; inferred: pressed from 60 mm to 20 mm; 8 turns of 1.4 mm are solid at 11 mm
SEGMENT_RATE = 1350.0  # N/m; five equal segments in series: 5 x spring_rate
SEGMENT_DAMPING = 0.5  # N·s/m; inferred: 0.1 N·s/m for the whole spring, a damping ratio of 0.017 under the head

# rubber_sole: OpenStax, College Physics, table 5.1: shoe on wood, kinetic 0.7; restitution inferred, a thin soft sole
RUBBER_SOLE = contacts.surface(
    friction=0.7, torsional=0.005, rolling=0.0001, restitution=0.3, time_constant=4 * TIME_STEP
)
# ground: the same pair: constants belong to both surfaces
GROUND = contacts.surface(friction=0.7, torsional=0.005, rolling=0.0001, restitution=0.3, time_constant=4 * TIME_STEP)
# abs: worldwright materials table: ABS 1050 kg/m^3; nearest row of OpenStax, table 5.1: metal on wood, kinetic 0.3
ABS = contacts.surface(friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=1050.0)
# spring_steel: Gere, Mechanics of Materials, appendix (density); OpenStax, table 5.1: steel on steel, dry, kinetic 0.3
SPRING_STEEL = contacts.surface(
    friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=7850.0
)
# beech: wood handbook, beech; OpenStax, table 5.1: wood on wood, kinetic 0.3
BEECH = contacts.surface(friction=0.3, torsional=0.005, rolling=0.0001, time_constant=4 * TIME_STEP, density=720.0)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 13 objects; foot, ring_1, ring_2, ring_3, ring_4, head, ear_left, ear_right, eye_left, eye_right should move."""
    spec = scene.new(
        "a-compressed-spring-in-a-toy-releases-its-energy-and-launche",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks",
        floor_surface=GROUND,
    )
    # stands on the floor, carries the spring
    bodies.cylinder(
        spec,
        "foot",
        diameter=0.06,
        height=0.006,
        pos=(0.0, 0.0, 0.003),
        mass=0.008,
        look="plastic_red",
        surface=RUBBER_SOLE,
    )
    # coil of the spring
    bodies.cylinder(
        spec,
        "ring_1",
        diameter=0.026,
        height=0.003,
        pos=(0.0, 0.0, 0.0091),
        mass=0.0016,
        look="chrome",
        surface=SPRING_STEEL,
        parent="foot",
        joint=joints.Slide("slide_1", axis=(0.0, 0.0, 1.0), range_m=(-0.0016, 0.05)),
    )
    # coil of the spring
    bodies.cylinder(
        spec,
        "ring_2",
        diameter=0.026,
        height=0.003,
        pos=(0.0, 0.0, 0.0137),
        mass=0.0016,
        look="chrome",
        surface=SPRING_STEEL,
        parent="foot",
        joint=joints.Slide("slide_2", axis=(0.0, 0.0, 1.0), range_m=(-0.0032, 0.06)),
    )
    # coil of the spring
    bodies.cylinder(
        spec,
        "ring_3",
        diameter=0.026,
        height=0.003,
        pos=(0.0, 0.0, 0.0183),
        mass=0.0016,
        look="chrome",
        surface=SPRING_STEEL,
        parent="foot",
        joint=joints.Slide("slide_3", axis=(0.0, 0.0, 1.0), range_m=(-0.0048, 0.07)),
    )
    # coil of the spring
    bodies.cylinder(
        spec,
        "ring_4",
        diameter=0.026,
        height=0.003,
        pos=(0.0, 0.0, 0.0229),
        mass=0.0016,
        look="chrome",
        surface=SPRING_STEEL,
        parent="foot",
        joint=joints.Slide("slide_4", axis=(0.0, 0.0, 1.0), range_m=(-0.0064, 0.08)),
    )
    # what the spring throws
    bodies.sphere(
        spec,
        "head",
        diameter=0.06,
        pos=(0.0, 0.0, 0.056),
        mass=0.02894,
        look="#f0a830",
        surface=ABS,
        parent="foot",
        joint=joints.Slide("head_slide", axis=(0.0, 0.0, 1.0), range_m=(-0.008, 0.09)),
    )
    # part of the head
    bodies.capsule(
        spec,
        "ear_left",
        diameter=0.014,
        height=0.05,
        pos=(0.0105, 0.0079, 0.104),
        mass=0.0005,
        look="#f0a830",
        surface=ABS,
        parent="head",
        fixed=True,
    )
    # part of the head
    bodies.capsule(
        spec,
        "ear_right",
        diameter=0.014,
        height=0.05,
        pos=(-0.0121, -0.0051, 0.104),
        mass=0.0005,
        look="#f0a830",
        surface=ABS,
        parent="head",
        fixed=True,
    )
    # part of the head
    bodies.sphere(
        spec,
        "eye_left",
        diameter=0.009,
        pos=(0.0238, -0.0173, 0.062),
        mass=3e-05,
        look="#1c1a1a",
        surface=ABS,
        parent="head",
        fixed=True,
    )
    # part of the head
    bodies.sphere(
        spec,
        "eye_right",
        diameter=0.009,
        pos=(0.0031, -0.0292, 0.062),
        mass=3e-05,
        look="#1c1a1a",
        surface=ABS,
        parent="head",
        fixed=True,
    )
    # scenery, gives the scale
    bodies.box(
        spec,
        "block_left",
        size=(0.045, 0.045, 0.045),
        pos=(-0.19, 0.12, 0.0225),
        look="wood_maple",
        surface=BEECH,
        fixed=True,
    )
    # scenery, gives the scale
    bodies.box(
        spec,
        "block_right",
        size=(0.045, 0.045, 0.045),
        pos=(-0.13, 0.15, 0.0225),
        yaw_deg=12.0,
        look="#3f6ea5",
        surface=BEECH,
        fixed=True,
    )
    # scenery, gives the scale
    bodies.box(
        spec,
        "block_top",
        size=(0.045, 0.045, 0.045),
        pos=(-0.186, 0.124, 0.0675),
        yaw_deg=-20.0,
        look="#5a9367",
        surface=BEECH,
        fixed=True,
    )

    tendons.spring(
        spec,
        "coil_1",
        (("foot", (0.0, 0.0, 0.006)), ("ring_1", (0.0, 0.0, 0.0091))),
        stiffness=1350.0,
        length=0.0111,
        damping=0.5,
        diameter=0.018,
        look="steel_dark",
    )
    tendons.spring(
        spec,
        "coil_2",
        (("ring_1", (0.0, 0.0, 0.0091)), ("ring_2", (0.0, 0.0, 0.0137))),
        stiffness=1350.0,
        length=0.0126,
        damping=0.5,
        diameter=0.018,
        look="steel_dark",
    )
    tendons.spring(
        spec,
        "coil_3",
        (("ring_2", (0.0, 0.0, 0.0137)), ("ring_3", (0.0, 0.0, 0.0183))),
        stiffness=1350.0,
        length=0.0126,
        damping=0.5,
        diameter=0.018,
        look="steel_dark",
    )
    tendons.spring(
        spec,
        "coil_4",
        (("ring_3", (0.0, 0.0, 0.0183)), ("ring_4", (0.0, 0.0, 0.0229))),
        stiffness=1350.0,
        length=0.0126,
        damping=0.5,
        diameter=0.018,
        look="steel_dark",
    )
    tendons.spring(
        spec,
        "coil_5",
        (("ring_4", (0.0, 0.0, 0.0229)), ("head", (0.0, 0.0, 0.026))),
        stiffness=1350.0,
        length=0.0111,
        damping=0.5,
        diameter=0.018,
        look="steel_dark",
    )

    cameras.add(spec, "overview", view="perspective", subjects=("head", "foot", "ear_left"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("head", "foot", "ear_left"), fovy=35.0)
    cameras.add(
        spec,
        "close",
        position=(0.36, -0.32, 0.17),
        target=(0.0, 0.0, 0.085),
        subjects=("head", "foot", "ring_1"),
        fovy=30.0,
    )

    return spec


if __name__ == "__main__":
    program.main(
        build,
        duration=DURATION,
        fps=60,
        size=(960, 720),
        movers=(
            "foot",
            "ring_1",
            "ring_2",
            "ring_3",
            "ring_4",
            "head",
            "ear_left",
            "ear_right",
            "eye_left",
            "eye_right",
        ),
    )
