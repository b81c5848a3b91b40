"""A world that lives in a process of its own, as others here see it: its newest state, its commands, its end."""

import shutil
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from contextlib import suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_json

from ..model import try_lock
from ..model.errors import GateError, JobError
from ..model.evidence.run import sha256_file
from ..model.storage import StorageError, writing
from ..stage import confined, family, plain, sandbox
from ..stage.confined import ENDLESS_CPU_S
from ..stage.sandbox.confinement import Confinement, environment
from ..stage.sandbox.enter import enter
from ..stamp import keyring, signing
from .drive_folder import BEGINNING, BEGUN, DRIVES, GIVEN, LIVE, Begun
from .live_source import LiveSource
from .offered_commands import offered
from .witness import Witness

if TYPE_CHECKING:
    import numpy as np

    from worldengine.inputs.commands import Command

BEGIN_S = 120.0
FAREWELL_S = 30.0
SPEEDS = (0.01, 100.0)
LONGEST_S = 100_000.0
FILE_BYTES, MEMORY_BYTES = 8 << 30, 12 << 30
"""Of one file that the engine writes, and of its address space."""


class LiveWorld:
    """Begins a drive in a new folder of the run, and steps its world until `close`, or until it ends by itself.

    Args:
        source: the world.
        speed: simulated seconds in a second.
        seconds: simulated seconds at most.
        waits: stand still until the first command.
        folder: of the drive; one named by the time of day without it.

    Attributes:
        commands: what may be commanded.
        witness: writes down who drives, and vouches for what is left.
        newest: (facts, state). Facts: `step`, `time_s`, `factor` (simulated seconds in the last second), `overruns`, `worst_s`,
            `lost_s`, `waits`, `silent` (commands whose failsafe acts), `commands`; `ended` once it has. The state is a vector of
            `worldengine.clock.state_frames.PARTS`.

    Raises:
        GateError: the plan declares nothing to drive, or the world is no longer what was stamped.
        JobError: the engine did not begin, or nothing confines it here.
        StorageError: the folder cannot be written.
    """

    def __init__(
        self,
        source: LiveSource,
        speed: float = 1.0,
        seconds: float = LONGEST_S,
        waits: bool = True,
        folder: Path | None = None,
    ) -> None:
        self.source, self.speed = source, speed
        self.commands: tuple[Command, ...] = offered(source.model, source.plan, source.given, source.drove)
        self.folder = folder or source.run.folder / DRIVES / datetime.now(UTC).strftime("%Y%m%dT%H%M%S.%f")[:-3]
        self.begun = datetime.now(UTC).isoformat(timespec="milliseconds")
        self._newest: tuple[dict[str, Any], np.ndarray | None] = ({}, None)
        self.told: list[Callable[[], object]] = []
        """They are called, on another thread, when there is a newer state, and at the end."""
        self._level = sandbox.level()
        if not confined.allowed(self._level):
            raise JobError(
                "no level of the sandbox confines here, and a world's file may be anybody's",
                code="refused",
                place=str(source.run.folder),
                next_move="worldwright doctor; or WORLDWRIGHT_SANDBOX=rlimits, for a world that you trust",
            )
        self._lay()
        self._pending: dict[str, Any] = {}
        self._lock, self._wake, self._over, self._first = (
            threading.Lock(), threading.Event(), threading.Event(), threading.Event(),
        )  # fmt: skip
        self._start(seconds, waits)
        if not self._first.wait(BEGIN_S) or (not self.facts and self._over.is_set()):
            cause = self._failure() or self._log_end() or "the engine did not begin"
            self.close()
            raise JobError(
                f"the engine did not begin: {cause}", place=str(source.run.folder), next_move="worldwright doctor"
            )

    def _lay(self) -> None:
        with writing("the drive", self.folder):
            self.folder.mkdir(parents=True)
            source = self.source
            for name, path in (
                ("world.mjz", source.world),
                ("plan.md", source.plan_file),
                ("facts.json", source.facts / "program.json"),
                ("inputs.json", source.facts / "inputs.json"),
            ):
                shutil.copyfile(path, self.folder / name)
            write_json(self.folder / "commands.json", [row.written() for row in self.commands])
            (self.folder / BEGINNING).mkdir()
            files = {name: sha256_file(self.folder / name) for name in GIVEN}
            for name, digest in source.digests.items():
                if files[name] != digest:
                    shutil.rmtree(self.folder, ignore_errors=True)
                    raise GateError(
                        f"{name} changed while the drive began: it is not what was "
                        f"{'stamped' if source.stamp_sha256 else 'recorded'}",
                        place=str(source.run.folder),
                        next_move=f"worldwright stamp status {source.run.folder}",
                    )
            said = Begun(
                drive=self.folder.name, run=source.run.name, stamp_sha256=source.stamp_sha256, speed=self.speed,
                begun_at=self.begun, files=files,
            )  # fmt: skip
            write_json(self.folder / BEGUN, said.model_dump(mode="json"))
            # Whoever holds it lets nobody prove the drive meanwhile; the engine holds it, too, until its last row is written.
            self._held = (self.folder / BEGUN).open("rb")
            try_lock.taken(self._held.fileno())
            self.witness = Witness(self.folder, files, self.source.doubt)
        if self.source.doubt:
            return
        with suppress(signing.SigningError, StorageError):  # then the end is not signed either
            signing.sign(self.folder / BEGINNING, Path(BEGUN).name, keyring.own())

    def _start(self, seconds: float, waits: bool) -> None:
        """Start the engine, confined as every pass is: it sees this world and writes what it records, and has this one socket."""
        ours, theirs = socket.socketpair()
        self._room = tempfile.TemporaryDirectory(prefix="worldwright-live-", ignore_cleanup_errors=True)
        out, scratch, token = self.folder / LIVE, Path(self._room.name), family.new_token()
        out.mkdir()
        files = {"world": "world.mjz", "program": "facts.json", "inputs": "inputs.json", "commands": "commands.json"}
        given = {name: self.folder.absolute() / file for name, file in files.items()}
        if self.source.drove is not None:
            given["replay"] = self.source.drove.resolve()
        words = ["live", *(word for name, path in given.items() for word in (f"--{name}", str(path)))]
        words += ["--out", str(out.absolute()), "--socket", str(theirs.fileno())]
        words += ["--speed", repr(float(self.speed)), "--seconds", repr(float(seconds))]
        words += ["--waits"] if waits else []
        confinement = Confinement(
            out=out.absolute(), reads=tuple(given.values()), scratch=scratch, cpu_s=ENDLESS_CPU_S,
            file_bytes=FILE_BYTES, memory_bytes=MEMORY_BYTES, token=token, processes=16, threads=128,
            environment=environment(str(scratch)),
        )  # fmt: skip
        with theirs, (self.folder / "engine.log").open("wb") as log:
            self._entered = enter(
                sandbox.LADDER[self._level], call(words), confinement, stdout=log, stderr=log,
                descriptors=(theirs.fileno(), self._held.fileno()),
            )  # fmt: skip
        self._process, self._token, self._socket = self._entered.process, token, ours
        for work in (self._hear, self._say):
            threading.Thread(target=work, name=f"live{work.__name__}", daemon=True).start()

    def command(self, values: dict[str, float]) -> None:
        """Send commands: names of `commands`, finite numbers; only the newest of each matters."""
        with self._lock:
            self._pending = {**self._pending, "values": {**self._pending.get("values", {}), **values}}
        self._wake.set()

    def left(self) -> None:
        """Let the failsafes act at once."""
        with self._lock:
            self._pending = {"left": True}
        self._wake.set()

    @property
    def newest(self) -> "tuple[dict[str, Any], np.ndarray | None]":
        """The facts and the state that belong together."""
        return self._newest

    @property
    def facts(self) -> dict[str, Any]:
        """The facts of the newest state."""
        return self._newest[0]

    @property
    def over(self) -> bool:
        """Whether it has ended."""
        return self._over.is_set()

    def wait(self, seconds: float) -> bool:
        """Wait so long for its end; whether it has ended."""
        return self._over.wait(seconds)

    def close(self) -> int:
        """End the drive, and wait until it is recorded; returns the engine's exit status. Of one without a step nothing is kept."""
        with suppress(OSError):
            self._socket.shutdown(socket.SHUT_WR)
        try:
            status = self._process.wait(FAREWELL_S)
        except subprocess.TimeoutExpired:
            family.end(self._process.pid, self._token)
            status = self._process.wait()
        family.sweep(self._token)
        self._over.wait(FAREWELL_S)
        self._wake.set()
        self._socket.close()
        self._held.close()
        self._room.cleanup()
        self.witness.ended()
        if not self.facts.get("step"):
            self.witness.close()
            shutil.rmtree(self.folder, ignore_errors=True)
        return status

    def _hear(self) -> None:
        from worldengine.clock.state_frames import READS, Frames

        frames = Frames()
        with suppress(OSError, ValueError):
            while data := self._socket.recv(READS):
                for newest in frames.take(data):
                    self._newest = newest
                    self._first.set()
                for call_back in self.told:
                    call_back()
        self._over.set()
        self._first.set()
        if "ended" not in self.facts and self.facts:
            self._newest = ({**self.facts, "ended": self._failure() or "the engine ended"}, self._newest[1])
        for call_back in self.told:
            call_back()

    def _say(self) -> None:
        import json

        while not self._over.is_set():
            self._wake.wait()
            self._wake.clear()
            with self._lock:
                said, self._pending = self._pending, {}
            if said:
                with suppress(OSError):
                    self._socket.sendall(json.dumps(said).encode() + b"\n")

    def _failure(self) -> str:
        return str(plain.read_json(self.folder / LIVE / "error.json").get("message", ""))

    def _log_end(self) -> str:
        with suppress(OSError):
            lines = (self.folder / "engine.log").read_text(encoding="utf-8", errors="replace").split("\n")
            return next((line[:300] for line in reversed(lines) if line.strip()), "")
        return ""


def call(words: list[str]) -> list[str]:
    """The command line of an engine's process."""
    return [sys.executable, "-s", "-P", "-m", "worldengine", *words]
