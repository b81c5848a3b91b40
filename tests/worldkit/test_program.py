"""The command line that every generated program has."""

import json
import os
import subprocess
import sys
import textwrap
from pathlib import Path

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor
from worldengine.recording import stored
from worldkit import program, world
from worldkit.errors import ProgramError

SERVERS = Path(__file__).parents[2] / "servers"


def build():
    spec = empty()
    floor(spec)
    ball(spec, "ball", (0, 0, 0.3))
    spec.worldbody.add_camera(name="overview", pos=(0, -2, 0.5), xyaxes=(1, 0, 0, 0, 0.2, 1))
    return spec


def run(out, *more, world=build, control=None, **settings):
    settings = {"duration": 0.2, **settings}
    return program.main(world, control, argv=["--pass", "physics", "--out", str(out), *more], **settings)


def error(out):
    return json.loads((out / "error.json").read_text())


def test_the_physics_pass_leaves_a_recording_a_summary_and_its_progress(tmp_path):
    assert run(tmp_path, movers=("ball",), seed=7) == 0
    result = json.loads((tmp_path / "result.json").read_text())
    recording = stored.open(tmp_path / "trajectory")
    assert result["ok"] is True
    assert (result["steps"], result["rows"], result["bodies"]) == (200, 201, 1)
    assert result["trajectory_sha256"] == recording.sha256 == stored.digest(recording)
    assert result["final_time"] == pytest.approx(0.2)
    assert result["interventions"] == {} and result["warnings"] == {}
    assert result["proof"].startswith("none: run by hand")
    assert recording.meta["seed"] == 7 and recording.meta["movers"] == ["ball"]
    assert json.loads((tmp_path / "progress.json").read_text()) == {"done": 200, "total": 200, "unit": "steps"}
    assert not (tmp_path / "error.json").exists()


def test_build_and_control_may_draw_seeded_numbers(tmp_path):
    def random_build(rng):
        spec = empty()
        ball(spec, "ball", rng.uniform(-1, 1, 3))
        return spec

    def control(model, data, rng):
        data.xfrc_applied[1, :3] = rng.normal(size=3) + np.random.normal(size=3)  # noqa: NPY002 - the global one is seeded too

    def digest(name, seed):
        assert run(tmp_path / name, "--seed", str(seed), world=random_build, control=control) == 0
        return json.loads((tmp_path / name / "result.json").read_text())["trajectory_sha256"]

    assert digest("a", 1) == digest("b", 1) != digest("c", 2)
    assert json.loads((tmp_path / "a" / "result.json").read_text())["interventions"] == {"force": 200}


def test_a_duration_on_the_command_line_wins(tmp_path):
    assert run(tmp_path, "--duration", "0.05") == 0
    assert len(stored.open(tmp_path / "trajectory")) == 51


def test_a_compiled_model_is_refused_with_the_line_and_the_next_move(tmp_path):
    def compiled():
        spec = build()
        model = spec.compile()
        model.opt.timestep = 0.01
        return model

    assert run(tmp_path, world=compiled) == 1
    facts = error(tmp_path)
    assert (facts["code"], facts["type"], facts["source"]) == ("program", "ProgramError", "return model")
    assert "compiled() returned a compiled model" in facts["message"]
    assert "return the mujoco.MjSpec" in facts["next_move"]
    assert not (tmp_path / "world.mjz").exists()


def test_the_start_keyframe_is_where_it_begins(tmp_path):
    def thrown():
        spec = build()
        spec.add_key(name="start", qpos=[1, 2, 3, 1, 0, 0, 0], qvel=[4, 0, 0, 0, 0, 0])
        return spec

    assert run(tmp_path, world=thrown) == 0
    assert stored.open(tmp_path / "trajectory").pos[0, 0] == pytest.approx((1, 2, 3))


def test_an_error_in_the_program_names_file_line_and_source(tmp_path, capsys):
    def control(model, data):
        if data.time > 0.0995:
            data.ctrl[99] = 1.0

    assert run(tmp_path, control=control) == 1
    facts = error(tmp_path)
    assert facts["type"] == "IndexError"
    assert Path(facts["file"]) == Path(__file__)
    assert facts["source"] == "data.ctrl[99] = 1.0"
    assert Path(__file__).read_text().splitlines()[facts["line"] - 1].strip() == facts["source"]
    assert not (tmp_path / "result.json").exists()
    assert "IndexError" in capsys.readouterr().err
    recording = stored.open(tmp_path / "trajectory")
    assert not recording.complete
    assert len(recording) == 100  # everything up to the failing step


def broken_mesh():
    spec = empty()
    spec.worldbody.add_body(name="weightless").add_freejoint()
    return spec


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"world": lambda: None}, "returned NoneType, not a world (end it with `return spec`)"),
        ({"world": lambda: "<mujoco/>"}, "returned str, not a world"),
        ({"world": broken_mesh}, "does not compile: .*weightless|does not compile: .*mass"),
        ({"world": lambda: empty(time_step=0.0)}, "time step is 0.0 s|does not compile"),
        ({"duration": -1.0}, "duration is -1.0"),
        ({"duration": float("nan")}, "duration is nan"),
        ({"duration": 1e-9}, "shorter than one time step"),
        ({"duration": 1e9}, "steps"),
        ({"movers": ("bell",)}, "movers names bell, which is not in the world"),
        ({"movers": "ball"}, "movers is the text"),
        ({"visual_only": ("ghost",)}, "visual_only names ghost"),
        ({"fps": 0}, "fps is 0"),
        ({"size": (33, 16)}, "size is"),
        ({"control": 3}, "control is 3"),
        ({"seed": -1}, "seed must be"),
    ],
)
def test_what_cannot_be_simulated_is_said_clearly(settings, message, tmp_path, capsys):
    assert run(tmp_path, **settings) == 1
    facts = error(tmp_path)
    assert facts["code"] == "program"
    assert facts["next_move"]
    import re

    assert re.search(message.replace("(", r"\(").replace(")", r"\)"), facts["message"]), facts["message"]
    assert "Traceback" not in capsys.readouterr().err


def test_a_blow_up_has_its_own_type(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)

    def control(model, data):
        data.xfrc_applied[1, 0] = 1e15

    assert run(tmp_path, control=control) == 1
    facts = error(tmp_path)
    assert facts["type"] == facts["code"] == "diverged"
    assert "ball" in facts["message"]
    assert (tmp_path / "trajectory" / "state.arrows").exists()
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()


def test_an_error_of_the_engine_keeps_what_was_recorded(tmp_path):
    def control(model, data):
        if data.time > 0.0495:
            model.opt.solver = 99

    def resting():
        spec = empty()
        floor(spec)
        ball(spec, "ball", (0, 0, 0.0999))
        return spec

    assert run(tmp_path, world=resting, control=control) == 1
    facts = error(tmp_path)
    assert facts["code"] == "engine"
    assert "solver" in facts["message"]
    assert facts["line"]
    recording = stored.open(tmp_path / "trajectory")
    assert not recording.complete
    assert len(recording) == 50
    assert recording.interventions.target.tolist() == ["opt.solver"]


def test_a_recording_is_never_overwritten(tmp_path, capsys):
    assert run(tmp_path) == 0
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    assert run(tmp_path) == 1
    assert "already" in capsys.readouterr().err
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_pictures_need_a_recording_of_this_world(tmp_path):
    assert program.main(build, argv=["--pass", "video", "--out", str(tmp_path)], duration=1) == 1
    assert "no recording" in error(tmp_path)["message"]
    assert run(tmp_path / "physics") == 0

    def other():
        spec = build()
        ball(spec, "second", (1, 0, 1))
        return spec

    arguments = ["--pass", "still", "--out", str(tmp_path), "--from", str(tmp_path / "physics")]
    assert program.main(other, argv=arguments, duration=1) == 1
    assert "another world; they differ in second" in error(tmp_path)["message"]
    assert program.main(build, argv=[*arguments, "--camera", "side"], duration=1) == 1
    assert "name one of: overview" in error(tmp_path)["next_move"]


PROGRAM = """
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    body = spec.worldbody.add_body(name="ball", pos=(0, 0, 1))
    body.add_freejoint()
    body.add_geom(size=(0.1, 0, 0))
    return spec

if __name__ == "__main__":
    program.main(build, duration={duration}, movers=("ball",))
"""


def script(tmp_path, *arguments, duration=0.1, source=PROGRAM):
    path = tmp_path / "simulation.py"
    path.write_text(source.format(duration=duration))
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "MUJOCO_GL")
    environment = {k: v for k, v in os.environ.items() if k not in hidden} | {"PYTHONPATH": str(SERVERS)}
    call = [sys.executable, str(path), *arguments]
    return subprocess.run(call, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=60)


def test_a_script_without_arguments_simulates_and_says_what_it_did(tmp_path):
    for _ in range(2):  # the default folder holds the latest run
        done = script(tmp_path)
        assert done.returncode == 0, done.stderr
        assert "1 bodies, 50 steps" in done.stdout and f"proof: {program.NO_PROOF}" in done.stdout
    assert len(stored.open(tmp_path / "out" / "trajectory")) == 51
    assert sorted(p.name for p in tmp_path.iterdir()) == ["out", "simulation.py"]


def test_a_script_that_fails_ends_with_status_1_and_the_line_of_its_call(tmp_path):
    done = script(tmp_path, "--pass", "physics", "--out", "o", duration=-1)
    assert done.returncode == 1
    facts = error(tmp_path / "o")
    assert facts["source"].startswith("program.main(build")
    assert Path(facts["file"]).name == "simulation.py"


def test_view_without_a_display_says_so(tmp_path):
    done = script(tmp_path, "--pass", "view")
    assert done.returncode == 1
    assert "no display" in done.stderr
    assert "Traceback" not in done.stderr


def test_importing_worldkit_is_light():
    code = """
    import sys
    from worldengine.clock import simulate
    from worldengine.inputs import ledger
    from worldengine.recording import record, replay, stored
    from worldkit import contacts, motion, program
    heavy = {"mujoco", "numpy", "pyarrow", "av", "cv2"} & set(sys.modules)
    assert not heavy, heavy
    """
    environment = os.environ | {"PYTHONPATH": str(SERVERS)}
    subprocess.run([sys.executable, "-c", textwrap.dedent(code)], env=environment, check=True, timeout=30)


def test_a_callback_that_breaks_the_compiler_is_named():
    """The engine asks it while it compiles, where a program's `data` is not yet there, and says only that Python raised."""
    spec = mujoco.MjSpec()
    spec.worldbody.add_body(name="crate").add_geom(size=(0.1, 0, 0))

    def pushes(model, data):
        raise KeyError("crate")

    mujoco.set_mjcb_control(pushes)
    try:
        with pytest.raises(ProgramError, match="set_mjcb_control") as caught:
            world.finish(spec, "build()")
    finally:
        mujoco.set_mjcb_control(None)
    assert "control(model, data)" in caught.value.next_move
