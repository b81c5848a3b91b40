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
