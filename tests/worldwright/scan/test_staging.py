"""Every kind of staging that capable authors were seen to use is caught; the honest way to the same outcome is not."""

import mujoco
import numpy as np
import pytest
from staged import World, audit, box, declare, empty, weld

# -- fasteners let go by a clock -------------------------------------------------------------------------------------


def shelf(release):
    """A shelf held by a bolt, onto which a load is winched down; `release(model, data, load)` says when it lets go."""

    def build():
        spec = empty()
        box(spec, "shelf", (0, 0, 1.0), (0.3, 0.3, 0.1), 2.0)
        box(spec, "crate", (0, 0, 1.35), (0.1, 0.1, 0.1), 8.0)
        weld(spec, "bolt", "shelf")
        return spec

    def control(model, data):
        mujoco.mj_forward(model, data)  # before it, the forces are not those of this state
        force = np.sqrt((data.efc_force[: data.ne] ** 2).sum())
        if data.eq_active[0] and release(data.time, force):
            data.eq_active[0] = 0

    return build, control


FALLS = {
    "claim": "The crate breaks the bolt.",
    "expect": [{"falls": {"body": "shelf", "min_m": 0.5}}],
    "cause": "crate",
}


def bolted(release, **more):
    build, control = shelf(release)
    return World(build, control, 1.4, ("shelf", "crate"), objectives=(FALLS,), **more)


def by_clock(time, force):
    return time > 0.8


def by_load(time, force):
    return force > 60.0


def test_a_bolt_that_lets_go_by_the_clock_is_caught_undeclared(tmp_path):
    found = audit(bolted(by_clock), tmp_path)
    assert {"WS108", "WS321"} <= found.codes()
    (cause,) = found.causes.causes
    assert cause.outcome == "survives"


def test_a_bolt_said_to_break_under_its_load_but_let_go_by_the_clock_is_caught(tmp_path):
    said = (declare("constraint", "bolt", trigger="load > 60 N"),)
    found = audit(bolted(by_clock, interventions=said), tmp_path)
    assert {"WS310", "WS321", "WS323"} <= found.codes()
    (trigger,) = found.causes.triggers
    assert trigger.outcome == "timed" and len(trigger.onsets_s) >= 2


def test_a_bolt_that_breaks_under_its_load_is_honest(tmp_path):
    said = (declare("constraint", "bolt", trigger="load > 60 N", law="the bolt lets go at its strength"),)
    found = audit(bolted(by_load, interventions=said), tmp_path)
    assert found.codes() == set(), [str(a) for a in (*found.scan.anomalies, *found.causes.anomalies)]
    assert found.causes.causes[0].outcome == "caused"
    assert found.causes.triggers[0].outcome == "consequence"
    assert found.causes.helpers[0].needed_by == (0,)
    assert found.ledger.ok and found.ledger.acting[0].when == "state"


# -- an invisible hand keeps a figure upright ------------------------------------------------------------------------


def figure(servo=False, hop=0.0):
    spec = empty()
    body = box(spec, "figure", (0, 0, 0.5), (0.05, 0.05, 0.5), 60.0)
    body.quat = (np.cos(0.02), np.sin(0.02), 0, 0)
    if servo:
        balance = spec.add_actuator(name="balance", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="pitch")
        slim = spec.worldbody.add_body(name="pole", pos=(2, 0, 0))
        slim.add_joint(name="pitch", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(1, 0, 0))
        slim.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=(0.02, 0.5, 0), pos=(0, 0, 0.6), mass=5.0)
        balance.gainprm[0] = 400.0
        balance.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        balance.biasprm[1], balance.biasprm[2] = -400.0, -40.0
    key = spec.add_key(name="start")
    key.qpos = [0, 0, 0.52, np.cos(0.02), np.sin(0.02), 0, 0, *([0.1] if servo else [])]
    key.qvel = [0, 0, hop, 0.3 * hop, 0, 0, *([0.0] if servo else [])]
    return spec


def upright(data):
    """A torque that keeps the figure upright, world frame."""
    up = data.xmat[1].reshape(3, 3)[:, 2]
    return 600.0 * np.cross(up, (0, 0, 1.0)) - 60.0 * data.xmat[1].reshape(3, 3) @ data.qvel[3:6]


def by_wrench(model, data):
    data.xfrc_applied[1, 3:] = upright(data)


def by_joint(model, data):
    data.qfrc_applied[3:6] = data.xmat[1].reshape(3, 3).T @ upright(data)


def by_stealth(model, data):
    data.qfrc_passive[3:6] += data.xmat[1].reshape(3, 3).T @ upright(data)


@pytest.mark.parametrize("hand", [by_wrench, by_joint])
def test_an_invisible_torque_is_caught_however_it_is_applied(hand, tmp_path):
    found = audit(World(lambda: figure(hop=3.0), hand, 0.6, ("figure",)), tmp_path)
    assert "WS108" in found.codes()
    (row,) = found.ledger.acting
    assert (row.kind, row.body, row.declared) == ("torque", "figure", False)
    assert row.peak > 5 and row.airborne_s > 0.3 and row.angular_impulse_n_m_s > 1
    assert abs(row.work_j) < 0.2 * row.angular_impulse_n_m_s * 10  # its work alone would say little


def test_a_torque_written_where_the_engine_computes_goes_nowhere(tmp_path):
    left_alone = World(lambda: figure(hop=3.0), None, 0.6, ("figure",)).run(tmp_path / "alone")
    by_hand = World(lambda: figure(hop=3.0), by_stealth, 0.6, ("figure",)).run(tmp_path / "by hand")
    assert by_hand.sha256 == left_alone.sha256


def test_a_servo_that_balances_from_inside_the_model_is_caught_unless_declared(tmp_path):
    claim = ({"claim": "the pole stays up", "expect": [{"stays_upright": {"body": "pole", "max_tilt_deg": 10}}]},)
    world = World(lambda: figure(servo=True), None, 0.6, ("pole",), objectives=claim)
    found = audit(world, tmp_path / "a")
    assert "WS308" in found.codes()
    assert [(r.kind, r.body) for r in found.ledger.undeclared] == [("control", "pole")]
    world.interventions = (declare("control", "balance", law="PD, 400 N·m/rad", source="the robot's data sheet"),)
    found = audit(world, tmp_path / "b")
    assert "WS308" not in found.codes() and found.ledger.ok
    (helper,) = found.causes.helpers
    assert helper.needed_by == (0,)  # switch the servo off, and the pole falls


def test_a_figure_held_by_its_own_joint_or_sent_off_spinning_is_caught(tmp_path):
    def build():
        spec = figure(hop=3.0)
        spec.joints[0].stiffness[0] = 300.0
        return spec

    found = audit(World(build, None, 0.3, ("figure",)), tmp_path)
    assert {"WS314", "WS316"} <= found.codes()


# -- parameters edited when it matters -------------------------------------------------------------------------------


def braked(edit):
    def build():
        spec = empty(gravity=0.0, floor=False)
        cart = spec.worldbody.add_body(name="cart")
        cart.add_joint(name="rail", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
        cart.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.1, 0.1), mass=5.0)
        key = spec.add_key(name="start")
        key.qvel = [2.0]
        return spec

    def control(model, data):
        if data.qpos[0] > 0.5:
            edit(model, data)

    return build, control


def test_friction_edited_at_the_right_moment_is_caught_and_its_part_shown(tmp_path):
    def edit(model, data):
        model.dof_frictionloss[0] = 330.0

    objective = {
        "claim": "The cart stops at the wall.",
        "expect": [{"comes_to_rest": {"body": "cart", "before_s": 0.9}}],
    }
    build, control = braked(edit)
    world = World(build, control, 1.0, ("cart",), objectives=(objective,), motion={"rail": {"joint_velocity": 2.0}})
    found = audit(world, tmp_path / "a")
    assert "WS108" in found.codes()
    world.interventions = (declare("parameter", "cart.dof_frictionloss", trigger="speed of cart > 0 m/s"),)
    found = audit(world, tmp_path / "b")
    (row,) = found.ledger.acting
    assert row.declared and row.target == "cart.dof_frictionloss[cart]"
    (helper,) = found.causes.helpers
    assert helper.needed_by == (0,)  # suppress the edit, and nothing stops the cart


def test_a_conveyor_nobody_mentions_is_caught_and_one_the_plan_names_is_not(tmp_path):
    def build():
        spec = empty()
        belt = spec.worldbody.add_body(name="belt", pos=(0, 0, 0.05))
        belt.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(1, 0.3, 0.05), surfacevel=(0.5, 0, 0, 0, 0, 0))
        box(spec, "parcel", (0, 0, 0.2))
        return spec

    carried = {"claim": "The belt carries the parcel.", "expect": [{"moves": {"body": "parcel", "min_m": 0.2}}]}
    world = World(build, None, 1.0, ("parcel",), objectives=(carried,))
    found = audit(world, tmp_path / "a")
    assert "WS315" in found.codes()
    world.interventions = (declare("force", "belt", law="its surface runs at 0.5 m/s", source="the prompt's belt"),)
    found = audit(world, tmp_path / "b")
    assert "WS315" not in found.codes()


# -- the load goes another way than shown ----------------------------------------------------------------------------


def crash(axle):
    """A vehicle runs against a wall with a crumple bumper in front; `axle` sticks out further and takes the blow."""
    spec = empty()
    wall = spec.worldbody.add_body(name="wall", pos=(2, 0, 0.5))
    wall.add_geom(name="wall", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 1, 0.5))
    car = spec.worldbody.add_body(name="car", pos=(0, 0, 0.2))
    car.add_joint(name="road", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    car.add_geom(name="car", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.4, 0.2, 0.1), mass=20.0)
    car.add_geom(name="axle", type=mujoco.mjtGeom.mjGEOM_BOX, size=(axle, 0.02, 0.02), mass=1.0, pos=(0.1, 0, -0.05))
    bumper = car.add_body(name="bumper", pos=(0.45, 0, 0.0))
    bumper.add_joint(
        name="crush", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0), damping=(8000, 0, 0), stiffness=(9e4, 0, 0)
    )
    bumper.add_geom(name="bumper", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.05, 0.15, 0.06), mass=2.0)
    key = spec.add_key(name="start")
    key.qpos, key.qvel = [0, 0], [5.0, 0]
    return spec


STOPS = {"claim": "The bumper stops the car.", "cause": "bumper", "effect": "stays",
         "expect": [{"stays": {"body": "car", "max_m": 1.5}}]}  # fmt: skip


def test_a_load_that_an_axle_takes_is_shown_and_the_bumper_is_no_cause(tmp_path):
    motion = {"road": {"joint_velocity": 5.0}}
    found = audit(World(lambda: crash(0.6), None, 0.6, ("car",), objectives=(STOPS,), motion=motion), tmp_path)
    hit = [p for p in found.ledger.load_paths if "wall" in p.bodies]
    assert hit[0].geoms == ("wall", "axle") and hit[0].share[0] > 0.9
    assert "WS321" in found.codes()


# -- lines that carry nothing, pins that do --------------------------------------------------------------------------


def tent(pinned, slack):
    spec = empty(floor=False)
    canvas = box(spec, "canvas", (0, 0, 1.0), (0.5, 0.5, 0.01), 2.0)
    for i, (x, y) in enumerate(((1, 1), (1, -1), (-1, 1), (-1, -1))):
        canvas.add_site(name=f"eye_{i}", pos=(0.5 * x, 0.5 * y, 0))
        spec.worldbody.add_site(name=f"peg_{i}", pos=(x, y, 2))
        line = spec.add_tendon(name=f"guy_{i}", limited=True, range=(0, np.sqrt(1.5) + (0.5 if slack else 0.0)))
        line.wrap_site(f"peg_{i}")
        line.wrap_site(f"eye_{i}")
    if pinned:
        weld(spec, "pin", "canvas")
    return spec


HUNG = {"claim": "The lines hold the canvas.", "expect": [{"stays": {"body": "canvas", "max_m": 0.2}}],
        "cause": ["guy_0", "guy_1"]}  # fmt: skip


def test_guy_lines_that_carry_nothing_are_caught(tmp_path):
    found = audit(World(lambda: tent(True, True), None, 0.5, objectives=(HUNG,)), tmp_path)
    assert {"WS306", "WS321"} <= found.codes()
    assert "WS305" in found.codes("warn") | found.codes()
    assert all(c.loaded_share == 0 for c in found.ledger.carriers if c.kind == "tendon")


def test_guy_lines_under_load_are_honest(tmp_path):
    lines = "guy_0+guy_1+guy_2+guy_3"
    found = audit(World(lambda: tent(False, False), None, 0.6, objectives=({**HUNG, "cause": lines},)), tmp_path)
    (cause,) = found.causes.causes
    assert cause.outcome == "caused" and "cannot be weakened" in cause.message
    assert found.codes() == set() and not found.codes("warn") & {"WS305", "WS306"}
    assert min(c.peak for c in found.ledger.carriers if c.kind == "tendon") > 1.0


def test_a_pinned_cloth_is_caught(tmp_path):
    def build():
        return mujoco.MjSpec.from_string(
            """<mujoco><option timestep="0.002"/><worldbody><body name="pole" pos="0 0 2">
            <flexcomp name="sail" type="grid" count="4 4 1" spacing=".1 .1 .1" dim="2" radius=".01" mass=".5">
            <pin id="0 1 2 3"/><edge equality="true"/></flexcomp></body></worldbody></mujoco>"""
        )

    found = audit(World(build, None, 0.1), tmp_path / "a")
    assert "WS306" in found.codes()
    declared = (declare("constraint", "sail", law="the edge is sewn to the pole"),)
    found = audit(World(build, None, 0.1, interventions=declared), tmp_path / "b")
    assert "WS306" not in found.codes()


# -- flexes ----------------------------------------------------------------------------------------------------------


def sheet():
    """A cloth of sixteen points in the air."""
    spec = empty()
    cloth = mujoco.MjSpec.from_string(
        """<mujoco><worldbody><flexcomp name="th" type="grid" count="4 4 1" spacing=".1 .1 .1" pos="0 0 1" dim="2"
        radius=".005" mass=".1"><edge equality="true"/></flexcomp></worldbody></mujoco>"""
    )
    spec.attach(cloth, frame=spec.worldbody.add_frame(), prefix="clo")
    return spec


def gust(model, data):
    """A push on each point of the cloth, along x."""
    for body in range(1, model.nbody):
        data.xfrc_applied[body, 0] = 0.02


@pytest.mark.parametrize(
    ("bodies", "declared"), [((), False), (("cloth",), True), (("cloth_3",), False), (("clo",), False)]
)
def test_a_force_on_the_points_of_a_flex_is_declared_by_the_name_of_the_flex(bodies, declared, tmp_path):
    rows = (declare("force", *bodies),) if bodies else ()
    found = audit(World(sheet, gust, 0.3, movers=("cloth",), interventions=rows), tmp_path)
    assert ("WS108" in found.codes()) is not declared
    acted = [row for row in found.ledger.acting if row.kind == "force"]
    assert len(acted) == 16 and sum(row.declared for row in acted) == {(): 0, ("cloth",): 16}.get(
        bodies, int(bodies == ("cloth_3",))
    )
    assert ("WS111" in found.codes()) is False


def test_a_flex_moves_as_one_thing(tmp_path):
    def lamp():
        spec = sheet()
        box(spec, "lamp", (3, 0, 1))
        return spec

    def told(code, movers, folder, build=lamp, seconds=0.3):
        found = audit(World(build, None, seconds, movers=movers), tmp_path / folder).scan.anomalies
        return [(a.body, a.severity) for a in found if a.code == code]

    assert told("WS112", ("lamp", "cloth"), "both") == []
    assert told("WS112", ("lamp",), "lamp") == [("cloth", "info")]
    assert told("WS111", ("cloth",), "falls") == []

    def floating():
        spec = lamp()
        spec.option.gravity = (0, 0, 0)
        return spec

    assert told("WS111", ("cloth",), "floats", floating) == [("cloth", "blocking")]


# -- launches at fixed moments and speeds ----------------------------------------------------------------------------


def splash(keyed):
    """A stone falls into a dish; drops are thrown up: `keyed` gives the launch speed, or None."""

    def build():
        spec = empty()
        box(spec, "stone", (0, 0, 0.6), (0.05, 0.05, 0.05), 0.5)
        box(spec, "drop", (0.3, 0, 0.02), (0.02, 0.02, 0.02), 0.01)
        return spec

    state = {}

    def control(model, data):
        impact = any({model.geom_bodyid[a], model.geom_bodyid[b]} == {0, 1} for a, b in data.contact.geom)
        speed = keyed(data.time, impact, -data.qvel[2])
        if speed and "done" not in state:
            state["done"] = True
            data.qvel[8] = speed

    return World(
        build, control, 0.6, ("stone", "drop"), before=state.clear,
        objectives=({"claim": "A drop jumps when the stone falls in.", "cause": "stone",
                     "expect": [{"reaches_speed": {"body": "drop", "min_m_s": 0.8}}]},),
    )  # fmt: skip


def test_a_splash_at_a_fixed_moment_and_speed_is_caught(tmp_path):
    world = splash(lambda time, impact, speed: 1.5 if time > 0.35 else 0)
    assert {"WS108", "WS321"} <= audit(world, tmp_path / "a").codes()
    world.interventions = (declare("velocity", "drop", trigger="the stone's impact"),)
    found = audit(world, tmp_path / "b")
    assert {"WS321", "WS323"} <= found.codes()
    assert found.causes.triggers[0].outcome == "timed"


def test_a_splash_of_fixed_speed_is_shown_and_one_keyed_to_the_impact_is_honest(tmp_path):
    said = (declare("velocity", "drop", trigger="impact of the stone", law="v = 0.6 times the impact speed"),)
    fixed = splash(lambda time, impact, speed: 1.5 if impact else 0)
    fixed.interventions = said
    found = audit(fixed, tmp_path / "a")
    assert found.causes.triggers[0].outcome == "fixed_size" and "WS323" in found.codes("warn")
    honest = splash(lambda time, impact, speed: 0.6 * max(speed, 0.1) if impact else 0)
    honest.interventions = said
    found = audit(honest, tmp_path / "b")
    assert found.codes() == set(), [str(a) for a in (*found.scan.anomalies, *found.causes.anomalies)]
    assert found.causes.triggers[0].outcome == "consequence"
    assert found.causes.causes[0].outcome == "caused"


# -- drawn, not simulated --------------------------------------------------------------------------------------------


def test_painted_damage_and_hidden_twins_are_caught(tmp_path):
    def build():
        spec = empty()
        box(spec, "vase", (0, 0, 0.3)).add_geom(
            name="crack", size=(0.11, 0, 0), contype=0, conaffinity=0, rgba=(0, 0, 0, 0), mass=0
        )
        box(spec, "ghost", (1, 0, 0.3), rgba=(1, 1, 1, 0))
        return spec

    def control(model, data):
        if data.ncon:
            model.geom("crack").rgba[3] = 1.0

    found = audit(World(build, control, 0.5, ("vase", "ghost")), tmp_path)
    assert {"WS307", "WS312"} <= found.codes()


# -- contact replaced, weight cancelled, floors walked through -------------------------------------------------------


def test_a_contact_replaced_by_a_spring_of_ones_own_is_caught(tmp_path):
    def build():
        spec = empty()
        box(spec, "ball", (0, 0, 0.5), contype=0, conaffinity=0)
        return spec

    def control(model, data):
        depth = 0.05 - data.qpos[2]
        data.xfrc_applied[1, 2] = max(0.0, 3000 * depth - 30 * data.qvel[2]) if depth > 0 else 0.0

    found = audit(World(build, control, 1.0, ("ball",)), tmp_path)
    assert {"WS108", "WS303", "WS304"} <= found.codes()
    assert found.ledger.overlaps[0].bodies == ("world", "ball")


def test_a_weightless_boom_and_a_floor_without_contact_are_caught(tmp_path):
    def build():
        spec = empty()
        arm = spec.worldbody.add_body(name="boom", pos=(0, 0, 2))
        arm.add_joint(name="pivot", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0))
        arm.add_geom(type=mujoco.mjtGeom.mjGEOM_CAPSULE, size=(0.05, 0.5, 0), pos=(0.5, 0, 0), mass=20.0)
        arm.gravcomp = 1.0
        box(spec, "brick", (0, 0, 0.2))
        spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
        return spec

    found = audit(World(build, None, 0.5, ("boom", "brick")), tmp_path)
    assert {"WS301", "WS302", "WS304"} <= found.codes()


# -- constants without a source --------------------------------------------------------------------------------------


def test_a_law_without_a_source_is_caught(tmp_path):
    said = (declare("constraint", "bolt", trigger="load > 60 N", source=" "),)
    world = bolted(by_load, interventions=said)
    world.objectives = ({**FALLS, "cause": []},)
    assert audit(world, tmp_path).codes() == {"WS309"}


# -- honest twins ----------------------------------------------------------------------------------------------------


def test_a_winch_that_lifts_by_its_motor_is_honest(tmp_path):
    def build():
        spec = empty()
        load = box(spec, "load", (0, 0, 0.1), mass=5.0)
        load.add_site(name="hook", pos=(0, 0, 0.1))
        spec.worldbody.add_site(name="drum", pos=(0, 0, 2))
        rope = spec.add_tendon(name="rope")
        rope.wrap_site("drum")
        rope.wrap_site("hook")
        winch = spec.add_actuator(name="winch", trntype=mujoco.mjtTrn.mjTRN_TENDON, target="rope")
        winch.gainprm[0] = -1.0
        return spec

    def control(model, data):
        data.ctrl[0] = 60.0 - 40.0 * max(0.0, data.qvel[2] - 0.3)

    lifts = {"claim": "The winch lifts the load.", "cause": "winch",
             "expect": [{"moves": {"body": "load", "min_m": 0.1}}]}  # fmt: skip
    said = (
        declare("control", "winch", law="60 N less 40 N·s/m of the speed above 0.3 m/s", source="the prompt's winch"),
    )
    found = audit(World(build, control, 0.8, ("load",), said, (lifts,)), tmp_path)
    assert found.codes() == set(), [str(a) for a in (*found.scan.anomalies, *found.causes.anomalies)]
    assert found.causes.causes[0].outcome == "caused"
    assert found.ledger.ok and not found.codes("warn") & {"WS305"}


def test_a_wall_that_stops_a_ball_is_its_cause_though_it_cannot_be_weaker(tmp_path):
    def build():
        spec = empty(gravity=0.0, floor=False)
        wall = spec.worldbody.add_body(name="wall", pos=(1, 0, 0))
        wall.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 1, 1))
        box(spec, "puck", (0, 0, 0))
        key = spec.add_key(name="start")
        key.qpos, key.qvel = [0, 0, 0, 1, 0, 0, 0], [4.0, 0, 0, 0, 0, 0]
        return spec

    stopped = {"claim": "The wall stops it.", "cause": "wall", "expect": [{"stays": {"body": "puck", "max_m": 0.9}}]}
    motion = {"puck": {"linear": [4.0, 0, 0]}}
    found = audit(World(build, None, 0.5, ("puck",), (), (stopped,), motion), tmp_path)
    (cause,) = found.causes.causes
    assert cause.outcome == "caused" and "nothing of it moves" in cause.message


def test_a_ball_that_topples_a_domino_is_its_cause(tmp_path):
    def build():
        spec = empty()
        ball = spec.worldbody.add_body(name="ball", pos=(-0.5, 0, 0.1))
        ball.add_freejoint()
        ball.add_geom(name="ball", size=(0.1, 0, 0), mass=1.0)
        box(spec, "domino", (0, 0, 0.2), (0.02, 0.1, 0.2), 0.3)
        key = spec.add_key(name="start")
        key.qpos = [-0.5, 0, 0.1, 1, 0, 0, 0, 0, 0, 0.2, 1, 0, 0, 0]
        key.qvel = [1.5, 0, 0, 0, 15, 0, *[0] * 6]
        return spec

    falls = {"claim": "The ball topples the domino.", "cause": "ball",
             "expect": [{"moves": {"body": "domino", "min_m": 0.1}}, {"touches": {"bodies": ["ball", "domino"]}}]}  # fmt: skip
    motion = {"ball": {"linear": [1.5, 0, 0]}}
    found = audit(World(build, None, 1.5, ("ball", "domino"), (), (falls,), motion), tmp_path)
    (cause,) = found.causes.causes
    assert cause.outcome == "caused" and "moves" in cause.effect and "touches" not in cause.effect
    assert not {c for c in found.codes() if c.startswith("WS3")}
    assert {c.when for c in found.ledger.acting} == set()
