"""Draw one quantity of some bodies over time."""

import io
from collections.abc import Callable
from typing import Any, Literal

import numpy as np

from worldkit.turning import matrices

from ...model.errors import NotFoundError
from ...model.recording.trajectory import Trajectory
from .marking import Mark

Quantity = Literal["height", "speed", "spin", "tilt", "position", "energy", "contact_force", "penetration"]
PALETTE = ("#2a6fdb", "#d1495b", "#2e9e6b", "#b07d1a", "#7a4fc0", "#1795a8", "#c2588f", "#5f6b7a")
INK, GRID, ALARM = "#22272e", "#dfe3e8", "#c81e3a"

QUANTITIES: dict[str, tuple[str, Callable[[Trajectory, int], np.ndarray] | None]] = {
    "height": ("height of the origin (m)", lambda t, b: t.pos[:, b, 2]),
    "speed": ("speed (m/s)", lambda t, b: t.speed[:, b]),
    "spin": ("angular speed (rad/s)", lambda t, b: t.spin[:, b]),
    "tilt": ("tilt of the own z axis (deg)", lambda t, b: _tilt(t, b)),
    "position": ("distance from the start (m)", lambda t, b: np.linalg.norm(t.pos[:, b] - t.pos[0, b], axis=1)),
    "energy": ("energy (J)", None),
    "contact_force": ("contact force (N)", None),
    "penetration": ("deepest contact (mm)", None),
}


def draw(
    trajectory: Trajectory,
    quantity: Quantity,
    bodies: tuple[str, ...],
    window_s: tuple[float, float] | None,
    mark: Mark | None = None,
) -> bytes:
    """Draw one quantity as PNG; without `bodies`, of those that move most (at most eight). A `mark` shows a finding in it.

    Raises:
        NotFoundError: an unknown body, or a channel that was not recorded.
    """
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    rows = trajectory.rows(*window_s) if window_s else trajectory.rows()
    label, lines = _lines(trajectory, quantity, bodies)
    style = {
        "font.size": 11,
        "axes.edgecolor": INK,
        "text.color": INK,
        "axes.labelcolor": INK,
        "font.family": "DejaVu Sans",
    }
    with pyplot.rc_context(style):
        figure, axes = pyplot.subplots(figsize=(9, 4.2), dpi=110)
        t = trajectory.t[rows]
        for (name, values), colour in zip(lines, PALETTE * 4, strict=False):
            axes.plot(t, values[rows], color=colour, linewidth=1.8, label=name)
        _mark_contacts(axes, trajectory, rows)
        if mark is not None:
            _mark_finding(axes, mark)
        axes.set_xlabel("time (s)")
        axes.set_ylabel(label)
        axes.set_xlim(float(t[0]), float(max(t[-1], t[0] + 1e-6)))
        axes.grid(color=GRID, linewidth=0.8)
        axes.set_axisbelow(True)
        for side in ("top", "right"):
            axes.spines[side].set_visible(False)
        if len(lines) > 1 or quantity != "energy" or mark is not None:
            axes.legend(frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
        figure.tight_layout()
        buffer = io.BytesIO()
        figure.savefig(buffer, format="png", metadata={"Software": None})
        pyplot.close(figure)
    return buffer.getvalue()


def _lines(trajectory: Trajectory, quantity: str, bodies: tuple[str, ...]) -> tuple[str, list[tuple[str, np.ndarray]]]:
    label, of_body = QUANTITIES[quantity]
    if quantity == "energy":
        if trajectory.energy is None:
            raise NotFoundError("no energy was recorded", next_move="record with the energy flag, or plot the speed")
        potential, kinetic = trajectory.energy[:, 0], trajectory.energy[:, 1]
        return label, [("kinetic", kinetic), ("potential", potential), ("total", potential + kinetic)]
    indices = [trajectory.index(name) for name in bodies] or _liveliest(trajectory)
    names = [trajectory.names[i] if i >= 0 else "ground" for i in indices]
    if of_body is not None:
        return label, [(n, of_body(trajectory, i)) for n, i in zip(names, indices, strict=True) if i >= 0]
    if trajectory.contacts is None or trajectory.depth_m is None:
        return label, _without_contacts(trajectory, quantity, names, indices)
    lines = []
    for name, index in zip(names, indices, strict=True):
        if quantity == "penetration":
            lines.append((name, trajectory.depth_m[:, index] * 1000))
            continue
        force = np.zeros(len(trajectory.t))
        contacts = trajectory.contacts
        mine = (contacts.body1 == index) | (contacts.body2 == index)
        np.add.at(force, contacts.row[mine], contacts.normal_force[mine])
        lines.append((name, force))
    return label, lines


def _without_contacts(
    trajectory: Trajectory, quantity: str, names: list[str], indices: list[int]
) -> list[tuple[str, np.ndarray]]:
    """What an interchange file tells about contacts: the sum of forces on each body, the deepest contact of all."""
    if quantity == "contact_force" and trajectory.contact_force_sum is not None:
        sums = trajectory.contact_force_sum
        return [(name, sums[:, i]) for name, i in zip(names, indices, strict=True) if i >= 0]
    if quantity == "penetration" and trajectory.max_penetration is not None:
        return [("deepest of all", trajectory.max_penetration * 1000)]
    raise NotFoundError("no contacts were recorded", next_move="plot the height or the speed")


def _tilt(trajectory: Trajectory, body: int) -> np.ndarray:
    axis = matrices(trajectory.quat[:, body])[:, :, 2]
    return np.degrees(np.arccos(np.clip(axis @ axis[0], -1, 1)))


def _mark_finding(axes: Any, mark: Mark) -> None:
    """Mark a finding: its stretch as a band, its threshold as a dashed line, its numbers above the plot."""
    start, end = mark.window_s
    if end > start:
        axes.axvspan(start, end, color=ALARM, alpha=0.12, linewidth=0, label="finding")
    for edge in {start, end}:
        axes.axvline(edge, color=ALARM, linewidth=1.0)
    if mark.threshold is not None:
        axes.axhline(mark.threshold, color=ALARM, linewidth=1.4, linestyle=(0, (5, 3)), label="threshold")
    axes.set_title(f"{mark.title}\n{mark.note}", loc="left", fontsize=11, color=INK)


def _liveliest(trajectory: Trajectory) -> list[int]:
    far = np.linalg.norm(trajectory.pos - trajectory.pos[:1], axis=2).max(axis=0)
    return [int(i) for i in np.argsort(-far)[:8]]


def _mark_contacts(axes: object, trajectory: Trajectory, rows: slice) -> None:
    """Mark on the time axis where a contact between moving bodies begins."""
    contacts = trajectory.contacts
    if contacts is None or not len(contacts.row):
        return
    live = contacts.take(contacts.live)
    touched = np.zeros(len(trajectory.t), dtype=bool)
    touched[live.row] = True
    begins = np.flatnonzero(touched & ~np.concatenate(([False], touched[:-1])))
    begins = begins[(begins >= rows.start) & (begins < rows.stop)]
    if 0 < len(begins) <= 60:
        for row in begins:
            axes.axvline(trajectory.t[row], color=GRID, linewidth=1.2, zorder=0)
