"""A recording as MCAP, read back by the packages that others read such files with."""

import click.testing
import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, record
from worldwright.ends import mcap_file, ros_messages, ros_rows
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.storage import StorageError

pytest.importorskip("mcap", reason="the extra `mcap` is not installed")
pytest.importorskip("mcap_ros2", reason="the extra `mcap` is not installed")


@pytest.fixture(scope="module")
def recording(tmp_path_factory):
    """A ball that flies and spins over a shelf, and a door that a motor opens, 0.5 s."""
    spec = empty()
    floor(spec)
    ball(spec, "a ball", (0, 0, 2))
    spec.worldbody.add_body(name="shelf", pos=(1, 0, 0.5)).add_geom(size=(0.1, 0, 0))
    door = spec.worldbody.add_body(name="door", pos=(0, 2, 1))
    door.add_joint(name="hinge", axis=(0, 0, 1))
    door.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.4, 0.02, 0.9), pos=(0.4, 0, 0))
    spec.add_actuator(name="opener", target="hinge", trntype=mujoco.mjtTrn.mjTRN_JOINT)

    def thrown(_, data):
        data.joint("a ball").qvel[:] = (1.0, 0.5, 2.0, 0.0, 3.0, 1.0)

    def control(_, data):
        data.ctrl[0] = 5.0 * data.time

    rows = (("control", frozenset({"opener"})),)
    return record(spec, tmp_path_factory.mktemp("door") / "recording", 500, control, rows=rows, before=thrown)


@pytest.fixture(scope="module")
def told(recording, tmp_path_factory):
    path = tmp_path_factory.mktemp("mcap") / "recording.mcap"
    count = mcap_file.write(recording, path, plan=b"# A plan")
    return path, count, messages(path)


def messages(path):
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    with path.open("rb") as stream:
        reader = make_reader(stream, decoder_factories=[DecoderFactory()])
        return [
            (channel.topic, schema, message, body) for schema, channel, message, body in reader.iter_decoded_messages()
        ]


def of(told, topic):
    return [(message.log_time, body) for name, _, message, body in told[2] if name == topic]


def test_the_mcap_package_reads_every_message_in_its_order(told):
    _, count, found = told
    times = [message.log_time for _, _, message, _ in found]
    assert len(found) == count and times == sorted(times)
    assert {(name, schema.name, schema.encoding) for name, schema, *_ in found} == {
        ("/clock", "rosgraph_msgs/msg/Clock", "ros2msg"),
        ("/tf", "tf2_msgs/msg/TFMessage", "ros2msg"),
        ("/tf_static", "tf2_msgs/msg/TFMessage", "ros2msg"),
        ("/joint_states", "sensor_msgs/msg/JointState", "ros2msg"),
        ("/odom/a_ball", "nav_msgs/msg/Odometry", "ros2msg"),
        ("/control/opener", "std_msgs/msg/Float64", "ros2msg"),
    }
    assert len(of(told, "/clock")) == 14  # 25 a second from 0 to 0.48 s, and the end
    assert all(time == body.clock.sec * 10**9 + body.clock.nanosec for time, body in of(told, "/clock"))


def test_poses_and_joints_are_those_of_the_recording(told, recording):
    for time, body in of(told, "/tf"):
        row = round(time / 1e6)
        assert [one.child_frame_id for one in body.transforms] == ["a ball", "door"]
        place, turn = body.transforms[0].transform.translation, body.transforms[1].transform.rotation
        assert (place.x, place.y, place.z) == tuple(recording.pos[row, 0])
        assert (turn.w, turn.x, turn.y, turn.z) == tuple(recording.quat[row, recording.body("door")])
    ((_, still),) = of(told, "/tf_static")
    assert [one.child_frame_id for one in still.transforms] == ["shelf"] and still.transforms[
        0
    ].header.frame_id == "world"
    for time, body in of(told, "/joint_states"):
        row = round(time / 1e6)
        assert list(body.name) == ["hinge"]
        assert (body.position[0], body.velocity[0]) == (recording.qpos[row, 7], recording.qvel[row, 6])
    assert [body.data for _, body in of(told, "/control/opener")] == list(recording.ctrl[[*range(0, 500, 40), 500], 0])


def test_an_odometry_has_its_twist_in_the_bodys_own_frame(told, recording):
    time, body = of(told, "/odom/a_ball")[5]
    row = round(time / 1e6)
    assert (body.header.frame_id, body.child_frame_id) == ("world", "a ball")
    # MuJoCo has the spin of a loose body in its own frame, too.
    spin = body.twist.twist.angular
    assert (spin.x, spin.y, spin.z) == pytest.approx(tuple(recording.qvel[row, 3:6]), abs=1e-9)
    speed = body.twist.twist.linear
    assert np.hypot(np.hypot(speed.x, speed.y), speed.z) == pytest.approx(np.linalg.norm(recording.qvel[row, :3]))
    assert abs(speed.z - recording.qvel[row, 2]) > 0.1


def test_plan_and_hash_go_with_it(told, recording):
    from mcap.reader import make_reader

    with told[0].open("rb") as stream:
        reader = make_reader(stream)
        assert reader.get_header().profile == "ros2"
        ((name, data),) = [(one.name, one.data) for one in reader.iter_attachments()]
        (metadata,) = list(reader.iter_metadata())
    assert (name, bytes(data)) == ("plan.md", b"# A plan")
    assert metadata.metadata["trajectory_sha256"] == recording.sha256


def test_every_row_can_be_told_and_nonsense_is_refused(recording, tmp_path):
    assert ros_rows.chosen_rows(recording, 0) == list(range(501))
    with pytest.raises(NotFoundError, match="rows a second"):
        mcap_file.write(recording, tmp_path / "a.mcap", rate_hz=-1)
    with pytest.raises(NotFoundError, match="no film"):
        mcap_file.write(recording, tmp_path / "a.mcap", film=tmp_path / "side.mp4")
    assert not (tmp_path / "a.mcap").exists()


def test_a_film_is_told_frame_by_frame(recording, tmp_path):
    import cv2

    from worldengine.film.encode import Video

    with Video(tmp_path / "side.mp4", 64, 48, 10) as film:
        for shade in (0, 60, 120, 180, 240):
            film.add(np.full((48, 64, 3), shade, np.uint8))
    mcap_file.write(recording, tmp_path / "a.mcap", film=tmp_path / "side.mp4")
    pictures = [
        (time.log_time, body) for name, _, time, body in messages(tmp_path / "a.mcap") if name == "/camera/side"
    ]
    assert [time for time, _ in pictures] == [0, 100_000_000, 200_000_000, 300_000_000, 400_000_000]
    shades = [cv2.imdecode(np.frombuffer(bytes(body.data), np.uint8), 1).mean() for _, body in pictures]
    assert shades == pytest.approx([0, 60, 120, 180, 240], abs=12)


def test_names_become_topics():
    assert [ros_rows.topic(name) for name in ("ball", "2nd ball", "käse/x")] == ["ball", "_2nd_ball", "k_se_x"]


def test_two_names_never_become_one_topic(tmp_path):
    assert ros_rows.topics(["a b", "a_b", "a_b_2", "a/b"]) == ["a_b", "a_b_3", "a_b_2", "a_b_4"]
    spec = empty()
    for number, name in enumerate(("a ball", "a_ball")):
        ball(spec, name, (0, number, 2))
        joint = spec.worldbody.add_body(name=f"wing {number}", pos=(3, number, 2)).add_joint(name=f"hinge {number}")
        spec.body(f"wing {number}").add_geom(size=(0.1, 0, 0))
        spec.add_actuator(name=name, target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    mcap_file.write(record(spec, tmp_path / "recording", 3), tmp_path / "a.mcap", rate_hz=0)
    found = [(name, body) for name, _, _, body in messages(tmp_path / "a.mcap")]
    for kind in ("odom", "control"):
        assert [len([1 for name, _ in found if name == f"/{kind}/a_ball{end}"]) for end in ("", "_2")] == [4, 4]
    assert {body.child_frame_id for name, body in found if name == "/odom/a_ball_2"} == {"a_ball"}


def test_a_definition_has_each_part_once():
    text = ros_messages.definition("nav_msgs/msg/Odometry")
    assert text.count("MSG: geometry_msgs/Vector3\n") == 1 and text.count("MSG: std_msgs/Header\n") == 1
    with pytest.raises(KeyError):
        ros_messages.definition("std_msgs/msg/String")


def test_the_command_names_its_formats():
    from worldwright.exported import command

    shown = click.testing.CliRunner().invoke(command, ["--help"]).output
    assert "gltf|usd|mcap" in shown and "--pictures" in shown


def test_a_run_is_exported_with_its_plan(recording, tmp_path, monkeypatch):
    from mcap.reader import make_reader

    from worldwright import exported
    from worldwright.model.evidence.run import Run
    from worldwright.stage import gates, one_frame

    (tmp_path / "plan.md").write_text("# The plan of a door")
    (tmp_path / "simulation.py").write_text("")
    monkeypatch.setattr(one_frame, "recorded", lambda run, key: recording.folder.parent)
    (recording.folder.parent / "trajectory").symlink_to(recording.folder)
    path = exported.write(Run(tmp_path), "mcap", rate_hz=10)
    assert path == tmp_path / "recording.mcap" and len([1 for name, *_ in messages(path) if name == "/clock"]) == 6
    with path.open("rb") as stream:
        assert [bytes(one.data) for one in make_reader(stream).iter_attachments()] == [b"# The plan of a door"]
    with pytest.raises(StorageError):  # a folder stands where the file is to lie
        exported.write(Run(tmp_path), "mcap", tmp_path)
    bag = exported.write(Run(tmp_path), "rosbag2", rate_hz=10)
    assert bag == tmp_path / "recording.bag" and (bag / "plan.md").read_text() == "# The plan of a door"
    video, filmed = {"summary": {"cameras": ["side"], "film": {}}}, {}
    monkeypatch.setattr(gates, "passed", lambda run, key, stage: filmed.get(stage))
    with pytest.raises(GateError, match="as they would be drawn now"):
        exported.write(Run(tmp_path), "mcap", camera="side")
    filmed["video"] = video
    with pytest.raises(NotFoundError, match=r"no film side\.mp4"):
        exported.write(Run(tmp_path), "mcap", camera="side")
    for name in ("film", "../side"):
        with pytest.raises(NotFoundError, match="name one of: side"):
            exported.write(Run(tmp_path), "mcap", camera=name)
    for words, option in (({"camera": "side"}, "--pictures"), ({"rate_hz": 0.0}, "--rate")):
        with pytest.raises(NotFoundError, match=f"{option} does nothing to usd"):
            exported.write(Run(tmp_path), "usd", **words)
