"""One run of CI tells all: every part runs, the table counts from the runners' own results, and one failure fails it all."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

CI = Path(__file__).parents[1] / ".ci"
TESTS = {
    "passes": "def test_a():\n    pass\n\ndef test_b():\n    pass\n",
    "fails": "def test_a():\n    pass\n\ndef test_wrong():\n    assert 1 == 2, 'one is not two'\n",
    "breaks": "import no_such_module\n",
    "skips": "import pytest\n\ndef test_it():\n    pytest.skip('not here')\n",
}


def results(tmp_path: Path, name: str) -> Path:
    """What pytest leaves of a small suite of this name, in JUnit's form."""
    suite, report = tmp_path / name, tmp_path / f"{name}.xml"
    suite.mkdir()
    (suite / f"test_{name}.py").write_text(TESTS[name])
    call = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", f"--junit-xml={report}", str(suite)]
    bare = {**os.environ, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}  # they cost each start four fifths of its time
    done = subprocess.run(call, cwd=suite, env=bare, capture_output=True, text=True, timeout=120)
    (tmp_path / f"{name}.log").write_text(done.stdout)
    with (tmp_path / "parts").open("a") as parts:
        parts.write(f"{name} {done.returncode} 7\n")
    return report


def table(folder: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, str(CI / "table.py"), str(folder)], capture_output=True, text=True, timeout=60
    )


def rows(text: str) -> dict[str, list[str]]:
    return {line.split()[0]: line.split()[1:] for line in text.splitlines() if line and ":" not in line}


def test_the_table_counts_what_the_runner_found(tmp_path):
    for name in TESTS:
        results(tmp_path, name)
    done = table(tmp_path)
    found = rows(done.stdout)
    assert found["passes"] == ["2", "0", "0", "7"] and found["fails"] == ["1", "1", "0", "7"]
    assert found["breaks"] == ["0", "1", "0", "7"] and found["skips"] == ["0", "0", "1", "7"]
    assert done.returncode == 1 and "test_wrong: AssertionError: one is not two" in done.stdout


def test_all_that_pass_end_with_nothing(tmp_path):
    results(tmp_path, "passes")
    (tmp_path / "parts").open("a").write("-style 0 1\n")
    done = table(tmp_path)
    assert done.returncode == 0 and rows(done.stdout)["style"] == ["no", "1"]
    assert "slowest (0 over 20 s):" in done.stdout and "test_passes::test_a" in done.stdout


@pytest.mark.skipif(shutil.which("ldconfig") is None, reason="the set-up asks ldconfig")
def test_the_harness_suite_brings_what_its_harnesses_need(tmp_path):
    """Alone, without the set-up of all suites: OpenCode does not start without ripgrep."""
    told = subprocess.run(["make", "-n", "test-harness"], cwd=CI.parent, capture_output=True, text=True, check=True)
    steps = [
        line for line in told.stdout.splitlines() if "system.sh harness" in line or "WORLDWRIGHT_HARNESSES=1" in line
    ]
    assert len(steps) == 2 and "system.sh harness" in steps[0]
    for name in ("bash", "ldconfig", "grep"):
        (tmp_path / name).symlink_to(shutil.which(name))
    done = subprocess.run(  # on a system without anything, apt-get least of all
        [tmp_path / "bash", CI / "system.sh", "harness"],
        env={"PATH": str(tmp_path), "PYTHON": sys.executable}, capture_output=True, text=True, timeout=60,
    )  # fmt: skip
    assert done.returncode == 1 and {"npm", "ripgrep", "socat"} <= set(done.stderr.replace("Missing:", "").split())


@pytest.mark.parametrize("cut", [None, "<testsuites><testsuite><testca"], ids=["missing", "cut off"])
def test_a_suite_without_results_failed(tmp_path, cut):
    (tmp_path / "parts").write_text("tests 0 3\n")
    if cut:
        (tmp_path / "tests.xml").write_text(cut)
    (tmp_path / "tests.log").write_text("\nmake: something\nValueError: it is broken\n")
    done = table(tmp_path)
    assert done.returncode == 1 and "tests: exit code 0: ValueError: it is broken" in done.stdout


def test_every_part_runs_after_one_that_failed(tmp_path):
    """The script itself, with a `make` that only says what it was asked for and fails at the types."""
    home, tools = tmp_path / "a folder" / ".ci", tmp_path / "bin"
    home.mkdir(parents=True)
    tools.mkdir()
    for name in ("run", "table.py"):
        shutil.copy(CI / name, home)
    make = tools / "make"
    make.write_text(
        '#!/bin/sh\necho "asked for $*"\n[ "$1" != types ] || { echo "x.py:1: error: wrong type"; exit 2; }\n'
    )
    make.chmod(0o755)
    env = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PYTHON": sys.executable}
    done = subprocess.run(["bash", str(home / "run")], env=env, capture_output=True, text=True, timeout=60)
    for part in ("set-up", "style", "types", "test", "test-conformance", "test-harness"):
        assert f"asked for {part}" in done.stdout.replace("-k ", "")
    found = rows(done.stdout)
    assert done.returncode == 1 and found["style"][0] == "no" and found["types"][0] == "yes"
    assert "types: exit code 2: x.py:1: error: wrong type" in done.stdout
    assert "tests: exit code 0: asked for -k test" in done.stdout  # it left no results


def test_a_busy_machine_is_busy_while_the_tests_run_and_at_no_other_time(tmp_path):
    """The script itself; its `make` counts the loops beside it and fails to set up the second clone."""
    room = tmp_path / "a folder"
    home, tools, seen = room / ".ci", room / "bin", room / "seen"
    home.mkdir(parents=True)
    tools.mkdir()
    for name in ("matrix", "table.py"):
        shutil.copy(CI / name, home)
    git = '#!/bin/sh\nmkdir -p "$4"\n'
    make = f"""#!/bin/sh
loops=$(cat /proc/[0-9]*/status 2>/dev/null | grep -A 8 "^Name:[[:space:]]*bash" | grep -c "^PPid:[[:space:]]*$PPID$")
case "$*" in *set-up*) what=set-up ;; *) what=tests ;; esac
echo "$what $loops" >> "{seen}"
[ "$what" = tests ] || [ "$(grep -c set-up "{seen}")" = 1 ]
"""
    for name, text in (("git", git), ("make", make)):
        (tools / name).write_text(text)
        (tools / name).chmod(0o755)
    env = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}", "PYTHON": sys.executable}
    said = in_a_group(["bash", str(home / "matrix"), "busy", "busy+elsewhere", "again"], env, timeout_s=120)
    assert seen.read_text().split("\n")[:-1] == ["set-up 0", "tests 4", "set-up 0", "tests 0"], said


def in_a_group(call: list[str], env: dict[str, str], timeout_s: float) -> str:
    """Run a script that begins loops, in a session of its own; returns what it printed. Out of time, all of it is ended."""
    with subprocess.Popen(
        call, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True
    ) as script:
        try:
            return script.communicate(timeout=timeout_s)[0]
        except BaseException:
            os.killpg(script.pid, signal.SIGKILL)
            raise


def test_a_script_that_is_out_of_time_leaves_no_loop(tmp_path):
    begun = tmp_path / "begun"
    loops = f"""trap 'kill $!' EXIT; while :; do sleep 0.05; done & echo $! > "{begun}"; wait"""
    with pytest.raises(subprocess.TimeoutExpired):
        in_a_group(["bash", "-c", loops], {**os.environ}, timeout_s=3)
    loop = Path(f"/proc/{begun.read_text().strip()}/stat")
    until = time.monotonic() + 60
    while not (gone := _ended(loop)) and time.monotonic() < until:
        time.sleep(0.05)  # the kernel ends it when it comes to it
    assert gone


def _ended(stat: Path) -> bool:
    try:
        return ") Z " in stat.read_text()
    except (FileNotFoundError, ProcessLookupError):
        return True
