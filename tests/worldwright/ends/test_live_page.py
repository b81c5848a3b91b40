"""The page holds its own against its peers: who floods, who reads nothing, who watches and meddles with the driver's picture."""

import contextlib
import json
import socket
import time
from types import SimpleNamespace

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from worldwright.ends import live_page
from worldwright.ends.live_page import LivePage
from worldwright.ends.seats import Seats
from worldwright.model.errors import NotFoundError

PATIENCE_S = 60.0


def until(true):
    end = time.monotonic() + PATIENCE_S
    while not true():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.01)


class Stage:
    """A page whose world stands still, and whose pictures are only bytes."""

    def __init__(self):
        run = SimpleNamespace(name="still")
        self.world = SimpleNamespace(
            facts={"time_s": 1.0}, commands=(), over=False, told=[], speed=1.0, source=SimpleNamespace(run=run)
        )
        self.pictures = SimpleNamespace(
            cameras=("chase", "side"), camera="", wanted=False, problem="", made=[], jpeg=(1, b"\xff" * 500_000)
        )
        self.notes = []
        self.seats = Seats(
            (), lambda values: None, lambda: None, lambda: 0.0, lambda *told: self.notes.append(told), lambda: 0.0
        )
        self.page = LivePage(self.world, self.seats, self.pictures)

    def peer(self, name):
        return connect(f"{self.page.address.replace('http', 'ws')}stream?name={name}", max_queue=None)


@pytest.fixture
def stage():
    made = Stage()
    yield made
    made.page.close()


def hear(peer, kind):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        said = peer.recv(timeout=PATIENCE_S)
        if isinstance(said, bytes):
            said = json.dumps({"kind": "picture"})
        if (found := json.loads(said))["kind"] == kind:
            return found
    raise AssertionError(f"no {kind}")


def say(peer, **message):
    peer.send(json.dumps(message))


def deaf(page):
    """A peer that asks for pictures and never reads a byte."""
    host, port = page.address[7:].rstrip("/").split(":")
    found = socket.create_connection((host, int(port)))
    found.sendall(
        f"GET /stream?name=Eve HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: MDEyMzQ1Njc4OWFiY2RlZg==\r\nSec-WebSocket-Version: 13\r\n\r\n".encode()
    )
    words = json.dumps({"kind": "pictures", "on": True}).encode()
    found.sendall(bytes([0x81, 0x80 | len(words), 0, 0, 0, 0]) + words)
    return found


def test_the_camera_is_the_drivers_and_what_stops_the_pictures_is_told(stage):
    with stage.peer("Ada") as ada, stage.peer("Bob") as bob:
        until(lambda: len(stage.seats.taken) == 2 and stage.seats.driver)
        driver, watcher = (ada, bob) if stage.seats.driver.name == "Ada" else (bob, ada)
        say(driver, kind="camera", name="side")
        until(lambda: stage.pictures.camera == "side")
        say(watcher, kind="camera", name="chase")
        assert "chooses the camera" in hear(watcher, "refused")["cause"] and stage.pictures.camera == "side"
        say(driver, kind="camera", name="top")
        assert "no camera top" in hear(driver, "refused")["cause"] and stage.pictures.camera == "side"
        say(driver, kind="release")
        until(lambda: stage.seats.driver is None)
        say(watcher, kind="camera", name="chase")
        until(lambda: stage.pictures.camera == "chase")
        stage.pictures.problem = "no more pictures: the graphics are gone"
        until(lambda: hear(watcher, "state")["no_pictures"] == stage.pictures.problem)


def test_pictures_come_to_who_asks_while_he_asks(stage):
    with stage.peer("Ada") as ada:
        say(ada, kind="pictures", on=True)
        until(lambda: stage.pictures.wanted)
        for call_back in stage.pictures.made:
            call_back()
        hear(ada, "picture")
        say(ada, kind="pictures", on=False)
        until(lambda: not stage.pictures.wanted)


@pytest.mark.parametrize("kind", ["camera", "pictures"])
def test_whatever_floods_is_shown_the_door(stage, kind):
    with stage.peer("Ada") as ada, contextlib.suppress(ConnectionClosed):
        for _ in range(300):
            say(ada, kind=kind, name="side", on=False)
    until(lambda: any("more than 200" in more.get("cause", "") for _, more in stage.notes))
    until(lambda: not stage.seats.taken)


def test_who_reads_nothing_is_cut_off_and_keeps_the_wheel_no_longer(stage, monkeypatch):
    monkeypatch.setattr(live_page, "MOST_BEHIND_S", 0.3)
    eve = deaf(stage.page)
    until(lambda: stage.pictures.wanted and stage.seats.driver)
    until(lambda: [call_back() for call_back in stage.pictures.made] and stage.seats.driver is None)
    assert (stage.notes[-1][0], stage.notes[-1][1]["name"]) == ("left", "Eve")
    eve.close()


def test_a_page_closes_on_a_peer_that_reads_nothing(stage, monkeypatch):
    monkeypatch.setattr(live_page, "FAREWELL_S", 0.3)
    eve = deaf(stage.page)
    until(lambda: stage.pictures.wanted)
    (guest,) = stage.page._guests.values()
    until(lambda: [call_back() for call_back in stage.pictures.made] and guest.behind)
    stage.page.close()
    assert not stage.page._thread.is_alive() and not stage.seats.taken
    eve.close()


def test_whatever_is_wrong_with_an_address_is_told(stage):
    with pytest.raises(NotFoundError, match="cannot be listened on"):
        LivePage(stage.world, stage.seats, None, host="a" * 70, token="x")
