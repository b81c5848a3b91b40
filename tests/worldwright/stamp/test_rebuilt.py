"""A program must build the world that is kept: the same content here, elsewhere the same within rounding."""

import json
import zipfile
from pathlib import Path

import mujoco
import pytest

from worldkit import closed_archive, portable
from worldwright.model.errors import GateError, JobError
from worldwright.stage import launch
from worldwright.stage import tools as stage
from worldwright.stage.confined import Confined
from worldwright.stamp import rebuilt
from worldwright.stamp import tools as stamp
from worldwright.stamp.strip import BEGIN, END


def world(path: Path, radius: float = 0.1, color: float = 0.5, more: int = 0) -> Path:
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(name="ball")
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(radius, 0, 0), rgba=(color, 0, 0, 1))
    for i in range(more):
        spec.worldbody.add_body(name=f"more_{i}")
    portable.write(spec, path)
    return path


def test_another_packing_has_the_same_content(tmp_path: Path) -> None:
    one, other = world(tmp_path / "one.mjz"), tmp_path / "other.mjz"
    with zipfile.ZipFile(other, "w", zipfile.ZIP_STORED) as archive:
        for name, content in closed_archive.packed(one).items():
            archive.writestr(name, content)
    assert one.read_bytes() != other.read_bytes()
    assert closed_archive.content_sha256(one) == closed_archive.content_sha256(other)
    assert rebuilt.compare(one, other, elsewhere=False) == rebuilt.SAME


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"radius": 0.11}, "geom_|body_|dof_|light|stat"),
        ({"more": 1}, "the naming differs"),
        ({"radius": 0.1 + 1e-9}, r"differs by .* line 1|differs by .* line \d+"),
        ({"color": 0.6}, r"no number of its motion differs; seen in its model.xml, line \d+"),
    ],
)
def test_a_difference_is_refused_by_its_name(tmp_path: Path, change: dict, named: str) -> None:
    with pytest.raises(rebuilt.OtherWorldError, match=named):
        rebuilt.compare(world(tmp_path / "one.mjz"), world(tmp_path / "other.mjz", **change), elsewhere=False)


def test_elsewhere_rounding_is_accepted_and_told_and_no_more(tmp_path: Path) -> None:
    kept = world(tmp_path / "one.mjz")
    told = rebuilt.compare(kept, world(tmp_path / "near.mjz", radius=0.1 + 1e-9), elsewhere=True)
    assert told.startswith("the same within 1e-06: ") and " differs by " in told
    with pytest.raises(rebuilt.OtherWorldError, match="differs by"):
        rebuilt.compare(kept, world(tmp_path / "far.mjz", radius=0.1001), elsewhere=True)


def test_what_is_no_archive_is_told(tmp_path: Path) -> None:
    (tmp_path / "none.mjz").write_bytes(b"nothing")
    with pytest.raises(rebuilt.OtherWorldError, match="no archive"):
        rebuilt.compare(world(tmp_path / "one.mjz"), tmp_path / "none.mjz", elsewhere=True)


@pytest.mark.parametrize(("status", "advice"), [("timed_out", "less to do"), ("out_of_memory", "smaller")])
def test_a_comparison_without_an_end_says_what_would_end_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, status: str, advice: str
) -> None:
    monkeypatch.setattr(stage, "run_confined", lambda *_, **__: Confined(status))
    with pytest.raises(JobError) as caught:
        rebuilt.compare(world(tmp_path / "one.mjz"), world(tmp_path / "other.mjz", more=1), elsewhere=False)
    assert caught.value.code == status and advice in caught.value.next_move


def test_two_worlds_may_take_what_two_passes_may() -> None:
    assert rebuilt.MEMORY_MB == 2 * launch.MEMORY_MB


def test_facts_must_be_the_same(tmp_path: Path) -> None:
    files = [tmp_path / name for name in ("a.json", "b.json")]
    facts = {"duration": 1.0, "world_sha256": "one"}
    for path, more in zip(files, ({}, {"world_sha256": "other"}), strict=True):
        path.write_text(json.dumps(facts | more))
    rebuilt.same_facts(files[:1], files[1:], elsewhere=False)
    files[1].write_text(json.dumps(facts | {"duration": 2.0}))
    with pytest.raises(rebuilt.OtherWorldError, match=r"`duration` of a\.json differs: 1\.0, now 2\.0"):
        rebuilt.same_facts(files[:1], files[1:], elsewhere=True)
    files[1].write_text(json.dumps(facts | {"of_later": 1}))
    rebuilt.same_facts(files[:1], files[1:], elsewhere=True)  # an older stamp does not know it
    with pytest.raises(rebuilt.OtherWorldError, match="`of_later`"):
        rebuilt.same_facts(files[:1], files[1:], elsewhere=False)


def test_instrumentation_that_changes_a_look_is_refused_by_its_place(planned: Path, copy, prepare) -> None:
    """It moves the same, bit for bit; what is stamped is the whole file all the same."""
    folder = copy(planned)
    plan, program = folder / "plan.md", folder / "simulation.py"
    plan.write_text(plan.read_text(encoding="utf-8").replace("mode: cameras", "mode: none"), encoding="utf-8")
    painted = f"    {BEGIN}\n    spec.geoms[-1].rgba = (1, 0, 0, 1)\n    {END}\n    return spec"
    program.write_text(program.read_text(encoding="utf-8").replace("    return spec", painted), encoding="utf-8")
    prepare(folder)
    with pytest.raises(
        GateError, match=r"another world .* no number of its motion differs; seen in its model.xml, line"
    ):
        stamp.accept(str(folder), timeout_s=60)
    assert not (folder / "accepted").exists()
