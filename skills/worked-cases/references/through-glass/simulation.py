"""A marble passes behind a glass of tea.

What the plan claims of it:
- The marble rolls past behind the glass.
- Through the tea it is seen where it is not.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import bodies, cameras, contacts, forms, motion, program, scene

TIME_STEP = 0.002  # s
DURATION = 1.6  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# glass: CRC Handbook: soda-lime glass, on wood 0.2 to 0.5
GLASS = contacts.surface(
    friction=0.4,
    torsional=0.005,
    rolling=1e-05,
    restitution=0.6,
    onset=contacts.QUIET_ONSET,
    time_constant=4 * TIME_STEP,
    density=2500.0,
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 3 objects; marble should move."""
    spec = scene.new(
        "a-marble-passes-behind-a-glass-of-tea",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_walnut",
    )
    bodies.formed(
        spec,
        "tumbler",
        form=forms.lathe(
            profile=(
                (0.0, 0.0),
                (0.033, 0.0),
                (0.036, 0.004),
                (0.04, 0.1),
                (0.0385, 0.1015),
                (0.037, 0.1),
                (0.0335, 0.01),
                (0.031, 0.008),
                (0.0, 0.008),
            ),
            smooth=2,
        ),
        pos=(0.0, 0.0, 0.051298),
        look="glass_clear",
        surface=GLASS,
        fixed=True,
    )
    bodies.formed(
        spec,
        "tea",
        form=forms.lathe(profile=((0.0, 0.0), (0.0325, 0.0), (0.0343, 0.004), (0.0367, 0.066), (0.0, 0.066))),
        pos=(0.0, 0.0, 0.0415),
        look="tea",
        visual_only=True,
    )
    bodies.sphere(spec, "marble", diameter=0.032, pos=(-0.2, 0.085, 0.016), look="ball_blue", surface=GLASS)

    cameras.add(spec, "overview", view="perspective", subjects=("tumbler", "marble"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("tumbler", "marble"), fovy=35.0)

    motion.launch(
        spec,
        {
            "marble": motion.Launch(linear=(0.28, 0.0, 0.0), angular=(0.0, 17.5, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(960, 540), movers=("marble",), visual_only=("tea",))
