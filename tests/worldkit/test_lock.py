"""The environment contract: what is observed, what differs, and that a mismatch stops a program at its first import."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from worldkit import lock

SERVERS = Path(lock.__file__).parents[1]


def test_what_is_observed_names_engine_wheels_python_renderer_and_processor():
    facts = lock.observe("egl")
    assert facts["gl"] == "egl"
    assert facts["python"].endswith(".".join(map(str, sys.version_info[:3])))
    assert facts["engine"].startswith("libmujoco")
    assert {f"wheel {name}" for name in ("mujoco", "numpy", "pyarrow")} <= set(facts)
    assert facts["origin of mujoco"].endswith("__init__.py")
    assert lock.differences(facts, lock.observe("egl")) == []


def test_differences_are_readable():
    facts = {**lock.observe("egl"), "cpu features": "avx2 fma sse2"}
    other = {**facts, "gl": "osmesa", "cpu features": "avx512f fma sse2", "wheel numpy": "1.0 abc"}
    assert lock.differences(facts, other) == [
        "gl: osmesa (locked: egl)",
        "cpu features: without avx2; also avx512f",
        f"wheel numpy: 1.0 abc (locked: {facts['wheel numpy']})",
    ]
    assert lock.differences({}, {"gl": "egl"}) == ["gl: egl (locked: missing)"]


@pytest.mark.parametrize("changed", ["engine", "wheel numpy", "python", "gl", "origin of mujoco"])
def test_a_program_in_another_environment_stops_at_its_import(tmp_path, changed):
    (tmp_path / "lock.json").write_text(json.dumps({**lock.observe("egl"), changed: "something else"}))
    code = "import worldkit; print('went on')"
    variables = {
        **os.environ,
        "WORLDKIT_LOCK": str(tmp_path / "lock.json"),
        "PYTHONPATH": str(SERVERS),
        "MUJOCO_GL": "egl",
    }
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=variables, capture_output=True, text=True)
    assert done.returncode == lock.CONFIGURATION_ERROR
    assert "went on" not in done.stdout
    error = json.loads((tmp_path / "error.json").read_text())
    assert (error["code"], error["type"]) == ("environment", "EnvironmentMismatch")
    assert changed in error["message"]
    assert error["next_move"]


def test_the_right_environment_goes_on(tmp_path):
    (tmp_path / "lock.json").write_text(json.dumps(lock.observe("egl")))
    variables = {
        **os.environ,
        "WORLDKIT_LOCK": str(tmp_path / "lock.json"),
        "PYTHONPATH": str(SERVERS),
        "MUJOCO_GL": "egl",
    }
    done = subprocess.run([sys.executable, "-c", "import worldkit"], cwd=tmp_path, env=variables, capture_output=True)
    assert done.returncode == 0, done.stderr
