"""The process that begins the traced film beside other work: `python -m worldwright.traced_beside RUN LOCK`; `stamp.traced_ahead` begins it."""

import os
import sys
from contextlib import suppress

from .model.errors import WorldwrightError
from .model.evidence.run import Run
from .stamp import traced_ahead


def main(folder: str) -> None:
    """Begin it; what keeps it from beginning the pass itself tells whoever asks for it."""
    with suppress(WorldwrightError):
        traced_ahead.trace(Run(folder))


if __name__ == "__main__":
    os.set_inheritable(int(sys.argv[2]), False)  # the lock is this process's own
    main(sys.argv[1])
