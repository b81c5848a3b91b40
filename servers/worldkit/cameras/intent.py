"""What a camera is meant to show, kept in the model so that a compiled world still knows it."""

import json
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

from .views import VIEWS, Vec3

if TYPE_CHECKING:
    import mujoco

PREFIX = "worldkit.camera."


@dataclass(frozen=True)
class Intent:
    """A named view of subjects, or an explicit position and target."""

    view: str | None = None
    subjects: tuple[str, ...] = ()
    """Body names; empty: everything that can move."""
    position: Vec3 | None = None
    target: Vec3 | None = None
    fovy: float = 40.0
    follow: bool = False


def add(
    spec: "mujoco.MjSpec",
    name: str,
    *,
    view: str | None = None,
    subjects: tuple[str, ...] = (),
    position: Vec3 | None = None,
    target: Vec3 | None = None,
    fovy: float = 40.0,
    follow: bool = False,
) -> "mujoco.MjsCamera":
    """Add a fixed camera.

    Args:
        spec: the world; its bodies should be there already, since the first pose is taken from them.
        name: the camera's name.
        view: one of `VIEWS`; `perspective` when neither a view nor a position is given.
        subjects: names of the bodies to frame; empty: everything that can move.
        position: explicit position (m), instead of a view.
        target: what an explicitly placed camera looks at (m); None: its subjects.
        fovy: vertical field of view, degrees.
        follow: keep the subjects centred as they move.

    Raises:
        ValueError: an unknown view or subject; the known ones are listed.
    """
    if view is not None and view not in VIEWS:
        raise ValueError(f"camera {name}: there is no view {view!r}; known: {', '.join(VIEWS)}")
    known = [body.name for body in spec.bodies]
    if missing := [subject for subject in subjects if subject not in known]:
        raise ValueError(
            f"camera {name}: there is no body {', '.join(missing)}; known: {', '.join(known[1:]) or 'none'}"
        )
    intent = Intent(view or (None if position else "perspective"), tuple(subjects), position, target, fovy, follow)
    spec.add_text(name=PREFIX + name, data=json.dumps(asdict(intent)))
    from .framing import first_pose, orientation

    place, aim_at = first_pose(spec, intent)
    return spec.worldbody.add_camera(name=name, pos=place, quat=orientation(place, aim_at), fovy=fovy)


def intents(model: "mujoco.MjModel") -> dict[int, Intent]:
    """The intent of every annotated camera of a compiled model, by camera number."""
    import mujoco

    found = {}
    for number in range(model.ncam):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_CAMERA, number) or ""
        text = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, PREFIX + name)
        if text < 0:
            continue
        start = model.text_adr[text]
        raw = bytes(model.text_data[start : start + model.text_size[text]]).rstrip(b"\0")
        value = json.loads(raw.decode())
        value |= {key: tuple(value[key]) for key in ("subjects", "position", "target") if value[key] is not None}
        found[number] = Intent(**value)
    return found
