"""An engine that is forked into its sandbox is confined as one that bubblewrap starts, to the last bit that the kernel tells."""

import json
import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest

from worldwright.stage import family, sandbox
from worldwright.stage.sandbox.births import _lives
from worldwright.stage.sandbox.probe import started as begun

from .. import escapes
from ..test_births import CROWD
from . import warm_engines
from .warm_engines import confinement, nursery, said, started

pytestmark = pytest.mark.skipif(bool(sandbox.unusable("bubblewrap")), reason="bubblewrap does not confine here")

STATE = '''
import ctypes, json, os, random, resource, signal, sys, time
from pathlib import Path

def read(name):
    return Path("/proc/self", name).read_text(errors="replace")

def mounts():
    """What is mounted where and how, without the numbers that the kernel gives in passing."""
    lines = []
    for line in read("mountinfo").splitlines():
        front, _, behind = line.partition(" - ")
        lines.append(" ".join([*front.split()[3:6], behind.split()[0]]))
    return sorted(lines)

libc = ctypes.CDLL(None)
death = ctypes.c_int()
libc.prctl(2, ctypes.byref(death), 0, 0, 0)
NAMES = "Uid Gid Groups NoNewPrivs Seccomp Seccomp_filters CapInh CapPrm CapEff CapBnd CapAmb Umask Threads SigBlk SigIgn SigCgt"
status = dict(line.split(":", 1) for line in read("status").splitlines() if ":" in line)
print(json.dumps({
    **{name: status[name].split() for name in NAMES.split()},
    "maps": [read(name).split() for name in ("uid_map", "gid_map", "setgroups")],
    "mounts": mounts(),
    "root": sorted(os.listdir("/")),
    "processes": sum(name.isdigit() for name in os.listdir("/proc")),
    "limits": {name: resource.getrlimit(getattr(resource, name)) for name in dir(resource) if name.startswith("RLIMIT_")},
    "environment": dict(os.environ),
    "folder": os.getcwd(),
    "leads": [os.getpid() == os.getsid(0), os.getpid() == os.getpgid(0)],
    "dies": death.value,
    "dumpable": libc.prctl(3, 0, 0, 0, 0),
    "oom": read("oom_score_adj"),
    "host": os.uname().nodename,
    "open": sorted(int(name) for name in os.listdir("/proc/self/fd") if int(name) < 200)[:-1],
    "input": os.read(0, 10).decode(),
    "path": sys.path[1:] if sys.path[0] == os.path.dirname(sys.argv[0]) else sys.path,
    "flags": [sys.dont_write_bytecode, sys.flags.no_user_site, sys.flags.safe_path, hash("a word")],
    "nice": os.nice(0),
    "devices": sorted(os.listdir("/dev")),
    "words": sys.argv[1:],
}))
'''
NAMESPACES = """
import json, os
print(json.dumps({name: os.readlink(f"/proc/self/ns/{name}") for name in os.listdir("/proc/self/ns")}))
"""


@pytest.fixture(scope="module", autouse=True)
def ours():
    with nursery() as now:
        yield now


def told(folder: Path, text: str, warm: bool, *words: str):
    program = folder / "program.py"
    program.parent.mkdir(exist_ok=True, parents=True)
    program.write_text(text)
    status, text = said(program, confinement(folder / ("warm" if warm else "cold"), program), warm, *words)
    assert status == 0, text
    return json.loads(text)


def test_what_the_kernel_tells_of_it_is_the_same(tmp_path):
    warm, cold = (told(tmp_path, STATE, warm, "a", "b") for warm in (True, False))
    as_cold = json.loads(json.dumps(warm).replace("/warm/", "/cold/"))
    as_cold["limits"]["RLIMIT_MSGQUEUE"] = cold["limits"]["RLIMIT_MSGQUEUE"]  # the token, its own
    as_cold["processes"] -= 1  # the shell that waits
    as_cold["dies"] = cold["dies"]  # with its keeper; the other with all of its namespace
    as_cold["leads"] = cold["leads"]  # a session of its own; the other is in that of its namespace's first process
    as_cold["mounts"].sort()
    assert {name: (as_cold[name], cold[name]) for name in cold if as_cold[name] != cold[name]} == {}
    assert set(warm["CapEff"] + warm["CapPrm"] + warm["CapBnd"] + warm["CapInh"] + warm["CapAmb"]) == {"0" * 16}
    assert warm["NoNewPrivs"] == ["1"] and warm["Seccomp"] == ["2"] and warm["dies"] == signal.SIGKILL


def test_every_namespace_is_its_own(tmp_path):
    warm, cold = (told(tmp_path, NAMESPACES, warm) for warm in (True, False))
    here = {name: os.readlink(f"/proc/self/ns/{name}") for name in os.listdir("/proc/self/ns")}  # noqa: PTH115, PTH208
    assert {name for name in here if warm[name] == here[name]} == {name for name in here if cold[name] == here[name]}
    assert all(warm[name] != here[name] for name in ("user", "mnt", "pid", "net", "ipc", "uts", "cgroup"))


def test_there_is_no_way_out(tmp_path):
    outside, home = tmp_path / "outside", tmp_path / "home"
    for path in (outside / "empty", home / ".ssh"):
        path.mkdir(parents=True)
    (outside / "victim").write_text("precious")
    (home / ".ssh" / "id_ed25519").write_text("secret")
    kinds = (
        (socket.AF_INET, socket.SOCK_STREAM),
        (socket.AF_INET, socket.SOCK_DGRAM),
        (socket.AF_UNIX, socket.SOCK_STREAM),
    )
    tcp, udp, unix = (socket.socket(*kind) for kind in kinds)
    with tcp, udp, unix:
        for one in (tcp, udp):
            one.bind(("127.0.0.1", 0))
        unix.bind(str(tmp_path / "unix"))
        for one in (tcp, unix):
            one.listen()
        facts = {
            "name": "worldwright-warm", "outside": str(outside), "victim": str(outside / "victim"), "home": str(home),
            "real_home": str(Path.home()), "real_names": sorted(path.name for path in Path.home().iterdir()),
            "secret": str(home / ".ssh" / "id_ed25519"), "worldkit": str(Path(sandbox.__file__).parents[3] / "worldkit/__init__.py"),
            "packages": str(Path(json.__file__).parent), "disk": "/dev/vda", "unix": str(tmp_path / "unix"),
            "pid": os.getpid(), "start": begun(os.getpid()), "tcp": tcp.getsockname()[1], "udp": udp.getsockname()[1],
            **{name: str(outside / "victim") for name in ("plan", "program", "journal", "evidence")},
        }  # fmt: skip
        program = tmp_path / "program.py"
        # Whoever joins a sandbox has no parent there: number 0 would mean one's own group.
        source = "import os\nos.getppid = lambda: 1\n" + Path(escapes.__file__).read_text() + f"\n\nmain({facts!r})\n"
        program.write_text(source)
        status, text = said(program, confinement(tmp_path / "job", program), True)
    assert status == 0, text
    outcomes = json.loads(
        [line for line in text.splitlines() if line.startswith(escapes.MARK)][-1].removeprefix(escapes.MARK)
    )
    assert outcomes.keys() == escapes.ATTEMPTS.keys()
    assert {name: said for name, said in outcomes.items() if not said.startswith(("barred", "not feasible"))} == {}
    assert (outside / "victim").read_text() == "precious"


def test_its_memory_and_its_tables_hold_nothing_of_who_asked(tmp_path, monkeypatch):
    monkeypatch.setenv("WORLDWRIGHT_TEST_SECRET", "a-secret-of-the-user")
    look = """
import json
found = []
for line in open("/proc/self/maps"):
    words = line.split()
    if "r" in words[1] and words[-1] not in ("[vvar]", "[vsyscall]", "[vvar_vclock]"):
        low, high = (int(word, 16) for word in words[0].split("-"))
        with open("/proc/self/mem", "rb") as memory:
            memory.seek(low)
            try:
                held = memory.read(high - low)
            except OSError:
                continue
        found += [words[-1]] * ("-".join(["a", "secret", "of", "the", "user"]).encode() in held)
print(json.dumps(found))
"""
    assert told(tmp_path, look, True) == []


def test_no_two_draw_the_same_by_chance(tmp_path):
    draw = "import json, random, uuid\nimport numpy as np\nprint(json.dumps([random.random(), np.random.rand(), str(uuid.uuid4())]))"
    first, again = (told(tmp_path / name, draw, True) for name in ("one", "two"))
    assert all(a != b for a, b in zip(first, again, strict=True))


@pytest.mark.parametrize("end", ["raise SystemExit(7)", "import os, signal; os.kill(os.getpid(), signal.SIGKILL)", "1 / 0", "pass",
                                 "import os; os._exit(3)", "open('large', 'wb').write(bytes(1 << 21))"])  # fmt: skip
def test_it_ends_as_one_that_was_started(tmp_path, end):
    program = tmp_path / "program.py"
    program.write_text(end)
    warm, cold = (said(program, confinement(tmp_path / str(warm), program), warm) for warm in (True, False))
    assert warm[0] == cold[0] and warm[1].splitlines()[-1:] == cold[1].splitlines()[-1:]


def gone(*pids: int) -> bool:
    until = time.monotonic() + 20
    while any(map(_lives, pids)) and time.monotonic() < until:
        time.sleep(0.01)
    return not any(map(_lives, pids))


def test_who_ends_the_sandbox_ends_it(tmp_path):
    program = tmp_path / "program.py"
    program.write_text("import time; print('here', flush=True); time.sleep(60)")
    entered = started(program, given := confinement(tmp_path / "job", program), True)
    assert entered.process.stdout.readline() == b"here\n"
    assert entered.joined.engine in family.bearing(given.token)
    family.end(entered.process.pid, 0)
    assert entered.process.wait() != 0 and gone(entered.joined.engine)


def test_it_ends_with_whoever_asked(tmp_path):
    program = tmp_path / "program.py"
    program.write_text("import time; time.sleep(60)")
    ask = f"""
import sys, time
from pathlib import Path
sys.path.insert(0, {str(Path(__file__).parent)!r})
import warm_engines as engines
with engines.nursery():
    entered = engines.started(Path(sys.argv[1]), engines.confinement(Path(sys.argv[2]), Path(sys.argv[1])), True)
    print(entered.joined.engine, entered.process.pid, flush=True)
    time.sleep(60)
"""
    call = [sys.executable, "-c", ask, str(program), str(tmp_path / "job")]
    asks = subprocess.Popen(call, stdout=subprocess.PIPE, text=True)
    pids = [int(word) for word in asks.stdout.readline().split()]
    assert all(map(_lives, pids))
    asks.kill()
    asks.wait()
    asks.stdout.close()
    assert gone(*pids)


def test_its_births_are_limited(tmp_path):
    program = tmp_path / "program.py"
    program.write_text(CROWD)
    entered = started(program, given := confinement(tmp_path / "job", program, processes=40), True)
    most = 0
    while not entered.births.exceeded and entered.process.poll() is None:
        most = max(most, len(family.census(*entered.roots).processes))
        time.sleep(0.01)
    family.end(entered.process.pid, given.token)
    entered.process.wait()
    assert most <= 45 and "more than 40 processes" in entered.births.exceeded
    assert not family.bearing(given.token)


def test_where_a_loaded_file_has_changed_it_is_started_cold(tmp_path):
    given = confinement(tmp_path, tmp_path)
    with nursery(since_s=0.0):
        assert warm_engines.joining.join([], given, 100, (), subprocess.PIPE) is None


def test_where_the_interpreter_would_start_otherwise_it_is_started_cold(tmp_path):
    given = confinement(tmp_path, tmp_path)
    given.environment["LD_PRELOAD"] = "/lib/other.so"
    assert warm_engines.joining.join([], given, 100, (), subprocess.PIPE) is None
