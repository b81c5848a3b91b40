"""A short confined run: limits hold, nothing is left behind, and only plain files come back."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.model import call_time
from worldwright.model.errors import CallOverError
from worldwright.model.own_time import STARVED, OwnTime
from worldwright.stage import family, sandbox
from worldwright.stage.confined import run

pytestmark = pytest.mark.skipif(sandbox.level() not in sandbox.CONFINING, reason="no level confines here")


def python(code, **limits):
    return run([sys.executable, "-c", code, "{out}"], **limits)


def test_what_is_asked_for_comes_back_and_the_rest_is_gone():
    done = python(
        "import sys, pathlib; o = pathlib.Path(sys.argv[1]); (o / 'a').write_text('x'); print(o)", wanted=("a", "b")
    )
    assert (done.status, done.exit_code, done.files) == ("ended", 0, {"a": b"x"})
    assert not Path(done.log.strip()).exists()


def test_links_and_pipes_do_not_come_back():
    code = "import os, sys; os.chdir(sys.argv[1]); os.symlink('/etc/hostname', 'a'); os.mkfifo('b'); os.mkdir('c')"
    assert python(code, wanted=("a", "b", "c")).files == {}


@given(st.lists(st.tuples(st.floats(0, 10), st.floats(0, 20), st.booleans()), max_size=20))
def test_a_run_is_charged_what_it_sleeps_and_what_it_computes(looks):
    own, now, cpu, charged = OwnTime(100.0), 100.0, 0.0, 0.0
    for passed, computed, wanting in looks:
        now, cpu = now + passed, cpu + computed
        charged += min(passed, computed) if wanting else passed
        assert own.after(now, cpu, wanting) == pytest.approx(max(charged, (now - 100.0) / STARVED), abs=1e-9)


def test_other_work_on_the_machine_does_not_end_a_run():
    own = OwnTime(0.0)
    assert own.after(50.0, 2.0, True) < 3.0  # 48 s long it only waited for a processor
    assert own.after(52.0, 2.0, False) > 3.0  # and then it slept


def test_who_sleeps_is_ended_too():
    assert python("import time; time.sleep(60)", wall_s=1.0).status == "timed_out"


ADVANCES = """
import json, pathlib, sys, time
out = pathlib.Path(sys.argv[1])
for done in range(8):
    (out / ".next").write_text(json.dumps({"done": 1 + done // PACE, "total": 8}))
    (out / ".next").replace(out / "progress.json")
    time.sleep(0.4)
"""


def test_what_advances_may_take_its_time_and_what_stands_still_may_not():
    def ended(pace):
        return python(ADVANCES.replace("PACE", str(pace)), wall_s=1.2, advances=True).status

    assert ended(1) == "ended"
    assert ended(100) == "timed_out"


def test_the_end_of_a_call_ends_it_by_the_clock():
    """As an error that says to call again: what ran has not failed."""
    with call_time.limited(1.0), pytest.raises(CallOverError, match="280 s that a call may take") as over:
        python("import time; time.sleep(60)", wall_s=60.0)
    assert over.value.code == "timed_out" and "on the shell" in over.value.next_move
    assert call_time.left_s() > 1e9


def test_nothing_is_begun_when_the_call_is_over():
    """However soon it would end: it is not a matter of who is faster."""
    with call_time.limited(0.0), pytest.raises(CallOverError):
        run(["true"])


def test_time_memory_and_output_are_limited():
    assert python("while True: pass", wall_s=1.0).status == "timed_out"
    hog = python("x = b'x' * (300 << 20)\nwhile True: pass", memory_mb=128, wall_s=20.0)
    assert hog.status == "out_of_memory"
    loud = python("while True: print('x' * 100000)", file_mb=1, wall_s=20.0)
    assert loud.exit_code != 0 and len(loud.log) <= 20_000


def test_only_what_was_named_can_be_read(tmp_path):
    named, other = tmp_path / "named.txt", tmp_path / "other.txt"
    named.write_text("yes")
    other.write_text("no")
    code = "import pathlib, sys; print(pathlib.Path({!r}).read_text())"
    assert "yes" in python(code.format(str(named)), reads=[named]).log
    assert python(code.format(str(other)), reads=[named]).exit_code != 0


@pytest.mark.parametrize("told", [True, False])
def test_an_end_is_noticed_whether_or_not_the_kernel_tells_of_it(told, monkeypatch):
    if not told:
        monkeypatch.delattr(os, "pidfd_open")
    process = subprocess.Popen(["cat"], stdin=subprocess.PIPE)
    assert not family.ends_within(process, 0.05)
    process.communicate(b"")
    assert family.ends_within(process, 0.05)
    waited = subprocess.Popen(["true"])
    assert family.ends_within(waited, 60) and waited.returncode == 0
