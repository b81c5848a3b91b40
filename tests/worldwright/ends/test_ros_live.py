"""A live world on a ROS 2 network: told to and driven by another vendor's peers, in the right units, until they are gone."""

import contextlib
import math
import shutil
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

pytest.importorskip("cyclonedds", reason="the extra `ros` is not installed")
pytest.importorskip("rosbags", reason="the extra `ros` is not installed")

from click.testing import CliRunner

import dds_peers
from dds_peers import Peer
from small_worlds import empty, floor
from worldengine.clock.state_frames import signature
from worldengine.inputs.commands import PEDALS, Command
from worldkit import vehicles
from worldwright import live
from worldwright.ends import ros_drivers
from worldwright.ends.ros_live import RosAsked, RosEnd, own_domain
from worldwright.ends.seats import Seats
from worldwright.model.errors import NotFoundError

fast_dds = pytest.mark.skipif(bool(dds_peers.missing()), reason=dds_peers.missing())


def until(true):
    end = time.monotonic() + dds_peers.PATIENCE_S
    while not (found := true()):
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.02)
    return found


class Parked:
    """A car that stands, as a live world shows it; what is commanded is only noted."""

    def __init__(self):
        spec = empty(time_step=0.002)
        floor(spec)
        vehicles.add(spec, vehicles.Car(), name="car", look=None)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self.source = SimpleNamespace(model=self.model, given=SimpleNamespace(visual_only=()))
        rows = [Command(f"car.{pedal}", car="car", pedal=pedal) for pedal in PEDALS]
        self.commands, self.sent, self.lefts = (*rows, Command("pull", control=0)), [], 0
        self.stand(0.0, 0.0)
        self.seats = Seats([row.name for row in self.commands], self.sent.append, self.left, lambda: 0.0)

    def left(self):
        self.lefts += 1

    def stand(self, time_s, speed):
        self.data.time, self.data.qvel[0] = time_s, speed
        state = np.zeros(mujoco.mj_stateSize(self.model, signature()))
        mujoco.mj_getState(self.model, self.data, state, signature())
        self.newest = ({"time_s": time_s}, state)


@pytest.fixture
def parked():
    return Parked()


@fast_dds
def test_it_is_told_and_driven_by_one_at_a_time(parked, monkeypatch):
    monkeypatch.setattr(ros_drivers, "SILENT_S", math.inf)  # a busy machine may keep a peer silent for long
    monkeypatch.setattr(ros_drivers, "BARRED_S", 0.1)
    with dds_peers.domain() as number, contextlib.ExitStack() as left:
        end = RosEnd(parked, parked.seats, RosAsked("sedan", number, lidar=True), "car")
        left.callback(end.close)
        ada, bob = Peer(number, "ada"), Peer(number, "bob")
        for peer in (ada, bob):
            left.callback(peer.close)
        for topic in ("rt/drive", "rt/cmd_vel", "rt/command/pull"):
            ada.wait(f"matched {topic} ")
            bob.wait(f"matched {topic} ")
        until(lambda: dds_peers.met(end._node, drive=2, cmd_vel=2, command__pull=2))
        until(lambda: {"/ada", "/bob"} <= set(end._node._nodes.copy().values()))
        # Told: the clock of the world, where the car is, how fast, and where its lidar stands; the node by its name.
        parked.stand(2.5, 3.0)
        until(lambda: ada.ask("clock") == ["2", "500000000"])
        until(lambda: float(ada.ask("odom")[-1]) == pytest.approx(3.0))
        assert ada.ask("odom")[0] == "car" and float(ada.ask("odom")[1]) == pytest.approx(parked.data.qpos[0])
        until(lambda: "car>car/lidar" in ada.ask("still"))
        assert any(name.startswith("/sedan:") for name in until(lambda: ada.ask("nodes")))
        # Driven: radians become degrees, and a twist the pedals that make up for the speed.
        ada.say(f"drive {math.pi / 12} 0.5 0.25")
        until(lambda: parked.sent)
        assert parked.sent[0] == pytest.approx({"car.steering": 15.0, "car.throttle": 0.5, "car.brake": 0.25})
        assert parked.seats.driver.name == "/ada"
        ada.say("twist 5 0")
        until(lambda: len(parked.sent) == 2)
        assert parked.sent[1]["car.throttle"] > 0.1 and parked.sent[1]["car.brake"] == 0.0
        # The second is refused, and told why; so is what is no number.
        bob.say("command 0.5")
        until(lambda: "/bob: /ada drives, you watch" in " ".join(bob.ask("refused")))
        ada.say("twist nan 0")
        until(lambda: "/ada: car.steering, car.throttle, car.brake: no finite number" in " ".join(bob.ask("refused")))
        assert len(parked.sent) == 2 and "[30 sedan]" in " ".join(bob.ask("refused"))
        # A flood of another's takes nothing from who drives.
        bob.say("flood 2000")
        ada.say("drive 0 0.125 0")
        until(lambda: len(parked.sent) == 3)
        assert parked.sent[2]["car.throttle"] == 0.125 and parked.seats.driver.name == "/ada"
        bob.ask("clock")  # answered when the flood is over, which would take a wheel that is free
        # A driver that is killed is silent, and the wheel is free.
        ada.process.kill()
        monkeypatch.setattr(ros_drivers, "SILENT_S", 0.5)
        until(lambda: parked.lefts == 1 and parked.seats.driver is None)
        monkeypatch.setattr(ros_drivers, "SILENT_S", math.inf)
        # It may have been shown the door for its flood, of which the rest is still on the way.
        until(lambda: bob.say("command 0.5") or parked.sent[-1] == {"pull": 0.5})
        assert parked.seats.driver.name == "/bob" and end.problem == ""


@fast_dds
def test_a_world_is_driven_over_the_network_and_proves_who_drove(roped, tmp_path):
    run = tmp_path / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    with dds_peers.domain() as number, contextlib.ExitStack() as left:
        words = [
            sys.executable,
            "-m",
            "worldwright.cli",
            "live",
            str(run),
            "--no-pictures",
            "--ros",
            "--ros-domain",
            str(number),
        ]
        process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        left.callback(process.kill)
        assert process.stdout.readline().startswith("http://")
        assert f"/worldwright in domain {number} on the loopback interface" in process.stdout.readline()
        peer = Peer(number, "teleop")
        left.callback(peer.close)
        peer.wait("matched rt/command/pull 1")
        peer.wait("matched rt/clock 1")

        def driven():
            peer.say("command 0.2")
            return peer.ask("clock")

        until(lambda: driven()[0] not in ("-1", "0") or int(driven()[1]) > 300_000_000)
        process.send_signal(signal.SIGINT)
        told, heard = process.communicate(timeout=dds_peers.PATIENCE_S)
    assert process.returncode == 0, heard
    assert "driven by /teleop" in told and "ROS 2, participant" in told and "bit for bit" in told


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        (["--ros-lidar"], "--ros-lidar does nothing without --ros"),
        (["--ros", "--ros-node", "a b"], "no name of a node"),
        (["--ros", "--no-pictures", "--ros-images", "raw"], "no pictures to publish"),
    ],
)
def test_what_the_network_cannot_be_asked_is_told_before_anything_is_driven(roped, tmp_path, words, cause):
    run = tmp_path / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    found = CliRunner().invoke(live.command, [str(run), "--no-pictures", *words], env={"ROS_DOMAIN_ID": "99"})
    assert found.exit_code == 2 and cause in found.output and "next: " in found.output
    assert not list(run.glob("drives/*"))


def test_the_domain_is_that_of_the_environment(monkeypatch):
    monkeypatch.delenv("ROS_DOMAIN_ID", raising=False)
    assert own_domain() == 0
    monkeypatch.setenv("ROS_DOMAIN_ID", "17")
    assert own_domain() == 17
    for wrong in ("x", "-1", "233", "1.5"):
        monkeypatch.setenv("ROS_DOMAIN_ID", wrong)
        with pytest.raises(NotFoundError, match="which is no domain"):
            own_domain()
