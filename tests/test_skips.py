"""A test that skips fails where CI is meant to prove it; elsewhere the whole suite says what it did not run."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

SKIPS = {
    "test": "import pytest\n\ndef test_it():\n    pytest.skip('no such test here')\n",
    "mark": "import pytest\n\n@pytest.mark.skipif(True, reason='no such mark here')\ndef test_it():\n    pass\n",
    "module": "import pytest\n\npytest.importorskip('no_such_thing', reason='no such module here')\n",
    "fixture": "import pytest\n\n@pytest.fixture\ndef x():\n    pytest.skip('no such fixture here')\n\ndef test_it(x):\n    pass\n",
    "nothing": "def test_it():\n    pass\n",
}

ALONE = {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
"""What is tested here is our conftest: the installed plugins cost each start four fifths of its time."""


@pytest.fixture
def suite(tmp_path):
    """Runs a small suite in which four tests skip and one passes, beside this suite's own conftest."""
    tests = tmp_path / "tests"
    tests.mkdir()
    shutil.copy(Path(__file__).with_name("conftest.py"), tests)
    for name, text in SKIPS.items():
        (tests / f"test_{name}.py").write_text(text)
    (tmp_path / "pytest.ini").write_text("[pytest]\ntestpaths = tests\n")

    def run(*options: str, stdout=subprocess.PIPE, **environment: str) -> subprocess.CompletedProcess[str]:
        env = {name: value for name, value in os.environ.items() if name != "CI" and not name.startswith("PYTEST")}
        call = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *(("-p", "xdist") if "-n" in options else ())]
        return subprocess.run(
            [*call, *options],
            cwd=tmp_path,
            env={**env, **ALONE, **environment},
            stdout=stdout,
            stderr=subprocess.PIPE,
            text=True,
            timeout=120,
        )

    return run


@pytest.mark.parametrize("options", [(), ("-n", "1")], ids=["here", "in a worker"])
def test_what_skips_fails_in_ci(suite, options):
    done = suite("--continue-on-collection-errors", *options, CI="true")
    assert done.returncode != 0 and "1 passed" in done.stdout and "skipped" not in done.stdout.splitlines()[-1]
    for name in ("test", "mark", "module", "fixture"):
        assert f"CI is meant to prove this, and it did not run: Skipped: no such {name} here" in done.stdout


def test_elsewhere_the_end_says_what_did_not_run(suite):
    done = suite()
    assert done.returncode == 0, done.stdout
    end = done.stdout[done.stdout.index("did not run") :]
    assert all(f"no such {name} here" in end for name in ("test", "mark", "module", "fixture"))
    assert "make test-harness" in end and "make test-conformance" in end


def test_a_part_of_the_suite_says_nothing_of_the_rest(suite):
    done = suite("tests/test_mark.py", "tests/test_nothing.py")
    assert done.returncode == 0 and "did not run" not in done.stdout


@pytest.mark.parametrize("options", [(), ("-n", "1")], ids=["here", "in a worker"])
def test_a_failing_test_is_named_at_once(suite, tmp_path, options):
    """By the second test: the first has failed, and what has been written of it until then is in the log already."""
    log = tmp_path / "log.txt"
    told = f"import time\n\ndef test_b():\n    for _ in range(600):\n        if 'test_red.py::test_a' in open({str(log)!r}).read():\n            return\n        time.sleep(0.1)\n    assert False, 'not named'\n"
    (tmp_path / "tests/test_red.py").write_text("def test_a():\n    assert 1 == 2\n")
    (tmp_path / "tests/test_then.py").write_text(told)
    with log.open("w") as stream:
        done = suite("-q", "tests/test_nothing.py", "tests/test_red.py", "tests/test_then.py", *options, stdout=stream)
    lines = log.read_text().splitlines()
    assert done.returncode == 1 and "1 failed, 2 passed" in lines[-1], lines
    assert lines.index("FAILED tests/test_red.py::test_a") < next(
        n for n, line in enumerate(lines) if "FAILURES" in line
    )
