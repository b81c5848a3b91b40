"""The process that makes a proof run beside other work: `python -m worldwright.proof_beside RUN LOCK`; `stamp.proof_ahead` begins it."""

import os
import sys
from contextlib import suppress

from .model.errors import WorldwrightError
from .model.evidence.run import Run
from .stamp import proof_ahead


def main(folder: str) -> None:
    """Prove a run's present world; what speaks against it `accept` tells, when it is asked."""
    with suppress(WorldwrightError):
        proof_ahead.finish(Run(folder))


if __name__ == "__main__":
    os.set_inheritable(int(sys.argv[2]), False)  # the lock is this process's own
    main(sys.argv[1])
