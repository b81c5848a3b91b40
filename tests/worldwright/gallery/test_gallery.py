"""Keeping an accepted run in its small form, and making again what was left out."""

import hashlib
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright.cli import main
from worldwright.gallery import making, pages, worlds
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stamp import bundle, poster, small_form, verification
from worldwright.stamp import tools as stamp
from worldwright.stamp.verification import static

Copy = Callable[[Path], Path]


@pytest.fixture(scope="module")
def small(accepted: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The small form of the accepted world, in an `examples/` of its own."""
    target = tmp_path_factory.mktemp("checkout") / "examples" / accepted.name
    small_form.write(Run(accepted), target)
    return target


def checks(folder: Path) -> dict[str, str]:
    """What does not hold of a small form, without running it."""
    return {c.name: c.detail for c in static(Run(folder), folder) if not c.ok}


def test_the_small_form_is_what_a_person_reads(small: Path, accepted: Path) -> None:
    names = {path.name for path in small.iterdir()}
    assert names - {"stamp.dsse.json", "stamp.pub"} == {
        "prompt.md", "plan.md", "simulation.py", "journal.jsonl", "motion.json", "poster.webp", "stamp.json", "SHA256SUMS",
        "world.mjz", "world",
    }  # fmt: skip
    assert {path.name for path in (small / "world").iterdir()} == {"program.json", "inputs.json"}
    assert sum(path.stat().st_size for path in small.iterdir() if path.name != "world.mjz") < 120_000
    assert (small / "stamp.json").read_bytes() == (accepted / "accepted" / "stamp.json").read_bytes()
    sums = ["sha256sum", "--check", "--quiet", "SHA256SUMS"]
    assert subprocess.run(sums, cwd=small, capture_output=True, check=False).returncode == 0


def test_the_poster_is_small_and_shows_something(small: Path) -> None:
    import cv2

    path = small / poster.NAME
    image = cv2.imread(str(path))
    assert path.stat().st_size <= poster.BYTES
    assert image.shape[1] == poster.WIDTH
    assert image.std() > 3


def never_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a verification fail that would run the program."""
    monkeypatch.setattr(verification, "prove", lambda *_, **__: pytest.fail("the program was run"))


def test_a_world_is_proved_again_from_its_small_form_and_no_program_runs(
    small: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    never_runs(monkeypatch)
    before = {name: sha256_file(small / name) for name in bundle.files_in(small)}
    result = stamp.verify(str(small), timeout_s=60)
    assert (result.state, result.mode) == ("proved", "bitwise"), result.text()
    assert "left out of the small form" in result.text() and "without its program" in result.text()
    assert {name: sha256_file(small / name) for name in bundle.files_in(small)} == before
    assert stamp.status(str(small)).state == "accepted"
    assert stamp.accept(str(small)).already


def test_a_large_world_is_left_out_and_built_again(
    accepted: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As in the small forms of before, in which no world is kept."""
    monkeypatch.setattr(small_form, "WORLD_BYTES", 1000)
    folder = tmp_path / "examples" / "ball"
    small_form.write(Run(accepted), folder)
    assert not (folder / "world.mjz").exists() and not (folder / "world").exists()
    result = stamp.verify(str(folder), timeout_s=60)
    assert (result.state, result.mode) == ("proved", "bitwise"), result.text()
    assert "built again by the stamped program: the same, sha256" in result.text()


def test_rebuilt_from_the_small_form_it_is_the_same_content(small: Path) -> None:
    result = stamp.verify(str(small), timeout_s=60, rebuild=True)
    assert result.state == "proved", result.text()
    assert "built again by the stamped program: the same content" in result.text()


@pytest.mark.parametrize("name", ["plan.md", "prompt.md", "simulation.py", "motion.json", "poster.webp", "SHA256SUMS"])
def test_a_small_form_that_was_changed_or_lost_a_file_is_not_as_stamped(small: Path, copy: Copy, name: str) -> None:
    folder = copy(small)
    path = folder / name
    path.write_bytes(path.read_bytes() + b"\n")
    assert name in checks(folder)["checksums"]
    path.unlink()
    assert "cannot be read" in checks(folder)["checksums"]


def test_what_was_left_out_must_be_as_stamped_where_it_is_there(small: Path, accepted: Path, copy: Copy) -> None:
    folder = copy(small)
    assert checks(folder) == {}
    (folder / "trajectory.npz").write_bytes((accepted / "accepted" / "trajectory.npz").read_bytes())
    assert "trajectory.npz was changed" not in str(checks(folder))
    for name in ("trajectory.npz", "world.mjz"):
        (folder / name).write_bytes(b"another")
        assert f"{name} was changed" in checks(folder)["checksums"]


def test_a_file_that_nobody_stamped_is_named_and_a_build_beside_is_not(small: Path, copy: Copy) -> None:
    folder = copy(small)
    (folder / "evidence" / "0123456789ab").mkdir(parents=True)
    (folder / "evidence" / "0123456789ab" / "anything.json").write_text("{}")
    (folder / "report.html").write_text("<p>")
    assert checks(folder) == {}
    (folder / "evidence" / "robust.json").write_text("{}")
    assert "evidence/robust.json is not in the stamp" in checks(folder)["checksums"]
    (folder / "evidence" / "robust.json").unlink()
    (folder / "numpy.py").write_text("raise SystemExit")
    assert "numpy.py is not in the stamp" in checks(folder)["checksums"]


def test_only_an_accepted_and_whole_run_is_kept(reviewed: Path, accepted: Path, copy: Copy, tmp_path: Path) -> None:
    with pytest.raises(NotFoundError, match="not accepted"):
        small_form.write(Run(reviewed), tmp_path / "examples" / "ball")
    folder = copy(accepted)
    (folder / "accepted" / "plan.md").write_text("another plan")
    with pytest.raises(GateError, match="not as it was stamped"):
        small_form.write(Run(folder), tmp_path / "examples" / "ball")
    assert not (tmp_path / "examples" / "ball").exists()


def test_keeping_again_replaces_the_older_small_form(accepted: Path, tmp_path: Path) -> None:
    target = tmp_path / "examples" / "ball"
    small_form.write(Run(accepted), target)
    (target / "leftover.txt").write_text("of before")
    small_form.write(Run(accepted), target)
    assert not (target / "leftover.txt").exists()
    assert [path.name for path in target.parent.iterdir()] == ["ball"]


def test_the_gallery_builds_what_was_left_out_and_does_nothing_twice(
    small: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(small.parents[1])
    (slug,) = worlds.slugs()
    made = making.one("build", slug)
    assert made.ok, made.detail
    built = worlds.BUILT / slug
    films = sorted(built.glob("evidence/*/video/*.mp4"))
    assert films and (built / "report.html").is_file()
    assert "Accepted" in (built / "report.html").read_text()
    before = {path: path.stat().st_mtime_ns for path in films}
    again = making.one("build", slug)
    assert again.ok and again.seconds < made.seconds
    assert {path: path.stat().st_mtime_ns for path in films} == before
    page = pages.write_index([slug]).read_text()
    assert films[0].name in page or any(film.name in page for film in films)
    assert "The ball falls to the floor." in page


def test_a_build_begins_without_what_another_one_left_beside_the_small_form(
    small: Path, copy: Copy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "examples").mkdir()
    folder = copy(small).rename(tmp_path / "examples" / "ball")
    monkeypatch.chdir(tmp_path)
    kept = {*bundle.files_in(folder), "parts/jobs/leg.stl"}
    for name in ("parts/jobs/leg.stl", "earlier/abc/plan.md", "evidence/key.json", "report.html", "scene.glb", "out/a"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("left by a build, or a part of the world")
    assert {*bundle.files_in(worlds.seeded("ball").folder)} == kept


def test_a_world_that_is_not_as_stamped_fails_the_gallery(
    small: Path, copy: Copy, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "examples").mkdir()
    folder = copy(small).rename(tmp_path / "examples" / "ball")
    monkeypatch.chdir(tmp_path)
    (folder / "plan.md").write_bytes((folder / "plan.md").read_bytes() + b"\n")
    done = CliRunner().invoke(main, ["gallery", "prove", "ball", "--jobs", "1"])
    assert done.exit_code == 1
    assert "FAIL ball" in done.output and "plan.md was changed" in done.output
    unknown = CliRunner().invoke(main, ["gallery", "prove", "cube"])
    assert unknown.exit_code == 2
    assert "name some of: ball" in unknown.output


def test_accepting_anew_keeps_the_program_unless_it_is_to_be_drafted_again(
    small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    source = tmp_path / "examples" / "ball"
    small_form.write(Run(small), source)
    program = source / "simulation.py"
    drafted = program.read_bytes()
    Run(source).log("build", "draft", program_sha256=sha256_file(program))
    assert not worlds.restarted("ball", redraft=True).program.exists()
    assert worlds.restarted("ball").program.read_bytes() == drafted
    program.write_bytes(older := drafted.replace(b"import", b"#\nimport", 1))  # by older code, which folded otherwise
    Run(source).log("build", "draft", program_sha256=sha256_file(program))
    worlds.restarted("ball").log("build", "draft", program_sha256=hashlib.sha256(drafted).hexdigest())
    assert worlds.restarted("ball").program.read_bytes() == older
    assert worlds.restarted("ball", redraft=True).program.exists()  # a draft that is there is gone on with


def test_accepting_anew_keeps_the_small_form(small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    small_form.write(Run(small), tmp_path / "examples" / "ball")
    program = (small / "simulation.py").read_bytes()
    (tmp_path / "README.md").write_text(f"# Worlds\n{pages.BEGIN}\n{pages.END}\n")
    stamped = (tmp_path / "examples/ball/stamp.json").read_bytes()
    made = making.one("accept", "ball")
    assert made.ok, made.detail
    kept = tmp_path / "examples" / "ball"
    assert bundle.is_small(kept) and (kept / "stamp.json").read_bytes() != stamped
    assert (kept / "simulation.py").read_bytes() == program
    assert stamp.verify(str(kept), timeout_s=60).ok
    assert pages.write_table()
    assert 'src="examples/ball/poster.webp"' in (tmp_path / "README.md").read_text()
    assert not pages.write_table()


def test_the_readme_shows_the_posters_that_there_are() -> None:
    root = Path(__file__).parents[3]
    text = (root / "README.md").read_text(encoding="utf-8")
    between = text.split(pages.BEGIN)[1].split(pages.END)[0].strip()
    assert between == pages.table(root), "`worldwright gallery keep` or `accept` writes it"
