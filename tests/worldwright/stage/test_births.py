"""The limit on processes holds (to one or two), however they are started, and short-lived ones do not add up."""

import sys
import textwrap
import time

import pytest

from worldwright.stage import family, sandbox
from worldwright.stage.sandbox import Confinement
from worldwright.stage.sandbox.confinement import environment
from worldwright.stage.sandbox.enter import enter

# Bounded: at most 380 children, each gone after three seconds by itself.
CROWD = """
import os, time
def some(deeper):
    for _ in range(19):
        try:
            if os.fork() == 0:
                if deeper:
                    some(False)
                time.sleep(3)
                os._exit(0)
        except OSError:
            pass
some(True)
time.sleep(3)
"""
FLEETING = """
import os
for _ in range(300):
    if os.fork() == 0:
        os._exit(0)
    os.wait()
"""


@pytest.fixture(params=[name for name in sandbox.LADDER if not sandbox.unusable(name)])
def confine(request, tmp_path):
    """Start a program at a level with room for 40 processes."""

    def confine(source: str):
        for name in ("out", "scratch", "in"):
            (tmp_path / name).mkdir()
        program = tmp_path / "in" / "program.py"
        program.write_text(textwrap.dedent(source))
        confinement = Confinement(
            out=tmp_path / "out",
            reads=(program.parent,),
            scratch=tmp_path / "scratch",
            cpu_s=20,
            file_bytes=1 << 20,
            memory_bytes=4 << 30,
            token=family.new_token(),
            environment=environment(str(tmp_path / "scratch")),
            processes=40,
        )
        entered = enter(sandbox.LADDER[request.param], [sys.executable, "-I", "-S", str(program)], confinement)
        if entered.births is None:
            family.end(entered.process.pid, confinement.token)
            pytest.skip("this kernel cannot ask before a birth")
        return entered, confinement

    return confine


def test_a_crowd_stays_under_its_limit(confine):
    entered, confinement = confine(CROWD)
    most, deadline = 0, time.monotonic() + 2.5
    while time.monotonic() < deadline and entered.process.poll() is None:
        most = max(most, len(family.census(entered.process.pid).processes))
        time.sleep(0.01)
    family.end(entered.process.pid, confinement.token)
    entered.process.wait()
    assert 30 <= most <= 42
    assert "more than 40 processes" in entered.births.exceeded
    assert not family.bearing(confinement.token)


def test_many_short_lives_are_no_crowd(confine):
    entered, confinement = confine(FLEETING)
    assert entered.process.wait(timeout=30) == 0
    assert not entered.births.exceeded
    family.end(entered.process.pid, confinement.token)
