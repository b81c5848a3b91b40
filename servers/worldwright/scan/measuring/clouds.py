"""What is made of many points, over time: a crowd of bodies, the surface of a soft body, the points that an author's law moves."""

from collections.abc import Sequence

import numpy as np

from ...model.recording.trajectory import Trajectory
from .channels import group
from .solids import skin

Array = np.ndarray


def cloud(trajectory: Trajectory, parts: str | Sequence[str], rows: slice | Sequence[int] | Array) -> Array:
    """(R, n, 3) m, world frame, at these rows: of a medium its points, of a solid flex its surface, else the origins of bodies.

    Raises:
        NotFoundError: nothing has this name; the message lists what there is.
    """
    chosen = np.arange(len(trajectory.t))[rows] if isinstance(rows, slice) else np.asarray(rows, dtype=int)
    if isinstance(parts, str) and parts in trajectory.media.names:
        lay = trajectory.media.of(parts)
        return np.stack([lay.at(float(time)) for time in trajectory.t[chosen]])
    flexes = trajectory.meta.get("flexes") or ()
    if any(row.get("name") == parts and "shell" in row for row in flexes):
        return skin(trajectory, str(parts), chosen)[0]
    return np.asarray(trajectory.pos[chosen][:, group(trajectory, parts)])
