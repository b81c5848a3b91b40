"""Shaders compiled once: a job that draws finds them, draws the same with them, and can change nobody else's."""

import sys
import zipfile
from io import BytesIO
from pathlib import Path

import pytest

from worldwright.stage import compiled_shaders, sandbox, shader_sampler
from worldwright.stage.confined import Confined, run
from worldwright.stage.one_frame import given_words

pytestmark = [
    pytest.mark.gl,
    pytest.mark.skipif(sandbox.level() not in sandbox.CONFINING, reason="no level confines here"),
]


def laid(home: Path) -> dict[str, bytes]:
    """What a job finds in its home, by name."""
    compiled_shaders.lay(home)
    return {path.relative_to(home).as_posix(): path.read_bytes() for path in home.rglob("*") if path.is_file()}


def test_what_is_laid_there_is_all_that_a_driver_needs_for_the_same_things(tmp_path):
    found = laid(tmp_path)
    script = Path(shader_sampler.__file__)
    call = [sys.executable, "-s", str(script), "{out}"]
    done = run(call, reads=[script], wanted=[shader_sampler.PACKED], wall_s=300.0, home=compiled_shaders.lay)
    again = zipfile.ZipFile(BytesIO(done.files[shader_sampler.PACKED])).namelist()
    assert set(again) == set(found), done.log
    if not any(Path("/dev/dri").glob("render*")):  # a driver for the processor keeps what it compiles
        assert len(found) > 10


def test_a_picture_is_the_same_with_them_and_without(reviewed):
    (physics,) = reviewed.glob("evidence/*/physics")
    call = [sys.executable, "-s", "-m", "worldengine", "still", *given_words(physics), "--out", "{out}"]
    bare = run(call, reads=[physics], wanted=["*.png"], wall_s=300.0, memory_mb=4096)
    kept = {path.name: path.read_bytes() for path in physics.parent.glob("stills/*.png")}
    assert kept and bare.files == kept, bare.log


def test_a_world_of_such_things_has_nothing_compiled_anew(reviewed, tmp_path):
    """Or each job would compile for a second or two what it is to find."""
    (physics,) = reviewed.glob("evidence/*/physics")
    script = tmp_path / "drawing.py"
    script.write_text(
        "import os, pathlib, subprocess, sys\n"
        "subprocess.run([sys.executable, '-s', '-m', 'worldengine', *sys.argv[1:]], check=True)\n"
        "home, out = pathlib.Path(os.environ['HOME']), pathlib.Path(sys.argv[-1])\n"
        "left = [path.relative_to(home).as_posix() for path in home.rglob('*') if path.is_file()]\n"
        "(out / 'left.txt').write_text('\\n'.join(left))\n"
    )
    call = [sys.executable, "-s", str(script), "still", *given_words(physics), "--out", "{out}"]
    reads = [physics, script]
    done = run(call, reads=reads, wanted=["left.txt"], wall_s=300.0, memory_mb=4096, home=compiled_shaders.lay)
    assert done.exit_code == 0, done.log
    if not any(Path("/dev/dri").glob("render*")):  # what a card's driver adds is its own matter
        new = set(done.files["left.txt"].decode().split()) - set(laid(tmp_path / "home"))
        assert not any("mesa_shader_cache" in name for name in new), done.log


def test_what_a_job_writes_in_its_home_goes_with_it(tmp_path):
    before = laid(tmp_path / "before")
    spoil = (
        "import os, pathlib; [p.write_bytes(b'x') for p in pathlib.Path(os.environ['HOME']).rglob('*') if p.is_file()]"
    )
    assert run([sys.executable, "-c", spoil], home=compiled_shaders.lay).exit_code == 0
    assert laid(tmp_path / "after") == before


@pytest.fixture
def cache(tmp_path, monkeypatch):
    """An empty cache, and how often a sampler ran; each leaves what `leaves` says."""
    runs = Runs()
    runs.leaves = Confined("ended", 0, {shader_sampler.PACKED: packed()})
    monkeypatch.setattr(compiled_shaders, "cache_folder", lambda: tmp_path / "cache")
    monkeypatch.setattr(compiled_shaders.confined, "run", lambda *_, **__: runs.append(1) or runs.leaves)
    return runs


class Runs(list[int]):
    leaves: Confined


def packed() -> bytes:
    stream = BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        archive.writestr("mesa_shader_cache/one", "compiled")
    return stream.getvalue()


@pytest.mark.parametrize(
    "left", [Confined("ended", 1), Confined("ended", 1, {"shaders.zip": packed()}), Confined("ended")]
)
def test_what_a_sampler_that_crashed_leaves_is_not_kept(tmp_path, cache, left):
    good, cache.leaves = cache.leaves, left
    compiled_shaders.lay(tmp_path / "first")
    cache.leaves = good
    assert list(laid(tmp_path / "second")) == ["mesa_shader_cache/one"] and len(cache) == 2
    assert laid(tmp_path / "third") and len(cache) == 2


@pytest.mark.parametrize(
    "damaged",
    [b"", b"no archive", packed()[:40], packed().replace(b"compiled", b"modified")],
    ids=["empty", "no archive", "cut off", "changed"],
)
def test_a_damaged_file_is_made_anew_by_the_next_job_and_fails_none(tmp_path, cache, damaged):
    laid(tmp_path / "first")
    (kept,) = (tmp_path / "cache").iterdir()
    kept.write_bytes(damaged)
    compiled_shaders.lay(tmp_path / "second")
    assert list(laid(tmp_path / "third")) == ["mesa_shader_cache/one"] and len(cache) == 2


def left(home: Path, name: str = "mesa_shader_cache/of/mine", data: bytes = b"own") -> Path:
    """A home in which an engine compiled something."""
    path = home / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)
    return home


def given(home: Path, run: Path) -> set[str]:
    compiled_shaders.lay(home, run)
    return {path.relative_to(home).as_posix() for path in home.rglob("*") if path.is_file()}


def test_what_a_run_has_compiled_its_next_pictures_find_and_no_other_s(tmp_path, cache):
    compiled_shaders.lay(tmp_path / "first", tmp_path / "run")
    compiled_shaders.keep(left(tmp_path / "first"), tmp_path / "run")
    assert given(tmp_path / "second", tmp_path / "run") == {"mesa_shader_cache/one", "mesa_shader_cache/of/mine"}
    assert given(tmp_path / "third", tmp_path / "other") == {"mesa_shader_cache/one"}
    assert list(laid(tmp_path / "proof")) == ["mesa_shader_cache/one"], "what is proved is drawn without it"


def test_of_a_home_only_plain_files_are_kept(tmp_path, cache):
    secret = tmp_path / "secret"
    secret.write_text("of the host")
    home = left(tmp_path / "home")
    compiled_shaders.lay(home)
    (home / "mesa_shader_cache/link").symlink_to(secret)
    (home / "mesa_shader_cache/twin").hardlink_to(secret)
    (home / "mesa_shader_cache/folder").symlink_to(tmp_path)
    hosts = left(tmp_path / "host", "secret")
    (home / "mesa_shader_cache_db").symlink_to(hosts)
    left(home, "mesa_shader_cache/odd name")
    left(home, "elsewhere/file")
    compiled_shaders.keep(home, tmp_path / "run")
    assert given(tmp_path / "next", tmp_path / "run") == {"mesa_shader_cache/one", "mesa_shader_cache/of/mine"}


def test_too_much_is_not_kept_and_few_runs_are(tmp_path, cache, monkeypatch):
    monkeypatch.setattr(compiled_shaders, "MOST_BYTES", 10)
    monkeypatch.setattr(compiled_shaders, "MOST_RUNS", 2)
    compiled_shaders.lay(tmp_path / "home")
    compiled_shaders.keep(left(tmp_path / "large", data=b"x" * 11), tmp_path / "run")
    assert not (tmp_path / "cache/shaders-of-runs").exists()
    for number in range(4):
        compiled_shaders.keep(left(tmp_path / "small"), tmp_path / f"run-{number}")
    assert len(list((tmp_path / "cache/shaders-of-runs").iterdir())) == 2


def test_what_is_damaged_of_a_run_is_made_anew(tmp_path, cache):
    compiled_shaders.lay(tmp_path / "home")
    compiled_shaders.keep(left(tmp_path / "one"), tmp_path / "run")
    (kept,) = (tmp_path / "cache/shaders-of-runs").iterdir()
    kept.write_bytes(b"no archive")
    assert given(tmp_path / "next", tmp_path / "run") == {"mesa_shader_cache/one"} and not kept.exists()
    compiled_shaders.keep(left(tmp_path / "again"), tmp_path / "run")
    assert kept.exists()
