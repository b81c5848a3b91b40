"""A mesh file becomes an asset that is found, placed and acts: confined, whole or not at all."""

import errno
import json
import re
from pathlib import Path

import numpy as np
import pytest
import trimesh

from worldkit import assets
from worldwright.adding_assets import add_asset
from worldwright.intake import registering, substances, taking_in
from worldwright.model.errors import NotFoundError, WorldwrightError
from worldwright.model.storage import StorageError

PROFILE = [(0, 0), (50, 0), (80, 50), (80, 60), (72, 60), (45, 10), (0, 10)]
"""Of a bowl in mm: (radius, height), from the middle of its bottom around to that of its inside."""


def bowl(sections: int = 16) -> trimesh.Trimesh:
    """A thick-walled bowl 160 mm wide and 60 mm high, its floor 10 mm up."""
    return trimesh.creation.revolve(np.array(PROFILE, float), sections=sections)


@pytest.fixture(scope="module")
def own(tmp_path_factory: pytest.TempPathFactory):
    """The user's own folder with a bowl that was taken in, and what was told of it."""
    patch = pytest.MonkeyPatch()
    folder = tmp_path_factory.mktemp("own")
    patch.setenv("WORLDWRIGHT_ASSETS", str(folder))
    file = tmp_path_factory.mktemp("given") / "Soup Bowl.stl"
    bowl().export(file)
    yield (
        folder,
        add_asset(
            file, units="mm", material="ceramic", licence="CC0-1.0", creator="somebody", description="A deep soup bowl"
        ),
    )
    patch.undo()


def test_a_bowl_keeps_its_cavity_and_says_what_was_done(own) -> None:
    folder, answer = own
    told = answer.data
    assert told.key == "soup_bowl" and told.ok and told.holds is True
    assert told.extents_m == pytest.approx((0.16, 0.16, 0.06), abs=1e-3)
    volume = bowl().volume * 1e-9
    assert told.mass_kg == pytest.approx(2400 * volume, rel=1e-3)
    assert re.match(r"\d+ hulls by CoACD", told.collides_as) and "corners became" in " ".join(told.mended)
    assert "licence: CC0-1.0, by somebody" in told.text() and "filename: soup_bowl" in told.text()
    assert answer.pictures[0].data[:8] == b"\x89PNG\r\n\x1a\n"
    assert sorted(path.name for path in folder.iterdir()) == ["soup_bowl"], "nothing half written is left"
    assert (folder / "soup_bowl" / "thumbnail.png").is_file()
    inside = assets.find("soup_bowl").support("inside", height=0.06)
    assert inside.z == pytest.approx(0.01, abs=2e-3)


def test_what_a_gltf_names_goes_with_it(tmp_path: Path) -> None:
    for name in ("chair.gltf", "chair.bin", "textures/oak.png", "notes.txt"):
        (tmp_path / "from" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "from" / name).write_bytes(b"x")
    assert taking_in._lay(tmp_path / "from" / "chair.gltf", tmp_path / "given") == []
    laid = {path.relative_to(tmp_path / "given").as_posix() for path in (tmp_path / "given").rglob("*.*")}
    assert laid == {"chair.gltf", "chair.bin", "textures/oak.png"}


def test_it_is_found_and_shown_like_any_other(own) -> None:
    from click.testing import CliRunner

    from worldwright.intake.command import command
    from worldwright.retrieve.tools import find_asset

    hit = find_asset("soup bowl").assets[0]
    assert (hit.key, hit.source, hit.licence, hit.creator) == ("soup_bowl", "own_folder", "CC0-1.0", "somebody")
    assert Path(hit.thumbnail).is_file()
    listed = CliRunner().invoke(command, ["list", "--source", "own_folder"])
    assert listed.exit_code == 0 and listed.output.startswith("soup_bowl") and "mug" not in listed.output
    shown = CliRunner().invoke(command, ["show", "soup_bowl"])
    assert "rests on: top, inside" in shown.output and "by somebody" in shown.output
    missing = CliRunner().invoke(command, ["show", "soup_bowel"])
    assert missing.exit_code == 2 and "did you mean soup_bowl" in missing.output


def test_a_key_that_is_taken_is_refused_before_anything_is_read(own, tmp_path: Path) -> None:
    folder, _ = own
    (tmp_path / "mug.stl").write_bytes(b"no mesh at all")
    for key, place in (("soup_bowl", str(folder / "soup_bowl")), ("mug", "another source")):
        with pytest.raises(registering.RegisterError, match=f"an asset {key} already") as told:
            add_asset(tmp_path / "mug.stl", key=key, units="mm")
        assert told.value.place == place and "--key" in told.value.next_move


@pytest.mark.parametrize(
    ("name", "content", "words", "code"),
    [
        ("noise.glb", bytes(range(256)) * 4, {}, "no_mesh"),
        ("odd.off", b"OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 9\n3 1 2 3\n3 0 3 2\n", {}, "unreadable"),
    ],
)
def test_a_file_that_is_no_mesh_leaves_nothing(
    own, tmp_path: Path, name: str, content: bytes, words: dict, code: str
) -> None:
    folder, _ = own
    (tmp_path / name).write_bytes(content)
    with pytest.raises(taking_in.IntakeFailedError) as told:
        add_asset(tmp_path / name, key="thing", height=1.0, **words)
    assert told.value.code == code and told.value.place.startswith(name) and told.value.next_move
    assert sorted(path.name for path in folder.iterdir()) == ["soup_bowl"]


@pytest.mark.parametrize(
    ("limit", "value", "code"), [("MEMORY_MB", 20, "out_of_memory"), ("LEAST_S", 0.0, "timed_out")]
)
def test_an_intake_that_takes_too_much_is_ended(
    own, tmp_path: Path, monkeypatch, limit: str, value: float, code: str
) -> None:
    folder, _ = own
    monkeypatch.setattr(taking_in, limit, value)
    bowl(32).export(tmp_path / "large.stl")
    with pytest.raises(taking_in.IntakeFailedError) as told:
        add_asset(tmp_path / "large.stl", key="large", units="mm")
    assert told.value.code == code and told.value.next_move
    assert sorted(path.name for path in folder.iterdir()) == ["soup_bowl"]


@pytest.mark.parametrize(
    ("words", "error", "said"),
    [
        ({"material": "unobtainium"}, NotFoundError, "wood"),
        ({"key": "Not A Key"}, taking_in.IntakeFailedError, "garden_chair"),
        ({"height": -1.0}, taking_in.IntakeFailedError, "positive"),
        ({"units": "yd"}, taking_in.IntakeFailedError, "mm"),
    ],
)
def test_what_is_asked_wrongly_is_said(
    own, tmp_path: Path, words: dict, error: type[WorldwrightError], said: str
) -> None:
    bowl().export(tmp_path / "thing.stl")
    with pytest.raises(error) as told:
        add_asset(tmp_path / "thing.stl", **words)
    assert said in told.value.next_move
    with pytest.raises(NotFoundError, match="no file"):
        add_asset(tmp_path / "nothing.stl")


def files(own) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in (own[0] / "soup_bowl").iterdir()}


@pytest.mark.parametrize("number", [0, 3, 7])
def test_a_full_disk_leaves_nothing_half_registered(own, tmp_path: Path, monkeypatch, number: int) -> None:
    written = iter(range(100))
    real = registering.write_atomic

    def full(path, content):
        if next(written) == number:
            raise OSError(errno.ENOSPC, "No space left on device", str(path))
        real(path, content)

    monkeypatch.setattr(registering, "write_atomic", full)
    with pytest.raises(StorageError):
        registering.register("second", {"asset.yaml": files(own)["asset.yaml"], **files(own)}, tmp_path / "there")
    assert not (tmp_path / "there").exists() or list((tmp_path / "there").iterdir()) == []


def test_what_is_no_asset_is_not_registered_and_what_was_there_stays(own, tmp_path: Path, monkeypatch) -> None:
    good = {name: data.replace(b"key: soup_bowl", b"key: second") for name, data in files(own).items()}
    placed = registering.register("second", good, tmp_path)
    before = (placed / "asset.yaml").read_bytes()
    with pytest.raises(registering.RegisterError, match="no asset"):
        registering.register("second", {"asset.yaml": b"key: second\n"}, tmp_path, replace=True)
    with pytest.raises(registering.RegisterError, match="already"):
        registering.register("second", good, tmp_path)
    real = Path.rename

    def fails(self, target):
        if Path(target) == tmp_path / "second" and "earlier" not in self.name:
            raise OSError(errno.EACCES, "no")
        return real(self, target)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "rename", fails)
        with pytest.raises(StorageError):
            registering.register("second", good, tmp_path, replace=True)
    assert [path.name for path in tmp_path.iterdir()] == ["second"] and (placed / "asset.yaml").read_bytes() == before
    registering.register("second", {**good, "asset.yaml": before + b"# again\n"}, tmp_path, replace=True)
    assert (placed / "asset.yaml").read_bytes().endswith(b"# again\n")


def test_replacing_deletes_no_folder_that_is_no_asset(tmp_path: Path) -> None:
    (tmp_path / "notes").mkdir()
    (tmp_path / "notes" / "kept.txt").write_text("kept")
    with pytest.raises(registering.RegisterError, match="which is no asset") as told:
        registering.free("notes", tmp_path, True)
    assert "--key" in told.value.next_move and told.value.place == str(tmp_path / "notes")
    for key in ("make", "meshes"):
        with pytest.raises(registering.RegisterError, match="no asset's"):
            registering.free(key, tmp_path, True)


def test_an_interruption_or_an_add_beside_it_loses_no_asset(own, tmp_path: Path, monkeypatch) -> None:
    good = {name: data.replace(b"key: soup_bowl", b"key: second") for name, data in files(own).items()}
    registering.register("second", good, tmp_path)
    real, free = Path.rename, registering.free

    def interrupted(self, target):
        if Path(target) == tmp_path / "second" and "earlier" not in self.name:
            raise KeyboardInterrupt
        return real(self, target)

    with monkeypatch.context() as patch:
        patch.setattr(Path, "rename", interrupted)
        with pytest.raises(KeyboardInterrupt):
            registering.register("second", good, tmp_path, replace=True)
    assert [path.name for path in tmp_path.iterdir()] == ["second"] and len(list((tmp_path / "second").iterdir())) > 2

    asked = iter((False, True))

    def late(key, root, replace):  # the other add comes in between the question and the renaming
        return free(key, root, replace) if next(asked) else None

    monkeypatch.setattr(registering, "free", late)
    before = (tmp_path / "second" / "asset.yaml").stat().st_ino
    with pytest.raises(registering.RegisterError, match="already"):
        registering.register("second", good, tmp_path)
    assert (tmp_path / "second" / "asset.yaml").stat().st_ino == before


def test_a_mass_without_a_material_says_whose_friction_it_takes(tmp_path: Path) -> None:
    told = taking_in._request(tmp_path / "thing.stl", {"mass": 2.0, "licence": "CC0-1.0"})["assumed"]
    assert len(told) == 1 and substances.UNSTATED in told[0] and "--material" in told[0]
    assert (
        taking_in._request(tmp_path / "thing.stl", {"mass": 2.0, "material": "oak", "licence": "CC0-1.0"})["assumed"]
        == []
    )


def test_what_lies_beside_is_copied_meshes_first_no_link_followed_and_the_rest_said(
    tmp_path: Path, monkeypatch
) -> None:
    monkeypatch.setattr(taking_in, "MOST_BESIDE", 2)
    folder, elsewhere = tmp_path / "here", tmp_path / "elsewhere"
    folder.mkdir()
    elsewhere.mkdir()
    for path in (folder / "a.obj", folder / "z.mtl", folder / "a.png", folder / "b.png", elsewhere / "secret.png"):
        path.write_text("v 0 0 0")
    (folder / "linked").symlink_to(elsewhere)
    said = taking_in._lay(folder / "a.obj", tmp_path / "given")
    assert sorted(path.name for path in (tmp_path / "given").rglob("*")) == ["a.obj", "a.png", "z.mtl"]
    assert len(said) == 1 and said[0].startswith("1 files beside it were left out, such as b.png")


def test_every_substance_can_be_one_and_says_who_says_so() -> None:
    for row in substances.table().values():
        assert (
            10 < row["density"] < 22_590
            and 0 < row["friction"] < 1.5
            and 0 <= row["restitution"] <= 1
            and row["source"]
        )
    assert substances.UNSTATED in substances.table()
    json.dumps(substances.named("Steel"))


PLAN = (Path(__file__).parents[1] / "world" / "sculpted_plan.md").read_text(encoding="utf-8")


def test_a_plan_names_it_and_a_pea_rests_in_it_by_contact(own, tmp_path: Path) -> None:
    from worldwright.lint import tools as lint
    from worldwright.model.evidence.run import Run
    from worldwright.scan import tools as scan
    from worldwright.stage import tools as stage
    from worldwright.stamp import tools as stamp

    run = Run(tmp_path / "pea")
    run.folder.mkdir()
    row = '- {name: bowl, type: sculpt, filename: "sculpt/bowl.py:POT", size: [0.2, 0.2, 0.09], material: clay}'
    assert row in PLAN
    plan = PLAN.replace(row, "- {name: bowl, filename: soup_bowl}")
    plan = plan.replace("## asset_dimensions\n", "## asset_dimensions\n\n```yaml\n- bowl: 0.06\n```\n")
    plan = plan.replace("simulation_duration: 0.6", "simulation_duration: 1.5")
    plan = plan.replace("touches: {bodies: [pea, bowl]}", "supported_by: {body: pea, support: bowl}")
    run.plan.write_text(plan)
    stamp.approve(str(run.folder), by="tester")
    assert stage.draft(str(run.folder)).open_places == ()
    assert 'assets.add(spec, "soup_bowl", name="bowl"' in run.program.read_text()
    report = lint.check_program([run.program])
    assert not [f for f in report.findings if f.severity == "error"], report.text()
    job = stage.start(str(run.folder), stage="physics")
    while not job.ended:
        job = stage.wait(str(run.folder), job=job.job, timeout_s=30)
    assert job.state == "succeeded", job.text()
    measured = scan.expect(str(run.folder))
    assert measured.ok, measured.text()
