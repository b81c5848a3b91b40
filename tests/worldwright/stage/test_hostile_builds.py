"""A `build()` that loops, forks, lies or floods ends in a typed error, and leaves no process, no file and no evidence."""

import json
import re
from pathlib import Path

import pytest

from worldwright.stage import family
from worldwright.stage.job import Job

PROGRAM = """
import os, sys, time, zipfile
from pathlib import Path

import mujoco
from worldkit import program

OUT = Path(sys.argv[sys.argv.index("--out") + 1])


def build():
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="ball")
    ball.add_freejoint()
    ball.add_geom(size=(0.1, 0, 0))
{build}
    return spec


program.main(build, duration=0.02, movers=("ball",))
{after}
"""
HUGE = """
for name in ("one.obj", "two.obj"):
    with open(OUT / name, "wb") as file:
        file.truncate(1100 << 20)
    spec.add_mesh(name=name, file=str(OUT / name))
"""
"""Sparse files: 2.2 GB that take no room."""
FORKS = """
for _ in range(3):
    if os.fork() == 0:
        os.setsid()
        time.sleep(60)
        os._exit(0)
return None
"""
REPLACED = """
text = {text!r}
with zipfile.ZipFile(OUT / "world.mjz", "w", zipfile.ZIP_DEFLATED) as archive:
    archive.writestr("model.xml", text)
    archive.filelist[0].file_size = max(len(text), {claims})
"""
COPIES = "<replicate count='100000'><replicate count='100000'><geom size='.1'/></replicate></replicate>"
BALL = "<mujoco>{}<worldbody><body name='ball'><geom size='.1'/></body></worldbody></mujoco>"


def rewritten(text: str, claims: int = 0) -> str:
    """Lines that put another archive, whose text claims to unpack to so many bytes, in the place of the one that was built."""
    return REPLACED.format(text=text, claims=claims)


TRUNCATED = "data = (OUT / 'world.mjz').read_bytes()\n(OUT / 'world.mjz').write_bytes(data[: len(data) // 2])"
HOSTILE = {
    "loops": ("while True: pass", "", "timed_out", "", {"still_s": 1.0}),
    "loops in the engine": ("spec.option.timestep = 1e-12", "", "program", "steps", {}),
    "returns nothing": ("return", "", "program", r"returned NoneType, not a world \(end it with `return spec`\)", {}),
    "returns a text": ("return 'spec'", "", "program", "returned str, not a world", {}),
    "returns a compiled model": ("return spec.compile()", "", "program", "returned a compiled model", {}),
    "forks and goes": (FORKS, "", "program", "returned NoneType", {}),
    "writes beside the run": (
        "Path({outside!r}).write_text('x')",
        "",
        "crashed",
        "Read-only|Permission|No such file",
        {},
    ),
    "writes a gigabyte": ("(OUT / 'big').write_bytes(bytes(8 << 20))", "", "file_too_large", "", {"file_mb": 4}),
    "holds nan": ("spec.option.gravity = (0, 0, float('nan'))", "", "program", r"opt\.gravity|written as one file", {}),
    "has 2 GB of meshes": (HUGE, "", "program", r"take 2200 MB, .* at most 1024 MB", {}),
    "leaves a truncated archive": ("", TRUNCATED, "program", "no archive of a world", {}),
    "leaves a bomb": ("", rewritten(BALL.format(""), 2 << 30), "program", "larger than 1024 MB", {}),
    "leaves one that reaches outside": (
        "",
        rewritten(BALL.format("<include file='/etc/hostname'/>")),
        "program",
        "`include` in line 1 of model.xml",
        {},
    ),
    "leaves copies without end": (
        "",
        rewritten(f"<mujoco><worldbody>{COPIES}</worldbody></mujoco>"),
        "timed_out|out_of_memory",
        "",
        {"still_s": 2.0, "memory_mb": 600},
    ),
    "leaves a camera at nan": (
        "",
        rewritten("<mujoco><worldbody><camera name='eye' pos='nan 0 0'/><body name='ball'/></worldbody></mujoco>"),
        "program",
        "cam_pos of eye",
        {},
    ),
    "leaves a world without its mover": ("", rewritten("<mujoco/>"), "program", "movers names ball", {}),
    "leaves no world": ("", "(OUT / 'world.mjz').unlink()", "no_result", "left no world.mjz", {}),
}


def source(build: str, after: str, outside: Path) -> str:
    inside = build.replace("{outside!r}", repr(str(outside)))
    return PROGRAM.format(build="\n".join(f"    {line}" for line in inside.splitlines()), after=after)


@pytest.mark.parametrize("name", HOSTILE)
def test_it_is_refused_by_name_and_leaves_nothing(name, make, finish, evidence, tmp_path):
    build, after, code, said, options = HOSTILE[name]
    outside = tmp_path / "outside.txt"
    run = make(source(build, after, outside))
    job = finish(run, stage="bundle", **options)
    assert job.state == "failed" and job.code in code.split("|"), job.text()
    assert re.search(said, job.message), job.text()
    assert job.next_move
    assert not (evidence(run) / "bundle").exists()
    folder = Job(run.jobs / job.job)
    assert family.bearing(folder.spec.token) == []
    assert not folder.author.exists() and not folder.scratch.exists()
    assert not outside.exists()
    assert {path.name for path in tmp_path.iterdir()} <= {run.folder.name}
    left = sum(path.stat().st_size for path in folder.folder.rglob("*") if path.is_file())
    assert left < 2 << 20, [str(path) for path in folder.folder.rglob("*")]


def test_what_it_leaves_beside_its_world_is_thrown_away(make, finish, evidence):
    more = "(OUT / 'more.txt').write_text('x'); (OUT / 'layout.json').write_text('{}')"
    run = make(source("", more, Path("nowhere")))
    job = finish(run, stage="bundle")
    assert job.state == "succeeded", job.text()
    kept = {path.name for path in (evidence(run) / "bundle").iterdir()}
    assert kept == {
        "world.mjz", "program.json", "inputs.json", "layout.json", "environment.json", "log.txt", "result.json",
    }  # fmt: skip
    layout = json.loads((evidence(run) / "bundle" / "layout.json").read_text())
    assert layout["bodies"]["ball"]["parent"] == "world" and len(layout["model_sha256"]) == 64
    assert not (run.jobs / job.job / "author").exists()
