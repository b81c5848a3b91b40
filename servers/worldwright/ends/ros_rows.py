"""A recording as messages of ROS 2 by topic, in the order of their times: what bags hold, and what a live world tells.

    /clock                rosgraph_msgs/Clock
    /tf, /tf_static       tf2_msgs/TFMessage: every body in `world`; those that stand fast once
    /joint_states         sensor_msgs/JointState of hinges and slides
    /odom/BODY            nav_msgs/Odometry of each loose body
    /control/NAME         std_msgs/Float64: what the control was given
    /camera/NAME          sensor_msgs/CompressedImage: a film of a plan's camera, if asked for

Times are simulated, from 0.
"""

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..model import mp4_file
from ..model.errors import NotFoundError
from .ros_messages import Told

if TYPE_CHECKING:
    from worldengine.recording.stored import Recording

QUALITY = 85
Row = tuple[int, str, str, dict[str, Any]]
"""Time, ns; topic; type; message."""


def chosen_rows(recording: "Recording", rate_hz: float) -> list[int]:
    """The rows nearest to each tick, and the last one; each once."""
    import numpy as np

    time = recording.time
    if not (0 <= rate_hz < 1e6):
        raise NotFoundError(f"{rate_hz:g} rows a second cannot be told", next_move="give a rate from 0 (every row) on")
    if not rate_hz:
        return list(range(len(time)))
    ticks = np.arange(time[0], time[-1] + 0.5 / rate_hz, 1 / rate_hz)
    after = np.clip(np.searchsorted(time, ticks), 0, len(time) - 1)
    before = np.maximum(after - 1, 0)
    nearest = np.where(np.abs(time[before] - ticks) <= np.abs(time[after] - ticks), before, after)
    return [int(row) for row in np.unique([*nearest, len(time) - 1])]


def in_order(recording: "Recording", rate_hz: float, film: Path | None) -> Iterator[Row]:
    """All messages in the order of their times.

    Args:
        recording: what was recorded.
        rate_hz: rows a simulated second; 0 tells every recorded row.
        film: of a plan's camera, whose name is the file's.

    Raises:
        NotFoundError: the rate makes no sense, or the film cannot be read.
    """
    from heapq import merge

    told = Told(recording)
    pictures = _pictures(told, film) if film is not None else iter(())
    return merge(_recorded(told, chosen_rows(recording, rate_hz)), pictures, key=lambda row: row[0])


def _recorded(told: Told, rows: list[int]) -> Iterator[Row]:
    if told.still and rows:
        yield told.ns(rows[0]), "/tf_static", "tf2_msgs/msg/TFMessage", told.transforms(rows[0], told.still)
    yield from states(told, rows)


def states(told: Told, rows: list[int]) -> Iterator[Row]:
    """What is told of each of these rows."""
    odometries = dict(zip(told.loose, topics(told.frames[body] for body in told.loose), strict=True))
    controls = topics(told.controls)
    for row in rows:
        ns = told.ns(row)
        yield ns, "/clock", "rosgraph_msgs/msg/Clock", told.clock(row)
        yield ns, "/tf", "tf2_msgs/msg/TFMessage", told.transforms(row, told.moving)
        if told.joints:
            yield ns, "/joint_states", "sensor_msgs/msg/JointState", told.joint_state(row)
        for body in told.loose:
            yield ns, f"/odom/{odometries[body]}", "nav_msgs/msg/Odometry", told.odometry(row, body)
        for control, name in enumerate(controls):
            yield ns, f"/control/{name}", "std_msgs/msg/Float64", told.control(row, control)


def _pictures(told: Told, film: Path) -> Iterator[Row]:
    """The frames of a film of a plan's camera: frame k shows the world at k / fps."""
    import cv2

    with mp4_file.opened(film) as reader:
        stream = reader.streams.video[0]
        fps = float(stream.average_rate or 0)
        for number, frame in enumerate(reader.decode(stream) if fps > 0 else ()):
            ns, picture = round(number / fps * 1e9), frame.to_ndarray(format="bgr24")
            data = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, QUALITY])[1].tobytes()
            name = f"/camera/{topic(film.stem)}"
            yield ns, name, "sensor_msgs/msg/CompressedImage", told.picture(ns, data, film.stem)


def topic(name: str) -> str:
    """A name as a part of a topic: letters, digits and underscores, not beginning with a digit."""
    plain = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in name)
    return f"_{plain}" if plain[:1].isdigit() else plain


def topics(names: Iterable[str]) -> list[str]:
    """Names as parts of topics, no two alike: of those that would become one, the second ends with `_2`, and so on."""
    found: dict[str, None] = {}
    wanted = [topic(name) for name in names]
    for plain in wanted:
        own, number = plain, 1
        while own in found or (number > 1 and own in wanted):
            number += 1
            own = f"{plain}_{number}"
        found[own] = None
    return list(found)
