"""A recording as tables: a zip of CSV files, one for each body that moves and all that hangs on it, so one for each robot.

A loose body has one, and what is fixed to the world and has joints: an arm on its stand, a door.

    t_s, x_m, y_m, z_m, qw, qx, qy, qz, vx_m_s, vy_m_s, vz_m_s, wx_rad_s, wy_rad_s, wz_rad_s,
    then of each hinge or slide its position and its rate (rad or m; NAME, NAME_rate), of each actuator its control (NAME_control)

Places and velocities are those of the body's origin in the world. Joints and actuators are called as in the robot's own file.
"""

import csv
import io
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING

from .ros_rows import chosen_rows

if TYPE_CHECKING:
    import numpy as np

    from worldengine.recording.stored import Recording

OF_BODY = [
    "t_s",
    "x_m",
    "y_m",
    "z_m",
    "qw",
    "qx",
    "qy",
    "qz",
    "vx_m_s",
    "vy_m_s",
    "vz_m_s",
    "wx_rad_s",
    "wy_rad_s",
    "wz_rad_s",
]


def write(
    recording: "Recording", path: Path, *, rate_hz: float = 25.0, plan: bytes = b"", film: Path | None = None
) -> int:
    """Write the zip; returns how many tables it holds.

    Args:
        recording: what was recorded.
        path: of the file, written whole or not at all.
        rate_hz: rows a simulated second; 0 tells every recorded row.
        plan: its text, laid beside the tables.
        film: is not told here.

    Raises:
        NotFoundError: the rate makes no sense.
    """
    from worldkit.files import write_atomic

    del film
    rows, room = chosen_rows(recording, rate_hz), io.BytesIO()
    root = _roots(recording)
    tops = sorted(set(root.values()))
    with zipfile.ZipFile(room, "w") as file:
        for body in tops:
            name = recording.names[body]
            heads, columns = _table(recording, rows, body, {own for own, top in root.items() if top == body})
            text = io.StringIO()
            table = csv.writer(text, lineterminator="\n")
            table.writerow(heads)
            table.writerows([f"{value:.9g}" for value in row] for row in columns)
            file.writestr(zipfile.ZipInfo(f"{name.replace('/', '_')}.csv"), text.getvalue(), zipfile.ZIP_DEFLATED)
        if plan:
            file.writestr(zipfile.ZipInfo("plan.md"), plan)
    write_atomic(path, room.getvalue())
    return len(tops)


def _roots(recording: "Recording") -> dict[int, int]:
    """Each moving body's topmost one beneath the world, which carries it or is it. Parents come before what they carry."""
    number = {name: index for index, name in enumerate(recording.names)}
    found: dict[int, int] = {}
    for index, row in enumerate(recording.meta["bodies"]):
        parent = number.get(row["parent"])
        found[index] = index if parent is None else found[parent]
    moving = {found[index] for index, row in enumerate(recording.meta["bodies"]) if row["joints"]}
    return {index: top for index, top in found.items() if top in moving}


def _table(recording: "Recording", rows: list[int], body: int, own: set[int]) -> "tuple[list[str], np.ndarray]":
    """The heads and the numbers (rows, columns) of one table."""
    import numpy as np

    names, prefix = {recording.names[index] for index in own}, f"{recording.names[body]}_"
    heads = list(OF_BODY)
    parts = [
        np.asarray(recording.time)[rows][:, None],
        *(values[rows, body] for values in (recording.pos, recording.quat, recording.linvel, recording.angvel)),
    ]
    for joint in recording.meta["joints"]:
        if joint["type"] in ("hinge", "slide") and joint["body"] in names:
            called = joint["name"].removeprefix(prefix)
            heads += [called, f"{called}_rate"]
            parts += [
                recording.qpos[rows, joint["qpos_address"]][:, None],
                recording.qvel[rows, joint["dof_address"]][:, None],
            ]
    for index, actuator in enumerate(recording.meta["actuators"][: recording.meta["sizes"]["nu"]]):
        if names.intersection(actuator["bodies"]):
            heads.append(f"{actuator['name'].removeprefix(prefix)}_control")
            parts.append(recording.ctrl[rows, index][:, None])
    return heads, np.hstack(parts)
