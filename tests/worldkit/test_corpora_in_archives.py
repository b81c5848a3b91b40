"""Every kind of world that the engine knows, through the archive: the same model, or a list of what is rounded, or a refusal.

All are compiled once more, from their archives, by one clean process; there the binary model must be the same bit for bit.
"""

import json
import subprocess
import sys
import warnings
from pathlib import Path

import cv2
import mujoco
import numpy as np
import pytest

from worldengine.recording.describing import fingerprint
from worldkit import portable
from worldkit.errors import ProgramError

BALL = "<body name='ball' pos='0 0 1'><freejoint name='free'/><geom name='skin' size='.1'/><site name='mark' pos='.05 0 0'/></body>"
ARM = (
    "<body><joint name='hinge' axis='0 1 0' range='-30 30' springref='10' ref='5' frictionloss='.1'/>"
    "<geom size='.1' pos='.3 0 0'/></body>"
)
WEDGE = "<asset><mesh name='wedge' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>"


def within(content: str, before: str = "", after: str = "") -> str:
    """MJCF of a floor and this."""
    floor = "<geom name='floor' type='plane' size='5 5 .1'/>"
    return f"<mujoco>{before}<worldbody>{floor}{content}</worldbody>{after}</mujoco>"


def flex(dim: int, count: str, inside: str, more: str = "") -> str:
    """MJCF of one flex over a floor."""
    return within(
        f"<flexcomp name='flex' type='grid' count='{count}' spacing='.1 .1 .1' pos='0 0 1' dim='{dim}' mass='.5' "
        f"radius='.01' {more}>{inside}</flexcomp>"
    )


def extension(plugin: str, instance: str) -> str:
    """MJCF of the extension that loads a plugin."""
    return f"<extension><plugin plugin='{plugin}'>{instance}</plugin></extension>"


EDGES = "<edge equality='true'/>"
WORLDS = {
    "cloth": flex(2, "5 5 1", EDGES + "<contact selfcollide='none'/>"),
    "elastic pinned cloth": flex(
        2, "5 5 1", "<elasticity young='3e4' poisson='.2' thickness='1e-2' elastic2d='both'/><pin id='0 4'/>"
    ),
    "soft body": flex(3, "3 3 3", "<elasticity young='3e4' poisson='.2'/>"),
    "trilinear body": flex(3, "3 3 3", "<elasticity young='3e4' poisson='.2'/>", "dof='trilinear'"),
    "soft rod": flex(1, "9 1 1", EDGES),
    "pid plugin": within(
        ARM,
        extension(
            "mujoco.pid", "<instance name='p'><config key='kp' value='40'/><config key='ki' value='4'/></instance>"
        ),
        "<actuator><plugin joint='hinge' plugin='mujoco.pid' instance='p' actdim='1'/></actuator>",
    ),
    "shape by plugin": within(
        "<body pos='0 0 1'><freejoint/><geom type='sdf' mesh='torus'><plugin instance='t'/></geom></body>",
        extension("mujoco.sdf.torus", "<instance name='t'><config key='radius1' value='.35'/></instance>")
        + "<asset><mesh name='torus'><plugin instance='t'/></mesh></asset>",
    ),
    "sensor plugin": within(
        BALL,
        extension("mujoco.sensor.touch_grid", ""),
        "<sensor><plugin name='touch' plugin='mujoco.sensor.touch_grid' objtype='site' objname='mark'>"
        "<config key='size' value='7 7'/><config key='fov' value='45 45'/><config key='gamma' value='0'/>"
        "<config key='nchannel' value='3'/></plugin></sensor>",
    ),
    "height field": within(
        "<geom type='hfield' hfield='hills'/>" + BALL,
        "<asset><hfield name='hills' nrow='3' ncol='4' size='1 1 .3 .1' "
        "elevation='0 .1 .2 .3 .4 .5 .6 .7 .8 .9 1 .33333'/></asset>",
    ),
    "height field in a file": within(
        "<geom type='hfield' hfield='hills'/>" + BALL,
        "<asset><hfield name='hills' file='FOLDER/hills.png' size='1 1 .3 .1'/></asset>",
    ),
    "skin": within(
        BALL,
        "<asset><skin name='cover' vertex='0 0 0 .1 0 0 0 .1 0' face='0 1 2'>"
        "<bone body='ball' bindpos='0 0 1' bindquat='1 0 0 0' vertid='0 1 2' vertweight='1 1 1'/></skin></asset>",
    ),
    "asleep at first": within(
        BALL.replace("name='ball' pos='0 0 1'", "name='ball' pos='0 0 .1' sleep='init'"),
        "<option><flag sleep='enable'/></option>",
    ),
    "may sleep": within(
        BALL.replace("name='ball'", "name='ball' sleep='allowed'"),
        "<option sleep_tolerance='3e-4'><flag sleep='enable'/></option>",
    ),
    "keyframes": within(
        BALL + "<body name='hand' mocap='true' pos='1 0 1'><geom size='.1' contype='0' conaffinity='0'/></body>",
        after="<actuator><intvelocity site='mark' refsite='mark' actrange='-1 1'/></actuator><keyframe><key name='start' "
        "qpos='0 0 .33333333333333331 1 0 0 0' qvel='1 2 3 4 5 6' act='.1' ctrl='.7' mpos='1 .1 1'/>"
        "<key name='later' time='3'/><key/></keyframe>",
    ),
    "tendon and muscle": within(
        "<site name='top' pos='0 0 2'/><geom name='bar' type='cylinder' size='.05 .1' pos='0 0 1.5' euler='90 0 0'/>"
        "<site name='side' pos='.2 0 1.5'/>" + BALL,
        after="<tendon><spatial name='rope' range='0 1.1' springlength='.1 .2' stiffness='3 .2' damping='.1'>"
        "<site site='top'/><geom geom='bar' sidesite='side'/><site site='mark'/></spatial></tendon>"
        "<actuator><muscle tendon='rope' ctrlrange='0 1'/></actuator>"
        "<sensor><tendonpos name='length' tendon='rope' noise='.1' cutoff='2'/></sensor>",
    ),
    "ties": within(
        BALL + "<body name='other' pos='1 0 1'><freejoint/><geom size='.1'/></body><body><joint name='one' "
        "stiffness='1 2 3' damping='1 .1'/><joint name='two' axis='1 0 0'/><geom size='.1' pos='.1 0 0'/></body>",
        after="<equality><weld body1='ball' body2='other' relpose='0 0 0 1 0 0 0' torquescale='.3'/><connect body1='other' "
        "anchor='.1 .2 .3'/><joint joint1='one' joint2='two' polycoef='0 1 .5 0 0' active='false'/></equality>",
    ),
    "pairs": within(
        BALL,
        after="<contact><pair geom1='skin' geom2='floor' friction='.3 .3 .01 .001 .001' solref='-1000 -10' "
        "margin='.01'/></contact>",
    ),
    "sizes and texts": within(
        BALL,
        "<size memory='4M' nuserdata='7'/><custom><numeric name='n' size='4' data='1 2'/><text name='t' data='hello'/>"
        "<tuple name='u'><element objtype='body' objname='ball' prm='.3'/></tuple></custom>",
    ),
    "medium and overrides": within(
        BALL.replace("size='.1'", "size='.1 .2 .3' type='ellipsoid' fluidshape='ellipsoid' fluidcoef='.1 .2 .3 .4 .5'"),
        "<option density='1.2' viscosity='1e-5' wind='1 2 3' impratio='7' o_margin='.1'><flag override='enable'/></option>",
    ),
    "shape fitted to a mesh": within("<body><freejoint/><geom type='box' mesh='wedge'/></body>", WEDGE),
    "actuators": within(
        ARM,
        after="<actuator><position joint='hinge' kp='3' dampratio='1' timeconst='.1' inheritrange='1'/>"
        "<velocity joint='hinge' kv='3'/><damper joint='hinge' kv='3' ctrlrange='0 1'/>"
        "<cylinder joint='hinge' timeconst='2' bias='1 2 3'/>"
        "<general joint='hinge' dyntype='filterexact' dynprm='.3' actearly='true' delay='.01' nsample='5'/></actuator>",
    ),
    **{
        f"integrator {integrator}": within(
            BALL, f"<option timestep='.0033333333333333' integrator='{integrator}' solver='{solver}' cone='{cone}'/>"
        )
        for integrator, solver, cone in (
            ("Euler", "PGS", "pyramidal"),
            ("RK4", "CG", "elliptic"),
            ("implicit", "Newton", "elliptic"),
            ("implicitfast", "Newton", "pyramidal"),
            ("discrete", "Newton", "elliptic"),
        )
    },
}
"""Worlds that the archive carries bit for bit, in everything that decides the motion."""
ROUNDED = {
    "mesh of another frame": (
        within(
            "<body pos='.1 .2 1' euler='10 20 30'><freejoint/>"
            "<geom type='mesh' mesh='wedge' pos='.1 .3 .7' euler='3 4 5'/></body>",
            WEDGE.replace("/></asset>", " scale='.1 .2 .3' refpos='.1 .2 .3' refquat='1 1 0 0'/></asset>"),
        ),
        {"geom_quat", "body_iquat"},
    ),
    "frames and defaults": (
        within(
            "<frame euler='.1 .2 .3' pos='1 2 3'><body childclass='k' pos='.1 0 1' euler='.3 .2 .1'><joint/>"
            "<geom type='capsule' fromto='0 0 0 .1 .2 .33333333' size='.05'/></body></frame>",
            "<compiler angle='radian' eulerseq='zyx'/><default><default class='k'><joint damping='.3'/></default></default>",
        ),
        {"body_pos", "body_quat"},
    ),
    "a row of copies": (
        within(
            "<replicate count='5' offset='.3 0 0' euler='0 0 7'><body pos='0 0 1'><freejoint/><geom size='.1'/></body>"
            "</replicate>"
        ),
        {"body_pos", "qpos0"},
    ),
}
"""Worlds whose numbers the engine's writer computes anew, with fields of which one at least must be listed as rounded."""
CLEAN = """
import json, sys, warnings
from pathlib import Path
warnings.simplefilter("ignore")
from worldengine.recording.describing import fingerprint
from worldkit import portable
print(json.dumps({path.stem: fingerprint(portable.read(path)) for path in Path(sys.argv[1]).glob("*.mjz")}))
"""


def source(text: str, folder: Path) -> mujoco.MjSpec:
    return mujoco.MjSpec.from_string(text.replace("FOLDER", str(folder)))


@pytest.fixture(scope="module")
def archives(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict[str, dict], dict[str, str]]:
    """The folder of all archives, the facts of each, and what a clean process compiled of them: hashes of binary models."""
    folder = tmp_path_factory.mktemp("archives")
    cv2.imwrite(str(folder / "hills.png"), np.arange(64, dtype=np.uint8).reshape(8, 8) * 3)
    facts = {}
    with warnings.catch_warnings(action="ignore"):  # that a soft body is rather soft
        for name, text in {**WORLDS, **{name: row[0] for name, row in ROUNDED.items()}}.items():
            facts[name] = portable.write(source(text, folder), folder / f"{name}.mjz")
    call = [sys.executable, "-c", CLEAN, str(folder)]
    done = subprocess.run(call, capture_output=True, text=True, check=True, cwd="/")
    return folder, facts, json.loads(done.stdout)


def test_every_integrator_is_among_them() -> None:
    names = {name.removeprefix("mjINT_").lower() for name in mujoco.mjtIntegrator.__members__}
    assert names == {name.split()[1].lower() for name in WORLDS if name.startswith("integrator")}


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize("name", [*WORLDS, *ROUNDED])
def test_a_clean_process_compiles_the_same_bits(archives, name: str) -> None:
    folder, _, compiled = archives
    assert compiled[name] == fingerprint(portable.read(folder / f"{name}.mjz"))


@pytest.mark.parametrize("name", WORLDS)
def test_it_is_the_world_that_was_built_bit_for_bit(archives, name: str) -> None:
    assert archives[1][name]["rounded"] == {}


@pytest.mark.parametrize("name", ROUNDED)
def test_what_is_rounded_is_listed(archives, name: str) -> None:
    rounded = archives[1][name]["rounded"]
    assert ROUNDED[name][1] & rounded.keys()
    assert 0 < max(rounded.values()) < 1e-12


def test_six_digits_are_refused_by_the_field(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where the engine's writer cannot be told to write all digits."""
    from contextlib import nullcontext

    monkeypatch.setattr(portable, "_all_digits", nullcontext)
    spec = source(within(BALL.replace("pos='0 0 1'", "pos='0 0 0.123456789'")), tmp_path)
    facts = portable.write(spec, tmp_path / "near.mjz")  # less than a millionth is within the tolerance, and told
    assert 0 < facts["rounded"]["body_pos"] <= portable.TOLERANCE
    spec.body("ball").pos = (0, 0, 1.0000049)
    with pytest.raises(ProgramError, match=r"written as one file: \w+ differs by \d"):
        portable.write(spec, tmp_path / "far.mjz")


def spoilt(spec: mujoco.MjSpec, what: str) -> None:
    """Write a number that is none into a world."""
    none = (float("nan"), 0, 0)
    if what == "opt.gravity":
        spec.option.gravity = none
    elif what == "cam_pos of eye":
        spec.worldbody.add_camera(name="eye", pos=none)
    elif what == "geom_rgba of skin":
        spec.geom("skin").rgba = (*none, 1)
    elif what == "body_ipos of ball":
        spec.geom("skin").pos = (float("inf"), 0, 0)
    elif what == "key_qvel of start":
        spec.add_key(name="start", qvel=none * 2)
    else:
        spec.visual.map.zfar = none[0]


@pytest.mark.parametrize(
    "what",
    ["opt.gravity", "cam_pos of eye", "geom_rgba of skin", "body_ipos of ball", "key_qvel of start", "vis.map.zfar"],
)
def test_a_number_that_is_none_is_refused_by_its_field(tmp_path: Path, what: str) -> None:
    """Also one that only a picture would show."""
    spec = source(within(BALL), tmp_path)
    spoilt(spec, what)
    with pytest.raises(ProgramError, match=rf"numbers that are none \(nan, inf\): {what}"):
        portable.write(spec, tmp_path / "world.mjz")
    assert not (tmp_path / "world.mjz").exists()
