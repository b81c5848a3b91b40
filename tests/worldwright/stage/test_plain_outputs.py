"""A program cannot reach a file of the host by what it leaves in its folder: links are not followed, in or out."""

import json

import pytest

from worldwright.stage import plain

BUILT = """
import os, sys
from pathlib import Path
import mujoco
from worldkit import program

OUT = Path(sys.argv[sys.argv.index("--out") + 1])

def build():
    spec = mujoco.MjSpec()
    spec.worldbody.add_body(name="ball").add_geom(size=(0.1, 0, 0))
    return spec

program.main(build, duration=0.02)
"""


@pytest.fixture
def victim(tmp_path):
    """A file of the host that a program may name, and must neither change nor publish."""
    path = tmp_path / "precious"
    path.write_text("precious")
    return path


@pytest.mark.parametrize("name", ["log.txt", "result.json", "environment.json", "inputs.json", ".progress.json"])
def test_a_link_called_like_a_file_of_ours_overwrites_nothing(name, make, finish, victim, evidence):
    link = f"(OUT / {name!r}).unlink(missing_ok=True)\n(OUT / {name!r}).symlink_to({str(victim)!r})\n"
    kept = link if name != "result.json" else "Path('kept').symlink_to('result.json')\n"
    job = finish(make(BUILT + kept))
    assert job.state == "succeeded", job.text()
    assert victim.read_text() == "precious"


@pytest.mark.parametrize("name", ["world.mjz", "program.json"])
@pytest.mark.parametrize("kind", ["symlink_to", "hardlink_to"])
def test_a_link_in_place_of_the_world_publishes_nothing(name, kind, make, finish, victim, monkeypatch, evidence):
    from worldwright.stage import sandbox

    monkeypatch.setenv("WORLDWRIGHT_SANDBOX", "rlimits")  # where nothing but the reader stands in the way
    sandbox.level.cache_clear()
    run = make(BUILT + f"(OUT / {name!r}).unlink()\n(OUT / {name!r}).{kind}({str(victim)!r})\n")
    job = finish(run)
    sandbox.level.cache_clear()
    assert (job.state, job.code) == ("failed", "no_result"), job.text()
    held = [p for p in run.folder.rglob("*") if p.is_file() and not p.is_symlink() and "author" not in p.parts]
    assert not [path for path in held if b"precious" in path.read_bytes() and path.name != "simulation.py"]


def test_only_plain_files_of_one_name_are_read(tmp_path, victim):
    (tmp_path / "link").symlink_to(victim)
    (tmp_path / "second").hardlink_to(victim)
    (tmp_path / "folder").mkdir()
    fifo = tmp_path / "folder" / "pipe"
    import os

    os.mkfifo(fifo)
    assert plain.read(victim, 100) is None  # it has two names now
    assert plain.read(tmp_path / "link", 100) is None and plain.read(fifo, 100) is None
    assert sorted(plain.odd(tmp_path)) == ["folder/pipe", "link", "precious", "second"]
    (tmp_path / "second").unlink()
    assert plain.read(victim, 100) == b"precious" and plain.read(victim, 7) is None
    assert plain.read_json(victim) == {}
    (tmp_path / "deep").write_text("[" * 100_000)
    assert plain.read_json(tmp_path / "deep") == {}
    (tmp_path / "good").write_text(json.dumps({"ok": True}))
    assert plain.read_json(tmp_path / "good") == {"ok": True}


def test_a_report_that_is_too_long_is_not_parsed():
    fits = b'{"ok": true}' + b" " * (plain.MOST_JSON - 12)
    assert plain.as_object(fits) == {"ok": True} and plain.as_object(fits + b" ") == {}
    assert plain.as_object(b"[1]") == plain.as_object(b"{") == plain.as_object(b"[" * 100_000) == {}


def test_the_author_sees_neither_the_evidence_nor_the_engines_folder(level, make, finish):
    run = make(
        BUILT
        + """
for place in (OUT.parents[1] / "out" / "planted", OUT.parents[3] / "evidence" / "planted"):
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text("x")
        print("PLANTED")
    except OSError:
        print("refused")
"""
    )
    job = finish(run)
    assert job.state == "succeeded", job.text()
    if level != "rlimits":
        assert not list(run.folder.rglob("planted"))


def test_modules_and_data_beside_the_program_are_there_in_the_sandbox(level, make, finish, evidence):
    source = BUILT.replace("import mujoco\n", "import mujoco\nfrom helper import NAME\n").replace('"ball"', "NAME")
    run = make(source)
    (run.folder / "helper.py").write_text(
        "from pathlib import Path\nNAME = Path(__file__).with_name('n.txt').read_text()\n"
    )
    (run.folder / "n.txt").write_text("marble")
    run = make(source)  # linted again, with what belongs to it
    job = finish(run)
    assert job.state == "succeeded", job.text()
    meta = json.loads((evidence(run) / "physics/trajectory/meta.json").read_text())
    assert [body["name"] for body in meta["bodies"]] == ["marble"]
    assert (evidence(run) / "source" / "helper.py").is_file()
