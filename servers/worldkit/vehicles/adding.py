"""Add a vehicle of any kind to a world, and dress it."""

from collections.abc import Callable
from importlib import import_module
from typing import TYPE_CHECKING, Any

from .axles import OnAxles
from .bicycle_numbers import Bicycle
from .two_wheels import add_bicycle
from .wheeled import add_on_axles

if TYPE_CHECKING:
    import mujoco

    from ..joints import Joint

Vehicle = OnAxles | Bicycle
LOOK_COLOUR = "#a31621"
DRESSED = {
    "car": "car_body:dress_car",
    "truck": "heavy_bodies:dress_truck",
    "bus": "heavy_bodies:dress_bus",
    "trailer": "heavy_bodies:dress_trailer",
    "tracked vehicle": "tracked_body:dress_tracked",
    "bicycle": "bicycle_body:dress_bicycle",
}
"""What draws each kind of vehicle: a module beside this one, and its function."""


def add(
    spec: "mujoco.MjSpec",
    vehicle: Vehicle,
    *,
    name: str,
    pos: tuple[float, float, float] = (0.0, 0.0, 0.0),
    yaw_deg: float = 0.0,
    look: str | None = LOOK_COLOUR,
    parent: str | None = None,
    joint: "Joint | None" = None,
) -> "mujoco.MjsBody":
    """Add a vehicle that stands with its wheels on the level through `pos`, m, the point below the middle of its wheelbase.

    The world gets elliptic friction cones with `impratio` 10, without which a car weaves in corners. Use a time step of at
    most 2 ms. `look` is the paint, `#rrggbb`; None leaves the bare boxes, for tests. A trailer hangs by `joint`, a ball at its
    hitch (`Trailer.ball`), on the vehicle `parent`.

    Raises ValueError for a name that is taken.
    """
    import mujoco

    if spec.body(name) is not None:
        raise ValueError(f"there is a body {name!r} already: name this {vehicle.word} otherwise")
    spec.option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    spec.option.impratio = max(spec.option.impratio, 10.0)
    if isinstance(vehicle, Bicycle):
        body = add_bicycle(spec, vehicle, name, pos, yaw_deg)
    else:
        body = add_on_axles(spec, vehicle, name, pos, yaw_deg, parent, joint)
    if look is not None:
        module, _, function = DRESSED[vehicle.word].partition(":")
        dress: Callable[..., Any] = getattr(import_module(f".{module}", __package__), function)
        dress(spec, vehicle, name, look)
    return body
