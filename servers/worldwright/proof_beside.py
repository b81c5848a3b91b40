"""The process that makes a proof run beside other work: `python -m worldwright.proof_beside RUN LOCK`; `stamp.proof_ahead` begins it."""

import os
import sys
from contextlib import suppress

from .model.errors import WorldwrightError
from .model.evidence.run import Run
from .stamp import audited, proof_ahead
from .stamp.state import State
from .stamp.steps import one


def main(folder: str) -> None:
    """Prove a run's present world; what speaks against it `accept` tells, when it is asked.

    The worlds a little otherwise, which waited for the processor, begin then, if the run has come to its pictures.
    """
    run = Run(folder)
    with suppress(OSError):
        os.nice(proof_ahead.BEHIND)
    with suppress(WorldwrightError):
        if proof_ahead.finish(run) and all(one(State(run), name).holds for name in audited.BEFORE_ROBUST):
            audited.robust_beside(run)


if __name__ == "__main__":
    os.set_inheritable(int(sys.argv[2]), False)  # the lock is this process's own
    main(sys.argv[1])
