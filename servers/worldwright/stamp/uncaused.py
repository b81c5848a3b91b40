"""What speaks against a cause already without it, told with the claims: before a film is drawn of what will have to change.

The whole audit, which also weakens each cause and switches each intervention off, comes beside the pictures. Of a short physics
the repetitions without each cause cost seconds, and most of what the audit refuses is seen in them.
"""

from ..model.evidence.run import Run
from ..model.progress import Progress
from . import audited
from .state import State

WITHIN_S = 30.0
"""Where all of them would take longer, the claims are told without them."""


def wrong(run: Run, left_s: float, progress: Progress) -> list[str]:
    """The blocking findings, one line each, as far as they are known within `left_s` s.

    None where no objective names a cause, or the audit stands already.
    """
    state = State(run)
    physics = state.passes["physics"].value
    named = any(objective.cause for objective in (state.plan.objectives if state.plan else ()))
    if physics is None or not named or audited.standing(state, state.causes) in ("holds", "fails"):
        return []
    from ..scan.tools import without_causes

    return without_causes(run, physics.wall_s, WITHIN_S, left_s, progress)
