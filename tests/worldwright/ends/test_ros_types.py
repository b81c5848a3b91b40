"""Messages as bytes: as Cyclone's own serializer writes them, whole again when read, and nothing else when they are none."""

import string

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from worldwright.ends import ros_messages
from worldwright.ends.ros_types import DRIVE, Types, UnreadableError, mangled

pytest.importorskip("rosbags", reason="the extra `ros` is not installed")
pytest.importorskip("cyclonedds", reason="the extra `ros` is not installed")

TYPES = Types()
ODOMETRY = "nav_msgs/msg/Odometry"


def test_hashes_and_names_are_those_of_ros():
    # As `ros2 topic info --verbose` of a Jazzy installation tells them.
    assert (
        TYPES.hash("std_msgs/msg/String") == "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    )
    assert mangled(ODOMETRY) == "nav_msgs::msg::dds_::Odometry_"


@given(
    st.text(string.printable, max_size=9),
    st.lists(st.floats(allow_nan=False), min_size=36, max_size=36),
    st.integers(0, 2**31 - 1),
)
@settings(deadline=None, max_examples=30)
def test_a_message_is_read_as_it_was_written(frame, numbers, sec):
    message = {
        "header": {"stamp": {"sec": sec, "nanosec": 7}, "frame_id": frame},
        "pose": {"pose": {"orientation": {"w": numbers[0]}}, "covariance": numbers},
    }
    found = TYPES.decode(ODOMETRY, TYPES.encode(ODOMETRY, message))
    assert (found.header.stamp.sec, found.header.frame_id, found.child_frame_id) == (sec, frame, "")
    assert found.pose.pose.orientation.w == numbers[0] and found.pose.pose.position.x == 0.0
    assert found.pose.covariance.tolist() == numbers and not found.twist.covariance.any()


def test_bytes_are_those_of_cyclones_own_serializer():
    """Another implementation of CDR: the types that go over the network are taken apart by it, field by field."""
    from dataclasses import fields

    types = Types()

    def other(struct, value):
        made = {}
        for row in fields(struct):
            part = getattr(value, row.name)
            inner = types._structs.get(getattr(part, "__msgtype__", ""))
            made[row.name] = other(inner, part) if inner else part.tolist() if isinstance(part, np.ndarray) else part
        return struct(**made)

    for kind, message in (
        (ODOMETRY, {"child_frame_id": "wheel", "twist": {"twist": {"angular": {"z": 3.5}}, "covariance": range(36)}}),
        (
            "sensor_msgs/msg/LaserScan",
            {"header": {"frame_id": "abc"}, "ranges": [1.5, float("inf")], "range_max": 60.0},
        ),
        ("sensor_msgs/msg/CompressedImage", {"format": "jpeg", "data": b"\xff\xd8\x00"}),
        ("sensor_msgs/msg/JointState", {"name": ["a", "bcd"], "position": [1.0, 2.0]}),
        (DRIVE, {"steering": -0.25, "throttle": 1.0}),
    ):
        data = types.encode(kind, message)
        struct = types._struct(kind)
        written = struct.__idl__.serialize(other(struct, types.decode(kind, data)), use_version_2=False)
        assert bytes(written) == data, kind


@given(st.binary(max_size=60))
@settings(deadline=None)
def test_bytes_that_are_no_message_are_told(data):
    for kind in (DRIVE, "std_msgs/msg/String", "sensor_msgs/msg/JointState"):
        try:
            TYPES.decode(kind, data)
        except UnreadableError as refused:
            assert kind in str(refused)


def test_a_field_that_there_is_not_is_an_error():
    with pytest.raises(KeyError, match="Drive has no speed"):
        TYPES.encode(DRIVE, {"speed": 1.0})


def test_the_definitions_in_a_bag_are_those_of_ros():
    from rosbags.typesys import get_types_from_msg

    for kind in ros_messages.MESSAGES:
        for name, fields in get_types_from_msg(ros_messages.definition(kind), kind).items():
            assert fields[1] == TYPES.store.fielddefs[name][1], name
