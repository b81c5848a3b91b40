"""The motion key: whatever a force can depend on changes it, and nothing that is only seen does."""

import mujoco
import numpy as np
import pytest

from worldengine.recording.drive_source import Beside, drive_source, same_source
from worldengine.recording.motion_key import decides, motion_key

WORLD = """
<mujoco model="{title}">
  <option timestep="0.002"/>
  <visual><global offwidth="{width}"/></visual>
  <asset>
    <texture name="t" type="2d" builtin="checker" rgb1="{rgb}" rgb2="0 0 0" width="8" height="8"/>
    <material name="{look}" texture="t" shininess="{shine}"/>{more_looks}
    <mesh name="wedge" vertex="0 0 0  .1 0 0  0 .1 0  0 0 .1"/>
    <hfield name="land" nrow="2" ncol="2" size="1 1 .1 .1" elevation="0 1 1 0"/>
  </asset>
  <worldbody>
    <light pos="0 0 {light}"/>{more_lights}
    <geom name="ground" type="plane" size="0 0 1" material="{look}"/>
    <geom name="hill" type="hfield" hfield="land" pos="5 0 0"/>
    <body name="ball" pos="0 0 1">
      <freejoint name="fly"/>
      <geom name="ball" type="sphere" size=".1" rgba="{rgb} 1"/>
      <geom name="wedge" type="mesh" mesh="wedge" pos="0 0 .2"/>
      <site name="top" pos="0 0 .1" rgba="{rgb} 1"/>
      <camera name="{camera}" pos="0 {distance} 0" fovy="{fovy}"/>
    </body>
    <body name="arm" pos="1 0 1">
      <joint name="hinge" axis="0 1 0" damping=".1" limited="true" range="-90 90"/>
      <geom name="arm" type="capsule" size=".05 .3"/>
      <site name="tip" pos="0 0 .3"/>
    </body>{more_cameras}
  </worldbody>
  <equality><weld name="hold" body1="ball" body2="arm" active="false"/></equality>
  <tendon><spatial name="rope" stiffness="1" rgba="{rgb} 1"><site site="top"/><site site="tip"/></spatial></tendon>
  <actuator><motor name="motor" joint="hinge" gear="2"/></actuator>
  <sensor>{sensors}</sensor>
  <custom><text name="note" data="{note}"/><numeric name="n" data="1 2"/></custom>
  <keyframe><key name="start" qvel="0 0 0 0 0 0 1"/></keyframe>
</mujoco>
"""
PLAIN = {
    "title": "a", "width": "640", "rgb": "1 0 0", "look": "wood", "shine": ".5", "more_looks": "", "light": "3",
    "more_lights": "", "camera": "near", "distance": "-2", "fovy": "45", "more_cameras": "", "note": "hello",
    "sensors": '<framepos name="where" objtype="body" objname="ball"/>',
}  # fmt: skip
FACTS = {"steps": 100, "seed": 0}


def key(facts: dict = FACTS, **changes: str) -> str:
    return motion_key(mujoco.MjModel.from_xml_string(WORLD.format(**{**PLAIN, **changes})), facts)


@pytest.mark.parametrize(
    "change",
    [
        {"title": "another"}, {"width": "1920"}, {"rgb": "0 0.5 1"}, {"look": "steel"}, {"shine": "1"},
        {"more_looks": '<material name="glass"/>'}, {"light": "9"}, {"more_lights": '<light name="sun" pos="1 1 9"/>'},
        {"camera": "far"}, {"distance": "-7"}, {"fovy": "20"}, {"note": "a longer text than before"},
        {"more_cameras": '<camera name="top" pos="0 0 9"/>'},
    ],
)  # fmt: skip
def test_what_is_only_seen_changes_nothing(change: dict) -> None:
    assert key() == key(**change) != ""


def test_steps_seed_and_names_count() -> None:
    assert key({**FACTS, "steps": 101}) != key() != key({**FACTS, "seed": 1})
    renamed = WORLD.format(**PLAIN).replace('name="hinge"', 'name="elbow"').replace('joint="hinge"', 'joint="elbow"')
    assert motion_key(mujoco.MjModel.from_xml_string(renamed), FACTS) != key()


def test_every_array_and_option_that_is_no_look_counts() -> None:
    """Field by field: one number changed, another key. So no field of the engine is forgotten, old or new."""
    model = mujoco.MjModel.from_xml_string(WORLD.format(**PLAIN))
    plain = motion_key(model, FACTS)
    changed = 0
    for holder in (model, model.opt):
        for name in dir(holder):
            value = getattr(holder, name) if not name.startswith("_") else None
            if not isinstance(value, np.ndarray) or not value.size:
                continue
            before = value.copy()
            value.reshape(-1)[-1] = 1 - value.reshape(-1)[-1] if value.dtype == bool else value.reshape(-1)[-1] + 1
            if name in ("sensor_type", "sensor_objtype", "sensor_reftype"):
                value[...] = before
                continue
            if name.startswith(("name_", "numeric_")):  # tables of names and custom numbers are read, not hashed
                value[...] = before
                continue
            assert (motion_key(model, FACTS) != plain) == decides(name), name
            value[...] = before
            changed += 1
    assert changed > 200
    for name in ("timestep", "viscosity", "iterations", "disableflags", "integrator", "impratio"):
        before = getattr(model.opt, name)
        setattr(model.opt, name, before + 1)
        assert motion_key(model, FACTS) != plain, name
        setattr(model.opt, name, before)
    assert motion_key(model, FACTS) == plain


@pytest.mark.parametrize(
    "sensor",
    [
        '<rangefinder name="ray" site="top"/>',
        '<camprojection name="seen" site="top" camera="near"/>',
        '<framepos name="where" objtype="camera" objname="near"/>',
    ],
)
def test_a_sensor_that_sees_makes_looks_count(sensor: str) -> None:
    changes = {"more_cameras": "", "sensors": sensor}
    text = WORLD.format(**{**PLAIN, **changes}).replace('fovy="45"', 'fovy="45" resolution="64 64"')
    assert motion_key(mujoco.MjModel.from_xml_string(text), FACTS) == ""


DRIVEN = '''
"""A world."""
import mujoco
from worldkit import cameras, program

PUSH = 2.0  # N

def build():
    spec = mujoco.MjSpec()
    cameras.add(spec, "side", position=(0, -2, 1), fovy=40.0)
    return spec

def control(model, data):
    """Pushes."""
    data.ctrl[0] = PUSH * data.time

if __name__ == "__main__":
    program.main(build, control, duration=1.0)
'''


def driven(source: str) -> str:
    return drive_source(source, "control")


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("(0, -2, 1)", "(0, -3.5, 2)"), ("fovy=40.0", "fovy=25"), ('"side"', '"other"'), ("Pushes.", "Pulls."),
        ("  # N", ""), ("    return spec", '    cameras.add(spec, "top", view="top_down")\n    return spec'),
    ],
)  # fmt: skip
def test_placing_a_camera_does_not_change_how_a_program_drives(old: str, new: str) -> None:
    assert old in DRIVEN
    a, b = driven(DRIVEN), driven(DRIVEN.replace(old, new))
    if "top_down" in new:  # a statement more: left in as an empty one, which costs a run and is safe
        assert b
    else:
        assert a == b != ""


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("PUSH = 2.0", "PUSH = 2.1"), ("data.time", "data.time + 1"), ("duration=1.0", "duration=1.1"),
        ("(0, -2, 1)", "(0, -PUSH, 1)"), ("    return spec", "    spec.option.timestep = 0.001\n    return spec"),
    ],
)  # fmt: skip
def test_anything_else_changes_it(old: str, new: str) -> None:
    assert driven(DRIVEN) != driven(DRIVEN.replace(old, new))


@pytest.mark.parametrize(
    "law",
    [
        "data.ctrl[0] = model.cam_pos[0, 1]", "data.ctrl[0] = data.cam_xpos[0, 1]", "data.ctrl[0] = model.ncam",
        "data.ctrl[0] = model.camera('side').fovy[0]", "data.ctrl[0] = model.geom_rgba[0, 0]",
        "data.ctrl[0] = getattr(model, 'cam' + '_pos')[0, 1]", "data.ctrl[0] = eval('model.cam_fovy[0]')",
        "data.ctrl[0] = len(open(__file__).read())", "data.ctrl[0] = vars(model)['x']",
        "data.ctrl[0] = model.names.count(b'a')", "data.ctrl[0] = mujoco.mj_sizeModel(model)",
        "data.ctrl[0] = model.__getattribute__('cam_fovy')[0]",
    ],
)  # fmt: skip
def test_control_that_could_see_is_never_promised_anything(law: str) -> None:
    assert driven(DRIVEN.replace("data.ctrl[0] = PUSH * data.time", law)) == ""


def test_control_of_unknown_source_is_never_promised_anything() -> None:
    assert drive_source(None, "control") == ""
    assert driven("import socket\n" + DRIVEN) == ""
    assert driven(DRIVEN.replace("def control", "control = None\ndef helper") + "\ncontrol = lambda m, d: None") == ""


LAWFUL = DRIVEN.replace("import mujoco\n", "import mujoco\nfrom laws.snow import Snow\n").replace(
    "control, ", "laws=[Snow(PUSH)], "
)
SNOW = '''
"""Flakes."""
from .grains import SIZE
from worldkit.matter import Matter

class Snow(Matter):
    def __init__(self, push):
        super().__init__(SIZE, push)
'''
GRAINS = "SIZE = 0.01  # m\n"


def stepped(source: str = LAWFUL, snow: str = SNOW, grains: str = GRAINS, data: str = "", world: str = "w", **changes):
    model = mujoco.MjModel.from_xml_string(WORLD.format(**{**PLAIN, **changes}))
    beside = Beside({"laws/snow.py": snow, "laws/grains.py": grains}, data)
    return motion_key(model, FACTS, "", source, laws=True, beside=beside, world=world)


@pytest.mark.parametrize(
    "old_new", [("(0, -2, 1)", "(1, -2, 1)"), ('"""A world."""', '"""Other claims."""'), ("# N", "# newton")]
)
def test_a_world_with_a_law_moves_alike_where_only_texts_and_cameras_differ(old_new: tuple[str, str]) -> None:
    assert stepped() == stepped(LAWFUL.replace(*old_new), fovy="20", world="another") != ""
    assert stepped() == stepped(snow=SNOW.replace("Flakes", "Snow"), grains="SIZE = 0.01\n")


@pytest.mark.parametrize(
    "changed",
    [
        {"source": LAWFUL.replace("PUSH = 2.0", "PUSH = 2.5")}, {"snow": SNOW.replace("push)", "2 * push)")},
        {"grains": "SIZE = 0.02"}, {"data": "a table"}, {"distance": "-2", "sensors": ""},
    ],
)  # fmt: skip
def test_what_a_law_may_read_counts(changed: dict[str, str]) -> None:
    assert "" != stepped(**changed) != stepped()


def test_a_law_that_could_see_moves_alike_only_in_the_same_world() -> None:
    seeing = SNOW + "    def start(self, model, data):\n        self.x = model.cam_pos[0]\n"
    assert stepped(snow=seeing) == stepped(LAWFUL.replace("A world", "Other claims"), snow=seeing) != ""
    assert stepped(snow=seeing, world="another") != stepped(snow=seeing)
    assert stepped(snow=seeing, world="") == ""


def test_a_law_is_promised_nothing_where_not_all_is_known_that_it_reads() -> None:
    model = mujoco.MjModel.from_xml_string(WORLD.format(**PLAIN))
    assert motion_key(model, FACTS, "", LAWFUL, laws=True, world="w") == ""
    assert stepped(snow=SNOW + "    text = open('plan.md').read()\n") == ""
    own = SNOW + "    text = open(__file__).read()\n"
    assert same_source(own, Beside()) != same_source(own + "# more\n", Beside()) != ""
    assert drive_source(DRIVEN.replace("import mujoco", "from . import other\nimport mujoco"), "control") == ""
