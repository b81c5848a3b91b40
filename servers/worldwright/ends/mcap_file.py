"""A recording as an MCAP file in ROS 2's messages and encoding (CDR), for Foxglove, `ros2 bag` and whatever reads bags (extra `mcap`).

Its topics are those of `ros_rows`. The plan is attached, and the metadata `worldwright` names the trajectory's hash.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from ..model.errors import NotFoundError
from .ros_messages import definition
from .ros_rows import in_order

if TYPE_CHECKING:
    from worldengine.recording.stored import Recording


def write(
    recording: "Recording", path: Path, *, rate_hz: float = 25.0, plan: bytes = b"", film: Path | None = None
) -> int:
    """Write the file; returns how many messages it holds.

    Args:
        recording: what was recorded.
        path: of the file, written whole or not at all.
        rate_hz: rows a simulated second; 0 tells every recorded row.
        plan: its text.
        film: of a plan's camera, whose name is the file's.

    Raises:
        NotFoundError: the extra is not installed, the rate makes no sense, or the film cannot be read.
    """
    import tempfile

    from worldkit.files import write_atomic

    try:
        from mcap_ros2.writer import Writer
    except ImportError as cause:
        raise NotFoundError(
            "mcap-ros2-support is not installed", place="extra `mcap`", next_move='pip install "worldwright[mcap]"'
        ) from cause
    with tempfile.TemporaryFile() as room:
        writer, schemas, count = Writer(room), {}, 0
        for ns, topic, kind, message in in_order(recording, rate_hz, film):
            if kind not in schemas:
                schemas[kind] = writer.register_msgdef(kind, definition(kind))
            writer.write_message(topic, schemas[kind], message, log_time=ns, publish_time=ns, sequence=count)
            count += 1
        if plan:
            writer.add_attachment(0, 0, "plan.md", "text/markdown", plan)
        told = {"trajectory_sha256": recording.sha256, "simulator": f"mujoco {recording.meta['simulator']['version']}"}
        writer.add_metadata("worldwright", told)
        writer.finish()
        room.seek(0)
        write_atomic(path, room.read())
    return count
