"""What the driver of a plan that follows a path would do in the recorded states: the plan's own, whatever the program's does.

A driver knows nothing but the state and where on its course it last was, so that the recording tells what it did. Of a surveyed
road, whose place in the world is resolved, nothing is told here.
"""

from types import SimpleNamespace
from typing import Any

import numpy as np

from worldkit.turning import matrices
from worldkit.vehicles.path_following import Course, Driver

from ...model.plan.vehicle_rows import Vehicle
from ...model.recording.trajectory import Trajectory

MOST_ROWS = 40_000
"""A driver is asked at so many recorded instants, evenly spread; between them what it does goes in a line. Asked every 75 ms, an
honest one seems to steer otherwise: its aim goes on by whole points of the course."""
Known = list[tuple[float, dict[str, float]]]


def commands(vehicle: Vehicle, name: str, trajectory: Trajectory) -> Known:
    """(time in s, what is given then) of a vehicle that follows a path; empty of any other, and where it is not recorded."""
    way = vehicle.follows
    if way is None or not way.path or name not in trajectory.names:
        return []
    driver = Driver(
        vehicle.made(), Course(way.path, closed=way.closed), top_m_s=way.speed_m_s, across_m_s2=way.across_m_s2,
        faster_m_s2=way.faster_m_s2, slower_m_s2=way.slower_m_s2,
    )  # fmt: skip
    body = trajectory.index(name)
    rows = np.arange(0, len(trajectory.t), max(len(trajectory.t) // MOST_ROWS, 1))
    turns = matrices(np.asarray(trajectory.quat[rows, body], float))
    found: Known = []
    for row, turn in zip(rows.tolist(), turns, strict=True):
        state: Any = _State(float(trajectory.t[row]), trajectory.pos[row, body], turn, trajectory.linvel[row, body])
        found.append((state.time, dict(vars(driver.commands(state, name)))))
    return found


class _State:
    """A recorded state of one vehicle, as its driver asks for it of an MjData."""

    def __init__(self, time: float, pos: np.ndarray, turn: np.ndarray, linvel: np.ndarray) -> None:
        self.time = time
        self._body = SimpleNamespace(xpos=np.asarray(pos, float), xmat=turn.reshape(-1))
        self._joint = SimpleNamespace(qvel=np.asarray(linvel, float))

    def body(self, name: str) -> SimpleNamespace:  # noqa: ARG002 (as of an MjData)
        return self._body

    def joint(self, name: str) -> SimpleNamespace:  # noqa: ARG002
        return self._joint
