"""A robot with its meshes beside the plan is drafted, its files belong to the approval, and a missing one is told."""

import io
import resource
import shutil
from contextlib import suppress
from pathlib import Path

import mujoco
import pytest
import trimesh

from worldkit import models
from worldwright.draft import draft
from worldwright.lint.tools import check_plan, check_program
from worldwright.model import companions
from worldwright.model.errors import PlanError
from worldwright.model.plan import imported
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.engine import resolve

HERE = Path(__file__).parent / "models"
MESH = '<mesh filename="package://arm_description/meshes/upper.stl"/>'
ARM = (HERE / "arm.urdf").read_text().replace('<cylinder radius="0.03" length="0.4"/>', MESH)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "parts").mkdir()
    shutil.copy(HERE / "chest.xml", tmp_path / "parts")
    shutil.copy(HERE / "plan.md", tmp_path)
    (tmp_path / "robot/meshes").mkdir(parents=True)
    (tmp_path / "robot/arm.urdf").write_text(ARM)
    trimesh.creation.cylinder(0.03, 0.4).export(tmp_path / "robot/meshes/upper.stl")
    plan = (tmp_path / "plan.md").read_text()
    (tmp_path / "plan.md").write_text(plan.replace("filename: arm.urdf", "filename: robot/arm.urdf"))
    return tmp_path


def test_a_robot_stands_in_its_plan_with_its_meshes(folder: Path, monkeypatch) -> None:
    assert [f for f in check_plan(folder / "plan.md").findings if f.severity == "error"] == []
    plan = read_plan(folder / "plan.md").plan
    made = draft(plan, resolve(plan).scene)
    (folder / "simulation.py").write_text(made.source)
    assert 'ARM_FILES = (\n    "robot/meshes/upper.stl",\n)' in made.source
    assert "robot/meshes/upper.stl" in companions.of(folder / "simulation.py"), "evidence is about the mesh, too"
    assert {"robot/arm.urdf", "robot/meshes/upper.stl"} <= {*imported.beside(folder)}, "and so is the approval"
    report = check_program([folder / "simulation.py"])
    assert not [f for f in report.findings if f.severity == "error"], report.text()
    monkeypatch.syspath_prepend(str(folder))
    names: dict = {"__name__": "drafted"}
    exec(compile(made.source, "drafted", "exec"), names)
    model = names["build"]().compile()
    assert (model.geom_type == mujoco.mjtGeom.mjGEOM_MESH).any() and model.body("arm_upper").mass[0] == 2.0


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda home: (home / "robot/meshes/upper.stl").unlink(), "files that are not there: package://arm_description/meshes/upper.stl"),
        (lambda home: (home / "robot/meshes/upper.stl").write_bytes(b"\0" * 80 + b"\xff\xff\xff\0"), "16,777,215 faces"),
        (lambda home: (home / "plan.md").write_text((home / "plan.md").read_text().replace("robot/arm.urdf", "robot")), "holds some"),
    ],
)  # fmt: skip
def test_what_is_wrong_with_its_files_is_told(folder: Path, change, told: str) -> None:
    change(folder)
    (finding,) = [f for f in check_plan(folder / "plan.md").findings if f.code == "WP126" and "`arm`" in f.message]
    assert told in finding.message and finding.fix


def test_a_mesh_that_changes_is_read_anew(folder: Path) -> None:
    def size() -> tuple:
        plan = read_plan(folder / "plan.md").plan
        row = next(row for row in plan.assets if row.name == "arm")
        return imported.load(row, plan.folder).extents

    before = size()
    trimesh.creation.cylinder(0.03, 0.8).export(folder / "robot/meshes/upper.stl")
    assert size()[2] == pytest.approx(before[2] + 0.3)


def test_no_module_beside_a_plan_runs_when_the_plan_is_read(folder: Path) -> None:
    mesh = folder / "robot/meshes/upper.stl"
    trimesh.load(mesh).export(mesh.with_suffix(".ply"))
    (folder / "robot/arm.urdf").write_text(ARM.replace("upper.stl", "upper.ply"))
    (folder / "trimesh.py").write_text(f"open({str(folder / 'ran')!r}, 'w').close()\n")
    plan = read_plan(folder / "plan.md").plan
    row = next(row for row in plan.assets if row.filename == "robot/arm.urdf")
    with suppress(PlanError):
        imported.load(row, folder)
    assert not (folder / "ran").exists(), "nothing confines this process"
    assert imported.load(row, folder).files == ("robot/meshes/upper.ply",)


def test_a_mesh_of_a_plan_is_counted_as_often_as_it_is_drawn_before_it_is_read(folder: Path) -> None:
    node = '<node><instance_geometry url="#g"/></node>'
    (folder / "robot/meshes/upper.dae").write_text(
        '<COLLADA><library_geometries><geometry id="g"><mesh><triangles count="9000"/></mesh></geometry></library_geometries>'
        f"<library_visual_scenes><visual_scene>{1000 * node}</visual_scene></library_visual_scenes></COLLADA>"
    )
    (folder / "robot/arm.urdf").write_text(ARM.replace("upper.stl", "upper.dae"))
    row = next(row for row in read_plan(folder / "plan.md").plan.assets if row.filename == "robot/arm.urdf")
    with pytest.raises(PlanError, match="9,000,000 faces"):
        imported.load(row, folder)


def test_what_needs_more_memory_than_a_model_may_is_told(monkeypatch, capsys) -> None:
    def greedy(**_: object) -> None:
        assert resource.getrlimit(resource.RLIMIT_AS)[0] <= models.MOST_MEMORY
        raise MemoryError

    before = resource.getrlimit(resource.RLIMIT_AS)
    monkeypatch.setattr(models, "facts", greedy)
    monkeypatch.setattr("sys.stdin", io.StringIO("{}"))
    try:
        models.main()
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)
    assert "more than 6 GB of memory" in capsys.readouterr().out
