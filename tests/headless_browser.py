"""Headless Chromium with one page, spoken to by its DevTools protocol, for what only a browser shows of a page."""

import contextlib
import itertools
import json
import shutil
import subprocess
import time
import urllib.request
from pathlib import Path

from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

PATIENCE_S = 60.0


def installed() -> str:
    """The program, where this machine has it; else empty. One from a snap sees no home of ours, and shows no page."""
    found = map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))
    return next((program for program in found if program and not _of_a_snap(Path(program))), "")


def _of_a_snap(program: Path) -> bool:
    """Whether it only leads into a snap, as a link or as a short script."""
    real = program.resolve()
    if real.is_relative_to("/snap") or real.name == "snap":
        return True
    with real.open("rb") as file:
        start = file.read(4096)
    return start.startswith(b"#!") and b"/snap/bin" in start


class Browser:
    """Headless Chromium with one page, spoken to by its DevTools protocol."""

    def __init__(self, program: str, address: str, home: str) -> None:
        words = ["--headless=new", "--no-sandbox", "--disable-gpu", "--mute-audio", "--remote-debugging-port=0"]
        self.process = subprocess.Popen(
            [program, *words, f"--user-data-dir={home}", address], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL
        )
        try:
            self._socket = self._reached(home)
        except BaseException:
            self._end()
            raise
        self._numbers = itertools.count(1)

    def _reached(self, home: str) -> ClientConnection:
        """Its one page, spoken to."""
        port = _until(lambda: (Path(home) / "DevToolsActivePort").read_text().split()[0])
        listed = f"http://127.0.0.1:{port}/json"
        told = _until(lambda: next(one for one in json.load(urllib.request.urlopen(listed)) if one["type"] == "page"))
        return connect(told["webSocketDebuggerUrl"], max_size=None).__enter__()

    def do(self, method: str, **what: object) -> dict:
        """Call a method of the protocol; its result."""
        number = next(self._numbers)
        self._socket.send(json.dumps({"id": number, "method": method, "params": what}))
        while (said := json.loads(self._socket.recv(timeout=PATIENCE_S))).get("id") != number:
            pass
        return said.get("result", {})

    def value(self, script: str) -> object:
        """What a line of JavaScript comes to."""
        return self.do("Runtime.evaluate", expression=script, returnByValue=True)["result"].get("value")

    def press(self, key: str) -> None:
        """Hold a key down on the page."""
        self.do("Emulation.setFocusEmulationEnabled", enabled=True)
        self.do("Input.dispatchKeyEvent", type="rawKeyDown", code=key, key=key)

    def close(self) -> None:
        """End it."""
        with contextlib.suppress(ConnectionClosed, TimeoutError):  # it may be gone before it answers
            self.do("Browser.close")
        self._end()

    def _end(self) -> None:
        try:
            self.process.wait(PATIENCE_S if hasattr(self, "_socket") else 0)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()


def _until(found):
    end = time.monotonic() + PATIENCE_S
    while True:
        try:
            return found()
        except (OSError, IndexError, ValueError, StopIteration):
            if time.monotonic() > end:
                raise
            time.sleep(0.1)
