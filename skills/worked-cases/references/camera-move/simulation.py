"""Eleven dominoes fall, one after another.

What the plan claims of it:
- The last domino is knocked over by the row.
- It reads as a row of wooden dominoes.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import bodies, cameras, contacts, forms, motion, program, scene

TIME_STEP = 0.002  # s
DURATION = 1.2  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# wood: wood handbook, beech 690 to 720 kg/m^3; wood on wood, kinetic
WOOD = contacts.surface(
    friction=0.35,
    torsional=0.005,
    rolling=0.0001,
    restitution=0.1,
    onset=contacts.QUIET_ONSET,
    time_constant=4 * TIME_STEP,
    density=690.0,
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 11 objects; domino should move."""
    spec = scene.new(
        "eleven-dominoes-fall-one-after-another",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_oak",
    )
    for name, pos, yaw_deg in (
        ("domino_1", (-0.22, 0.0, 0.05), 0.0),
        ("domino_2", (-0.175, 0.0, 0.05), 0.0),
        ("domino_3", (-0.13, 0.0, 0.05), 0.0),
        ("domino_4", (-0.085, 0.0, 0.05), 0.0),
        ("domino_5", (-0.04, 0.0, 0.05), 0.0),
        ("domino_6", (0.005, 0.0, 0.05), 0.0),
        ("domino_7", (0.05, 0.0, 0.05), 0.0),
        ("domino_8", (0.095, 0.0, 0.05), 0.0),
        ("domino_9", (0.14, 0.0, 0.05), 0.0),
        ("domino_10", (0.185, 0.0, 0.05), 0.0),
        ("domino_11", (0.23, 0.0, 0.05), 0.0),
    ):
        bodies.formed(
            spec,
            name,
            form=forms.rounded_box(size=(0.012, 0.05, 0.1), radius=0.002),
            pos=pos,
            yaw_deg=yaw_deg,
            look="wood_cherry",
            surface=WOOD,
        )

    cameras.add(
        spec,
        "overview",
        view="perspective",
        subjects=(
            "domino_1",
            "domino_2",
            "domino_3",
            "domino_4",
            "domino_5",
            "domino_6",
            "domino_7",
            "domino_8",
            "domino_9",
            "domino_10",
            "domino_11",
        ),
        fovy=35.0,
    )
    cameras.add(
        spec,
        "side",
        view="side_minus_y",
        subjects=(
            "domino_1",
            "domino_2",
            "domino_3",
            "domino_4",
            "domino_5",
            "domino_6",
            "domino_7",
            "domino_8",
            "domino_9",
            "domino_10",
            "domino_11",
        ),
        fovy=35.0,
    )

    motion.launch(
        spec,
        {
            "domino_1": motion.Launch(angular=(0.0, 3.5, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(
        build,
        duration=DURATION,
        fps=24,
        size=(960, 540),
        movers=(
            "domino_1",
            "domino_2",
            "domino_3",
            "domino_4",
            "domino_5",
            "domino_6",
            "domino_7",
            "domino_8",
            "domino_9",
            "domino_10",
            "domino_11",
        ),
    )
