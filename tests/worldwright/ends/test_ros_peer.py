"""ROS 2 as another vendor's DDS speaks it (eProsima Fast DDS): found, matched, and every message whole, both ways."""

import contextlib
import time

import pytest

pytest.importorskip("cyclonedds", reason="the extra `ros` is not installed")
pytest.importorskip("rosbags", reason="the extra `ros` is not installed")

import dds_peers
from dds_peers import Peer
from worldwright.ends import ros_node
from worldwright.ends.ros_node import RosNode
from worldwright.model.errors import NotFoundError

ROUNDS = 1000
TWIST, ODOMETRY = "geometry_msgs/msg/Twist", "nav_msgs/msg/Odometry"
fast_dds = pytest.mark.skipif(bool(dds_peers.missing()), reason=dds_peers.missing())


def value(number, field):
    return number * 0.125 + field * 1000.5


def name(number):
    return chr(ord("a") + number % 26) * (number % 9)


def odometry(number):
    """What the peer reckons of the same number."""
    fields = [value(number, field) for field in range(85)]
    xyz = lambda first: dict(zip("xyz", fields[first : first + 3], strict=True))  # noqa: E731
    turn = dict(zip("xyzw", fields[3:7], strict=True))
    return {
        "header": {"stamp": {"sec": number, "nanosec": 7 * number}, "frame_id": name(number)},
        "child_frame_id": name(number + 5),
        "pose": {"pose": {"position": xyz(0), "orientation": turn}, "covariance": fields[7:43]},
        "twist": {"twist": {"linear": xyz(43), "angular": xyz(46)}, "covariance": fields[49:85]},
    }


def spin_until(node, true):
    end = time.monotonic() + dds_peers.PATIENCE_S
    while not (found := true()):
        assert time.monotonic() < end, "it never came true"
        node.spin(0.05)
    return found


@fast_dds
def test_a_thousand_messages_go_each_way_whole_and_both_sides_know_each_other(monkeypatch):
    monkeypatch.setenv(
        "CYCLONEDDS_URI", "<CycloneDDS><Domain><Discovery><Tag>elsewhere</Tag></Discovery></Domain></CycloneDDS>"
    )
    with dds_peers.domain() as number, contextlib.ExitStack() as left:
        node = RosNode("worldwright", number)
        left.callback(node.close)
        pong, got, wrong = node.publisher("/pong", ODOMETRY), [], []

        def answer(message, sender):
            numbers = [getattr(part, axis) for part in (message.linear, message.angular) for axis in "xyz"]
            if numbers != [value(len(got), field) for field in range(6)]:
                wrong.append(message)
            got.append(sender)
            pong.send(odometry(len(got) - 1))

        node.subscribe("/ping", TWIST, answer)
        node.subscribe("/cmd_vel", TWIST, lambda message, sender: got.append(sender))
        node.announce()
        peer = Peer(number, "teleop")
        left.callback(peer.close)
        for topic in ("rt/ping 1", "rt/pong 1"):
            peer.wait(f"matched {topic} ")
        spin_until(node, lambda: pong.heard and dds_peers.met(node, ping=1, cmd_vel=1))
        since = len(peer.lines)
        peer.say(f"rounds {ROUNDS}")
        spin_until(node, lambda: len(got) >= ROUNDS and len(peer.lines) > since)
        assert peer.wait("rounds ", since) == f"rounds {ROUNDS} {ROUNDS} {ROUNDS}" and wrong == [] and pong.missed == 0
        # The peer knows the node by its name, with two readers and a writer, and the types by the hashes of ROS 2.
        spin_until(node, lambda: "/worldwright:2:1" in peer.ask("nodes"))
        peer.wait(f"found rt/pong nav_msgs::msg::dds_::Odometry_ typehash={node.types.hash(ODOMETRY)};")
        assert {sender.participant for sender in got} == node.present() and len(node.present()) == 1
        # What is no message of its type is not handed out, and what comes after it is.
        before = len(got)
        peer.say("rubbish 5")
        peer.say("twist nan 0.5")
        spin_until(node, lambda: len(got) > before)
        assert len(got) == before + 1
        spin_until(node, lambda: got[-1].node == "/teleop" or peer.say("twist 0 0"))
        peer.process.kill()
        assert node.present(), "a peer that is killed is missed only after its lease"


@fast_dds
def test_who_comes_later_gets_what_was_latched_and_who_leaves_is_lost():
    with dds_peers.domain() as number, contextlib.ExitStack() as left:
        node = RosNode("worldwright", number)
        left.callback(node.close)
        kind = "tf2_msgs/msg/TFMessage"
        frames = [{"header": {"frame_id": "world"}, "child_frame_id": f"frame {n}"} for n in range(2)]
        node.publisher("/tf_static", kind, latched=True, depth=1).send({"transforms": frames})
        node.subscribe("/cmd_vel", TWIST, lambda message, sender: None)
        node.announce()
        peer = Peer(number, "viewer")
        left.callback(peer.close)
        spin_until(node, lambda: " ".join(peer.ask("still")) == "world>frame 0 world>frame 1")
        spin_until(node, node.present)
        peer.process.stdin.close()  # it ends as it should
        spin_until(node, lambda: not node.present())


def test_a_node_leaves_its_domain_and_another_may_join():
    with dds_peers.domain() as number:
        for _ in range(2):
            node = RosNode("one", number)
            with pytest.raises(NotFoundError, match="cannot be joined"):
                RosNode("two", number)
            node.close()


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        ({"name": "a b"}, "no name of a node"),
        ({"name": "0"}, "no name"),
        ({"domain": 233}, "no domain"),
        ({"domain": -1}, "no domain"),
    ],
)
def test_what_is_no_node_is_told(words, cause):
    with pytest.raises(NotFoundError, match=cause) as told:
        RosNode(**words)
    assert told.value.next_move


def test_another_interface_than_loopback_is_only_by_name():
    plain, other = ros_node._configuration(""), ros_node._configuration('eth"0')
    assert '"127.0.0.1"' in plain and "<AllowMulticast>false" in plain and other.count("127.0.0.1") == 0
    assert "name='eth\"0'" in other and 'address="10.0.0.2"' in ros_node._configuration("10.0.0.2")
    with pytest.raises(NotFoundError, match="on no_such_interface"):
        RosNode("one", 3, "no_such_interface")
