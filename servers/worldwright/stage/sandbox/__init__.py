"""The sandbox ladder: bubblewrap, then Landlock with seccomp, then resource limits alone.

The strongest level that really works here is used, and recorded in the evidence. `WORLDWRIGHT_SANDBOX` picks a level
by name (a weaker one for debugging, or a stronger one to be refused without it).
"""

import os
from functools import lru_cache

from ...model.errors import JobError
from . import bubblewrap, landlock, rlimits
from .confinement import Confinement

LADDER = {"bubblewrap": bubblewrap, "landlock": landlock, "rlimits": rlimits}

__all__ = ["LADDER", "Confinement", "level"]


@lru_cache
def level() -> str:
    """The name of the strongest level that works, found by really running something at each.

    Raises:
        JobError: `WORLDWRIGHT_SANDBOX` names a level that is unknown or does not work here.
    """
    wanted = os.environ.get("WORLDWRIGHT_SANDBOX", "")
    if wanted and wanted not in LADDER:
        raise JobError(
            f"there is no sandbox level '{wanted}'",
            code="refused",
            place="WORLDWRIGHT_SANDBOX",
            next_move=f"use one of: {', '.join(LADDER)}",
        )
    for name in (wanted,) if wanted else LADDER:
        reason = LADDER[name].unusable()
        if not reason:
            return name
        if wanted:
            raise JobError(
                f"the sandbox level '{wanted}' does not work here: {reason}",
                code="refused",
                place="WORLDWRIGHT_SANDBOX",
                next_move="unset WORLDWRIGHT_SANDBOX to use the strongest level that does",
            )
    return "rlimits"
