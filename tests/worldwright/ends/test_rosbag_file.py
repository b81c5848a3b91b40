"""A recording as a bag of ROS 2, read back by the package that others read bags with."""

import pytest

from small_worlds import ball, empty, floor, record
from worldwright.ends import rosbag_file
from worldwright.model.errors import NotFoundError

pytest.importorskip("rosbags", reason="the extra `ros` is not installed")


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    spec = empty()
    floor(spec)
    ball(spec, "a ball", (0, 0, 2))
    return record(spec, tmp_path_factory.mktemp("ball") / "recording", 200)


def test_a_bag_is_read_back_with_every_message_in_its_order(recording, tmp_path):
    from rosbags.rosbag2 import Reader
    from rosbags.typesys import Stores, get_typestore

    folder, store = tmp_path / "new/recording.bag", get_typestore(Stores.ROS2_JAZZY)
    count = rosbag_file.write(recording, folder, plan=b"# A plan")
    assert rosbag_file.write(recording, folder, plan=b"# A plan") == count, "a bag is replaced"
    assert sorted(path.name for path in folder.iterdir()) == ["metadata.yaml", "plan.md", "recording.bag.mcap"]
    assert [path.name for path in folder.parent.iterdir()] == ["recording.bag"]
    with Reader(folder) as reader:
        rows = [(row.topic, ns, store.deserialize_cdr(data, row.msgtype)) for row, ns, data in reader.messages()]
        hashes = {row.topic: row.digest for row in reader.connections}
    assert len(rows) == count and hashes["/clock"] == store.hash_rihs01("rosgraph_msgs/msg/Clock")
    assert {topic for topic, *_ in rows} == {"/clock", "/tf", "/odom/a_ball"}
    assert [ns for topic, ns, _ in rows if topic == "/clock"] == [round(t * 40e6) for t in range(5)] + [200_000_000]
    for topic, ns, message in rows:
        if topic == "/odom/a_ball":
            assert message.pose.pose.position.z == recording.pos[round(ns / 1e6), 0, 2]
            assert message.header.stamp.sec * 10**9 + message.header.stamp.nanosec == ns


def test_what_is_no_bag_is_not_replaced(recording, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/metadata.yaml").write_text("title: of something else\n")
    with pytest.raises(NotFoundError, match="no bag"):
        rosbag_file.write(recording, tmp_path / "mine")
    with pytest.raises(NotFoundError, match="rows a second"):
        rosbag_file.write(recording, tmp_path / "bag", rate_hz=-1)
    assert [path.name for path in tmp_path.iterdir()] == ["mine"]
