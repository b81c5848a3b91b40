"""Any MJCF file can be recorded, with what it includes, and nothing else of the folder it lies in."""

import ast
import json
import runpy
import shutil
import struct
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright.cli import main
from worldwright.model.errors import GateError, JobError, NotFoundError
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.stage import bare_models, given_models, sandbox
from worldwright.stage.tools import start, wait

WORLD = """<mujoco model="thrown">
  <compiler meshdir="../assets" texturedir="../assets/pictures"/>
  <include file="parts/ground.xml"/>
  <asset><mesh name="rock" file="rock.stl"/><texture name="t" type="2d" file="t.png"/></asset>
  <worldbody><light pos="0 0 3"/>
    <body name="rock" pos="0 0 1"><freejoint/><geom type="mesh" mesh="rock" density="2000"/></body>
  </worldbody>
</mujoco>"""
GROUND = '<mujoco><worldbody><geom type="plane" size="5 5 .1"/></worldbody></mujoco>'


@pytest.fixture
def model(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("models/parts", "assets/pictures"):
        (tmp_path / name).mkdir(parents=True)
    corners = [(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0, 0, 0.1)]
    faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
    triangles = b"".join(struct.pack("<12fH", 0, 0, 0, *(c for i in face for c in corners[i]), 0) for face in faces)
    (tmp_path / "assets/rock.stl").write_bytes(bytes(80) + struct.pack("<I", len(faces)) + triangles)
    import cv2
    import numpy as np

    cv2.imwrite(str(tmp_path / "assets/pictures/t.png"), np.full((8, 8, 3), 128, np.uint8))
    (tmp_path / "models/parts/ground.xml").write_text(GROUND)
    (tmp_path / "models/thrown.xml").write_text(WORLD)
    (tmp_path / "models/unrelated.xml").write_text("<mujoco/>")
    return tmp_path / "models/thrown.xml"


def end(folder):
    job = wait(str(folder), timeout_s=40)
    while not job.ended:  # on a busy machine
        job = wait(str(folder), timeout_s=40)
    return job


def test_a_model_is_recorded_with_all_it_is_made_of(level, model):
    names = {path.name for path in bare_models.made_of(model, model.parent)}
    assert names == {"thrown.xml", "ground.xml", "rock.stl", "t.png"}
    started = CliRunner().invoke(
        main, ["stage", "start", "--model", str(model), "--duration", "0.6", "--format", "json"]
    )
    assert started.exit_code == 0, started.output
    job = end("runs/thrown")
    assert job.state == "succeeded", job.text()
    recording = read_trajectory(Run.find("runs/thrown").folder / job.result / "trajectory")
    assert recording.t[-1] == pytest.approx(0.6)
    assert recording.pos[0, 0, 2] - recording.pos[-1, 0, 2] > 0.5
    again = start(model=model, duration=0.6)
    assert again.cached
    assert start(model=model, duration=0.7).cached is False
    end("runs/thrown")


def test_a_model_that_changed_is_recorded_anew_and_never_under_its_old_name(model):
    start(model=model, duration=0.1)
    first = end("runs/thrown")
    model.with_name("parts").joinpath("ground.xml").write_text(GROUND.replace("5 5", "6 6"))
    with pytest.raises(JobError, match=r"ground\.xml"):
        start("runs/thrown", stage="stills")
    second = start(model=model, duration=0.1)
    assert second.key != first.key
    assert end("runs/thrown").state == "succeeded"


@pytest.mark.parametrize("text", ["", "<mujoco", "\0\1", "<mujoco><include file='thrown.xml'/></mujoco>", "<a/>" * 2])
def test_a_broken_model_is_named_and_the_folder_stays_usable(model, text):
    model.write_text(text)
    try:
        start(model=model, duration=0.1)
    except JobError as refusal:
        assert "thrown.xml" in refusal.place
        assert refusal.next_move
    else:
        job = end("runs/thrown")
        assert (job.state, job.code) == ("failed", "crashed")
        assert job.message
    model.write_text("<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>")
    start(model=model, duration=0.1)
    assert end("runs/thrown").state == "succeeded"


@pytest.mark.parametrize("level", [name for name in sandbox.CONFINING if not sandbox.unusable(name)], indirect=True)
def test_stills_of_a_bare_model(level, model):
    start(model=model, duration=0.2)
    end("runs/thrown")
    start("runs/thrown", stage="stills")
    job = end("runs/thrown")
    assert job.state == "succeeded", job.text()
    assert json.loads((Run.find("runs/thrown").folder / job.result / "result.json").read_text())["summary"]["cameras"]


def test_a_urdf_with_its_meshes_in_an_archive_is_recorded(level, model):
    import zipfile

    link = '<link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
    shape = '<geometry><mesh filename="package://stone/meshes/rock.stl"/></geometry>'
    text = f'<robot name="stone">{link}<collision>{shape}</collision></link></robot>'
    with zipfile.ZipFile("stone.zip", "w") as made:
        made.writestr("stone/urdf/stone.urdf", text)
        made.write(model.parent.parent / "assets/rock.stl", "stone/meshes/rock.stl")
    start(model=Path("stone.zip"), duration=0.1)
    job = end("runs/stone")
    assert job.state == "succeeded", job.text()
    assert start(model=Path("stone.zip"), duration=0.1).cached
    with zipfile.ZipFile("climbing.zip", "w") as made:
        made.writestr("../stone.urdf", text)
    with pytest.raises(JobError, match="outside") as told:
        start(model=Path("climbing.zip"))
    assert told.value.code == "climbs_out"


def test_a_name_from_an_archive_does_not_become_a_program(model):
    import zipfile

    name = 'a"""\nprint("INJECTED")\n"""b\\.xml'
    with zipfile.ZipFile("strange.zip", "w") as made:
        made.writestr(name, "<mujoco/>")
    run = bare_models.prepare(Path("strange.zip"), 0.1, None)
    tree = ast.parse(run.program.read_text())
    assert not any(isinstance(node, ast.Call) and ast.unparse(node.func) == "print" for node in ast.walk(tree))
    assert [node.value.value for node in tree.body if isinstance(node, ast.Assign)] == [
        str(next(run.folder.absolute().glob(".model-*")) / name)
    ]


PANDA = """<robot name="panda"><link name="base">
<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<collision><geometry><mesh filename="package://franka_description/meshes/rock.stl"/></geometry></collision></link></robot>"""


@pytest.fixture
def panda(model):
    """A package as ROS's are laid out, its model two folders deep."""
    home = model.parent.parent / "src/franka_description"
    for name in ("robots/panda", "meshes"):
        (home / name).mkdir(parents=True)
    (home / "robots/panda/panda.urdf").write_text(PANDA)
    (home / "meshes/rock.stl").write_bytes((home.parent.parent / "assets/rock.stl").read_bytes())
    return home


@pytest.mark.parametrize("given", ["robots/panda/panda.urdf", ".", "..", "robots"])
def test_the_meshes_of_a_package_are_found_from_any_of_its_places(panda, tmp_path, given):
    run = bare_models.prepare(panda / given, None, tmp_path / "runs/panda")
    assert [path.name for path in bare_models.files(run)] == ["panda.urdf", "rock.stl"]
    built = runpy.run_path(str(run.program))["build"]()
    assert len(built.compile().mesh_vert) == 4


def test_a_package_is_known_by_its_file_and_another_beside_it_is_read(panda, tmp_path):
    other = panda.rename(panda.with_name("renamed"))
    (other / "package.xml").write_text("<package/>")
    (other.parent / "hand/meshes").mkdir(parents=True)
    (other / "meshes/rock.stl").rename(other.parent / "hand/meshes/finger.stl")
    urdf = other / "robots/panda/panda.urdf"
    assert given_models.package_of(urdf) == other
    urdf.write_text(PANDA.replace("franka_description/meshes/rock", "hand/meshes/finger"))
    run = bare_models.prepare(urdf, None, tmp_path / "runs/panda")
    assert bare_models.files(run)[1] == other.parent / "hand/meshes/finger.stl"


def test_an_archive_is_unpacked_once_and_what_lies_beside_it_stays(panda, tmp_path):
    folder = tmp_path / "kept"
    (folder / "model").mkdir(parents=True)
    (folder / "model/notes.txt").write_text("mine")
    archive = shutil.make_archive(str(folder / "model/panda"), "zip", panda.parent, panda.name)
    bare_models.prepare(Path(archive), None, folder)
    assert (folder / "model/notes.txt").read_text() == "mine" and Path(archive).is_file()
    (made,) = folder.glob(".model-*")
    assert made.name == f".model-{sha256_file(Path(archive))[:12]}"
    before = (made / "franka_description/meshes/rock.stl").stat()
    bare_models.prepare(Path(archive), None, folder)
    assert (made / "franka_description/meshes/rock.stl").stat() == before
    (folder / "broken.zip").write_bytes(b"PK")
    with pytest.raises(JobError, match="unpacked"):
        bare_models.prepare(folder / "broken.zip", None, folder)
    assert [*folder.glob(".model-*")] == [made]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('<mujoco><asset><mesh file="a.stl"/><mesh file="b.stl"/></asset></mujoco>', r"a\.stl, b\.stl"),
        ('<mujoco><include file="thrown.xml"/></mujoco>', "includes itself"),
        ('<robot name="r"><link name="a"><visual><geometry><mesh filename="package://r/a.stl"/></geometry></visual></link></robot>', r"a\.stl"),
        ('<robot name="r"><link name="a"><visual><geometry><mesh filename="/home/me/rock.stl"/></geometry></visual></link></robot>', "one machine"),
    ],
)  # fmt: skip
def test_what_a_model_is_made_of_and_is_not_there_is_told_before_it_runs(model, text, said):
    model.write_text(text)
    with pytest.raises(JobError, match=said) as told:
        start(model=model, duration=0.1)
    assert told.value.code == "refused" and told.value.next_move


def test_an_empty_name_names_no_file(model):
    import mujoco

    model.write_text(
        '<mujoco><asset><texture name="t" type="2d" builtin="flat" width="8" height="8" file=""/></asset></mujoco>'
    )
    mujoco.MjModel.from_xml_path(str(model))
    assert bare_models.made_of(model, model.parent) == [model]


@pytest.mark.parametrize(
    ("given", "name"),
    [("robot.v1.xml", "robot.v1"), ("robot.v2.xml", "robot.v2"), (".m.xml", "m"), (".xml", "model"), ("a.XML.urdf", "a"), ("b.c", "b.c")],
)  # fmt: skip
def test_every_model_has_a_run_of_its_own(model, given, name):
    model.with_name(given).write_text("<mujoco/>")
    assert bare_models.prepare(model.with_name(given), 0.1, None).folder == Path("runs").absolute() / name


def test_the_folder_above_has_its_own_name(model):
    model.with_name("unrelated.xml").unlink()
    assert bare_models.prepare(model.parent / "parts" / "..", 0.1, None).folder == Path("runs/models").absolute()


def test_a_folder_gives_its_one_model(model):
    with pytest.raises(NotFoundError, match=r"2 models in it: thrown\.xml, unrelated\.xml"):
        start(model=model.parent)
    model.with_name("unrelated.xml").unlink()
    start("runs/folder", model=model.parent, duration=0.1)
    assert end("runs/folder").state == "succeeded"


def test_misuse_is_refused(model):
    with pytest.raises(NotFoundError):
        start(model=model.with_name("none.xml"))
    with pytest.raises(NotFoundError, match="name a run"):
        start()
    (model.parent / "plan.md").write_text("a plan")
    with pytest.raises(GateError, match="with a plan"):
        start(str(model.parent), model=model)
