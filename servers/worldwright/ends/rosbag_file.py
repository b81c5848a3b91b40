"""A recording as a folder that `ros2 bag` plays (rosbag2 with MCAP in it), in the topics of `ros_rows` (extra `ros`)."""

import shutil
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from ..model.errors import NotFoundError
from .ros_rows import in_order
from .ros_types import INSTALL, Types

if TYPE_CHECKING:
    from worldengine.recording.stored import Recording

VERSION: Final = 9


def write(
    recording: "Recording", folder: Path, *, rate_hz: float = 25.0, plan: bytes = b"", film: Path | None = None
) -> int:
    """Write the folder; returns how many messages it holds. One that lies there is replaced, if it is a bag.

    Args:
        recording: what was recorded.
        folder: of the bag, written whole or not at all.
        rate_hz: rows a simulated second; 0 tells every recorded row.
        plan: its text, put beside the messages as `plan.md`.
        film: of a plan's camera, whose name is the file's.

    Raises:
        NotFoundError: the extra is not installed, the rate makes no sense, a film cannot be read, or no bag lies there.
    """
    try:
        from rosbags.rosbag2 import StoragePlugin, Writer
    except ImportError as cause:
        raise NotFoundError("rosbags is not installed", place="extra `ros`", next_move=INSTALL) from cause
    if folder.exists() and not _is_bag(folder):
        raise NotFoundError(
            f"{folder} lies there, and is no bag", place=str(folder), next_move="name another folder with --out"
        )
    folder.parent.mkdir(parents=True, exist_ok=True)
    types, count, connections = Types(), 0, dict[str, Any]()
    with tempfile.TemporaryDirectory(prefix=".bag-", dir=folder.parent) as room:
        made = Path(room) / folder.name  # rosbags names its files after it
        with Writer(made, version=VERSION, storage_plugin=StoragePlugin.MCAP) as writer:
            for ns, topic, kind, message in in_order(recording, rate_hz, film):
                if topic not in connections:
                    connections[topic] = writer.add_connection(topic, kind, typestore=types.store)
                writer.write(connections[topic], ns, types.encode(kind, message))
                count += 1
            writer.set_custom_data("trajectory_sha256", recording.sha256)
        if plan:
            (made / "plan.md").write_bytes(plan)
        shutil.rmtree(folder, ignore_errors=True)
        made.rename(folder)
    return count


def _is_bag(folder: Path) -> bool:
    """Whether it is one: a `metadata.yaml` alone lies in many folders."""
    told = folder / "metadata.yaml"
    return told.is_file() and told.read_bytes().startswith(b"rosbag2_bagfile_information")
