"""Peers of another DDS vendor for tests: built once from `dds_peer.cpp`, each a process, in a domain of its own."""

import contextlib
import fcntl
import hashlib
import os
import shutil
import subprocess
import tempfile
import threading
from collections.abc import Iterator
from pathlib import Path

SOURCE = Path(__file__).with_name("dds_peer.cpp")
HEADER = Path("/usr/include/fastdds/dds/domain/DomainParticipant.hpp")
PATIENCE_S = 200.0
DOMAINS = range(40, 100)
"""Of higher ones the ports are those that the system gives to anybody."""


def missing() -> str:
    """Why no peer can be built here; empty: it can."""
    if shutil.which("g++") is None:
        return "there is no g++ here"
    return "" if HEADER.is_file() else "there is no Fast DDS here (Debian: libfastrtps-dev)"


def built() -> Path:
    """The program, built by whichever test comes first on this machine."""
    room = Path(tempfile.gettempdir()) / f"worldwright-dds-peer-{os.getuid()}"
    room.mkdir(mode=0o700, exist_ok=True)
    program = room / hashlib.sha256(SOURCE.read_bytes()).hexdigest()[:16]
    with (room / "lock").open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        if not program.is_file():
            made = program.with_suffix(".new")
            words = ["g++", "-std=c++17", "-O0", "-o", str(made), str(SOURCE), "-lfastrtps", "-lfastcdr", "-lpthread"]
            done = subprocess.run(words, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr[:3000]
            made.rename(program)
    return program


@contextlib.contextmanager
def domain() -> Iterator[int]:
    """A domain for one test, held against all others on this machine."""
    room = Path(tempfile.gettempdir()) / f"worldwright-dds-peer-{os.getuid()}"
    room.mkdir(mode=0o700, exist_ok=True)
    for number in DOMAINS:
        with (room / f"domain-{number}").open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                continue
            yield number
            return
    raise AssertionError("all domains are taken")


def met(node, **counts: int) -> bool:
    """Whether so many peers' writers are matched, by the node's topics: what is sent before that is lost."""
    found = {one.topic: len(one.reader.get_matched_publications()) for one in node._subscriptions}
    return all(found[f"/{topic.replace('__', '/')}"] == count for topic, count in counts.items())


class Peer:
    """One peer: `ask` it, and `wait` for what it tells."""

    def __init__(self, number: int, name: str) -> None:
        words = [str(built()), str(number), name]
        self.process = subprocess.Popen(words, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.lines: list[str] = []
        self._more = threading.Condition()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in self.process.stdout:
            with self._more:
                self.lines.append(line.rstrip("\n"))
                self._more.notify_all()

    def say(self, line: str) -> None:
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()

    def wait(self, start: str, since: int = 0) -> str:
        """The first line that begins so, from the line of that number on."""

        def found() -> str:
            return next((line for line in self.lines[since:] if f"{line} ".startswith(start)), "")

        with self._more:
            assert self._more.wait_for(found, PATIENCE_S), f"no `{start}` in {self.lines}"
            return found()

    def ask(self, line: str) -> list[str]:
        """Say it, and take the words of the answer."""
        since = len(self.lines)
        self.say(line)
        return self.wait(f"{line.split()[0]} ", since).split()[1:]

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
