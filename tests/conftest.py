"""What holds for every test: the OpenGL that draws, hypothesis' examples, and that nothing is left out in silence.

Which OpenGL draws is decided before anything imports the simulator. Where `CI=true`, a test that skips fails: CI is meant
to prove it. Elsewhere the whole suite says at its end what it did not run, and how to. A test that fails is named when it does,
also when workers run the tests; why it failed stands at the end as always.
"""

import atexit
import gc
import os
import shutil
import tempfile
from collections import Counter
from collections.abc import Generator
from pathlib import Path

os.environ.setdefault("MUJOCO_GL", "egl")
os.environ.setdefault(
    "OPENBLAS_NUM_THREADS", "1"
)  # as in the sandbox: on small matrices its threads only wait for each other
# No test signs with the key of the person who runs it, nor trusts a key in their name. Workers have one key together, so
# that each knows what another has signed.
os.environ["WORLDWRIGHT_DATA"] = (
    os.environ["WORLDWRIGHT_DATA"]
    if "PYTEST_XDIST_WORKER" in os.environ
    else tempfile.mkdtemp(prefix="worldwright-tests-")
)
# Nor is a pre-roll's answer taken from that person's cache: each is given in the run itself.
os.environ["WORLDWRIGHT_PREROLLS"] = f"{os.environ['WORLDWRIGHT_DATA']}/prerolls"
# Nor does a walk leave anything at work beside it: a test that wants it asks for it.
os.environ["WORLDWRIGHT_BESIDE"] = "0"
# What is found does not depend on which libraries of meshes a machine happens to have.
os.environ["WORLDWRIGHT_SWEETHOME"] = f"{os.environ['WORLDWRIGHT_DATA']}/no-furniture"

import pytest
from hypothesis import HealthCheck, settings

# Tests kill processes, never the machine: what a process has written outlives it without waiting for the disk, on which all
# workers would wait for one another. A process that a test starts syncs as always.
os.fsync = lambda _: None  # type: ignore[assignment]

if "PYTEST_XDIST_WORKER" not in os.environ:
    atexit.register(shutil.rmtree, os.environ["WORLDWRIGHT_DATA"], ignore_errors=True)

# How fast a machine draws examples is no property of what is tested. CI judges a commit by the same examples each time;
# people's runs keep looking for new ones.
settings.register_profile(
    "worldwright",
    deadline=None,
    suppress_health_check=[HealthCheck.too_slow],
    derandomize="WORLDWRIGHT_SAME_EXAMPLES" in os.environ,
)
settings.load_profile("worldwright")

IN_CI = os.environ.get("CI", "").lower() in ("1", "true")
ELSEWHERE = {
    "WORLDWRIGHT_CONFORMANCE": "the protocol's own judges: make test-conformance (brings them from npm)",
    "WORLDWRIGHT_HARNESSES": "the real Claude Code, Codex and OpenCode: make test-harness (brings them from npm)",
    "WORLDWRIGHT_SEMANTIC": "torch and LanceDB: make test-semantic (installs the `semantic` extra)",
    "WORLDWRIGHT_RAY": "campaigns on Ray itself: make test-ray (installs the `cluster` extra)",
    "WORLDWRIGHT_KILLS": "kill -9 at a hundred moments instead of a few: make test-faults",
    "WORLDWRIGHT_TRICKS": "every trick to get a false claim stamped instead of a dozen: make test-tricks",
}
"""Suites with a target of their own, by the variable that their target sets."""

collect_ignore = [] if "WORLDWRIGHT_SEMANTIC" in os.environ else ["worldwright/retrieve/test_torch_and_lance.py"]


def _judged(report: "pytest.TestReport | pytest.CollectReport") -> None:
    """In CI a skip becomes a failure that keeps the skip's reason."""
    if IN_CI and report.skipped and not hasattr(report, "wasxfail"):
        reason = report.longrepr[2] if isinstance(report.longrepr, tuple) else str(report.longrepr)
        report.outcome = "failed"
        report.longrepr = f"CI is meant to prove this, and it did not run: {reason}"


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """A test that skips fails in CI."""
    report = yield
    _judged(report)
    return report


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_make_collect_report() -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """A module that skips fails in CI."""
    report = yield
    _judged(report)
    return report


class NamedAtOnce:
    """Between the dots, writes `FAILED` and the name of a test as soon as one fails: a long run's end is far."""

    def __init__(self, config: pytest.Config) -> None:
        self.config = config

    @pytest.hookimpl(trylast=True)
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """After the letter that stands for the test."""
        if not report.failed:
            return
        terminal = self.config.get_terminal_writer()
        if terminal.width_of_current_line:
            terminal.line()
        terminal.line(f"FAILED {report.nodeid}")
        terminal.flush()  # who reads along reads a pipe or a file


def pytest_configure(config: pytest.Config) -> None:
    """Name failures where the terminal is, which is not in a worker; with -v each test is named anyway."""
    if not hasattr(config, "workerinput") and config.get_verbosity() <= 0:
        config.pluginmanager.register(NamedAtOnce(config))


def pytest_collection() -> None:
    """What is collected stays to the end: whoever looked for garbage on the way found none, in a fifth of the time."""
    gc.disable()


def pytest_collection_finish() -> None:
    """Nor need anybody walk through thousands of tests and all modules each time, later."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(10 * gc.get_threshold()[0], *gc.get_threshold()[1:])
    gc.enable()


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """After the whole suite: what did not run, why, and how to run it."""
    if config.args_source != pytest.Config.ArgsSource.TESTPATHS:
        return
    lines = [hint for variable, hint in ELSEWHERE.items() if variable not in os.environ]
    skipped = Counter(_place(report) for report in terminalreporter.stats.get("skipped", []))
    lines += [f"{count} x {place}" for place, count in skipped.items()]
    terminalreporter.section("did not run")
    for line in lines:
        terminalreporter.write_line(line)


def _place(report: "pytest.TestReport | pytest.CollectReport") -> str:
    if not isinstance(report.longrepr, tuple):
        return f"{report.nodeid}: {report.longrepr}"
    path, line, reason = report.longrepr
    return f"{Path(path).name}:{line}: {reason.removeprefix('Skipped: ')}"
