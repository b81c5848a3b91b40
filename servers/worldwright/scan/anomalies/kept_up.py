"""Whether what a law says is constant is kept up: a wind of 5 N that blows half of the time is another one, whatever its mean.

Of a trigger that waits for the state of the world and says from when on (`once`, `after`), from its first act on; of one that
may cease to hold (`while`, `when`, `during`, `height < 0.1 m`), that names several times or only a moment (`at t = 2 s`), of a law
with a time of its own (`for 0.5 s`) and of what somebody drives (`live`), nothing is said.
"""

import re
from collections.abc import Iterator

import numpy as np

from ...model.plan import law_words
from ...model.plan.committed import Intervention
from ...model.plan.declaration import owner
from ...model.recording.trajectory import Trajectory
from .declared import SECONDS, times, when
from .sign import Sign

SHARE, SLACK_S = 0.05, 0.05
"""Of the magnitude, and of the time; and how long may be lacking in any case."""
CONSTANT = re.compile(
    r"(?<!spring )(?<!damping )(?<!time )\b(?:constant|steady)\b"
    r"(?!\W+(?:\w+\W+)?(?:speed|velocity|rate|rpm|revolutions|turning|spin|coefficient|density|stiffness)\b)",
    re.IGNORECASE,
)
"""What it exerts; a motor that keeps a constant speed exerts what that takes, and a spring constant is none of it."""
NUMBERS = re.compile(r"\d+(?:\.\d+)?")
LESS = re.compile(r"\b(less|minus|at most|up to|until|while|till|times)\b", re.IGNORECASE)
"""Words by which a law has more to it than its constant."""

MOMENT = re.compile(r"^\s*(?:(?:at|every|start)\b|(?:t\s*=+\s*)?[\d.]+\s*(?:s|ms|seconds?)\W*$)", re.IGNORECASE)
"""Triggers that say when it begins, and not how long it lasts."""
ONSET = re.compile(
    r"^\s*(?:once|after|as soon as|from|since)\b(?!.*\b(?:for|during|to|within|in)\b)", re.IGNORECASE | re.DOTALL
)
"""Triggers by the state of the world that say from when on, and of no end."""


def constant(law: str) -> bool:
    """Whether a law says that what acts is the same all the time."""
    return CONSTANT.search(law) is not None and LESS.search(law) is None


def check(
    trajectory: Trajectory, row: Intervention, kind: str, targets: np.ndarray, times_s: np.ndarray, sizes: np.ndarray
) -> Iterator[Sign]:
    """Yield each target (N,) on which a push that its law calls constant is less than that for part of its time.

    Args:
        trajectory: the recording.
        row: the plan's declaration.
        kind: `force` or `torque`: the unit that its law is read in.
        targets, times_s, sizes: (N,) on what it acts, when, s, once a step, and how much, N or N·m.
    """
    most, state = law_words.limit(row.law, kind), when(row.trigger) == "state"
    if most is None or not constant(row.law) or SECONDS.search(row.law) or row.live is not None:
        return
    if state and (LESS.search(row.trigger) or not ONSET.match(row.trigger)):
        return
    if when(row.trigger) == "time" and (MOMENT.match(row.trigger) or len(NUMBERS.findall(row.trigger)) > 2):
        return
    step, (since, until) = trajectory.time_step or trajectory.interval_s, times(row.trigger)
    for target in np.unique(targets):
        own = targets == target
        begin = max(float(trajectory.t[0]), since, float(times_s[own].min()) if state else -np.inf)
        end = min(float(trajectory.t[-1]), until)
        full = own & (np.abs(sizes - most) <= SHARE * most + 1e-6) & (times_s > begin - 1e-9) & (times_s < end - 1e-9)
        lacks = end - begin - step * len(np.unique(np.round(times_s[full] / step)))
        if lacks > max(SLACK_S, SHARE * (end - begin)):
            message = (
                f"the {kind} on {target} is less than its law says for {lacks:.3g} of {end - begin:.3g} s: {row.law}"
            )
            window = (float(trajectory.t[0]), float(trajectory.t[-1]))
            yield Sign(owner(str(target)), window, lacks, SLACK_S, "s", "blocking", message)
