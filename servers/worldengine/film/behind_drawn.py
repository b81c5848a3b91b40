"""Which movers stand behind what a film draws of its own, by rays from its camera to their middle and around it."""

from typing import TYPE_CHECKING, Any

from . import thick_puffs

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.stored import Recording
    from .described import Described
    from .hiding import Swaying

PAST_M = 1e-5
"""A ray goes on so far behind a surface that does not count."""
AROUND = 0.6
"""Where, between its middle and its sides, a mover is looked at besides."""
MOST = 3
"""Of the four places around its middle: where so many are covered, it is, though one looks at its middle through a hole."""


def aims(recording: "Recording", movers: list[str]) -> "dict[str, tuple[np.ndarray, np.ndarray]]":
    """Middle and half extents (3,), m, of the box around each mover's shapes, in its frame."""
    from .motion_facts import boxes

    if not movers:
        return {}
    middle, half = boxes(recording)
    return {name: (middle[row], half[row]) for name in movers for row in (recording.names.index(name),)}


def met(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    camera: int,
    film: "Described",
    frame: int,
    movers: "dict[str, tuple[np.ndarray, np.ndarray]]",
    swaying: "Swaying",
    puffed: bool,
) -> list[str]:
    """What covers each mover (`aims`), while rays pass what sways: `ball behind pillar`; puffs only where they are drawn (`puffed`)."""
    import numpy as np

    eye, found = np.array(data.cam_xpos[camera]), []
    skins = {f"drawn.{thing['name']}" for thing in film.things if thing.get("instead")}
    whole = {str(thing["name"]): str(thing["of"]) for thing in film.things if thing.get("of")}
    clouds, laws = (film.puffs, film.clouds) if puffed else ((), ())
    solid = film.things or any(panel["seen"] for panel in film.panels)
    wisps = tuple((law.name, *law.puffs(frame)) for law in laws) if movers else ()

    def before(body: int, to: Any) -> str:
        name = _before(model, data, eye, to, body, skins, swaying)
        return whole.get(name, name)

    for name, (middle, half) in movers.items() if solid or clouds or laws else ():
        body = model.body(name).id
        if solid:
            cover = before(body, data.xipos[body])
            if not cover:
                around = [before(body, place) for place in _around(data, body, middle, half, eye)]
                covered = [one for one in around if one]
                cover = max(covered, key=covered.count) if len(covered) >= MOST else ""
            if cover:
                found.append(f"{name} behind {cover}")
        if cloud := thick_puffs.before(clouds, film.arrays, frame, eye, data.xipos[body], wisps):
            found.append(f"{name} behind {cloud}")
    return found


def _around(
    data: "mujoco.MjData", body: int, middle: "np.ndarray", half: "np.ndarray", eye: "np.ndarray"
) -> "np.ndarray":
    """(4, 3) m: places on a mover beside its middle, above and below, as seen from an eye."""
    import numpy as np

    turn = data.xmat[body].reshape(3, 3)
    centre = data.xpos[body] + turn @ middle
    way = (centre - eye) / max(float(np.linalg.norm(centre - eye)), 1e-9)
    across = np.cross(way, np.eye(3)[int(np.abs(way).argmin())])
    across /= np.linalg.norm(across)
    places = []
    for side in (across, np.cross(way, across)):
        own = turn.T @ side
        far = AROUND * float(np.min(half / np.maximum(np.abs(own), 1e-9)))  # as far as the box goes that way
        places += [centre + far * side, centre - far * side]
    return np.array(places)


def _before(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    eye: "np.ndarray",
    to: "np.ndarray",
    body: int,
    skins: set[str],
    swaying: "Swaying",
) -> str:
    """The drawn thing that a ray to a place on a body meets before that; empty where it meets none."""
    import mujoco
    import numpy as np

    away, hit, gone = float(np.linalg.norm(to - eye)), np.zeros(1, np.int32), 0.0
    way, groups = (to - eye) / max(away, 1e-9), np.array([1, 1, 1, 0, 0, 0], np.uint8)
    near, swayed = swaying.nearest(eye, way, away)
    while gone < away:
        far = mujoco.mj_ray(model, data, eye + gone * way, way, groups, True, -1, hit)
        if far < 0 or gone + far >= near:
            return _called(model.geom(swayed).name) if swayed >= 0 else ""
        geom = model.geom(int(hit[0]))
        drawn = geom.name.startswith("drawn.")
        if int(model.geom_bodyid[geom.id]) != body or (drawn and geom.name not in skins):
            return _called(geom.name) if drawn else ""
        gone += far + PAST_M  # neither the mover itself nor its skin hides it
    return ""


def _called(geom: str) -> str:
    """The name of a drawn thing by that of its geom, which its copies number."""
    return geom.removeprefix("drawn.").split("/")[0]
