"""Films with a known fault, made by code from three small worlds that are simulated when they are needed.

| fault | how it is planted | what a judge must say No to |
|---|---|---|
| `sound` | none | nothing |
| `frozen` | the first moment, shown all the time | the event |
| `reversed` | the recorded moments in the opposite order | the event |
| `missing` | the thing that moves is not drawn | the objects, the event |
| `passing` | what it meets no longer holds it: simulated anew without that contact | the event, that nothing passes through |
| `recoloured` | the thing is drawn in another colour than the criteria name | the objects |

Of each film only those fields count that its fault decides, besides all fields of a sound one.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, get_args

from .criteria import EVENT, OBJECTS, Criteria, Scenario
from .entrants import Entrant

if TYPE_CHECKING:
    import mujoco
    import numpy as np

Fault = Literal["sound", "frozen", "reversed", "missing", "passing", "recoloured"]
FAULTS: tuple[Fault, ...] = get_args(Fault)
FRAMES, FPS = 24, 12
WIDTH, HEIGHT = 320, 240
SEPARATOR = "-"


@dataclass(frozen=True)
class Small:
    """A world of one thing that does one thing."""

    name: str
    xml: str
    seconds: float
    thing: str
    """The geom that moves first."""
    meets: str
    """The geom that holds it, or that it hits."""
    other_rgba: tuple[float, float, float, float]
    criteria: Criteria
    """Its second standard says that nothing passes through."""


HEAD = """<mujoco><option timestep="0.002"/><visual><headlight ambient=".4 .4 .4" diffuse=".5 .5 .5"/>
<quality shadowsize="512" offsamples="2"/></visual>
<asset><texture name="sky" type="skybox" builtin="flat" rgb1=".8 .87 .95" width="8" height="8"/>
<texture name="tiles" type="2d" builtin="checker" rgb1=".75 .75 .75" rgb2=".6 .6 .6" width="64" height="64"/>
<material name="tiles" texture="tiles" texrepeat="6 6"/></asset><worldbody><light pos="0 -2 4" dir="0 .4 -1"/>
<camera name="eye" pos="0 -3.4 1.3" xyaxes="1 0 0 0 .26 1"/>
<geom name="ground" type="plane" size="4 4 .1" material="tiles" friction=".25"/>"""
TAIL = "</worldbody></mujoco>"
SMALL = (
    Small(
        "drop",
        HEAD
        + '<body name="thing" pos="0 0 1.45"><freejoint/><geom name="thing" type="sphere" size=".22" rgba=".85 .1 .1 1" '
        + 'solref=".006 1"/></body>'
        + TAIL,
        1.2,
        "thing",
        "ground",
        (0.1, 0.2, 0.9, 1),
        Criteria(
            objects=("a red ball", "a floor of grey tiles"),
            event="the ball falls from the air onto the floor and stays lying on it",
            standards=(
                "the ball moves downwards until it meets the floor, and never rises far by itself",
                "the ball does not sink into the floor or fall through it",
            ),
        ),
    ),
    Small(
        "push",
        HEAD
        + '<body name="thing" pos="-1.3 0 .2"><freejoint/><geom name="thing" type="sphere" size=".2" '
        + 'rgba=".95 .8 .1 1" mass="2"/></body><body name="box" pos=".25 0 .2"><freejoint/>'
        + '<geom name="box" type="box" size=".2 .2 .2" rgba=".1 .3 .85 1" mass="1" friction=".25"/></body>'
        + TAIL,
        1.6,
        "thing",
        "box",
        (0.55, 0.1, 0.7, 1),
        Criteria(
            objects=("a yellow ball", "a blue box"),
            event="the ball rolls from the left against the box and pushes it to the right",
            standards=(
                "the box rests until the ball reaches it",
                "the ball does not pass through the box",
            ),
        ),
    ),
    Small(
        "slide",
        HEAD
        + '<geom name="ramp" type="box" size=".9 .4 .03" pos="0 0 .55" euler="0 30 0" rgba=".45 .3 .15 1" friction=".1"/>'
        + '<body name="thing" pos="-.45 0 1.02" euler="0 30 0"><freejoint/><geom name="thing" type="box" '
        + 'size=".15 .15 .12" rgba=".95 .5 .05 1" friction=".1"/></body>'
        + TAIL,
        1.2,
        "thing",
        "ramp",
        (0.1, 0.6, 0.2, 1),
        Criteria(
            objects=("an orange block", "a brown sloping board"),
            event="the block slides down the board and off its lower end",
            standards=(
                "along the board the block moves downwards only, and faster as it goes",
                "the block stays on top of the board and does not sink through it",
            ),
        ),
    ),
)
START_M_S = {"push": 2.4}
"""Speed along +x at the beginning; it rolls without slip. Worlds that are not named start at rest."""


def expected(fault: Fault, criteria: Criteria) -> dict[str, bool]:
    """The right answers, by field, of those fields that a fault decides."""
    if fault == "sound":
        return dict.fromkeys(criteria.fields, True)
    found = {
        "frozen": {EVENT: False},
        "reversed": {OBJECTS: True, EVENT: False},
        "missing": {OBJECTS: False, EVENT: False},
        "passing": {OBJECTS: True, EVENT: False, "Standard_2": False},
        "recoloured": {OBJECTS: False},
    }
    return found[fault]


def scenarios() -> dict[str, Scenario]:
    """All films by their ids, `drop-frozen` and so on, with what each is judged by."""
    return {
        f"{small.name}{SEPARATOR}{fault}": Scenario(
            id=f"{small.name}{SEPARATOR}{fault}", category=fault, criteria=small.criteria
        )
        for small in SMALL
        for fault in FAULTS
    }


def answers(id: str) -> tuple[Fault, dict[str, bool]]:
    """Of a film by its id: its fault, and the right answers that it decides.

    Raises:
        ValueError: it is none of them.
    """
    name, _, fault = id.partition(SEPARATOR)
    small = next((one for one in SMALL if one.name == name), None)
    if small is None or fault not in FAULTS:
        raise ValueError(f"{id!r} is no film with a planted fault")
    known = next(one for one in FAULTS if one == fault)
    return known, expected(known, small.criteria)


def films(folder: Path) -> dict[str, Entrant]:
    """Simulate, draw and write all films as MP4; returns them by id. Needs an offscreen OpenGL context."""
    from worldengine.film.encode import Video

    made = {}
    for small in SMALL:
        for fault, pictures in drawn(small):
            id = f"{small.name}{SEPARATOR}{fault}"
            path = folder / f"{id}.mp4"
            with Video(path, WIDTH, HEIGHT, FPS) as video:
                for picture in pictures:
                    video.add(picture)
            made[id] = Entrant(path)
    return made


def drawn(small: Small, width: int = WIDTH, height: int = HEIGHT) -> "Iterator[tuple[Fault, list[np.ndarray]]]":
    """Each fault with the frames of its film, uint8 (height, width, 3)."""
    import mujoco

    model = mujoco.MjModel.from_xml_string(small.xml)
    states = recorded(model, small)
    sound = _pictures(model, states, width, height)
    yield "sound", sound
    yield "frozen", [sound[0]] * FRAMES
    yield "reversed", sound[::-1]
    geom = model.geom(small.thing).id
    model.geom_rgba[geom] = (0, 0, 0, 0)
    yield "missing", _pictures(model, states, width, height)
    model.geom_rgba[geom] = small.other_rgba
    yield "recoloured", _pictures(model, states, width, height)
    loose = apart(mujoco.MjModel.from_xml_string(small.xml), small)
    yield "passing", _pictures(loose, recorded(loose, small), width, height)


def apart(model: "mujoco.MjModel", small: Small) -> "mujoco.MjModel":
    """The same world in which the thing and what it meets do not touch; the rest touches as before."""
    thing, meets = model.geom(small.thing).id, model.geom(small.meets).id
    model.geom_contype[:], model.geom_conaffinity[:] = 1, 1
    model.geom_contype[thing], model.geom_conaffinity[thing] = 2, 4
    for geom in range(model.ngeom):
        if geom not in (thing, meets):
            model.geom_conaffinity[geom] |= 2
    return model


def recorded(model: "mujoco.MjModel", small: Small) -> "np.ndarray":
    """The states of its frames, (FRAMES, nq), evenly over its seconds, simulated."""
    import mujoco
    import numpy as np

    data = mujoco.MjData(model)
    speed = START_M_S.get(small.name, 0.0)
    data.qvel[0] = speed
    if speed:
        data.qvel[4] = speed / model.geom(small.thing).size[0]  # it rolls: no slip where it meets the floor
    rows = []
    for number in range(FRAMES):
        while data.time < number * small.seconds / (FRAMES - 1) - 1e-9:
            mujoco.mj_step(model, data)
        rows.append(data.qpos.copy())
    return np.array(rows)


def _pictures(model: "mujoco.MjModel", states: "np.ndarray", width: int, height: int) -> "list[np.ndarray]":
    import mujoco

    from worldengine.film import renderers

    drawing, data = renderers.SEAM.find(renderers.PLAIN).take(model, width, height), mujoco.MjData(model)
    try:
        found = []
        for row in states:
            data.qpos[:] = row
            mujoco.mj_forward(model, data)
            found.append(drawing.image(data, model.camera("eye").id, "video"))
        return found
    finally:
        drawing.close()
