"""What a description needs to count: it describes every picture, uses names that exist, and observes something of each.

A description by measurement counts pixels and looks at nothing. Until somebody has described the pictures by looking at
them, the stamp lists what only a picture can show as not looked at.
"""

from collections.abc import Iterator

from ..model.evidence.reports import VisualDescription
from . import recognition
from .refusal import Refusal
from .state import State


def problems(state: State, description: VisualDescription) -> Iterator[Refusal]:
    """Refusals for names that do not exist and for subjects without an observation; they reveal only what is in the pictures."""
    pictured = _pictured(state)
    if not description.summary.strip():
        yield Refusal(cause="the summary is empty", next_move="say in a sentence what is seen")
    for camera in pictured:
        if not description.cameras.get(camera, "").strip():
            yield Refusal(
                cause=f"nothing is observed of camera `{camera}`", next_move="describe each camera under `cameras`"
            )
    for camera in description.cameras:
        if camera not in pictured:
            yield Refusal(
                cause=f"no picture is of a camera `{camera}`", next_move=f"the cameras: {', '.join(pictured)}"
            )
    yield from recognition.unnamed(description, pictured)
    bodies = _bodies(state)
    objects = bodies | set(state.plan.object_names() if state.plan else ())
    listed = f"name objects as: {', '.join(sorted(bodies - {'world'}))}"
    if not description.objects:
        yield Refusal(cause="no object is described", next_move=f"describe what is seen under `objects`; {listed}")
    for name, seen in description.objects.items():
        if name not in objects:
            yield Refusal(cause=f"there is no object `{name}`", next_move=listed)
        elif not seen.strip():
            yield Refusal(cause=f"nothing is observed of object `{name}`", next_move="say what is seen of it")


def by_eye(state: State) -> tuple[int, ...]:
    """The objectives that only a picture can show, by index."""
    return tuple(i for i, o in enumerate(state.plan.objectives if state.plan else ()) if o.visual_only)


def _pictured(state: State) -> list[str]:
    """The cameras of which this key has a still or a film."""
    found = {path.stem for path in (state.folder / "stills").glob("*.png")}
    return sorted(found | {path.stem for path in (state.folder / "video").glob("*.mp4")})


def _bodies(state: State) -> set[str]:
    """The bodies that some still shows, by segmentation."""
    import json

    try:
        seen = json.loads((state.folder / "stills" / "visibility.json").read_bytes())
        return {str(body) for shown in seen.values() for body in shown}
    except (OSError, ValueError, AttributeError, TypeError):
        return set()
