"""Two billiard balls collide head-on and move apart.

What the plan claims of it:
- The balls roll towards each other and collide.
- After the collision they move on in opposite directions.
- The collision itself conserves the pair's momentum.
- Once the cloth has undone the slip, both balls roll again, until a cushion turns one of them.
- The balls stay on the bed of the table and sink into nothing.
- The scene reads as a real pool table in a warmly lit room, with both balls clearly visible.

Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.
Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.
"""

import mujoco

from worldkit import assets, cameras, contacts, motion, program, scene

TIME_STEP = 0.000125  # s
DURATION = 3.0  # s
GRAVITY = (0.0, 0.0, -9.81)  # m/s^2
BALL_RADIUS = 0.028575  # m; WPA equipment specification: diameter 2.25 in

# phenolic: D. Alciatore, Physical properties of pool balls: ball-ball friction 0.03-0.08, restitution 0.92-0.98
PHENOLIC = contacts.surface(
    friction=0.06, torsional=0.0005, rolling=1e-05, restitution=0.95, time_constant=4 * TIME_STEP
)
# cloth: D. Alciatore, Physical properties: ball-cloth sliding 0.15-0.4, rolling resistance 0.005-0.015 times the
# radius, drop restitution 0.5
CLOTH = contacts.surface(friction=0.2, torsional=0.001, rolling=0.00028, restitution=0.5, time_constant=4 * TIME_STEP)


def build() -> mujoco.MjSpec:
    """The world at t = 0: 3 objects; cue_ball, object_ball should move."""
    spec = scene.new(
        "two-billiard-balls-collide-head-on-and-move-apart",
        time_step=TIME_STEP,
        gravity=GRAVITY,
        integrator="implicitfast",
        setting="room",
        floor="wood_planks",
    )
    assets.add(spec, "pool_table", name="pool_table", pos=(0.0, 0.0, 0.41), height=0.82, surface=CLOTH, fixed=True)
    assets.add(
        spec,
        "billiard_ball",
        name="cue_ball",
        pos=(-0.5, 0.0, 0.804774),
        mass=0.17,
        height=0.05715,
        surface=PHENOLIC,
        look="phenolic_white",
    )
    assets.add(
        spec,
        "billiard_ball",
        name="object_ball",
        pos=(0.5, 0.0, 0.804774),
        yaw_deg=180.0,
        mass=0.17,
        height=0.05715,
        surface=PHENOLIC,
        look="phenolic_red",
    )

    cameras.add(spec, "overview", view="perspective", subjects=("cue_ball", "object_ball"), fovy=35.0)
    cameras.add(spec, "side", view="side_minus_y", subjects=("cue_ball", "object_ball"), fovy=35.0)
    cameras.add(spec, "above", view="top_down", subjects=("cue_ball", "object_ball"))

    motion.launch(
        spec,
        {
            "cue_ball": motion.Launch(linear=(1.4, 0.0, 0.0), angular=(0.0, 48.994, 0.0)),
            "object_ball": motion.Launch(linear=(-1.0, 0.0, 0.0), angular=(0.0, -34.996, 0.0)),
        },
    )

    return spec


if __name__ == "__main__":
    program.main(build, duration=DURATION, fps=24, size=(1280, 720), movers=("cue_ball", "object_ball"))
