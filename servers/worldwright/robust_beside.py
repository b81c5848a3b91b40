"""The process that audits robustness beside other work: `python -m worldwright.robust_beside RUN LOCK`.

`scan.audits.unasked_audit` begins it. At its end it writes the run's report anew, if there is one, which then tells in how many of the
worlds each claim holds. What keeps it from its end stands in the run's journal.
"""

import os
import sys

from .model.errors import WorldwrightError
from .model.evidence.run import Run


def main(folder: str) -> None:
    """Make the audit of a run's present recording, and its report anew."""
    from .report import write
    from .scan.tools import finish_robust

    run = Run(folder)
    try:
        if finish_robust(run) and run.report.is_file():
            write(run)
    except WorldwrightError as failed:
        if run.folder.is_dir():
            run.log("scan", "robust_failed", message=str(failed)[:300])


if __name__ == "__main__":
    os.set_inheritable(int(sys.argv[2]), False)  # the lock is this process's own
    main(sys.argv[1])
