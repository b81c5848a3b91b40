"""Say of each shot which mover stands in the full shadow of what is drawn only, and from where the key light would reach it."""

from functools import partial
from math import cos, radians, sin
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.stored import Recording
    from .described import Described

FAINT = 0.25
"""The strength of a key light under which nobody looks for its shadows."""
MOST_IN_THE_WAY = 8
STEP_DEG = 10


def told(
    model: "mujoco.MjModel", recording: "Recording", film: "Described", fps: float, movers: tuple[str, ...]
) -> list[str]:
    """A sentence for each shot and mover that the key light does not reach in the shot's middle; `model` is the dressed world."""
    import mujoco
    import numpy as np

    from worldkit.settings import STUDIO

    from .renderers.preview.lighting import relight
    from .renderers.preview.scenery import setting_of

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)  # what is drawn only and stands in the world stands there at all times
    time, own, found = np.asarray(recording.time) - recording.time[0], setting_of(model) or STUDIO, []
    for number, shot in enumerate(film.shots, 1):
        frame = shot["first"] + shot["frames"] // 2
        key = relight(own, treated := film.treatments.at(frame / fps)).key
        if treated.light_strength is not None and treated.light_strength < FAINT:
            continue
        row = int(np.abs(time - film.arrays["time"][frame]).argmin())
        for name in (mover for mover in movers if mover in recording.names):
            body, place = model.body(name), np.array(recording.pos[row, recording.names.index(name)], float)
            radius = float(model.geom_rbound[body.geomadr[0] : body.geomadr[0] + body.geomnum[0]].max(initial=0.0))

            in_the_way = partial(_shading, model, data, place, radius, key.elevation_deg)
            if not (thing := in_the_way(key.azimuth_deg)):
                continue
            turns = sorted(range(-180, 180, STEP_DEG), key=abs)
            free = next((key.azimuth_deg + turn for turn in turns if not in_the_way(key.azimuth_deg + turn)), None)
            remedy = (
                "it would from no azimuth at this elevation"
                if free is None
                else f"it would from film.light(azimuth_deg={(free + 180) % 360 - 180:.0f})"
            )
            found.append(
                f"shot {number}: the key light (azimuth {key.azimuth_deg:.0f}, elevation {key.elevation_deg:.0f} degrees) "
                f"does not reach {name!r}, behind {thing!r}: {remedy}"
            )
    return found


def _shading(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    place: "np.ndarray",
    radius: float,
    up_deg: float,
    azimuth_deg: float,
) -> str:
    """What drawn thing hides a light from all of a ball of this radius, or nothing."""
    import numpy as np

    a, e = radians(azimuth_deg), radians(up_deg)
    way = np.array([cos(e) * cos(a), cos(e) * sin(a), sin(e)])
    side = np.array([-sin(a), cos(a), 0.0])
    over = np.cross(way, side)
    thing = ""
    for x, y in ((0, 0), (0.8, 0), (-0.8, 0), (0, 0.8), (0, -0.8)):
        thing = _met(model, data, place + radius * (x * side + y * over), way)
        if not thing:
            return ""
    return thing


def _met(model: "mujoco.MjModel", data: "mujoco.MjData", start: "np.ndarray", way: "np.ndarray") -> str:
    """The name of the first thing that is drawn only and stands in the world along a ray, or nothing."""
    import mujoco
    import numpy as np

    groups, hit = np.array([1, 1, 1, 0, 0, 0], np.uint8), np.zeros(1, np.int32)
    for _ in range(MOST_IN_THE_WAY):
        far = mujoco.mj_ray(model, data, start, way, groups, True, -1, hit)
        if far < 0:
            return ""
        name = model.geom(int(hit[0])).name
        if name.startswith("drawn.") and model.geom_bodyid[hit[0]] == 0:
            return name.removeprefix("drawn.").split("/")[0]
        start = start + way * (far + 1e-4)
    return ""
