"""A world that lives: driven over its page, by one at a time; what was driven is kept, also by a kill, and proves itself again."""

import contextlib
import json
import os
import shutil
import signal
import time
import urllib.error
import urllib.request

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from worldengine.recording import stored
from worldwright.ends import driven
from worldwright.ends.driven import finish, prove
from worldwright.ends.live_page import LivePage
from worldwright.ends.live_source import LiveSource
from worldwright.ends.live_world import LiveWorld
from worldwright.ends.offered_commands import offered
from worldwright.ends.seats import Seats
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.plan.declared_inputs import Intervention

PATIENCE_S = 60.0


def until(true, seconds=PATIENCE_S):
    end = time.monotonic() + seconds
    while not (found := true()):
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.01)
    return found


class Peer:
    """A page without a browser."""

    def __init__(self, page, name, **more):
        self.number = 0
        self.socket = connect(
            f"{page.address.replace('http', 'ws')}stream?name={name}", max_queue=None, **more
        ).__enter__()
        self.world = self.hear("world")

    def hear(self, kind, true=lambda said: True):
        end = time.monotonic() + PATIENCE_S
        while time.monotonic() < end:
            said = json.loads(self.socket.recv(timeout=PATIENCE_S))
            if said["kind"] == kind and true(said):
                return said
        raise AssertionError(f"no {kind}")

    def drive(self, **values):
        self.number += 1
        self.socket.send(json.dumps({"kind": "drive", "n": self.number, "values": values}))


@pytest.fixture
def run(roped, seal, tmp_path):
    """A run whose plan is patient: a stall of the machine that tests it is no silence."""
    run = tmp_path / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    plan = (run / "plan.md").read_text()
    for place in (run, run / "accepted"):
        (place / "plan.md").write_text(plan.replace("bodies: [pull]\n", "bodies: [pull]\n    live: {timeout_s: 120}\n"))
    seal(run)
    return run


@contextlib.contextmanager
def served(world, **more):
    seats = Seats(["pull"], world.command, world.left, lambda: world.facts.get("time_s", 0.0), world.witness.note)
    page = LivePage(world, seats, None, **more)
    try:
        yield page
    finally:
        world.close()
        page.close()


def flood(peer):
    """The code by which a peer that never stops talking is shown the door."""
    try:
        for _ in range(2000):
            peer.drive(pull=-0.25)
        while True:
            peer.socket.recv(timeout=PATIENCE_S)
    except ConnectionClosed as closed:
        return closed.rcvd and closed.rcvd.code


def moved(world):
    return world.newest[0]["commands"]["pull"]


def test_a_drive_over_its_page_is_kept_and_proved_whatever_its_peers_do(run):
    world = LiveWorld(LiveSource.find(run))
    with served(world) as page:
        ada = Peer(page, "Ada")
        assert [row["name"] for row in ada.world["commands"]] == ["pull"] and ada.world["commands"][0]["unit"] == "m/s"
        ada.hear("state", lambda said: said["you"] == "driver" and "pull" in said["silent"])
        until(lambda: ada.drive(pull=0.2) or moved(world) == 0.2)
        bob = Peer(page, "Bob")
        bob.drive(pull=-0.25)
        assert "Ada drives" in bob.hear("refused")["cause"]
        ada.drive(pull=float("nan"))
        assert "no finite number" in ada.hear("refused")["cause"]
        code = flood(bob)
        assert code in (None, 1008)  # None: the door was shut while it still talked
        until(lambda: "more than 200 messages in a second" in (world.folder / driven.EVENTS).read_text())
        until(lambda: ada.drive(pull=0.24) or moved(world) == 0.24)
        began = world.facts["time_s"]
        until(lambda: ada.drive(pull=0.24) or world.facts["time_s"] > began + 0.5)
        assert moved(world) == 0.24
        ada.socket.close()  # mid-drive, and at once: the plan names no failsafe, so the servo's command is 0
        until(lambda: moved(world) == 0.0 and "pull" in world.facts["silent"])
        until(lambda: world.facts["time_s"] > began + 0.7)
    assert world.over and world.facts["ended"] == "its driver's end was closed"
    found = finish(world.folder, world.witness)
    assert found.complete and found.rows > 5 and "signed by this machine's key" in found.signed
    (span,) = found.driven_by
    assert span["driver"] == "Ada" and 0 <= span["from_s"] < span["to_s"] < found.simulated_s
    recording = stored.open(world.folder / "physics/trajectory")
    assert {0.0, 0.2, 0.24} <= set(np.round(recording.ctrl[:, 0], 9).tolist()) and not recording.ctrl.min() < 0
    way = recording.pos[:, recording.body("trolley"), 0]
    assert recording.ctrl[-1, 0] == 0.0 and way[-1] - way[0] > 0.06
    assert prove(world.folder) == found and driven.find(run) == world.folder
    stream = world.folder / "stream/inputs.arrows"
    stream.write_bytes(stream.read_bytes()[:-9] + b"\0" * 9)
    with pytest.raises(GateError, match=r"inputs\.arrows is not what the statement lists"):
        prove(world.folder)


def test_steps_that_are_left_to_the_engine_are_the_same(run, seal):
    """Nothing drove this world before, so nothing can change between two looks at the clock."""
    (run / "accepted/world/inputs.arrows").unlink()
    seal(run)
    world = LiveWorld(LiveSource.find(run), speed=4.0, seconds=1.7)  # it stands still until the first command
    world.command({"pull": 0.1})
    assert world.wait(PATIENCE_S)
    world.close()
    assert moved(world) == 0.1
    found = finish(world.folder, world.witness)
    assert found.vouched and found.rows == found.rows_live > 10


def test_what_was_driven_outlives_a_kill(run):
    world = LiveWorld(LiveSource.find(run))
    with served(world) as page:
        ada = Peer(page, "Ada")
        states = world.folder / "live/trajectory/state.arrows"
        until(lambda: ada.drive(pull=0.2) or moved(world) == 0.2)
        size, at = states.stat().st_size, world.facts["time_s"]
        until(lambda: ada.drive(pull=0.2) or (states.stat().st_size > size and world.facts["time_s"] > at + 0.3))
        os.kill(world._process.pid, signal.SIGKILL)
        assert "ended" in ada.hear("ended") and world.wait(PATIENCE_S)
    found = finish(world.folder, world.witness)
    assert found.vouched, "the process that ran it outlived the engine, and saw what it left"
    assert not found.complete and "killed" in found.text() and found.simulated_s >= at
    recording = stored.open(world.folder / "physics/trajectory")
    assert recording.complete and recording.ctrl[-1, 0] == 0.2
    assert prove(world.folder).trajectory_sha256 == found.trajectory_sha256


def test_nobody_comes_in_from_another_page_or_under_another_name_or_without_the_token(run):
    world = LiveWorld(LiveSource.find(run))
    with pytest.raises(NotFoundError, match="loopback"):
        LivePage(world, None, None, host="0.0.0.0")
    with served(world, token="s3cret") as page:
        assert page.address.endswith("?token=s3cret")
        bare = page.address.partition("?")[0]
        with urllib.request.urlopen(page.address) as answer:
            assert (
                b"<title>Live world" in answer.read()
                and "frame-ancestors 'none'" in answer.headers["Content-Security-Policy"]
            )
        stream = bare.replace("http", "ws") + "stream"
        for address, more in (
            (stream, {}),
            (f"{stream}?token=guess", {}),
            (f"{stream}?token=s3cret", {"origin": "http://evil.example"}),
        ):
            with pytest.raises(InvalidStatus) as refused:
                connect(address, **more).__enter__()
            assert refused.value.response.status_code == 403
        with connect(f"{stream}?token=s3cret", origin=bare.rstrip("/")) as socket:
            assert json.loads(socket.recv(timeout=PATIENCE_S))["kind"] == "world"
    with served(LiveWorld(LiveSource.find(run))) as page:
        asked = urllib.request.Request(page.address, headers={"Host": "evil.example:80"})
        with pytest.raises(urllib.error.HTTPError, match="403"):
            urllib.request.urlopen(asked)
        with pytest.raises(NotFoundError, match="cannot be listened on"):
            LivePage(world, None, None, port=int(page.address.rstrip("/").rpartition(":")[2]))


def test_the_plan_says_what_acts_in_silence(run):
    source = LiveSource.find(run)
    plan = source.plan.model_dump(mode="json")
    plan["simulation_parameters"]["interventions"][0]["live"] = {"failsafe": 0.1, "timeout_s": 2.0, "ends_after_s": 9.0}
    told = type(source.plan).model_validate(plan)
    (row,) = offered(source.model, told, source.given, source.drove)
    assert (row.failsafe, row.timeout_s, row.ends_after_s) == (0.1, 2.0, 9.0) and row.high == pytest.approx(0.25)
    plan["simulation_parameters"]["interventions"][0]["live"] = None
    (row,) = offered(source.model, type(source.plan).model_validate(plan), source.given, source.drove)
    assert row.failsafe == 0.0 and row.timeout_s == 0.5
    for wrong in (
        {"kind": "force", "live": {}},
        {"kind": "control", "live": {"failsafe": "fly"}},
        {"kind": "control", "live": {"timeout_s": 0}},
    ):
        with pytest.raises(ValueError, match="live"):
            Intervention.model_validate({"bodies": ["x"], "law": "1", "source": "y", **wrong})


def test_without_a_control_there_is_nothing_to_drive(run):
    source = LiveSource.find(run)
    given = type(source.given)(**{**vars(source.given), "inputs": ()})
    with pytest.raises(GateError, match="nothing to drive"):
        offered(source.model, source.plan, given, None)
