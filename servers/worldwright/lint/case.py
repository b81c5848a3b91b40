"""The cases a rule proves itself by: programs that are clean or at fault, and changes to a sound plan."""

from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any

from ..model.plan.committed import Plan

Changes = tuple[dict[str, Any], ...]
"""Cases of a plan rule: each a change to `SOUND_PLAN`."""


@dataclass(frozen=True)
class Case:
    """A program, and the plan it was written for as a change to `SOUND_PLAN` (None: there is no plan)."""

    source: str
    plan: dict[str, Any] | None = field(default_factory=dict)
    path: str = "simulation.py"


SOUND_PLAN: dict[str, Any] = {
    "title": "A crate slides off a ramp",
    "plan_type": "mbs_in_scene",
    "simulation_parameters": {
        "time_step": 0.002,
        "simulation_duration": 3.0,
        "gravity": -9.81,
        "materials": {"wood": {"density": 700, "friction": 0.3, "source": "engineering tables, dry beech"}},
        "masses": {"mug": 0.35},
        "initial_motion": {"crate": {"linear": [0.5, 0.0, 0.0]}},
    },
    "objectives": [
        {"claim": "The crate slides.", "expect": [{"moves": {"body": "crate", "min_m": 0.1}}]},
        {"claim": "The crate is brown.", "visual_only": "a colour has no state"},
    ],
    "implementation_steps": [
        {
            "description": "Build the ramp, the crate and the mug.",
            "scene_objects": ["ramp", "crate"],
            "assets": ["mug"],
            "cameras": ["perspective", "side_minus_y"],
            "motion_expectations": ["crate"],
        }
    ],
    "scene_objects": [
        {"name": "ramp", "primitive": "box", "size": [2.0, 1.0, 0.2], "fixed": True, "dynamic": False},
        {"name": "crate", "primitive": "box", "size": [0.4, 0.3, 0.2], "material": "wood"},
    ],
    "assets": [{"name": "mug", "filename": "mug"}],
    "asset_dimensions": {"mug": 0.1},
    "topology": {
        "scene_predicates": [
            {"subject": "ramp", "predicate": "PLACE-ON-BASE"},
            {"subject": "crate", "predicate": "PLACE-ON", "object": "ramp"},
            {"subject": "mug", "predicate": "PLACE-ON", "object": "ramp"},
        ]
    },
}
"""A plan without faults; a case changes one thing in it."""


def plan_with(change: dict[str, Any]) -> Plan:
    """The sound plan with `change` merged in: mappings are merged, everything else is replaced; None removes a key."""
    return Plan.model_validate(_merged(deepcopy(SOUND_PLAN), change))


def _merged(old: dict[str, Any], change: dict[str, Any]) -> dict[str, Any]:
    for key, value in change.items():
        if value is None:
            old.pop(key, None)
        elif isinstance(value, dict) and isinstance(old.get(key), dict):
            old[key] = _merged(old[key], value)
        else:
            old[key] = value
    return old
