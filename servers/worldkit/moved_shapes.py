"""What an author's law moves: points that are only drawn, as a surface of triangles or as grains.

The engine simulates nothing of them. In a picture they lie where the law's points lay (`worldkit.laws`); grains that touch can be
drawn as one skin (`film.surface`).
"""

from typing import TYPE_CHECKING, Any

from . import materials
from .bodies import DRAWN
from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco
    import numpy as np

THIN_M = 2e-4
"""Half of what a surface is thick by itself."""


def surface(spec: "mujoco.MjSpec", name: str, points: Any, triangles: Any, look: str | None = None) -> "mujoco.MjsFlex":
    """Add a surface whose corners a law moves.

    Args:
        spec: the world.
        name: of the flex, as the law's `shown_by` and the plan say it.
        points: (n, 3) m, world frame, where they lie at the start.
        triangles: (f, 3) corners of each, anticlockwise from outside.
        look: a look of the skill materials; None leaves the engine's grey.

    Raises:
        ProgramError: the arrays are no points and triangles.
    """
    import numpy as np

    places, corners = np.asarray(points, float), np.asarray(triangles, int)
    good = places.ndim == 2 and places.shape[1:] == (3,) and corners.ndim == 2 and corners.shape[1:] == (3,)
    if not (good and len(corners) and np.isfinite(places).all() and corners.min() >= 0 and corners.max() < len(places)):
        cause = f"{name} has points of the shape {places.shape} and triangles of the shape {corners.shape}"
        raise ProgramError(cause, f"surface({name})", "give (n, 3) points in m, and (f, 3) numbers of points from 0")
    flex = spec.add_flex(name=name)
    flex.dim, flex.vertbody = 2, ["world"]
    flex.vert, flex.elem = places.ravel().tolist(), corners.ravel().tolist()
    flex.radius, flex.contype, flex.conaffinity = THIN_M, 0, 0
    if look is not None:
        flex.material = [materials.add(spec, look.replace(" ", "_"))]  # MJCF lists them with spaces between
    return flex


def at_rest(model: "mujoco.MjModel", flex: int) -> "np.ndarray":
    """(n, 3) m: the points of a flex as the world is built, world frame."""
    import mujoco
    import numpy as np

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_flex(model, data)
    first = int(model.flex_vertadr[flex])
    return np.array(data.flexvert_xpos[first : first + int(model.flex_vertnum[flex])])


def tube(rings: int, around: int) -> "list[tuple[int, int, int]]":
    """Triangles of a tube of so many rings, each of `around` points anticlockwise as seen from the last one; closed at both ends."""
    sides = [
        triangle
        for a in range(0, (rings - 1) * around, around)
        for i in range(around)
        for j in ((i + 1) % around,)
        for triangle in ((a + i, a + j, a + around + i), (a + j, a + around + j, a + around + i))
    ]
    last = (rings - 1) * around
    caps = [cap for i in range(1, around - 1) for cap in ((0, i + 1, i), (last, last + i, last + i + 1))]
    return sides + caps


def grains(spec: "mujoco.MjSpec", name: str, points: Any, radius: float, look: str | None = None) -> "mujoco.MjsBody":
    """Add grains whose middles a law moves: spheres of a radius, m, of one body of this name, (n, 3) m at the start.

    The body stands in the middle of the box around them, as a plan says where a thing is.
    """
    import mujoco
    import numpy as np

    places = np.asarray(points, float).reshape(-1, 3)
    middle = (places.min(axis=0) + places.max(axis=0)) / 2
    body = spec.worldbody.add_body(name=name, pos=middle)
    skin = {} if look is None else {"material": materials.add(spec, look)}
    for place in (places - middle).tolist():
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(radius, 0, 0), pos=place, **DRAWN, **skin)
    return body
