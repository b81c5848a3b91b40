"""Bodies that the plan's own expectations prove to rest up to the end: no check denies what they have proved.

An expectation proves rest if it holds for the recording and its own limit of rest is strict: an argument that lets a body
roll on proves what it says, and not this.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...model.errors import WorldwrightError
from ...model.recording.trajectory import Trajectory
from ..objectives.claims import EXPECTATIONS
from .sign import Context

SPEED_M_S, SPEED_SHARE = 0.02, 0.1
"""A body rests below the vocabulary's own speed, or below this share of sqrt(g r), with r its radius."""


def proved(trajectory: Trajectory, context: Context) -> frozenset[str]:
    """Names of the bodies whose claims of rest all hold, and are about rest."""
    said: dict[str, bool] = {}
    for name, arguments in context.rest_claims:
        for body, holds in _judge_claim(trajectory, name, arguments):
            said[body] = said.get(body, True) and holds
    return frozenset(body for body, holds in said.items() if holds)


def _judge_claim(trajectory: Trajectory, name: str, arguments: dict[str, Any]) -> Iterator[tuple[str, bool]]:
    """Each body that a claim names, and whether the claim proves that it rests."""
    entry = EXPECTATIONS[name]
    bodies = [body for body in (arguments.get("body"), *(arguments.get("bodies") or ())) if body in trajectory.names]
    try:
        given = entry.Given.model_validate(arguments)
        with np.errstate(all="ignore"):
            holds = entry.measure(trajectory, given).margin >= 0
    except (WorldwrightError, ValueError):  # what cannot be measured proves nothing
        return
    for body in bodies:
        b = trajectory.index(body)
        speed = max(SPEED_M_S, SPEED_SHARE * float(trajectory.speed_scale[b]))
        strict = getattr(given, "max_speed_m_s", 0.0) <= speed and getattr(given, "max_m", 0.0) <= trajectory.size_m[b]
        yield body, bool(holds and strict)
