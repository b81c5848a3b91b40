"""The shape of a body made of parts, apart from where it is and how it is turned."""

import numpy as np
from pydantic import Field, model_validator

from ...model.recording.trajectory import Trajectory
from ..measuring.channels import Channel, distance, group, tendon
from ..measuring.measured import Name, UnknowableError, Windowed, one_of

Array = np.ndarray
MOST_ROWS = 400


class OfShape(Windowed):
    """Something that can be deformed."""

    parts: str | tuple[Name, ...] | None = Field(None, description="a flex, a pattern such as `rope_*`, or bodies; or")
    tendon: Name | None = Field(None, description="a tendon; or")
    bodies: tuple[Name, Name] | None = Field(None, description="two bodies, whose distance counts")

    @model_validator(mode="after")
    def _one(self) -> "OfShape":
        one_of(self, "parts", "tendon", "bodies")
        return self


def strain(trajectory: Trajectory, given: OfShape, rows: slice) -> tuple[Array, Channel]:
    """Numbers of some rows, the last one always, and the deformation there, relative to the size at the first row.

    For parts: the root mean square distance from the first shape after the best rigid motion (Kabsch's algorithm),
    divided by the radius of gyration. For a length: |L - L0| / L0.
    """
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    if given.parts is None:
        length = tendon(trajectory, given.tendon) if given.tendon else distance(trajectory, *(given.bodies or ("", "")))
        values = length.values[chosen]
        if values[0] <= 0:
            raise UnknowableError(f"{length.name} has no length at the start")
        return chosen, Channel(np.abs(values - values[0]) / values[0], "1", length.name)
    bodies = group(trajectory, given.parts)
    if len(bodies) < 3:
        raise UnknowableError("a shape needs at least three parts", next_move="name more parts, or two `bodies`")
    points = trajectory.pos[chosen][:, bodies]
    points = points - points.mean(axis=1, keepdims=True)
    first = points[0]
    size = float(np.sqrt((first**2).sum(axis=1).mean()))
    if size <= 0:
        raise UnknowableError("all parts are in one place at the start")
    left, _, right = np.linalg.svd(np.einsum("pi,tpj->tij", first, points))
    sign = np.sign(np.linalg.det(left @ right))
    left[:, :, 2] *= sign[:, None]
    aligned = np.einsum("pi,tij->tpj", first, left @ right)
    off = np.sqrt(((points - aligned) ** 2).sum(axis=2).mean(axis=1)) / size
    name = given.parts if isinstance(given.parts, str) else ", ".join(given.parts[:3])
    return chosen, Channel(off, "1", name)
