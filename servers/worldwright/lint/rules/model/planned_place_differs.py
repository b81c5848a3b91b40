"""A compiled body stands elsewhere than the plan resolved.

What it does: compares where each object starts with its resolved position (the origin of the body, or the centre of the
box around it, whichever is nearer): more than 5 mm apart. Where the plan lets a joint start away from its home, the home
counts.

Why is this bad: the layout was checked for gaps, supports and sight lines; what was built was not.

Use instead: the plan's numbers; to move something, change its predicates and resolve again.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Argued
from ...problem import Problem
from ._planned import THREE, centre, home, opened, places, starts_away

CODE = "WM152"
SEVERITY = "error"
SCOPE = "plan"
ROWS = [{"subject": "mug", "predicate": "PLACE-ON", "object": "ramp", "position": {"x": 0.5, "y": 0.0, "z": 0.25}}]
PLAN: dict[str, object] = {"topology": {"scene_predicates": ROWS}}
SWING: dict[str, object] = {
    "topology": {"scene_predicates": ROWS, "joints": [{"name": "pivot", "type": "hinge", "child": "mug"}]},
    "simulation_parameters": {"initial_motion": {"pivot": {"joint_position": 20}}},
}
RAISED = THREE.replace("qpos='0 0 .3 1 0 0 0 .5 0 .25 1 0 0 0'", "qpos='0 0 .3 1 0 0 0 .349'").replace(
    "qvel='.5 0 0 0 0 0 0 0 0 0 0 0'", "qvel='.5 0 0 0 0 0 0'"
)
RAISED = RAISED.replace("'.5 0 .25'><freejoint/>", "'.5 0 .25'><joint name='pivot' axis='0 1 0' pos='0 0 1'/>")
GOOD: tuple[tuple[str, dict[str, object]], ...] = ((THREE, PLAN), (THREE, {}), (RAISED, SWING))
BAD = (
    (THREE.replace(".5 0 .25", ".5 .3 .25"), PLAN),
    (RAISED, PLAN),
    (RAISED.replace(".5 0 .25", ".5 .3 .25"), SWING),
)
EVIDENCE = Argued("a world simulates wherever its bodies are; only the plan says where they were meant to be")
MOST_M = 5e-3


def check(view: ModelView) -> Iterator[Problem]:
    """Check every object with a resolved position."""
    assert view.plan is not None
    for name, planned in places(view.plan).items():
        body = view.root_named(name)
        if body is None or opened(view.plan, name):
            continue
        away = starts_away(view, view.plan, body)
        options = home(view, body) if away else (view.xpos[body], centre(view, body))
        apart = min(float(np.linalg.norm(place - planned)) for place in options if np.isfinite(place).all())
        if apart > MOST_M:
            here, there = (", ".join(f"{v:.3f}" for v in place) for place in (options[0], planned))
            message = f"{name} starts at ({here}), the plan resolved ({there}): {apart * 1e3:.0f} mm apart"
            yield view.at("body", body, message, "use the plan's position, or resolve the plan again")
