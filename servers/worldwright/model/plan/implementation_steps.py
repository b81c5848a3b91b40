"""Section `implementation_steps`: what is built in which order, what should move, and the cameras that it is reviewed by."""

from collections.abc import Mapping, Sequence

from pydantic import Field

from ..frozen import Frozen
from .observation import REFERENCE_VIEW, ImageObservation
from .scene_objects import Vec3


class CameraRow(Frozen):
    """A camera: a named view of its subjects, or an explicit position and target."""

    name: str
    view: str | None = None
    """A camera template, e.g. `perspective`, `side_minus_y`, `top_down`."""
    subjects: tuple[str, ...] = ()
    """Objects to frame; empty: everything that moves."""
    position: Vec3 | None = None
    target: Vec3 | None = None
    fovy: float = Field(40.0, gt=1, lt=170)
    """Vertical field of view, degrees."""
    follow: bool = False
    """Keep the subjects centred as they move, instead of framing all the space they cross."""


class Step(Frozen):
    """One implementation step."""

    description: str
    assets: tuple[str, ...] = ()
    scene_objects: tuple[str, ...] = ()
    cameras: tuple[CameraRow | str, ...] = ()
    """Cameras to review the step by; a plain string is a view template and names the camera too."""
    motion_expectations: tuple[str, ...] = ()
    """Objects that are expected to move."""


def seen_as_in_image(
    rows: tuple[CameraRow, ...], observed: ImageObservation | None, placed: Mapping[str, str], names: Sequence[str]
) -> tuple[CameraRow, ...]:
    """The viewpoint of the image configures the first camera: an open one takes it, else one is put before it.

    Args:
        rows: the plan's cameras, in order.
        observed: what the reference image shows, when there is one.
        placed: the relation that places a camera, by its name.
        names: the objects of the plan.
    """
    if observed is None:
        return rows
    if rows:
        first = rows[0]
        view = placed.get(first.name, first.view)
        if view == observed.viewpoint:
            return rows
        if view is None and first.position is None:
            return (first.model_copy(update={"view": observed.viewpoint}), *rows[1:])
    subjects = tuple(v.name for v in observed.visible if v.name in names)
    view_of_image = CameraRow(name=REFERENCE_VIEW, view=observed.viewpoint, subjects=subjects)
    return (view_of_image, *(row for row in rows if row.name != REFERENCE_VIEW))
