"""A variant takes one thing away, or makes it weaker, whatever the program is; everything else stays what it was."""

import json

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, heap, record
from worldengine.recording import stored
from worldengine.variants import altered
from worldkit import program
from worldkit.errors import ProgramError


def vary(spec, folder, steps, control=None, *, factor=None, without=(), weaken=()):
    """Record a variant of a world."""
    model = spec.compile()
    hold = altered.alter(model, altered.Variant.parse(factor, without, weaken))
    return record(model, folder, steps, None if hold.silent else control, hold=hold)


def bowling(control=False):
    """A ball that rolls against a resting one; a lamp stands by."""
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.1))
    ball(spec, "pin", (0.6, 0, 0.1))
    lamp = spec.worldbody.add_body(name="lamp", pos=(0, 2, 0.5))
    lamp.add_geom(name="shade", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.1, 0.1, 0.5))
    key = spec.add_key(name="start")
    key.qpos = [0, 0, 0.1, 1, 0, 0, 0, 0.6, 0, 0.1, 1, 0, 0, 0]
    key.qvel = [2.0, 0, 0, 0, 20.0, 0, *[0] * 6]
    return spec


def hit_time(recording, body=1):
    """When a body first moves along x."""
    return float(recording.time[np.argmax(recording.linvel[:, body, 0] > 0.05)])


def test_nothing_changed_is_nothing_changed(tmp_path):
    assert not altered.Variant.parse(None, [], [])
    same = vary(heap(), tmp_path / "a", 50)
    assert same.sha256 == record(heap(), tmp_path / "b", 50).sha256


def test_without_a_body_its_effect_is_gone_and_it_stays_where_it_was(tmp_path):
    hit = vary(bowling(), tmp_path / "a", 400)
    assert hit.linvel[-1, 1, 0] > 0.5
    alone = vary(bowling(), tmp_path / "b", 400, without=["ball"])
    assert abs(alone.linvel[:, 1, 0]).max() < 1e-6
    np.testing.assert_allclose(alone.pos[:, 0], [[0, 0, 0.1]] * 401, atol=1e-6)
    assert alone.names == hit.names


def test_without_a_support_what_it_carries_falls(tmp_path):
    def shelf():
        spec = empty()
        board = spec.worldbody.add_body(name="board", pos=(0, 0, 1))
        board.add_geom(name="plank", type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.5, 0.5, 0.05))
        ball(spec, "ball", (0, 0, 1.15))
        spec.add_pair(geomname1="plank", geomname2="ball")  # an explicit pair ignores contact masks
        return spec

    for number, change in enumerate((["board"], ["plank"], ["geom:plank"])):
        fallen = vary(shelf(), tmp_path / str(number), 500, without=change)
        assert fallen.pos[-1, 1, 2] < 0.2, change
    assert vary(shelf(), tmp_path / "kept", 500).pos[-1, 1, 2] > 1.1


SHAPES = {
    "box": (mujoco.mjtGeom.mjGEOM_BOX, (0.1, 0.1, 0.003)),
    "cylinder": (mujoco.mjtGeom.mjGEOM_CYLINDER, (0.1, 0.003, 0)),
    "ellipsoid": (mujoco.mjtGeom.mjGEOM_ELLIPSOID, (0.1, 0.1, 0.003)),
    "plane": (mujoco.mjtGeom.mjGEOM_PLANE, (1, 1, 0.1)),
}


@pytest.mark.parametrize("lies", ["box", "cylinder", "ellipsoid"])
@pytest.mark.parametrize("carries", SHAPES)
def test_without_a_support_that_is_paired_nothing_touches_it_whatever_its_shape(carries, lies, tmp_path):
    spec = empty()
    for name, shape, height in (("plate", SHAPES[carries], 0.003), ("kettle", SHAPES[lies], 0.0095)):
        body = spec.worldbody.add_body(name=name, pos=(0, 0, height))
        body.add_geom(name=name, type=shape[0], size=shape[1], contype=0, conaffinity=0)
    body.add_freejoint()
    spec.add_pair(geomname1="plate", geomname2="kettle")
    assert vary(spec, tmp_path / "a", 200).ncon.any()
    alone = vary(spec, tmp_path / "b", 200, without=["plate"])
    assert not alone.ncon.any() and alone.pos[-1, 1, 2] < -0.1


def test_a_weaker_body_is_lighter_and_slower(tmp_path):
    times = [hit_time(vary(bowling(), tmp_path / str(f), 1500, weaken=[f"ball={f}"])) for f in (1.0, 0.8, 0.5)]
    assert times[0] < times[1] - 0.02 < times[2] - 0.1
    light = vary(bowling(), tmp_path / "mass", 600, weaken=["ball.mass=0.1"])
    assert hit_time(light) == pytest.approx(times[0], abs=0.02)
    assert light.linvel[-1, 1, 0] < 0.5  # a tenth of the mass hands over less
    assert light.meta["bodies"][0]["mass"] == pytest.approx(0.1)


def test_a_weaker_body_falls_slower(tmp_path):
    spec = empty()
    ball(spec, "ball", (0, 0, 5))
    slow = vary(spec, tmp_path / "t", 500, weaken=["ball=0.5"])
    assert slow.linvel[-1, 0, 2] == pytest.approx(-9.81 * 0.5 * 0.5, rel=1e-3)


def test_gravity_and_wind(tmp_path):
    spec = empty()
    spec.option.wind = (3.0, 0, 0)
    spec.option.density = 1.2
    spec.option.viscosity = 0.01
    ball(spec, "ball", (0, 0, 5), mass=0.01)
    drifting = vary(spec.copy(), tmp_path / "a", 300)
    assert drifting.linvel[-1, 0, 0] > 0.05
    still = vary(spec.copy(), tmp_path / "b", 300, without=["wind", "gravity"])
    assert abs(still.linvel).max() < 1e-9
    assert vary(spec.copy(), tmp_path / "c", 300, weaken=["gravity=0.5"]).linvel[-1, 0, 2] > drifting.linvel[-1, 0, 2]


@pytest.mark.parametrize(("change", "left"), [({"without": ["wind"]}, 0.0), ({"weaken": ["wind=0.5"]}, 0.5)])
def test_a_wind_that_control_writes_is_taken_away_and_weakened_too(tmp_path, change, left):
    """A cause that is written anew at every step would otherwise stay as strong as it was."""
    spec = empty(gravity=0.0)
    spec.option.wind, spec.option.density = (1.0, 0, 0), 1.2
    ball(spec, "ball", (0, 0, 5), mass=0.001)

    def gust(model, data):
        model.opt.wind[0] = 2.0 + np.sin(6.0 * data.time)

    def halved(model, data):
        model.opt.wind[0] = left * (2.0 + np.sin(6.0 * data.time))

    spec_of_it = spec.copy()
    spec_of_it.option.wind = (left, 0, 0)
    gone = vary(spec, tmp_path / "a", 300, gust, **change).linvel[:, 0, 0]
    meant = vary(spec_of_it, tmp_path / "b", 300, halved).linvel[:, 0, 0]
    assert np.array_equal(gone, meant) and (abs(gone).max() > 0.1) == (left > 0)
    undone = vary(spec, tmp_path / "c", 300, gust, without=["parameter:opt.wind"]).linvel[-1, 0, 0]
    assert 0 < undone < vary(spec, tmp_path / "d", 300, gust).linvel[-1, 0, 0]  # the wind of the beginning stays


def cart():
    spec = empty(gravity=0.0)
    body = spec.worldbody.add_body(name="cart")
    body.add_joint(name="rail", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0))
    body.add_geom(size=(0.1, 0, 0), mass=2.0)
    motor = spec.add_actuator(name="motor", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="rail")
    motor.gainprm[0] = 5.0
    return spec


def drive(model, data):
    data.ctrl[0] = 2.0


@pytest.mark.parametrize(
    "name", ["motor", "actuator:motor", "control", "control:motor", "control:cart/motor", "cart", "rail"]
)
def test_without_its_motor_a_cart_stands(name, tmp_path):
    assert abs(vary(cart(), tmp_path / "t", 100, drive, without=[name]).linvel).max() < 1e-9


@pytest.mark.parametrize(
    ("name", "share"), [("motor", 0.25), ("control:motor", 0.5), ("cart", 0.25 * 0.25 * 2), ("rail", 0.25)]
)
def test_a_weaker_motor_drives_less(name, share, tmp_path):
    full = vary(cart(), tmp_path / "a", 100, drive)
    weak = vary(cart(), tmp_path / "b", 100, drive, weaken=[f"{name}=0.5"])
    assert weak.linvel[-1, 0, 0] == pytest.approx(full.linvel[-1, 0, 0] * share, rel=1e-6)


def test_springs_unload_and_tendons_let_go(tmp_path):
    def hung():
        spec = empty()
        body = ball(spec, "ball", (0, 0, 1))
        body.add_site(name="eye")
        spec.worldbody.add_site(name="hook", pos=(0, 0, 2))
        rope = spec.add_tendon(name="rope", range=(0, 1.0), limited=True)
        rope.wrap_site("hook")
        rope.wrap_site("eye")
        spring = cart()
        spring.joints[0].stiffness[0] = 50.0
        spring.joints[0].springref = 0.3
        return spec, spring

    assert vary(hung()[0], tmp_path / "a", 500).pos[-1, 0, 2] > 0.95
    assert vary(hung()[0], tmp_path / "b", 500, without=["rope"]).pos[-1, 0, 2] < 0
    assert vary(hung()[0], tmp_path / "f", 500, without=["ball"]).pos[-1, 0, 2] == pytest.approx(1, abs=1e-6)
    assert vary(hung()[1], tmp_path / "c", 100).linvel[-1, 0, 0] > 0.1
    assert abs(vary(hung()[1], tmp_path / "d", 100, without=["joint:rail"]).linvel).max() < 1e-9
    weak = vary(hung()[1], tmp_path / "e", 100, weaken=["rail=0.5"])
    assert weak.linvel[1, 0, 0] == pytest.approx(0.5 * vary(hung()[1], tmp_path / "g", 100).linvel[1, 0, 0], rel=1e-3)


def held():
    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    weld = spec.add_equality(name="hold", type=mujoco.mjtEq.mjEQ_WELD, name1="ball")
    weld.objtype = mujoco.mjtObj.mjOBJ_BODY
    return spec


def test_without_an_equality_nothing_holds_and_without_its_switch_it_never_lets_go(tmp_path):
    def let_go(model, data):
        data.eq_active[0] = data.time < 0.2

    assert vary(held(), tmp_path / "a", 400, let_go).linvel[-1, 0, 2] < -1.9
    kept = vary(held(), tmp_path / "b", 400, let_go, without=["constraint:hold"])
    assert kept.sha256 == record(held(), tmp_path / "d", 400).sha256

    def looking(model, data):
        data.eq_active[0] = data.time < 0.2
        mujoco.mj_forward(model, data)  # derives everything from a switch that is not to be

    kept = vary(held(), tmp_path / "e", 400, looking, without=["constraint:hold"])
    assert kept.sha256 == record(held(), tmp_path / "f", 400).sha256
    fallen = vary(held(), tmp_path / "c", 400, let_go, without=["hold"])
    assert fallen.linvel[-1, 0, 2] == pytest.approx(-9.81 * 0.4)
    assert len(fallen.interventions) == 0


def writing(kind):
    """A control that writes one kind of thing to the ball, and the world it acts on."""
    spec = empty(gravity=0.0)
    ball(spec, "ball", (0, 0, 1))
    ball(spec, "other", (3, 0, 1))
    hand = spec.worldbody.add_body(name="hand", mocap=True, pos=(9, 0, 0))
    hand.add_geom(size=(0.1, 0, 0))

    def act(model, data):
        if kind == "force":
            data.xfrc_applied[1, 0] += 1.0 if data.time < 0.0005 else 0.0  # builds on its own last value
        elif kind == "torque":
            data.qfrc_applied[3:6] = (0, 0, 1.0)
        elif kind == "velocity":
            data.qvel[0] = 1.0
            data.qvel[6] = 1.0
        elif kind == "pose":
            data.qpos[0] += 0.001
            data.qpos[3:7] = (np.cos(data.time), 0, 0, np.sin(data.time))
        elif kind == "mocap":
            data.mocap_pos[0, 0] += 0.001
            data.mocap_quat[0] = (np.cos(data.time), 0, 0, np.sin(data.time))
        elif kind == "parameter":
            model.body_mass[1] = 7.0
            model.body_mass[2] = 7.0
            model.opt.gravity[0] = 1.0

    return spec, act


@pytest.mark.parametrize("kind", ["force", "torque", "velocity", "pose", "mocap", "parameter"])
def test_one_kind_of_write_to_one_body_is_undone(kind, tmp_path):
    spec, act = writing(kind)
    name = {"mocap": "hand"}.get(kind, "ball")
    table = vary(spec.copy(), tmp_path / "a", 60, act).interventions
    assert any(k == kind and t.startswith(name) for k, t in zip(table.kind, table.target, strict=True))
    table = vary(spec.copy(), tmp_path / "b", 60, act, without=[f"{kind}:{name}"]).interventions
    assert not any(k == kind and t.startswith(name) for k, t in zip(table.kind, table.target, strict=True))
    if kind == "velocity":
        assert set(table.target) == {"other"}
    if kind == "parameter":
        assert set(table.target) == {"other.body_mass", "opt.gravity"}


def test_writes_shrink(tmp_path):
    for kind, read in (
        ("force", lambda r: r.interventions.value[-1, 0]),
        ("torque", lambda r: r.interventions.value[-1, 5]),
        ("mocap", lambda r: r.mocap_pos[-1, 0, 0] - 9),
        ("pose", lambda r: r.pos[-1, 0, 0]),
    ):
        spec, act = writing(kind)
        name = {"mocap": "hand"}.get(kind, "ball")
        full = read(vary(spec.copy(), tmp_path / f"{kind}-a", 60, act))
        half = read(vary(spec.copy(), tmp_path / f"{kind}-b", 60, act, weaken=[f"{kind}:{name}=0.5"]))
        assert half == pytest.approx(full / 2, rel=0.05), kind


def test_a_finer_step_records_the_same_instants(tmp_path):
    def build():
        return bowling()

    assert program.main(build, duration=0.3, argv=["--pass", "physics", "--out", str(tmp_path / "a")]) == 0
    options = ["--pass", "physics", "--out", str(tmp_path / "b"), "--time-step-factor", "0.5"]
    assert program.main(build, duration=0.3, argv=options) == 0
    one, two = (stored.open(tmp_path / name / "trajectory") for name in "ab")
    assert one.time_step == 2 * two.time_step
    np.testing.assert_allclose(one.time, two.time, atol=1e-12)
    assert "variant" not in one.meta
    said = json.loads((tmp_path / "b" / "result.json").read_text())
    assert said["variant"] == {"time_step_factor": 0.5, "without": [], "weaken": []}
    assert two.meta["variant"] == said["variant"]


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--without", "bal"], "there is no bal"),
        (["--without", "force:nobody"], "there is no body nobody"),
        (["--without", "control:ball/engine"], "there is no actuator ball/engine"),
        (["--without", "constraint:"], "there is no equality"),
        (["--weaken", "ball"], "does not say"),
        (["--weaken", "ball=-1"], "does not say"),
        (["--weaken", "lamp.mass.x=0.5"], "there is no lamp.mass.x"),
        (["--weaken", "geom:shade=0.5"], "cannot be weakened"),
        (["--time-step-factor", "0.4"], "0.4"),
        (["--time-step-factor", "2"], "2"),
    ],
)
def test_a_wrong_option_is_a_typed_error_that_names_the_known(options, says, tmp_path):
    argv = ["--pass", "physics", "--out", str(tmp_path / "t"), *options]
    assert program.main(bowling, duration=0.1, argv=argv) == 1
    error = json.loads((tmp_path / "t" / "error.json").read_text())
    assert says in error["message"] and error["code"] == "program"
    if "no bal" in says:
        assert "ball" in error["next_move"] and "shade" in error["next_move"]


def test_a_name_that_is_not_there_is_refused():
    with pytest.raises(ProgramError):
        altered.resolve(bowling().compile(), "world")


def test_without_its_initial_velocity_a_ball_stands_where_it_starts(tmp_path):
    still = vary(bowling(), tmp_path / "a", 300, without=["ball.velocity"])
    assert abs(still.linvel[:, 0, :2]).max() < 1e-6
    with pytest.raises(ProgramError, match="nothing moves without a mass"):
        vary(bowling(), tmp_path / "b", 1, without=["ball.mass"])


def test_less_friction_of_one_thing_leaves_its_rebound(tmp_path):
    spec = empty()
    floor(spec)
    spec.geom("ground").solref = (-40_000.0, -20.0)
    ball(spec, "ball", (0, 0, 0.5))
    spec.geom("ball").solref = (-20_000.0, -5.0)

    def highest(folder, **change):
        return vary(spec.copy(), tmp_path / folder, 900, **change).pos[400:, 0, 2].max()

    planned = highest("a")
    assert highest("b", weaken=["ball.friction=0.999999"]) == pytest.approx(planned, rel=1e-3)
    assert highest("c", without=["ball.friction"]) == pytest.approx(planned, rel=1e-3)
    ball(spec, "dead", (2, 0, 0.5))
    spec.geom("dead").solref = (-60_000.0, -500.0)
    with pytest.raises(ProgramError, match="unlike softness"):
        highest("d", without=["ground.friction"])


@pytest.mark.parametrize("paired", [False, True])
def test_friction_is_taken_away_and_weakened_of_all_or_of_one_thing(paired, tmp_path):
    spec = empty()
    floor(spec)
    spec.geom("ground").friction[0] = 0.3
    for name, y in (("one", 0.0), ("two", 2.0)):
        body = spec.worldbody.add_body(name=name, pos=(0, y, 0.1))
        body.add_freejoint()
        body.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.2, 0.2, 0.1), friction=(0.2, 0, 0), mass=1)
        if paired:
            spec.add_pair(geomname1="ground", geomname2=name, friction=(0.3, 0.3, 0, 0, 0), condim=3)
    key = spec.add_key(name="start")
    key.qpos = [0, 0, 0.1, 1, 0, 0, 0, 0, 2, 0.1, 1, 0, 0, 0]
    key.qvel = [1.0, *[0] * 5, 1.0, *[0] * 5]

    def speeds(folder, **change):
        return vary(spec.copy(), tmp_path / folder, 100, **change).linvel[-1, :2, 0]

    planned = speeds("a")
    assert planned[0] == pytest.approx(planned[1], abs=0.01) and planned[0] < 0.8
    assert speeds("b", without=["friction"]) == pytest.approx([1.0, 1.0], abs=0.01)
    assert speeds("c", without=["one.friction"]) == pytest.approx([1.0, planned[1]], abs=0.01)
    assert planned[0] < speeds("d", weaken=["one.friction=0.5"])[0] < 0.95
    if not paired:
        assert speeds("e", without=["ground.friction"]) == pytest.approx([1.0, 1.0], abs=0.01)
