"""Worlds with one planted mistake each, in the simulation or in the recording, and the checks that may name it."""

import numpy as np
from clean import CHAIN, _push, _spin
from parts import BOUNCY, ball, box, mjcf, pendulum
from simulate import World

FLIGHT = ("flight_force", "velocity_jump", "free_fall", "momentum_drift")


def _after(time, change, once=True):
    done = []

    def hook(model, data):
        if data.time >= time and not (once and done):
            done.append(True)
            change(model, data)

    return hook


def _qvel(body, index, value, add=True):
    def change(model, data):
        address = model.jnt_dofadr[model.body(body).jntadr[0]] + index
        data.qvel[address] = value + (data.qvel[address] if add else 0)

    return change


def _qpos(body, index, value, add=True):
    def change(model, data):
        address = model.jnt_qposadr[model.body(body).jntadr[0]] + index
        data.qpos[address] = value + (data.qpos[address] if add else 0)

    return change


def _gravity(z):
    def change(model, data):
        model.opt.gravity[2] = z

    return change


def _no_contact(model, data):
    model.geom_contype[:] = 0
    model.geom_conaffinity[:] = 0


def _glide(body, velocity):
    def hook(model, data):
        address = model.jnt_qposadr[model.body(body).jntadr[0]]
        dof = model.jnt_dofadr[model.body(body).jntadr[0]]
        data.qpos[address : address + 3] += np.array(velocity) * model.opt.timestep
        data.qvel[dof : dof + 6] = 0

    return hook


def _scripted(body, path):
    """Pose and velocity written every step: motion that no force explains."""

    def hook(model, data):
        address = model.jnt_qposadr[model.body(body).jntadr[0]]
        dof = model.jnt_dofadr[model.body(body).jntadr[0]]
        now, later = np.array(path(data.time)), np.array(path(data.time + 1e-4))
        data.qpos[address : address + 3] = now
        data.qvel[dof : dof + 3] = (later - now) / 1e-4
        data.qvel[dof + 3 : dof + 6] = 0

    return hook


def _rows(arrays, start, stop=None):
    t = arrays["t"]
    return slice(int(np.searchsorted(t, start)), None if stop is None else int(np.searchsorted(t, stop)))


def _nan(a):
    a["pos"][_rows(a, 1.0), 0] = np.nan


def _inf_velocity(a):
    a["linvel"][_rows(a, 1.2, 1.3), 0, 2] = np.inf


def _jump(a):
    a["pos"][_rows(a, 1.0), 0, 0] += 0.4


def _flip(a):
    a["quat"][_rows(a, 1.0), 0] = (0, 1, 0, 0)


def _frozen(a):
    rows = _rows(a, 0.2)
    a["pos"][rows, 0] = a["pos"][rows.start, 0]


def _all_frozen(a):
    rows = _rows(a, 0.2)
    for key in ("pos", "quat"):
        a[key][rows] = a[key][rows.start]


def _long_quat(a):
    a["quat"] *= 1.4


def _wrong_velocity(a):
    a["linvel"] *= 0.3


def _no_spin(a):
    a["quat"][:] = (1, 0, 0, 0)
    a["angvel"][:] = 0


def _sink(a):
    rows = _rows(a, 0.5)
    a["pos"][rows, 0, 2] -= 0.03 * (a["t"][rows] - 0.5)
    a["linvel"][rows, 0, 2] -= 0.03


def _hold(body, z):
    def hook(model, data):
        dof = model.jnt_dofadr[model.body(body).jntadr[0]]
        data.qfrc_applied[dof : dof + 3] = model.body(body).mass[0] * np.array([0, 0, 9.81])
        data.qvel[dof : dof + 6] *= 0.98

    return hook


def _stop(model, data):
    data.qvel[:] = 0


def _freeze(time):
    kept = []

    def hook(model, data):
        if data.time >= time:
            if not kept:
                kept.append(data.qpos.copy())
            data.qpos[:] = kept[0]
            data.qvel[:] = 0

    return hook


def _pump(model, data):
    data.qvel[0] *= 1.0015


def _negative_damping(model, data):
    data.qfrc_applied[:] = 0.15 * data.qvel


def _lively(body, factor):
    state = {"v": 0.0}

    def hook(model, data):
        dof = model.jnt_dofadr[model.body(body).jntadr[0]] + 2
        v = data.qvel[dof]
        if state["v"] < -0.3 and v > 0.3 and data.ncon == 0:
            data.qvel[dof] = -state["v"] * factor
            state["v"] = 0.0
        state["v"] = min(state["v"], v)

    return hook


SPIN_UP = _push("top", 0)


def _torque(body, value):
    def hook(model, data):
        data.body(body).xfrc_applied[3:] = value

    return hook


def _chatter(model, data):
    if int(data.time * 25) % 2:
        data.body("box").xfrc_applied[2] = 25
    else:
        data.body("box").xfrc_applied[2] = -25


WARNED = frozenset({"chatters", "never_settles", "scripted_arc"})
"""Faults that a recording without a ledger cannot tell from an honest drive: a warning is all it can give."""
WALL = '<geom name="wall" type="box" pos="1 0 0.5" size="0.01 1 0.5"/>'
PAIR = box("a", "0 0 0.1") + box("b", "0.4 0 0.1")


def worlds() -> list[World]:
    """Every faulty world."""
    return [
        World("nan_after_a_second", mjcf(ball()), edit=_nan, fault=("nan",)),
        World("infinite_velocity", mjcf(ball(geom=BOUNCY)), edit=_inf_velocity, fault=("nan",)),
        World("jump_in_recording", mjcf(box("crate", "0 0 0.1")), edit=_jump, fault=("teleportation",)),
        World(
            "jump_in_simulation",
            mjcf(box("crate", "0 0 1.5")),
            before=_after(0.3, _qpos("crate", 0, 0.3)),
            fault=("teleportation",),
        ),
        World(
            "jump_of_a_pendulum",
            mjcf(pendulum(at='euler="0 30 0"')),
            before=_after(1.0, _qpos("bob", 0, 1.2)),
            fault=("teleportation",),
        ),
        World("orientation_flips", mjcf(box("crate", "0 0 0.1")), edit=_flip, fault=("teleportation",)),
        World(
            "position_channel_freezes",
            mjcf(ball("ball", "0 0 3")),
            1.0,
            edit=_frozen,
            fault=("frozen_channel", "position_without_velocity"),
        ),
        World(
            "picture_freezes",
            mjcf(ball("ball", "0 0 3", geom=BOUNCY)),
            2.0,
            edit=_all_frozen,
            fault=("frozen_channel", "position_without_velocity"),
        ),
        World("quaternions_not_unit", mjcf(box("crate", "0 0 1")), edit=_long_quat, fault=("broken_orientation",)),
        World(
            "velocities_scaled",
            mjcf(ball("ball", "0 0 4")),
            0.9,
            edit=_wrong_velocity,
            fault=("position_without_velocity", "velocity_mismatch", "free_fall"),
        ),
        World(
            "sinks_slowly",
            mjcf(box("crate", "0 0 0.1")),
            3.0,
            edit=_sink,
            fault=("monotonic_sinking", "below_ground", "position_without_velocity"),
        ),
        World(
            "sinks_in_soft_floor",
            mjcf(box("crate", "0 0 0.1", geom='solref="0.5 5" solimp="0.1 0.2 0.5"', mass=50)),
            4.0,
            fault=("deep_penetration", "monotonic_sinking"),
        ),
        World(
            "falls_through_floor",
            mjcf(box("crate", "0 0 1")),
            2.0,
            before=_after(0.3, _no_contact),
            fault=("below_ground", "tunnelling"),
        ),
        World(
            "never_collides",
            mjcf(ball("ball", "0 0 1", geom='contype="0" conaffinity="0"')),
            1.5,
            fault=("below_ground", "tunnelling"),
            needs_model=True,
        ),
        World(
            "tunnels_through_wall",
            mjcf(ball("shot", "0 0 0.5", 0.02, 'contype="2" conaffinity="2"') + WALL, option='gravity="0 0 0"'),
            1.0,
            start=_spin("shot", (4, 0, 0)),
            fault=("tunnelling",),
            needs_model=True,
        ),
        World(
            "fast_ball_tunnels",
            mjcf(ball("shot", "0 0 0.5", 0.02) + WALL, option='gravity="0 0 0"').replace("0.002", "0.01"),
            0.5,
            start=_spin("shot", (90, 0, 0)),
            fault=("tunnelling",),
            needs_model=True,
        ),
        World(
            "bodies_pass_through",
            mjcf(
                ball("a", "-1 0 1", 0.1, 'contype="0"') + ball("b", "1 0 1", 0.1, 'contype="0" conaffinity="0"'),
                option='gravity="0 0 0"',
                ground=False,
            ),
            2.0,
            start=lambda m, d: (_spin("a", (1, 0, 0))(m, d), _spin("b", (-1, 0, 0))(m, d)),
            fault=("tunnelling",),
            needs_model=True,
        ),
        World(
            "starts_inside",
            mjcf(box("a", "0 0 0.1") + box("b", "0.05 0 0.1")),
            2.0,
            fault=("energy_gain", "deep_penetration", "runaway_velocity", "contact_force_spike"),
        ),
        World(
            "bounces_higher",
            mjcf(ball(geom=BOUNCY)),
            4.0,
            before=_lively("ball", 1.1),
            fault=("energy_gain", "bounce_gain"),
        ),
        World("pendulum_pumped", mjcf(pendulum(at='euler="0 15 0"')), 5.0, before=_pump, fault=("energy_gain",)),
        World(
            "negative_damping",
            mjcf(pendulum(at='euler="0 20 0"')),
            6.0,
            before=_negative_damping,
            fault=("energy_gain",),
        ),
        World(
            "kick_in_mid_air", mjcf(ball("ball", "0 0 3")), 0.9, before=_after(0.3, _qvel("ball", 0, 2.0)), fault=FLIGHT
        ),
        World(
            "kick_upwards",
            mjcf(ball("ball", "0 0 1.5", geom=BOUNCY)),
            2.0,
            before=_after(0.3, _qvel("ball", 2, 3.0)),
            fault=FLIGHT,
        ),
        World(
            "half_gravity",
            mjcf(ball("ball", "0 0 5")),
            1.2,
            start=lambda m, d: _gravity(-4.9)(m, d),
            fault=("free_fall",),
            needs_model=True,
        ),
        World(
            "gravity_changes",
            mjcf(ball("ball", "0 0 5")),
            1.0,
            before=_after(0.4, _gravity(-2.0)),
            fault=("free_fall", "flight_force"),
            needs_model=True,
        ),
        World(
            "gravity_reversed",
            mjcf(box("crate", "0 0 1")),
            1.0,
            start=_gravity(9.81),
            fault=("free_fall", "flight_force"),
            needs_model=True,
        ),
        World(
            "joint_beyond_limit",
            mjcf(
                '<body name="door" pos="0 0 1"><joint name="h" axis="0 0 1" range="-30 30"/><geom type="box" pos="0.3 0 0" size="0.3 0.02 0.2" mass="1"/></body>',
                ground=False,
            ),
            2.0,
            start=lambda m, d: d.joint("h").qvel.__setitem__(0, 2.0),
            before=lambda m, d: setattr(m.opt, "disableflags", int(m.opt.disableflags) | 8),
            fault=("joint_limit",),
            needs_model=True,
        ),
        World(
            "weld_drifts",
            mjcf(
                box("a", "0 0 1") + box("b", "0.3 0 1"),
                more='<equality><weld body1="a" body2="b" solref="0.3 1" solimp="0.9 0.95 0.001"/></equality>',
                ground=False,
                option='gravity="0 0 0"',
            ),
            1.5,
            start=_spin("b", (1.5, 0, 0)),
            fault=("constraint_drift",),
            needs_model=True,
        ),
        World(
            "stops_dead",
            mjcf(ball("ball", "0 0 4")),
            0.9,
            before=_after(0.5, _stop),
            fault=("dead_stop", "velocity_jump", "flight_force"),
        ),
        World(
            "slider_stops_dead",
            mjcf(box("ice", "0 0 0.1", geom='friction="0.01" priority="1"')),
            3.0,
            start=_spin("ice", (2, 0, 0)),
            before=_after(1.0, _stop),
            fault=("dead_stop",),
        ),
        World(
            "freezes_in_the_air",
            mjcf(ball("ball", "0 0 3")),
            1.5,
            before=_freeze(0.4),
            fault=("dead_stop", "floating", "frozen_channel", "velocity_jump"),
        ),
        World(
            "floats_without_support",
            mjcf(box("lamp", "0 0 1") + box("crate", "1 0 0.1")),
            2.0,
            before=_hold("lamp", 1.0),
            fault=("floating", "free_fall", "flight_force"),
        ),
        World(
            "glides_without_velocity",
            mjcf(box("crate", "0 0 0.1")),
            2.0,
            before=_glide("crate", (0.4, 0, 0)),
            fault=("position_without_velocity", "faked_motion"),
        ),
        World(
            "scripted_arc",
            mjcf(box("bird", "0 0 1") + box("crate", "2 0 0.1")),
            3.0,
            before=_scripted("bird", lambda t: (0.5 * t, 0, 1 + 0.2 * np.sin(6 * t))),
            fault=("faked_motion", "flight_force", "free_fall", "floating", "sliding_without_friction"),
        ),
        World(
            "scripted_slide",
            mjcf(box("crate", "0 0 0.1")),
            3.0,
            before=_scripted("crate", lambda t: (0.5 * t, 0, 0.1)),
            fault=("faked_motion", "sliding_without_friction", "floating"),
        ),
        World(
            "ball_slides_as_if_rolling",
            mjcf(ball("ball", "0 0 0.1", 0.1)),
            3.0,
            start=_spin("ball", (1, 0, 0), (0, 10, 0)),
            edit=_no_spin,
            fault=("sliding_as_rolling",),
            needs=("ncon",),
        ),
        World(
            "spins_up_by_itself",
            mjcf(
                '<body name="top" pos="0 0 1"><freejoint/><geom type="box" size="0.2 0.1 0.05" mass="1"/></body>',
                option='gravity="0 0 0"',
                ground=False,
            ),
            4.0,
            before=_torque("top", (0, 0, 0.3)),
            fault=("spin_up", "flight_torque", "energy_gain"),
        ),
        World(
            "runs_away",
            mjcf(CHAIN, ground=False),
            6.0,
            before=lambda m, d: d.qfrc_applied.__setitem__(slice(None), 0.004 * d.qvel),
            fault=("energy_gain", "runaway_velocity", "nan", "solver_warning", "teleportation", "spin_up", "clock"),
        ),
        World(
            "force_spike",
            mjcf(box("a", "0 0 0.1") + box("b", "0 0 0.3")),
            2.0,
            before=_after(1.0, _qpos("b", 2, -0.05)),
            fault=("contact_force_spike", "teleportation", "deep_penetration", "energy_gain"),
        ),
        World(
            "chatters",
            mjcf(box("box", "0 0 0.1")),
            3.0,
            before=_chatter,
            fault=("contact_chatter", "failure_to_settle", "flight_force"),
        ),
        World(
            "never_settles",
            mjcf(box("box", "0 0 0.3")),
            5.0,
            before=lambda m, d: d.qfrc_applied.__setitem__(
                slice(0, 3), (6 * np.sin(9 * d.time), 6 * np.cos(7 * d.time), 8 * np.sin(11 * d.time))
            ),
            fault=("failure_to_settle", "contact_chatter", "energy_gain", "flight_force"),
        ),
        World(
            "giant_cup",
            mjcf('<body name="cup" pos="0 0 500"><freejoint/><geom type="cylinder" size="400 500" mass="0.3"/></body>'),
            1.0,
            fault=("implausible_scale",),
            needs_model=True,
        ),
        World(
            "side_force_in_flight",
            mjcf(ball("ball", "0 0 6")),
            1.0,
            before=_push("ball", lambda d: (3 if d.time > 0.4 else 0, 0, 0)),
            fault=FLIGHT,
            needs_model=True,
        ),
        World(
            "one_row_glitch",
            mjcf(pendulum(at='euler="0 40 0"')),
            4.0,
            edit=lambda a: a["pos"].__setitem__((150, 0, 1), 0.5),
            fault=("teleportation",),
        ),
        World(
            "clock_runs_backwards",
            mjcf(ball()),
            2.0,
            edit=lambda a: a["t"].__setitem__(slice(80, 90), a["t"][80:90][::-1].copy()),
            fault=("clock", "recording"),
        ),
    ]
