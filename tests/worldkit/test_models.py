import mujoco
import numpy as np
import pytest

from worldkit import beside_program, contacts, models

ARM = """<robot name="arm">
  <link name="base">
    <inertial><origin xyz="0 0 0.05"/><mass value="5"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.05"/><geometry><box size="0.2 0.3 0.1"/></geometry></collision>
  </link>
  <link name="upper">
    <inertial><origin xyz="0 0 0.2"/><mass value="2"/><inertia ixx="0.027" iyy="0.027" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial>
    <collision><origin xyz="0 0 0.2"/><geometry><cylinder radius="0.03" length="0.4"/></geometry></collision>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><origin xyz="0 0 0.1"/><axis xyz="0 1 0"/>
    <limit lower="-1.57" upper="1.57" effort="40" velocity="2"/><dynamics damping="0.1" friction="0.2"/>
  </joint>
  <transmission name="drive"><actuator name="motor"/></transmission>
</robot>"""
CHEST = """<mujoco model="chest"><compiler angle="radian"/><option timestep="0.01" gravity="0 0 -1"/>
  <asset><material name="oak" rgba=".6 .4 .2 1"/></asset>
  <worldbody><light pos="0 0 3"/><geom name="floor" type="plane" size="1 1 .1"/>
    <body name="case" pos=".5 0 .1"><freejoint/><geom name="walls" type="box" size=".2 .1 .1" mass="4" material="oak" friction=".9"/>
      <camera name="peek"/>
      <body name="lid" pos="0 0 .11"><joint name="hinge" axis="0 1 0" pos="-.2 0 0" range="-1.5 0" damping=".1"/>
        <geom type="box" size=".2 .1 .01" mass=".5"/></body></body>
  </worldbody>
  <contact><exclude body1="case" body2="lid"/></contact>
  <actuator><position name="opener" joint="hinge" kp="20"/></actuator>
  <sensor><framepos name="where" objtype="body" objname="case"/></sensor>
  <keyframe><key qpos="0 0 0 1 0 0 0 -1"/></keyframe>
</mujoco>"""


def world(*calls):
    spec = mujoco.MjSpec()
    for text, common in calls:
        models.attach(spec, text, **common)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def test_a_urdf_stands_where_it_is_planned_under_its_planned_name():
    model, data = world(
        (ARM, {"name": "robot", "pos": (1, 2, 0.25), "yaw_deg": 90, "fixed": True, "look": "plastic_orange"})
    )
    assert [model.body(b).name for b in range(1, model.nbody)] == ["robot", "robot_upper"]
    assert [model.joint(j).name for j in range(model.njnt)] == ["robot_shoulder"]
    assert [model.geom(g).name for g in range(model.ngeom)] == ["robot/0", "robot_upper/0"]
    # The box is 0.2 x 0.3 x 0.5 m around (0, 0, 0.25): the base stands on the ground, its long side along x after the yaw.
    assert np.allclose(data.body("robot").xpos, (1, 2, 0)) and np.allclose(
        data.joint("robot_shoulder").xaxis, (-1, 0, 0)
    )
    assert np.allclose(data.geom("robot_upper/0").xpos, (1, 2, 0.3))
    assert model.body_mass.sum() == 7.0 and model.jnt_actfrcrange.tolist() == [[-40, 40]]
    assert model.nexclude == 1 and (model.geom_matid >= 0).all()
    joint = data.joint("robot_shoulder")
    joint.qpos[0] = 1.0
    mujoco.mj_forward(model, data)
    assert data.ncon == 0  # the fixed base lets its own link turn


def test_a_free_mjcf_brings_its_joints_servos_and_sensors_and_leaves_the_floor():
    model, data = world((CHEST, {"name": "chest", "pos": (0, 0, 0.11)}))
    assert model.ngeom == 2 and model.nlight == 0 and model.ncam == 0 and model.nkey == 0
    assert [model.joint(j).name for j in range(2)] == ["chest", "chest_hinge"]
    assert model.opt.timestep == 0.002 and model.jnt_range[1].tolist() == [-1.5, 0.0]
    assert model.actuator("chest_opener").trnid[0] == 1 and model.nexclude == 1
    assert np.allclose(data.sensor("chest_where").data, data.body("chest").xpos)
    assert np.allclose(data.body("chest").xpos, (0, 0, 0.1))  # its box, lid included, is 0.22 m high
    assert model.geom("chest_walls").friction[0] == 0.9
    shaped = contacts.surface(friction=0.2, restitution=0.3)
    model, _ = world((CHEST, {"name": "chest", "pos": (0, 0, 0.11), "surface": shaped, "fixed": True}))
    assert model.geom("chest_walls").friction[0] == 0.2 and model.geom("chest_walls").solref[0] < 0
    assert model.njnt == 1 and model.body("chest").parentid[0] == 0


def test_a_height_field_stands_on_the_middle_of_its_box_not_on_its_frame():
    text = """<mujoco><asset><hfield name="h" nrow="2" ncol="3" size="4 3 2 0.5" elevation="0 .5 1 0 .5 1"/></asset>
      <worldbody><body name="hill"><geom type="hfield" hfield="h"/></body></worldbody></mujoco>"""
    assert models.facts(text, "hill")["extents"] == pytest.approx((8, 6, 2.5))
    model, data = world((text, {"name": "hill", "pos": (1, 2, 1.25), "fixed": True}))
    top = mujoco.mj_rayHfield(
        model, data, model.geom("hill/0").id, np.array((1.0, 2.0, 9.0)), np.array((0.0, 0.0, -1.0))
    )
    assert 9.0 - top == pytest.approx(0.5 + 1.0)


def test_several_copies_each_have_names_of_their_own():
    model, data = world(*((CHEST, {"name": f"chest_{k}", "pos": (k, 0, 0.11), "yaw_deg": 30.0 * k}) for k in (1, 2, 3)))
    assert [model.actuator(a).name for a in range(3)] == [f"chest_{k}_opener" for k in (1, 2, 3)]
    for k in (1, 2, 3):
        middle = (data.geom(f"chest_{k}_walls").xpos * 10 + data.geom(f"chest_{k}_lid/0").xpos) / 11
        assert np.allclose(middle[:2], (k, 0), atol=1e-9)
        assert np.allclose(data.body(f"chest_{k}").xmat[0], np.cos(np.radians(30 * k)))


def test_what_a_plan_needs_to_know_of_a_model():
    known = models.facts(CHEST, "chest")
    assert known["extents"] == pytest.approx([0.4, 0.2, 0.22]) and known["mass"] == pytest.approx(4.5)
    assert known["joints"] == {"chest": "free", "chest_hinge": "hinge"} and known["actuators"] == ["chest_opener"]
    assert models.facts(ARM, "arm")["bodies"] == ["arm", "arm_upper"]


MESH = '<mujoco><asset><mesh name="m" file="{file}"/></asset><worldbody><body><geom type="mesh" mesh="m"/></body></worldbody></mujoco>'


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("nothing", "model it: it is not XML: syntax error"),
        ("<sdf/>", "its root is <sdf>; a URDF starts with <robot>"),
        (ARM.replace("<geometry>", "<geomtry>").replace("</geometry>", "</geomtry>"), "a URDF has no element <geomtry>"),
        (ARM.replace('<mass value="5"/>', "<mass/>"), "model it: .*mass"),
        (ARM.replace('child link="upper"', 'child link="uper"'), "URDF joint parent or child missing Element 'joint', line"),
        (CHEST.replace('type="box"', 'type="bx"'), "invalid keyword: 'bx' Element 'geom', line"),
        (CHEST.replace("<freejoint/>", "<freejont/>"), "unrecognized element Element 'freejont'"),
        ("<mujoco>\n<include file='/etc/passwd'/></mujoco>", "model it: line 2: <include> reads another file"),
        ("<mujoco><include xmlns='x' file='/etc/passwd'/></mujoco>", "<include> reads another file"),
        ("<mujoco><asset><model name='m' file='/m.xml'/></asset></mujoco>", "<model> reads another file"),
        ("<mujoco><worldbody><attach model='m'/></worldbody></mujoco>", "<attach> reads another file"),
        (
            "<mujoco><worldbody><flexcomp type='mesh' file='/m.obj'/></worldbody></mujoco>",
            "<flexcomp file='/m.obj'> reads another file",
        ),
        ("<mujoco><asset><texture type='cube' fileup='/m.png'/></asset></mujoco>", "<texture fileup='/m.png'> reads"),
        ("<mujoco><asset><skin file='/m.skn'/></asset></mujoco>", "<skin file='/m.skn'> reads another file"),
        ('<!DOCTYPE a [<!ENTITY b "c">]><mujoco/>', "it declares a document type"),
        ("<mujoco><worldbody/></mujoco>", "exactly one root body, it has 0: none"),
        ("<mujoco><worldbody><body name='a'/><body/></worldbody></mujoco>", r"it has 2: a, \(without a name\)"),
        ("<mujoco><worldbody><body name='a'><inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/></body></worldbody></mujoco>", "it has no geoms"),
        (MESH.format(file="m.stl"), "it reads the file 'm.stl', which is not among its `files`"),
    ],
)  # fmt: skip
def test_what_is_no_model_is_refused_by_name(text, says):
    with pytest.raises(ValueError, match=says) as refusal:
        models.facts(text, "it")
    assert str(refusal.value).startswith("model it: ")


def test_meshes_come_from_the_catalog_alone(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_CATALOG", str(tmp_path))
    (tmp_path / "wedge").mkdir()
    wedge = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
    (tmp_path / "wedge" / "m.obj").write_text(wedge)
    (tmp_path / "wedge" / "m.stl").write_text("solid")
    assert models.facts(MESH.format(file="m.obj"), "it", "wedge")["extents"] == pytest.approx([1, 1, 1])
    for file, says in (
        ("n.obj", "'n.obj' is not in the catalog's folder"),
        ("../x.obj", "is not in"),
        ("m.stl", "neither .obj"),
    ):
        with pytest.raises(ValueError, match=says):
            models.facts(MESH.format(file=file), "it", "wedge")


def test_copies_share_their_meshes_and_others_keep_their_own(tmp_path):
    for name, size in (("wedge", 0.4), ("other", 0.6)):
        (tmp_path / f"{name}.obj").write_text(
            f"v 0 0 0\nv {size} 0 0\nv 0 .2 0\nv 0 0 .22\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
        )
    told = """<mujoco><asset><mesh name="shell" file="{file}" scale="{scale}"/></asset>
      <worldbody><body name="thing"><freejoint/><geom type="mesh" mesh="shell" mass="1"/></body></worldbody></mujoco>"""
    spec = mujoco.MjSpec()
    with beside_program.below(tmp_path):
        for number, (file, scale) in enumerate(
            (("wedge", "1 1 1"), ("wedge", "1 1 1"), ("wedge", "2 2 2"), ("other", "1 1 1"))
        ):
            text = told.format(file=f"{file}.obj", scale=scale)
            models.attach(spec, text, name=f"thing_{number}", pos=(number, 0, 1), files=(f"{file}.obj",))
    model = spec.compile()
    assert model.nmesh == 3 and model.geom_dataid.tolist() == [0, 0, 1, 2]
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    for number, width in enumerate((0.4, 0.4, 0.8, 0.6)):  # each box, the middle of which was asked for
        mesh = model.geom_dataid[number]
        first = model.mesh_vertadr[mesh]
        cloud = model.mesh_vert[first : first + model.mesh_vertnum[mesh]] @ data.geom_xmat[number].reshape(3, 3).T
        cloud = cloud + data.geom_xpos[number]
        assert np.ptp(cloud[:, 0]) == pytest.approx(width, abs=1e-6)
        assert (cloud.min(axis=0) + cloud.max(axis=0)) / 2 == pytest.approx((number, 0, 1), abs=1e-6)
