"""A breakfast table settles.

What the plan claims of it:
- Everything comes to rest within the time shown.
- What was let go falls, and lands where it was meant to.
- What stands stays standing, where it was put.
- The mug and the laptop never meet, and nothing sinks into anything.
- A warm, believable breakfast table, every object recognisable.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, bodies, cameras, contacts, program, scene

TIME_STEP = 0.001  # s
DURATION = 3.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2

# bread: FAO/INFOODS density database: toasted white bread 0.25-0.30 g/ml
BREAD = contacts.surface(
    friction=0.6, torsional=0.005, rolling=0.0001, restitution=0.1, time_constant=4 * TIME_STEP, density=280.0
)
# butter: FAO/INFOODS density database: butter 0.911 g/ml
BUTTER = contacts.surface(
    friction=0.5, torsional=0.005, rolling=0.0001, restitution=0.1, time_constant=4 * TIME_STEP, density=911.0
)
# card: a 410 g packet of cereal of 0.19 x 0.06 x 0.30 m; The Engineering ToolBox: paper on wood 0.3-0.5
CARD = contacts.surface(
    friction=0.4, torsional=0.005, rolling=0.0001, restitution=0.2, time_constant=4 * TIME_STEP, density=120.0
)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 13 objects; toast, butter, apple, mug, upper_book should move."""
    spec = scene.new(
        "a-breakfast-table-settles",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks",
    )
    # a slice of toast, dropped onto the plate
    bodies.box(
        spec, "toast", size=(0.1, 0.1, 0.014), pos=(0.0, -0.24, 0.804594), yaw_deg=20.0, look="#c68642", surface=BREAD
    )
    # a stick of butter, dropped beside the plate
    bodies.box(
        spec,
        "butter",
        size=(0.12, 0.032, 0.032),
        pos=(0.0, -0.049174, 0.786),
        yaw_deg=8.0,
        look="#f3d97b",
        surface=BUTTER,
    )
    # a packet of cereal, standing
    bodies.box(
        spec, "cereal_box", size=(0.06, 0.19, 0.3), pos=(0.14, 0.24, 0.9), yaw_deg=-78.0, look="#c8452d", surface=CARD
    )
    assets.add(spec, "table", name="table", pos=(0.0, 0.0, 0.375), height=0.75, fixed=True)
    assets.add(spec, "chair", name="chair", pos=(0.0, -0.743458, 0.43), yaw_deg=90.0, height=0.86)
    assets.add(spec, "plate", name="plate", pos=(0.0, -0.24, 0.763), height=0.026)
    assets.add(spec, "bowl", name="bowl", pos=(-0.3, 0.12, 0.785), height=0.07)
    assets.add(spec, "mug", name="mug", pos=(0.267102, -0.18, 0.8175), yaw_deg=55.0, height=0.095)
    assets.add(spec, "apple", name="apple", pos=(-0.3, 0.12, 0.8395), height=0.079)
    assets.add(spec, "book", name="lower_book", pos=(-0.57, -0.12, 0.766), yaw_deg=78.0, height=0.032)
    assets.add(
        spec, "book", name="upper_book", pos=(-0.56407, -0.116149, 0.825), yaw_deg=95.0, height=0.026, look="#3d6b57"
    )
    assets.add(spec, "lamp", name="lamp", pos=(-0.58, 0.24, 0.975), height=0.45)
    assets.add(spec, "laptop", name="laptop", pos=(0.52, 0.06, 0.862), yaw_deg=-122.911034, height=0.224)

    cameras.add(spec, "overview", view="perspective", subjects=("table", "chair", "lamp", "cereal_box"))
    cameras.add(spec, "side", view="side_minus_y", subjects=("table", "chair"))
    cameras.add(spec, "above", view="top_down", subjects=("table",))
    cameras.add(spec, "close", view="close_up", subjects=("plate", "mug", "bowl", "toast"), fovy=35.0)

    return spec


if __name__ == "__main__":
    program.main(
        build, duration=DURATION, fps=24, size=(1280, 720), movers=("toast", "butter", "apple", "mug", "upper_book")
    )
