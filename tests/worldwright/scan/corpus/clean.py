"""Forty worlds in which nothing is wrong, though much looks suspicious: the scanner must not block any of them."""

import numpy as np
from parts import BOUNCY, ball, box, mjcf, pendulum
from simulate import World


def _push(body, force):
    def hook(model, data):
        data.body(body).xfrc_applied[:3] = force(data) if callable(force) else force

    return hook


def _spin(name, linear=(0, 0, 0), angular=(0, 0, 0)):
    def hook(model, data):
        address = model.jnt_dofadr[model.body(name).jntadr[0]]
        data.qvel[address : address + 3] = linear
        data.qvel[address + 3 : address + 6] = angular

    return hook


def _all(*hooks):
    def hook(model, data):
        for one in hooks:
            one(model, data)

    return hook


def _angle(**values):
    def hook(model, data):
        for name, value in values.items():
            data.joint(name).qpos[0] = value

    return hook


def _break_weld(model, data):
    if abs(data.efc_force[: data.ne]).max(initial=0.0) > 300:
        data.eq_active[0] = 0


def _central(data):
    away = data.body("planet").xpos - np.array([0, 0, 2.0])
    return -0.5 * 4.0 * away / np.linalg.norm(away) ** 3


def _lorentz(data):
    return np.cross(data.body("ball").cvel[3:], (0, 0, 6.0)) * 0.5


def _buoyant(data):
    z = data.body("cork").xpos[2]
    depth = np.clip((0.55 - z) / 0.1, 0, 1)
    return np.array([0, 0, 1000 * 9.81 * 0.001 * depth]) - 3.0 * depth * data.body("cork").cvel[3:]


def _motor(model, data):
    data.ctrl[:] = 2.0


def _hover(model, data):
    data.ctrl[0] = 9.81 * 1.0 + 4 * (1.0 - data.body("drone").xpos[2]) - 3 * data.body("drone").cvel[5]


def _mocap(model, data):
    data.mocap_pos[0] = (0.3 * np.sin(2 * data.time), 0, 0.2)


DOMINOES = "".join(box(f"d{k}", f"{0.12 * k} 0 0.15", "0.015 0.06 0.15", mass=0.2) for k in range(10))
CRADLE = "".join(pendulum(f"b{k}", f"{0.1001 * k} 0 2", 1.0, geom='solref="-1e5 -10" condim="1"') for k in range(5))
CHAIN = (
    "".join(
        f'<body name="link{k}" pos="{0 if k == 0 else 0.1} 0 {2 if k == 0 else 0}"><joint type="ball" damping="0.001" armature="1e-5"/>'
        '<geom type="capsule" fromto="0 0 0 0.1 0 0" size="0.01" mass="0.05" contype="0" conaffinity="0"/>'
        for k in range(8)
    )
    + "</body>" * 8
)
TOP = (
    '<body name="top" pos="0 0 0.06"><freejoint/><geom type="cylinder" size="0.05 0.01" mass="0.2"/>'
    '<geom type="capsule" fromto="0 0 -0.05 0 0 0.05" size="0.005" mass="0.02"/></body>'
)
TEE = (
    '<body name="tee" pos="0 0 1"><freejoint/><geom type="box" size="0.15 0.02 0.02" mass="0.3"/>'
    '<geom type="box" pos="0 0.08 0" size="0.02 0.06 0.02" mass="0.12"/></body>'
)
CAR = (
    '<body name="car" pos="0 0 0.1"><freejoint/><geom type="box" size="0.2 0.1 0.03" mass="2"/>'
    + "".join(
        f'<body name="wheel{i}{j}" pos="{x} {y} -0.03" euler="90 0 0"><joint name="axle{i}{j}" axis="0 0 1"/>'
        '<geom type="cylinder" size="0.06 0.02" mass="0.2" friction="1 0.01 0.001"/></body>'
        for i, x in enumerate((-0.14, 0.14))
        for j, y in enumerate((-0.13, 0.13))
    )
    + "</body>"
)


def worlds() -> list[World]:
    """Every clean world."""
    return [
        World("ringing_pendulum", mjcf(pendulum(at='euler="0 40 0"')), 20.0),
        World(
            "double_pendulum",
            mjcf(
                pendulum("a", "0 0 3", 0.8, at='euler="0 120 0"').replace(
                    "</body>", pendulum("b", "0 0 -0.8", 0.7) + "</body>"
                ),
                ground=False,
            ),
            10.0,
        ),
        World(
            "newtons_cradle",
            mjcf(CRADLE, option='cone="elliptic"', ground=False).replace("0.002", "0.0005"),
            6.0,
            start=_angle(b0=0.6),
        ),
        World(
            "breaking_weld",
            mjcf(
                box("shelf", "0 0 1", "0.3 0.3 0.02") + ball("weight", "0 0 2", 0.1, mass=8.0),
                more='<equality><weld name="w" body1="shelf"/></equality>',
            ),
            3.0,
            before=_break_weld,
        ),
        World(
            "rocket",
            mjcf(
                '<body name="rocket" pos="0 0 0.3"><freejoint/><geom type="capsule" size="0.05 0.2" mass="1"/><site name="nozzle" pos="0 0 -0.25"/></body>',
                more='<actuator><general name="thrust" site="nozzle" gear="0 0 1 0 0 0"/></actuator>',
            ),
            3.0,
            before=lambda m, d: d.ctrl.__setitem__(0, 15.0 if d.time < 1.5 else 0.0),
        ),
        World(
            "rocket_by_force",
            mjcf(
                '<body name="rocket" pos="0 0 0.3"><freejoint/><geom type="capsule" size="0.05 0.2" mass="1"/></body>'
            ),
            2.0,
            before=_push("rocket", (0, 0, 15.0)),
        ),
        World(
            "stick_slip",
            mjcf(
                '<body name="block" pos="0 0 0.1"><joint name="x" type="slide" axis="1 0 0"/><joint name="z" type="slide" axis="0 0 1"/><geom name="block" type="box" size="0.1 0.1 0.1" mass="1" friction="0.6"/></body><body name="puller" mocap="true" pos="0.5 0 0.1"><geom size="0.03" contype="0" conaffinity="0"/><site name="p"/></body>',
                more='<tendon><spatial stiffness="40" springlength="0.3"><site site="p"/><site site="q"/></spatial></tendon>',
            ).replace('friction="0.6"/>', 'friction="0.6"/><site name="q"/>'),
            6.0,
            before=lambda m, d: d.mocap_pos.__setitem__(0, (0.5 + 0.15 * d.time, 0, 0.1)),
        ),
        World(
            "circular_orbit",
            mjcf(ball("planet", "1 0 2"), option='gravity="0 0 0"', ground=False),
            8.0,
            start=_spin("planet", (0, 2, 0)),
            before=_push("planet", _central),
        ),
        World(
            "eccentric_orbit",
            mjcf(ball("planet", "1 0 2"), option='gravity="0 0 0"', ground=False),
            8.0,
            start=_spin("planet", (0, 1.3, 0)),
            before=_push("planet", _central),
        ),
        World("superball", mjcf(ball(geom=BOUNCY)), 6.0),
        World("superball_30hz", mjcf(ball(geom=BOUNCY)), 6.0, rate=30.0),
        World("superball_1khz", mjcf(ball(geom=BOUNCY)).replace("0.002", "0.001"), 4.0, rate=1000.0),
        World("spinning_top", mjcf(TOP), 4.0, start=_spin("top", angular=(0, 0, 200))),
        World(
            "tennis_racket_effect",
            mjcf(TEE, option='gravity="0 0 0"', ground=False),
            8.0,
            start=_spin("tee", angular=(0.01, 12, 0.02)),
        ),
        World(
            "gyroscope",
            mjcf(
                '<body name="gimbal" pos="0 0 1"><joint type="ball"/><geom type="capsule" fromto="0 0 0 0.2 0 0" size="0.005" mass="0.01"/><body name="rotor" pos="0.2 0 0"><joint name="spin" axis="1 0 0"/><geom type="cylinder" euler="0 90 0" size="0.08 0.01" mass="0.4"/></body></body>',
                ground=False,
            ),
            5.0,
            start=lambda m, d: d.joint("spin").qvel.__setitem__(0, 150),
        ),
        World("dominoes", mjcf(DOMINOES), 3.0, start=_spin("d0", angular=(0, 6, 0))),
        World("stack_of_boxes", mjcf("".join(box(f"b{k}", f"0 0 {0.1 + 0.2 * k}") for k in range(6))), 3.0),
        World(
            "leaning_tower_falls", mjcf("".join(box(f"b{k}", f"{0.06 * k} 0 {0.1 + 0.2 * k}") for k in range(5))), 3.0
        ),
        World(
            "rolling_ball",
            mjcf(ball("ball", "0 0 0.05", geom='condim="6" friction="0.8 0.005 0.0001"')),
            3.0,
            start=_spin("ball", (1, 0, 0), (0, 20, 0)),
        ),
        World(
            "bowling_slide_then_roll",
            mjcf(ball("ball", "0 0 0.1", 0.1, 'condim="3" friction="0.3"', 6.0)),
            3.0,
            start=_spin("ball", (4, 0, 0)),
        ),
        World(
            "ice_block",
            mjcf(box("ice", "0 0 0.1", geom='friction="0.01" priority="1"')),
            4.0,
            start=_spin("ice", (2, 0, 0)),
        ),
        World(
            "conveyor",
            mjcf(
                '<geom name="belt" type="box" pos="0 0 0.25" size="2 0.3 0.05" surfacevel="1 0 0 0 0 0"/>'
                + box("parcel", "-1 0 0.4")
            ),
            2.5,
        ),
        World("hanging_chain", mjcf(CHAIN, ground=False), 6.0),
        World(
            "driven_hinge",
            mjcf(pendulum(joint='damping="0.5"'), more='<actuator><motor joint="bob" gear="1"/></actuator>'),
            5.0,
            before=_motor,
        ),
        World(
            "position_servo",
            mjcf(pendulum(joint='damping="1"'), more='<actuator><position joint="bob" kp="60"/></actuator>'),
            4.0,
            before=_motor,
        ),
        World(
            "car_drives",
            mjcf(
                CAR,
                more="<actuator>"
                + "".join(f'<motor joint="axle{i}{j}" gear="0.5"/>' for i in (0, 1) for j in (0, 1))
                + "</actuator>",
            ),
            3.0,
            before=lambda m, d: d.ctrl.__setitem__(slice(None), -0.6),
        ),
        World(
            "drone_hovers",
            mjcf(
                '<body name="drone" pos="0 0 0.5"><freejoint/><geom type="box" size="0.2 0.2 0.03" mass="1"/><site name="up"/></body>',
                more='<actuator><general site="up" gear="0 0 1 0 0 0"/></actuator>',
            ),
            5.0,
            before=_hover,
        ),
        World(
            "ball_in_bowl",
            mjcf(
                ball("marble", "0.2 0 0.5", 0.03)
                + '<geom type="box" pos="0.3 0 0.2" euler="0 -30 0" size="0.3 0.3 0.01"/><geom type="box" pos="-0.3 0 0.2" euler="0 30 0" size="0.3 0.3 0.01"/>'
            ),
            5.0,
        ),
        World(
            "mass_on_spring",
            mjcf(
                '<body name="mass" pos="0 0 1"><joint type="slide" axis="0 0 1" stiffness="40" springref="0.2"/><geom size="0.08" mass="1"/></body>',
                ground=False,
            ),
            8.0,
        ),
        World(
            "spring_launcher",
            mjcf(
                '<body name="plate" pos="0 0 0.3"><joint name="s" type="slide" axis="0 0 1" stiffness="3000" damping="5" range="-0.2 0.02"/><geom type="box" size="0.15 0.15 0.02" mass="0.3"/></body>'
                + ball("ball", "0 0 0.25", 0.05)
            ),
            2.0,
            start=_angle(s=-0.1),
        ),
        World(
            "cork_floats",
            mjcf(
                '<body name="cork" pos="0 0 1"><freejoint/><geom type="cylinder" size="0.05 0.05" mass="0.25"/></body>'
            ),
            5.0,
            before=_push("cork", _buoyant),
        ),
        World(
            "magnetic_field",
            mjcf(ball("ball", "0 0 1"), option='gravity="0 0 0"', ground=False),
            4.0,
            start=_spin("ball", (1, 0, 0.2)),
            before=_push("ball", _lorentz),
        ),
        World(
            "feather_in_air",
            mjcf(
                '<body name="feather" pos="0 0 2"><freejoint/><geom type="ellipsoid" size="0.1 0.03 0.002" mass="0.002" fluidshape="ellipsoid"/></body>',
                option='density="1.2" viscosity="1.8e-5"',
            ),
            4.0,
        ),
        World(
            "mocap_pusher",
            mjcf(
                '<body name="hand" mocap="true" pos="0 0 0.2"><geom type="box" size="0.05 0.3 0.1"/></body>'
                + box("box", "0.45 0 0.1")
            ),
            4.0,
            before=_mocap,
        ),
        World(
            "bullet",
            mjcf(
                ball("bullet", "0 0 1", 0.03, mass=0.05) + box("target", "1.3 0 1", "0.2 0.2 0.2", mass=3.0),
                ground=False,
                option='gravity="0 0 0"',
            ).replace("0.002", "0.0002"),
            0.15,
            rate=1000.0,
            start=_spin("bullet", (20, 0, 0)),
        ),
        World(
            "billiards",
            mjcf(ball("cue", "-0.5 0 0.03", 0.03, BOUNCY) + ball("red", "0 0.01 0.03", 0.03, BOUNCY)).replace(
                "0.002", "0.0005"
            ),
            2.5,
            start=_spin("cue", (2, 0, 0)),
        ),
        World("moon_drop", mjcf(box("crate", "0 0 2"), option='gravity="0 0 -1.62"'), 3.0),
        World(
            "resting_mug",
            mjcf(
                '<body name="mug" pos="0 0 0.05"><freejoint/><geom type="cylinder" size="0.04 0.05" mass="0.3"/></body>'
            ),
            4.0,
        ),
        World(
            "trapdoor_hinge_limit",
            mjcf(
                '<body name="door" pos="0 0 1"><joint name="h" axis="0 1 0" range="-70 0" damping="0.05"/><geom type="box" pos="0.3 0 0" size="0.3 0.2 0.01" mass="1"/></body>',
                ground=False,
            ),
            4.0,
        ),
        World(
            "seesaw",
            mjcf(
                '<body name="plank" pos="0 0 0.3"><joint axis="0 1 0" range="-20 20"/><geom type="box" size="1 0.15 0.02" mass="2"/></body>'
                + box("left", "-0.8 0 0.5")
                + box("right", "0.7 0 1.2", mass=2.0)
            ),
            3.0,
        ),
        World(
            "thrown_and_tumbling",
            mjcf(box("brick", "0 0 1", "0.1 0.05 0.03")),
            2.0,
            start=_spin("brick", (3, 0, 4), (10, 5, 3)),
        ),
        World(
            "marbles_pour",
            mjcf(
                "".join(
                    ball(
                        f"m{k}",
                        f"{0.03 * (k % 3)} {0.03 * (k % 2)} {0.3 + 0.06 * k}",
                        0.02,
                        'solref="0.005 1"',
                        mass=0.02,
                    )
                    for k in range(15)
                )
            ),
            3.0,
        ),
        World(
            "wrecking_ball",
            mjcf(
                pendulum("ball", "-1 0 2", 1.5, at='euler="0 80 0"')
                + "".join(box(f"w{k}", f"-0.85 0 {0.1 + 0.2 * k}", mass=0.5) for k in range(4))
            ),
            3.0,
        ),
        World(
            "sparse_tumble",
            mjcf(box("die", "0 0 1", "0.05 0.05 0.05", mass=0.1)),
            2.0,
            rate=30.0,
            start=_spin("die", (1, 0, 0), (15, 20, 5)),
        ),
    ]
