"""However a rigid body is modelled, as one body or as parts welded together, the scan and the expectations say the same."""

import tempfile
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from staged import World

from worldengine.recording.describing import describe
from worldkit.turning import matrices
from worldwright.model.plan.committed import Intervention
from worldwright.model.recording.mechanics import Mechanics
from worldwright.scan.anomalies import engine
from worldwright.scan.anomalies.sign import Context
from worldwright.scan.anomalies.wholes import as_named, assembled, heads
from worldwright.scan.objectives.expecting import measure
from worldwright.scan.query.questions import answer

BOX = mujoco.mjtGeom.mjGEOM_BOX
PLACE = st.tuples(*[st.floats(-0.25, 0.25)] * 3)
TURN = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: sum(v * v for v in q) > 0.1)
PARTS = st.lists(st.tuples(PLACE, TURN, st.floats(0.03, 0.12)), min_size=1, max_size=3)


def ground():
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.002
    spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(5, 5, 0.1))
    return spec


def box(body, name, half, pos=(0, 0, 0), quat=(1, 0, 0, 0)):
    body.add_geom(name=name, type=BOX, size=(half, 1.5 * half, 0.7 * half), pos=pos, quat=quat, density=300)


def toy(parts, welded, height=0.6):
    """A box with more boxes on it, one body each or all of one body; the second hangs on the first, and so on."""
    spec = ground()
    body = spec.worldbody.add_body(name="toy", pos=(0, 0, height))
    body.add_freejoint()
    box(body, "core", 0.1)
    above, place, turn = body, np.zeros(3), np.array((1.0, 0, 0, 0))
    for number, (pos, quat, half) in enumerate(parts):
        quat = np.asarray(quat) / np.linalg.norm(quat)
        place = place + matrices(turn) @ pos
        now = np.zeros(4)
        mujoco.mju_mulQuat(now, turn, quat)
        turn = now
        if welded:
            above = above.add_body(name=f"part_{number}", pos=pos, quat=quat)
            box(above, f"geom_{number}", half)
        else:
            box(body, f"geom_{number}", half, place, turn)
    return spec


def record(build, duration=0.8, control=None):
    with tempfile.TemporaryDirectory() as folder:
        made = World(build, control, duration).run(Path(folder) / "run")
        # What is memory-mapped must outlive the folder.
        held = {name: np.array(getattr(made, name)) for name in ("t", "pos", "quat", "linvel", "angvel", "energy")}
        touches = made.contacts
        columns = {name: np.array(value) for name, value in vars(touches).items()}
        return replace(made, **held, contacts=replace(touches, **columns))


def tensor(facts, b):
    axes = matrices(facts.inertia_quat[b])
    return axes @ np.diag(facts.inertia[b]) @ axes.T


OF_WHOLES = {e.code for e in engine.CHECKS.values() if e.WHOLE} | {"WS112"}


def of_wholes(trajectory, context):
    """What the checks of wholes say; how deep a part sinks in is asked part by part."""
    found = engine.scan(trajectory, context).anomalies
    return {(a.code, a.severity, a.body) for a in found if a.code in OF_WHOLES}


CLAIMS = (
    ("falls", {"body": "toy", "min_m": 0.1}),
    ("lands_on", {"body": "toy", "support": "ground"}),
    ("touches", {"bodies": ["toy", "ground"]}),
    ("bounces", {"body": "toy", "min_count": 1}),
    ("supported_by", {"body": "toy", "support": "ground"}),
    ("slides", {"bodies": ["toy", "ground"], "min_m": 0.001}),
    ("never_touches", {"bodies": ["toy", "ground"]}),
    ("receives_impulse", {"body": "toy", "other": "ground", "min_n_s": 1e-3, "direction": [0, 0, 1]}),
    ("pushes_with", {"bodies": ["toy", "ground"], "min_n": 1}),
    ("follows_parabola", {"body": "toy", "window_s": [0, 0.1], "tolerance": 0.01}),
    ("conserves", {"quantity": "energy", "body": "toy", "tolerance": 0.02, "window_s": [0, 0.1]}),
)


@settings(max_examples=15, deadline=None)
@given(PARTS)
def test_parts_welded_together_are_the_one_body_that_they_make(parts):
    many = record(lambda: toy(parts, welded=True))
    whole = assembled(many)
    # The same motion and the same contacts, of the same thing modelled as one body.
    described = describe(toy(parts, welded=False).compile())
    touches = many.contacts
    one = replace(
        many,
        names=("toy",),
        **{name: getattr(many, name)[:, :1] for name in ("pos", "quat", "linvel", "angvel")},
        contacts=replace(touches, body1=np.minimum(touches.body1, 0), body2=np.minimum(touches.body2, 0)),
        mechanics=Mechanics.from_meta(described, ("toy",)),
        meta={**many.meta, **{key: described[key] for key in ("bodies", "geoms", "joints")}},
    )
    assert assembled(one) is one and whole.names == one.names == ("toy",)
    a, b = one.mechanics, whole.mechanics
    assert np.allclose(a.mass, b.mass) and np.allclose(a.com, b.com)
    assert np.allclose(tensor(a, 0), tensor(b, 0), rtol=1e-6, atol=1e-9)
    assert np.allclose(np.linalg.det(matrices(b.inertia_quat[0])), 1)
    assert np.allclose(a.center, b.center) and np.allclose(a.half_extents, b.half_extents)
    assert a.free.all() and b.free.all() and a.unforced.all() and b.unforced.all()
    for name, arguments in CLAIMS:
        x, y = measure(one, name, arguments), measure(many, name, arguments)
        assert x.measured is not None and (x.status, x.expected) == (y.status, y.expected), (x.message, y.message)
        assert np.isclose(x.measured, y.measured, rtol=1e-6, atol=1e-9), (x.message, y.message)
    context = Context(planned=True, movers=("toy",))
    assert of_wholes(one, context) == of_wholes(many, context)


FOOT = [((0, 0, -0.25), (1, 0, 0, 0), 0.05)]


@pytest.fixture(scope="module")
def landed():
    return record(lambda: toy(FOOT, welded=True), 1.5)


def test_a_body_means_the_whole_thing(landed):
    assert measure(landed, "lands_on", {"body": "toy", "support": "ground"}).status == "holds"
    assert measure(landed, "never_touches", {"bodies": ["toy", "ground"]}).status == "fails"
    carried = measure(landed, "supported_by", {"body": "toy", "support": "ground"})
    assert carried.status == "holds" and carried.measured == pytest.approx(1.0, abs=0.05)
    assert answer(landed, "toy", None).touching == "yes"


def test_a_part_means_itself_and_no_longer_counts_for_the_rest(landed):
    fallen = landed.before(int(0.35 / landed.interval_s))  # the foot has touched, the core has not
    assert measure(fallen, "touches", {"bodies": ["part_0", "ground"]}).status == "holds"
    assert measure(fallen, "touches", {"bodies": ["toy", "ground"]}).status == "holds"
    assert as_named(fallen, ["toy", "part_0"]).names == ("toy", "part_0")
    assert as_named(fallen, ["part_*"]).names == ("toy", "part_0")
    assert not as_named(fallen, ["toy", "part_0"]).touching[:, 0].any()
    assert as_named(fallen, ["toy"]).names == ("toy",)


@pytest.mark.parametrize(("movers", "codes"), [(("toy",), set()), (("part_0",), set()), (("lamp",), {"toy"})])
def test_what_is_welded_to_a_mover_is_expected_to_move(movers, codes, landed):
    found = engine.scan(landed, Context(planned=True, movers=movers)).anomalies
    assert {a.body for a in found if a.name == "moves_unexpectedly"} == codes


def test_a_fixed_part_must_not_move(landed):
    found = engine.scan(landed, Context(planned=True, movers=("toy",), fixed=("part_0",))).anomalies
    assert {(a.body, a.severity) for a in found if a.name == "moves_unexpectedly"} == {("part_0", "blocking")}


def test_a_body_with_parts_must_fly_freely_too():
    def push(model, data):
        data.qfrc_applied[2] = 30.0

    flown = record(lambda: toy(FOOT, welded=True, height=2.0), 0.4, push)
    unsaid = replace(flown, interventions=None)
    assert "flight_force" in {a.name for a in engine.scan(unsaid).anomalies if a.severity == "blocking"}
    # What the plan declares on a part acts on the whole.
    row = Intervention(kind="force", bodies=("part_0",), law="30 N", trigger="always", source="a test")
    found = engine.scan(unsaid, Context(planned=True, movers=("toy",), interventions=(row,))).anomalies
    assert {a.severity for a in found if a.name == "flight_force"} == {"info"}


def test_parts_that_move_against_each_other_stay_apart(landed):
    pos = landed.pos.copy()
    pos[200:, 1, 0] += 0.01
    torn = replace(landed, pos=pos)
    assert heads(torn).tolist() == [0, 1] and heads(landed).tolist() == [0, 0]
    assert assembled(torn) is torn


def test_scenery_made_of_parts_is_one_thing_and_joints_divide():
    def build():
        spec = ground()
        table = spec.worldbody.add_body(name="table", pos=(0, 0, 0.5))
        box(table, "top", 0.2)
        leg = table.add_body(name="leg", pos=(0, 0, -0.3))
        box(leg, "leg", 0.05)
        arm = leg.add_body(name="arm", pos=(0.5, 0, 0))
        arm.add_joint(name="hinge", type=mujoco.mjtJoint.mjJNT_HINGE, axis=(0, 1, 0))
        box(arm, "arm", 0.05)
        box(arm.add_body(name="hand", pos=(0.2, 0, 0)), "hand", 0.05)
        return spec

    made = record(build, 0.3)
    assert [made.names[h] for h in heads(made)] == ["table", "table", "arm", "arm"]
    assert [made.names[m] for m in made.members(0)] == ["table", "leg"]
    assert made.members(1) == (1,) and made.members(-1) == (-1,)
    whole = assembled(made)
    assert whole.names == ("table", "arm") and whole.mechanics.parent.tolist() == [-1, 0]
    assert not whole.mechanics.free.any()
